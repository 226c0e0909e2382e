// SPDX-License-Identifier: MIT
#pragma once

// The BSDF of a shape: its <bsdf> or <ref>, or one for each material that the faces of its mesh name.

#include "plumb/model/shape.h"
#include "scene_file/objects.h"

namespace plumb {

struct ShapeBsdf {
    std::shared_ptr<const Bsdf> bsdf; // null: it could not be made, which has been reported
    std::string name;                 // for people
};

// shape: the element; materials: of what it became.
ShapeBsdf build_shape_bsdf(const Element& shape, FaceMaterials materials, LoadContext& context);

// "mesh 'obj' (scene.xml:3)".
std::string place_name(const Element& element);

} // namespace plumb
