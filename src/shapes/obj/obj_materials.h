// SPDX-License-Identifier: MIT
#pragma once

// The materials that the faces of an OBJ file name. They are only counted: a mesh has one BSDF, the scene file's.

#include <optional>
#include <set>
#include <string_view>

namespace plumb {

class ObjMaterials {
public:
    // `usemtl`: the material of the faces that follow. The text must stay.
    void use(std::string_view name)
    {
        current_ = name;
        is_counted_ = false;
    }
    void add_face()
    {
        if (!is_counted_) count_current();
    }
    void append(const ObjMaterials& next); // of the chunk behind this one
    std::size_t count() const { return names_.size(); }

private:
    void count_current();

    std::set<std::string_view> names_;
    std::optional<std::string_view> current_; // nothing before the first `usemtl`
    bool is_counted_ = false;
    bool has_faces_before_ = false; // the first `usemtl`
};

} // namespace plumb
