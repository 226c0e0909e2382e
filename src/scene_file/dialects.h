// SPDX-License-Identifier: MIT
#pragma once

// Which course's reading of the scene language a file wants.

#include "plumb/dialect.h"
#include "scene_file/document.h"

namespace plumb {

// What the evidence in a file, a <scene> or a <test> of scenes, says: a pure function of it.
struct DialectEvidence {
    DialectName name = DialectName::zaragoza;
    std::string reason;
    // What the readings that the evidence leaves open would change in this picture.
    bool emitters_open = false;
    bool mirror_open = false;
};
DialectEvidence find_dialect(const Element& scene);

// What the command line says about it.
struct DialectWishes {
    std::optional<DialectName> name;
    std::optional<bool> emitters_absorb;
    std::optional<bool> mirrored_view;
    std::optional<float> environment_scale;
};
// The command line's dialect, else the dialect attribute, else the evidence; then what the command line overrides.
Dialect decide_dialect(const Element& scene, const DialectWishes& wishes, Diagnostics& diagnostics);

} // namespace plumb
