// SPDX-License-Identifier: MIT
#include "shapes/mesh_parts.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/regular_file.h"
#include "plumb/base/error.h"
#include "plumb/math/elementary.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 20; // bytes of a file
constexpr std::size_t max_size = std::size_t{8} << 30;   // so that the number of lines fits an index
constexpr std::size_t triangles_at_a_time = std::size_t{1} << 16;

bool has_area(const MeshData& mesh, const MeshData::Triangle& t)
{
    const TriangleEdges edges(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    return triangle_cross(edges) != Vec3d(0.0);
}

void add_warning(MeshData& mesh, const std::string& text)
{
    mesh.warning += (mesh.warning.empty() ? "" : "; ") + text;
}

// Keeps values[i] (`width` of them each) where keep(i).
template <class T, class Keep>
void keep_only(std::vector<T>& values, std::size_t width, const Keep& keep)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size() / width; ++i) {
        if (!keep(i)) continue;
        for (std::size_t k = 0; k < width; ++k) values[kept * width + k] = values[i * width + k];
        ++kept;
    }
    values.resize(kept * width);
}

void drop_flat_triangles(MeshData& mesh)
{
    const std::size_t count = mesh.triangles.size();
    std::vector<char> good(count);
    std::vector<std::size_t> flat((count + triangles_at_a_time - 1) / triangles_at_a_time);
    parallel_for(flat.size(), 0, [&](std::size_t chunk) {
        const std::size_t end = std::min((chunk + 1) * triangles_at_a_time, count);
        for (std::size_t i = chunk * triangles_at_a_time; i < end; ++i) {
            good[i] = has_area(mesh, mesh.triangles[i]);
            flat[chunk] += good[i] ? 0 : 1;
        }
    });
    std::size_t dropped = 0;
    for (const std::size_t n : flat) dropped += n;
    if (dropped == count) throw Error("no face has an area");
    if (dropped == 0) return;
    const auto keep = [&](std::size_t i) { return good[i] != 0; };
    keep_only(mesh.triangles, 1, keep);
    for (MeshAttribute& attribute : mesh.attributes)
        if (attribute.per_face) keep_only(attribute.values, attribute.channels, keep);
    add_warning(mesh, dropped == 1 ? std::string("1 triangle has no area and was discarded")
                                   : fmt::format("{} triangles have no area and were discarded", dropped));
}

void drop_unused_vertices(MeshData& mesh)
{
    std::vector<char> used(mesh.positions.size());
    for (const MeshData::Triangle& t : mesh.triangles)
        for (const std::uint32_t corner : t) used[corner] = 1;
    if (std::find(used.begin(), used.end(), 0) == used.end()) return;

    std::vector<std::uint32_t> numbers(used.size());
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        numbers[i] = kept;
        kept += used[i] ? 1u : 0u;
    }
    const auto keep = [&](std::size_t i) { return used[i] != 0; };
    keep_only(mesh.positions, 1, keep);
    keep_only(mesh.normals, 1, keep);
    keep_only(mesh.uvs, 1, keep);
    for (MeshAttribute& attribute : mesh.attributes)
        if (!attribute.per_face) keep_only(attribute.values, attribute.channels, keep);
    for (MeshData::Triangle& t : mesh.triangles)
        for (std::uint32_t& corner : t) corner = numbers[corner];
}

void normalize_normals(MeshData& mesh)
{
    std::size_t without = 0;
    std::vector<Vec3f> own;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        Vec3f& normal = mesh.normals[i];
        if (max_component(abs(normal)) > 0.f) {
            normal = Vec3f(normalize(Vec3d(normal)));
            continue;
        }
        if (own.empty()) own = angle_weighted_normals(mesh);
        normal = own[i];
        ++without;
    }
    if (without > 0)
        add_warning(mesh, fmt::format("{} of {} normals have length zero, where those of the faces are used",
                                      without, mesh.normals.size()));
}

double angle_between(const Vec3d& a, const Vec3d& b)
{
    return atan2(length(cross(a, b)), dot(a, b));
}

} // namespace

FileBytes read_file_bytes(const std::filesystem::path& path, std::size_t padding)
{
    const RegularFile file(path);
    const std::uintmax_t size = file.size();
    if (size == 0) file.fail("the file is empty");
    if (size > max_size) file.fail("files of more than 8 GiB are not supported");

    FileBytes content{std::make_unique_for_overwrite<char[]>(size + padding), size};
    prefer_large_pages(content.bytes.get(), size + padding);
    in_parallel_or_throw((size + chunk_size - 1) / chunk_size, [&](std::size_t i) {
        const std::size_t begin = i * chunk_size;
        file.read(begin, {content.bytes.get() + begin, std::min(chunk_size, size - begin)});
    });
    return content;
}

void in_parallel_or_throw(std::size_t count, const std::function<void(std::size_t)>& part)
{
    std::vector<std::exception_ptr> problems(count);
    parallel_for(count, 0, [&](std::size_t i) {
        try {
            part(i);
        } catch (...) {
            problems[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& problem : problems)
        if (problem) std::rethrow_exception(problem);
}

void tidy_mesh(MeshData& mesh)
{
    drop_flat_triangles(mesh);
    drop_unused_vertices(mesh);
    normalize_normals(mesh);
}

std::vector<Vec3f> angle_weighted_normals(const MeshData& mesh)
{
    std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
    for (const MeshData::Triangle& t : mesh.triangles) {
        const Vec3d corners[3] = {Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                                  Vec3d(mesh.positions[t[2]])};
        const Vec3d crossed = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double size = length(crossed);
        if (!(size > 0.0)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d& corner = corners[i];
            const double angle = angle_between(corners[(i + 1) % 3] - corner, corners[(i + 2) % 3] - corner);
            sums[t[i]] += crossed * (angle / size);
        }
    }
    std::vector<Vec3f> normals;
    normals.reserve(sums.size());
    for (const Vec3d& sum : sums) {
        const double size = length(sum);
        normals.push_back(size > 0.0 ? Vec3f(sum / size) : Vec3f(0.f, 0.f, 1.f));
    }
    return normals;
}

Barycentric barycentric_of(const TriangleEdges& triangle, const Vec3f& point)
{
    const Vec3d normal = triangle_cross(triangle);
    const Vec3d from_corner = Vec3d(point) - triangle.corner;
    const double scale = 1.0 / length_squared(normal);
    const double u = dot(cross(from_corner, triangle.edge2), normal) * scale;
    const double v = dot(cross(triangle.edge1, from_corner), normal) * scale;
    if (!std::isfinite(u) || !std::isfinite(v)) return {1.0 / 3.0, 1.0 / 3.0};
    return {u, v};
}

} // namespace plumb
