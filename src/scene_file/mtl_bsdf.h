// SPDX-License-Identifier: MIT
#pragma once

// From a material of an MTL file to a <bsdf> of ours. docs/scene-language.md has the mapping as a table.

#include "plumb/shapes/mtl.h"
#include "scene_file/document.h"

namespace plumb {

struct MtlBsdf {
    Element bsdf;
    std::vector<std::string>
        remarks; // what is approximated or left out, for a warning that names materials first
};

// at: whose place the element has. directory: that images are relative to; those that do not exist are left out.
MtlBsdf bsdf_of_mtl(const MtlMaterial& material, const Element& at, const std::filesystem::path& directory);

} // namespace plumb
