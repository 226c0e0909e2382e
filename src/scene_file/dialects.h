// SPDX-License-Identifier: MIT
#pragma once

// Which course's reading of the scene language a file wants.

#include "scene_file/marks.h"

#include <filesystem>

namespace plumb {

class Scene;

// What the marks in a file, a <scene> or a <test> of scenes, say: a pure function of them.
struct DialectEvidence {
    DialectName name = DialectName::plumb; // also where nothing decides, or marks contradict each other
    std::string reason;
    bool has_second_mark = false;      // independent of the first: enough for a mirrored view or a scaled map
    std::vector<DialectName> suspects; // that have some of the marks, where these do not decide
};
// beside: the scene files in the same directory, which are asked if the file itself says nothing.
DialectEvidence find_dialect(const Element& root, const std::vector<Element>& beside = {});

// The other scene files in a directory, in the order of their names, for find_dialect(). None if there are very many, or
// if one of them names its dialect: who knows the attribute leaves it out on purpose.
std::vector<Element> scene_files_beside(const std::filesystem::path& scene);

// What the command line says about it.
struct DialectWishes {
    std::optional<DialectName> name;
    std::optional<bool> emitters_absorb;
    std::optional<bool> mirrored_view;
    std::optional<float> environment_scale;
};

struct DialectChoice {
    Dialect dialect;
    std::optional<DialectEvidence> evidence; // nothing where the command line or the file names the dialect
};

// The command line's dialect, else the dialect attribute, else the evidence; then what the command line overrides.
DialectChoice choose_dialect(const Element& root, const DialectWishes& wishes, Diagnostics& diagnostics);

// Warns of what other readings, which the evidence leaves open and the command line does not close, would change in
// this image. scene: that was built of the root; null for a <test>, which has no view.
void warn_of_open_readings(const Element& root, const DialectChoice& choice, const DialectWishes& wishes,
                           const Scene* scene, Diagnostics& diagnostics);

} // namespace plumb
