// SPDX-License-Identifier: MIT
#pragma once

// What meshes need whatever file they come from.

#include "plumb/shapes/mesh.h"
#include "shapes/triangle.h"

#include <functional>
#include <memory>
#include <span>

namespace plumb {

// The whole of a file, with `padding` more bytes behind it, which are not set.
struct FileBytes {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0; // without the padding

    std::span<const char> view() const { return {bytes.get(), size}; }
};
FileBytes read_file_bytes(const std::filesystem::path& path, std::size_t padding = 0); // throws Error

// Calls part(i) for all i, on all threads, and throws what the first of those that failed has thrown.
void in_parallel_or_throw(std::size_t count, const std::function<void(std::size_t)>& part);

// Positions are finite and at most this large: their differences and products fit into single precision.
inline constexpr float largest_position = 1e18f;

// Makes a mesh as read from a file one as MeshData says: normals get unit length, those of length zero are that of the
// surface around; triangles without area and vertices without a triangle go. Says so in `warning`; throws Error if no
// triangle is left. Indices must be in range.
void tidy_mesh(MeshData& mesh);

// For each vertex the sum of its triangles' normals, each times the triangle's angle there (Thuermer and Wuethrich 1998,
// "Computing Vertex Normals from Polygonal Facets"), of unit length; +z for vertices without a direction.
std::vector<Vec3f> angle_weighted_normals(const MeshData& mesh);

// Of the point of the triangle's plane that is nearest to `point`.
Barycentric barycentric_of(const TriangleEdges& triangle, const Vec3f& point);

} // namespace plumb
