// SPDX-License-Identifier: MIT
#pragma once

// Where an OBJ file is wrong, and words for it.

#include "shapes/obj/obj_scan.h"

namespace plumb {

// The names of what indices count.
struct IndexKind {
    const char* one;
    const char* many;

    std::string counted(std::size_t count) const
    {
        if (count == 0) return std::string("no ") + many;
        return std::to_string(count) + " " + (count == 1 ? one : many);
    }
};
inline constexpr IndexKind position_indices{"vertex", "vertices"};
inline constexpr IndexKind uv_indices{"texture coordinate", "texture coordinates"};
inline constexpr IndexKind normal_indices{"normal", "normals"};

// Throws FileError. at: a part of the file's text.
[[noreturn]] void fail_obj(const ObjFile& file, std::string_view at, const std::string& message);

} // namespace plumb
