// SPDX-License-Identifier: MIT
#pragma once

// The values of Mitsuba's files in our syntax. All but mitsuba_syntax() are converters of one parameter, whose tag and
// name are ours already; false: reported, and left out (vocabulary.h).

#include "scene_file/vocabulary.h"

namespace plumb {

// Separators, x= y= z=, matrices of 9 numbers, spectra that are objects. Tags are the file's.
bool mitsuba_syntax(Element& element, Diagnostics& diagnostics);

// Numbers, <rgb> and spectra as a <color>: of light, of what reflects, of indices of refraction.
bool color_of_emission(Element& parameter, Diagnostics& diagnostics);
bool color_of_reflectance(Element& parameter, Diagnostics& diagnostics);
bool color_of_index(Element& parameter, Diagnostics& diagnostics);
// Also of a colour: its luminance.
bool to_number(Element& parameter, Diagnostics& diagnostics);

bool only_if_true(Element& parameter, Diagnostics& diagnostics); // false is as if it were not there
bool only_rgb(Element& parameter, Diagnostics& diagnostics);     // left out; a warning for other than RGB
// What depth_minus_one makes of 0, which is a black image: order_mitsuba() makes it one.
inline constexpr std::string_view no_light = "-2";
bool depth_minus_one(Element& parameter,
                     Diagnostics& diagnostics); // a number of path segments as one of bounces
bool index_by_name(Element& parameter, Diagnostics& diagnostics); // "bk7" as 1.5046
bool millimetres(Element& parameter, Diagnostics& diagnostics);   // "50mm" as 50
bool without_scale(Element& parameter, Diagnostics& diagnostics); // a transform, which must not scale
bool position_of(Element& parameter, Diagnostics& diagnostics);   // where a transform moves the origin
bool direction_of(Element& parameter, Diagnostics& diagnostics);  // where a transform turns +z

} // namespace plumb
