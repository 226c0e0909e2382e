// SPDX-License-Identifier: MIT
#pragma once

// What students' forks of Nori call things in their final projects: the words that no course hands out. Where the forks
// disagree, the majority's reading counts; docs/scene-language.md names it, and the parameter that changes it.

#include "scene_file/vocabulary.h"

namespace plumb {

// Why an integrator of ours may stand for theirs.
inline constexpr std::string_view other_way =
    "this is rendered by 'path_mis', which finds the same light up to noise";
inline constexpr std::string_view no_media =
    "this is rendered by 'path_mis': in a scene without media the light is the same";

// For Vocabulary::base of the courses' words.
extern const Vocabulary fork_words;

// The type that a name means whose words are all known, such as volumetric_photon_mapper; or null. For Vocabulary::guess.
const TypeName* guess_fork_type(std::string_view kind, std::string_view theirs);

// Converters of one parameter (vocabulary.h).
bool angle_of_cosine(Element& parameter,
                     Diagnostics& diagnostics);                   // in [-1, 1] a cosine; else degrees already
bool to_fraction(Element& parameter, Diagnostics& diagnostics);   // limited to [0, 1], with a warning
bool negated(Element& parameter, Diagnostics& diagnostics);       // false for true
bool image_of(Element& parameter, Diagnostics& diagnostics);      // a file's name as a texture
bool grey_color(Element& parameter, Diagnostics& diagnostics);    // a number as a colour
bool data_image_of(Element& parameter, Diagnostics& diagnostics); // the same, without decoding sRGB
bool uv_scale(Element& parameter, Diagnostics& diagnostics);      // numbers as a toUv that scales
bool u_scale(Element& parameter, Diagnostics& diagnostics);
bool v_scale(Element& parameter, Diagnostics& diagnostics);
bool uv_shift(Element& parameter, Diagnostics& diagnostics); // numbers as a toUv that moves
bool u_shift(Element& parameter, Diagnostics& diagnostics);
bool v_shift(Element& parameter, Diagnostics& diagnostics);

// What takes more than one parameter: textures of normals and heights become BSDFs, a parallelogram becomes a rectangle,
// an environment takes the image of its texture and stands in no shape. For Vocabulary::order.
void order_forks(Element& root, Diagnostics& diagnostics);

} // namespace plumb
