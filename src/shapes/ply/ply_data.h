// SPDX-License-Identifier: MIT
#pragma once

// The data of a PLY file, behind its header: numbers go where the caller wants them, lists of corners into chunks.

#include "shapes/ply/ply_header.h"

#include <limits>
#include <span>

namespace plumb {

// Where the values of one property go: that of element i to first[i * stride], multiplied by `scale`. Null: nowhere.
struct PlyTarget {
    float* first = nullptr;
    std::size_t stride = 1;
    float scale = 1.f;
    float largest = std::numeric_limits<float>::max(); // of their absolute values
};

// Corners of consecutive faces. ends is empty where all of them are triangles; else face i ends at corner ends[i].
struct PlyFaces {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> ends;

    void add_face() // of the corners since the last one
    {
        if (ends.empty() && corners.size() % 3 == 0 && corners.size() == 3 * (count_ + 1)) {
            ++count_;
            return;
        }
        if (ends.empty())
            for (std::size_t i = 1; i <= count_; ++i) ends.push_back(static_cast<std::uint32_t>(3 * i));
        ends.push_back(static_cast<std::uint32_t>(corners.size()));
        ++count_;
    }
    void add_triangles(std::size_t count) { count_ += count; } // whose corners have been added
    std::size_t count() const { return count_; }

private:
    std::size_t count_ = 0;
};

// How to read one element.
struct PlyPlan {
    const PlyElement* element = nullptr;
    std::vector<PlyTarget> targets;                                // one a property
    std::size_t corners = std::numeric_limits<std::size_t>::max(); // the property that lists corners, if any
    std::uint32_t vertices = 0;                                    // corners must be less
    bool has_corners() const { return corners < element->properties.size(); }
};

struct PlyFile {
    std::string name;
    std::string_view bytes;
    PlyHeader header;
};

// Read the elements as planned, in their order; chunks of faces in theirs. Return how many bytes or lines stand behind the
// last element. Throw Error and FileError.
std::size_t read_ply_text(const PlyFile& file, std::span<const PlyPlan> plans, std::vector<PlyFaces>& faces);
std::size_t read_ply_binary(const PlyFile& file, std::span<const PlyPlan> plans,
                            std::vector<PlyFaces>& faces);

} // namespace plumb
