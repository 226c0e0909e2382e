// SPDX-License-Identifier: MIT
#pragma once

// The faces of an OBJ file, as its scanner reads them.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

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

// From this face on, up to the next run: an index into FaceMaterials::names, or FaceMaterials::none.
struct ObjMaterialRun {
    std::size_t first_face = 0;
    std::uint32_t material = 0;
};

struct ObjFaces {
    ObjCorners corners;                    // of all faces, one after the other
    std::vector<std::uint32_t> ends;       // face i ends before corner ends[i]
    std::vector<ObjMaterialRun> materials; // empty: all of the file's faces have the same
    bool any_uv = false;
    bool all_uv = true;
    bool any_normal = false;

    void add_corner(const ObjCorner& corner)
    {
        any_uv |= corner.uv >= 0;
        all_uv &= corner.uv >= 0;
        any_normal |= corner.normal >= 0;
        corners.push_back(corner);
    }
    void end_face() { ends.push_back(static_cast<std::uint32_t>(corners.size())); }
};

} // namespace plumb
