// SPDX-License-Identifier: MIT
#pragma once

// The faces of an OBJ file, on their way from the scanner, which checks them, through tinyobjloader, which reads them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace plumb {

// Consecutive `f` lines that passed every check but the upper end of their indices, and what came before them in the
// file: negative indices count back from there. Without the last line's end.
struct ObjFaceBlock {
    std::string_view text;
    std::size_t first_face = 0; // counted from the first block
    std::int32_t positions_before = 0;
    std::int32_t uvs_before = 0;
    std::int32_t normals_before = 0;
};

// Indices count from 0; -1: the corner has none. They may still be too large.
struct ObjCorner {
    std::int32_t position = -1;
    std::int32_t uv = -1;
    std::int32_t normal = -1;
    friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};

// Corners one after the other. What none of them has takes no memory.
class ObjCorners {
public:
    void push_back(const ObjCorner& corner)
    {
        push_back(uvs_, corner.uv);
        push_back(normals_, corner.normal);
        positions_.push_back(corner.position);
    }

    std::size_t size() const { return positions_.size(); }
    ObjCorner operator[](std::size_t i) const
    {
        return {positions_[i], uvs_.empty() ? -1 : uvs_[i], normals_.empty() ? -1 : normals_[i]};
    }

private:
    void push_back(std::vector<std::int32_t>& indices, std::int32_t index) const
    {
        if (indices.empty() && index == -1) return;
        if (indices.empty()) indices.assign(positions_.size(), -1);
        indices.push_back(index);
    }

    std::vector<std::int32_t> positions_;
    std::vector<std::int32_t> uvs_;     // as many, or none
    std::vector<std::int32_t> normals_; // likewise
};

struct ObjFaces {
    ObjCorners corners;              // of all faces, one after the other
    std::vector<std::uint32_t> ends; // face i ends before corner ends[i]
    bool any_uv = false;
    bool all_uv = true;
    bool any_normal = false;
};

ObjFaces read_obj_faces(std::span<const ObjFaceBlock> blocks);

} // namespace plumb
