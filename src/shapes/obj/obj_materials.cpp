// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_materials.h"

namespace plumb {

void ObjMaterials::count_current()
{
    is_counted_ = true;
    if (current_)
        names_.insert(*current_);
    else
        has_faces_before_ = true;
}

void ObjMaterials::append(const ObjMaterials& next)
{
    if (next.has_faces_before_) add_face();
    names_.insert(next.names_.begin(), next.names_.end());
    if (!next.current_) return;
    current_ = next.current_;
    is_counted_ = next.is_counted_;
}

} // namespace plumb
