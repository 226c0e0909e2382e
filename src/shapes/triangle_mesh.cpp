// SPDX-License-Identifier: MIT
#include "shapes/triangle_mesh.h"

#include "plumb/sampling/sampling.h"
#include "shapes/mesh_parts.h"
#include "shapes/triangle_tangents.h"

#include <algorithm>

namespace plumb {

TriangleMesh::TriangleMesh(const Params& params, const Read& read)
{
    const std::filesystem::path file = params.file("filename");
    const Transform to_world = params.transform("toWorld");
    const bool smooth = params.boolean("smooth", false);
    const bool face_normals = params.boolean("faceNormals", false);
    const bool flip_v = params.boolean("flipV", false);
    const bool flip_normals = params.boolean("flipNormals", false);
    if (smooth && face_normals)
        params.fail("smooth", "and faceNormals cannot both be true: a mesh is smooth or faceted");
    if (params.missing_file()) return;
    mesh_ = read(file);
    if (!mesh_.warning.empty()) params.warn("filename", mesh_.warning);
    if (face_normals) mesh_.normals = {};
    if (flip_v)
        for (Vec2f& uv : mesh_.uvs) uv.y = 1.f - uv.y;
    if (!to_world.is_identity()) apply(to_world);
    if (!measure(params)) return;
    if (!(area_ > 0.f)) throw Error("every triangle of '" + file.string() + "' has an area of 0");
    if (smooth && mesh_.normals.empty()) mesh_.normals = angle_weighted_normals(mesh_);
    if (flip_normals) flip();
    rectangle_ = rectangle();
}

TriangleMesh::TriangleMesh(const Params& params, MeshData mesh) : mesh_(std::move(mesh))
{
    const Transform to_world = params.transform("toWorld");
    const bool flip_normals = params.boolean("flipNormals", false);
    if (!to_world.is_identity()) apply(to_world);
    if (!measure(params)) return;
    if (!(area_ > 0.f)) {
        params.fail("toWorld", "leaves the shape without an area; scale the scene");
        return;
    }
    if (flip_normals) flip();
    rectangle_ = rectangle();
}

// Whether all vertices are numbers; if so, what depends on their places is computed.
bool TriangleMesh::measure(const Params& params)
{
    mesh_.positions.reserve(mesh_.positions.size() + 1); // AccelBuilder
    for (const Vec3f& p : mesh_.positions)
        if (!is_finite(p)) {
            params.fail("toWorld", "moves vertices farther than a 32-bit float can represent");
            return false;
        }

    edge_clearance_ = edge_clearance(largest_coordinate(bounds()));
    double area = 0.0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        const double triangle = triangle_area(i);
        area += triangle;
        if (triangle > 0.0)
            edge_margin_ = std::max(edge_margin_, edge_margin(corners(i).edges(), edge_clearance_));
    }
    area_ = static_cast<float>(area);
    return true;
}

// The other side becomes the front.
void TriangleMesh::flip()
{
    for (Vec3f& n : mesh_.normals) n = -n;
    if (!mesh_.normals.empty()) return;
    for (MeshData::Triangle& t : mesh_.triangles) std::swap(t[1], t[2]);
    corners_turned_ = true;
}

void TriangleMesh::apply(const Transform& to_world)
{
    for (Vec3f& p : mesh_.positions) p = to_world.point(p);
    for (Vec3f& n : mesh_.normals) n = normalize(to_world.normal(n));
}

void TriangleMesh::add_to(AccelBuilder& builder) const
{
    builder.add_triangles(mesh_.positions, mesh_.triangles);
}

SurfacePoint TriangleMesh::surface_at(const RayD& ray, std::uint32_t primitive) const
{
    const TriangleCorners t = corners(primitive);
    const TriangleEdges edges = t.edges();
    const Barycentric b = intersect_triangle(ray, edges);
    const Vec3d normal = triangle_cross(edges);
    const double normal_length = length(normal);

    const Vec3f geometric_normal = normal_length > 0.0
                                       ? front_normal(primitive, normal * (1.0 / normal_length))
                                       : normalize(Vec3f(-ray.direction));
    const Frame shading(shading_normal(primitive, b, geometric_normal));
    const float clearance = triangle_clearance(t, geometric_normal, normal_length);
    SurfacePoint at{position(edges, b), clearance, geometric_normal, primitive, shading, 0, uv(primitive, b)};
    at.barycentric = Vec2f(static_cast<float>(b.u), static_cast<float>(b.v));
    return at;
}

Tangents TriangleMesh::tangents(const SurfacePoint& at) const
{
    const TriangleEdges e = corners(at.primitive).edges();
    if (mesh_.uvs.empty()) { // by the barycentric coordinates
        if (corners_turned_) return {Vec3f(e.edge2), Vec3f(e.edge1)};
        return {Vec3f(e.edge1), Vec3f(e.edge2)};
    }
    const MeshData::Triangle& t = mesh_.triangles[at.primitive];
    return triangle_tangents(e, mesh_.uvs[t[0]], mesh_.uvs[t[1]], mesh_.uvs[t[2]]);
}

void TriangleMesh::prepare_sampling()
{
    if (rectangle_) return; // sampled as a whole
    tree_ = std::make_unique<const TriangleTree>(mesh_);
}

ShapeSample TriangleMesh::sample_area(double u_select, const Vec2f& u) const
{
    if (rectangle_) return sample_rectangle(u.x, u.y, 1.f / area_);
    return sample_triangle(tree_->choose_by_area(u_select), u, 1.f / area_);
}

std::optional<ShapeSample> TriangleMesh::sample_for(const LightReceiver& receiver, double u_select,
                                                    const Vec2f& u) const
{
    const auto choice = tree_->choose(receiver, u_select);
    if (!choice) return std::nullopt;
    const double pdf = choice->probability / triangle_area(choice->triangle);
    return sample_triangle(choice->triangle, u, static_cast<float>(pdf));
}

double TriangleMesh::pdf_for(const LightReceiver& receiver, std::uint32_t primitive) const
{
    const double area = triangle_area(primitive);
    return area > 0.0 ? tree_->probability(receiver, primitive) / area : 0.0;
}

std::optional<ShapeSample> TriangleMesh::sample_solid_angle(const Vec3f& from, const Vec2f& u) const
{
    if (!rectangle_) return std::nullopt;
    const auto place = rectangle_->spherical.sample(from, u);
    if (!place) return std::nullopt;
    return sample_rectangle(place->along_edge1, place->along_edge2, place->pdf);
}

std::optional<float> TriangleMesh::solid_angle_pdf(const Vec3f& from) const
{
    return rectangle_ ? rectangle_->spherical.pdf(from) : std::nullopt;
}

Box3f TriangleMesh::bounds() const
{
    Box3f box;
    for (const Vec3f& p : mesh_.positions) box.extendBy(p); // each belongs to a triangle
    return box;
}

Box3f TriangleMesh::primitive_bounds(std::uint32_t primitive) const
{
    const TriangleCorners t = corners(primitive);
    Box3f box(t.p0);
    box.extendBy(t.p1);
    box.extendBy(t.p2);
    return box;
}

DirectionCone TriangleMesh::normals() const
{
    constexpr double closed_below = 1e-6; // those of a closed mesh cancel, and what is left is rounding
    Vec3d axis(0.0);
    double area = 0.0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        axis += Vec3d(triangle_normal(i)) * triangle_area(i);
        area += triangle_area(i);
    }
    const double size = length(axis);
    if (!(size > closed_below * area)) return {};
    double cosine = 1.0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
        if (triangle_area(i) > 0.0) cosine = std::min(cosine, dot(Vec3d(triangle_normal(i)), axis) / size);
    return cone_about(axis, cosine);
}

std::uint64_t TriangleMesh::memory_bytes() const
{
    std::uint64_t attributes = 0;
    for (const MeshAttribute& attribute : mesh_.attributes)
        attributes += attribute.values.capacity() * sizeof(float);
    return mesh_.positions.capacity() * sizeof(Vec3f) + mesh_.normals.capacity() * sizeof(Vec3f) +
           mesh_.uvs.capacity() * sizeof(Vec2f) + mesh_.triangles.capacity() * sizeof(MeshData::Triangle) +
           attributes + (tree_ ? tree_->memory_bytes() : 0);
}

std::vector<std::string> TriangleMesh::attribute_names() const
{
    std::vector<std::string> names;
    for (const MeshAttribute& attribute : mesh_.attributes) names.push_back(attribute.name);
    return names;
}

std::optional<Color> TriangleMesh::attribute(std::string_view name, const SurfacePoint& at) const
{
    const auto found = std::find_if(mesh_.attributes.begin(), mesh_.attributes.end(),
                                    [&](const MeshAttribute& a) { return a.name == name; });
    if (found == mesh_.attributes.end()) return std::nullopt;
    if (found->per_face) return found->color(at.primitive);
    const MeshData::Triangle& t = mesh_.triangles[at.primitive];
    const auto [u, v] = at.barycentric;
    return found->color(t[0]) * (1.f - u - v) + found->color(t[1]) * u + found->color(t[2]) * v;
}

TriangleMesh::Face TriangleMesh::face(std::uint32_t primitive) const
{
    const TriangleCorners t = corners(primitive);
    const TriangleEdges edges = t.edges();
    const Vec3d normal = triangle_cross(edges);
    const double normal_length = length(normal);
    const Vec3f front = front_normal(primitive, normal * (1.0 / normal_length));
    return {edges, front, triangle_clearance(t, front, normal_length)};
}

std::pair<std::uint32_t, Barycentric> TriangleMesh::MeshRectangle::at(double x, double y) const
{
    std::array<double, 3> weights;
    const bool second = x + y > 1.0;
    if (second) {
        weights[opposite] = x + y - 1.0;
        weights[end1] = 1.0 - y;
        weights[3 - opposite - end1] = 1.0 - x;
    } else {
        weights[first] = 1.0 - x - y;
        weights[(first + 1) % 3] = x;
        weights[(first + 2) % 3] = y;
    }
    return {second, {weights[1], weights[2]}};
}

std::optional<TriangleMesh::MeshRectangle> TriangleMesh::rectangle() const
{
    if (mesh_.triangles.size() != 2) return std::nullopt;
    const auto corner = [&](std::size_t triangle, std::size_t i) {
        return mesh_.positions[mesh_.triangles[triangle][i % 3]];
    };
    const std::array<Face, 2> faces = {face(0), face(1)};
    if (!(dot(faces[0].normal, faces[1].normal) > 0.f)) return std::nullopt;
    for (std::size_t first = 0; first < 3; ++first) {
        const TriangleEdges t(corner(0, first), corner(0, first + 1), corner(0, first + 2));
        const auto spherical = SphericalRectangle::from(t.corner, t.edge1, t.edge2, faces[0].normal);
        if (!spherical) continue;
        const Vec3d fourth = t.corner + t.edge1 + t.edge2;
        const double allowed = SphericalRectangle::tolerance *
                               std::sqrt(std::min(length_squared(t.edge1), length_squared(t.edge2)));
        for (std::size_t i = 0; i < 6; ++i) {
            const std::size_t opposite = i % 3;
            const std::size_t end1 = (opposite + 1 + i / 3) % 3;
            if (corner(1, end1) == corner(0, first + 1) &&
                corner(1, 3 - opposite - end1) == corner(0, first + 2) &&
                length(Vec3d(corner(1, opposite)) - fourth) <= allowed)
                return MeshRectangle{*spherical, faces, first, opposite, end1};
        }
    }
    return std::nullopt;
}

// The point at fractions (x, y) of the rectangle's edges.
ShapeSample TriangleMesh::sample_rectangle(double x, double y, float pdf) const
{
    const auto [primitive, b] = rectangle_->at(x, y);
    return sample_at(primitive, rectangle_->faces[primitive], b, pdf);
}

ShapeSample TriangleMesh::sample_triangle(std::uint32_t primitive, const Vec2f& u, float pdf) const
{
    const Vec2f uv_in_triangle = square_to_triangle(u);
    return sample_at(primitive, face(primitive), {uv_in_triangle.x, uv_in_triangle.y}, pdf);
}

ShapeSample TriangleMesh::sample_at(std::uint32_t primitive, const Face& face, const Barycentric& b,
                                    float pdf) const
{
    return {position(face.edges, b), face.clearance, face.normal, pdf, uv(primitive, b)};
}

Vec3f TriangleMesh::position(const TriangleEdges& edges, const Barycentric& b) const
{
    if (std::min(std::min(b.u, b.v), 1.0 - b.u - b.v) < edge_margin_) [[unlikely]]
        return point_off_edges(edges, b, edge_clearance_);
    return triangle_point(edges, b);
}

double TriangleMesh::triangle_area(std::uint32_t primitive) const
{
    return length(triangle_cross(corners(primitive).edges())) * 0.5;
}

// Zero for triangles without area.
Vec3f TriangleMesh::triangle_normal(std::uint32_t primitive) const
{
    const Vec3d normal = triangle_cross(corners(primitive).edges());
    const double size = length(normal);
    return size > 0.0 ? front_normal(primitive, normal * (1.0 / size)) : Vec3f(0.f);
}

// On the side of the vertex normals.
Vec3f TriangleMesh::front_normal(std::uint32_t primitive, const Vec3d& unit) const
{
    const Vec3f normal(static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z));
    if (mesh_.normals.empty()) return normal;
    const MeshData::Triangle& t = mesh_.triangles[primitive];
    const Vec3f sum = mesh_.normals[t[0]] + mesh_.normals[t[1]] + mesh_.normals[t[2]];
    return dot(sum, normal) < 0.f ? -normal : normal;
}

Vec3f TriangleMesh::shading_normal(std::uint32_t primitive, const Barycentric& b,
                                   const Vec3f& geometric_normal) const
{
    constexpr float shortest = 1e-3f; // below, the three normals cancel and have no direction
    if (mesh_.normals.empty()) return geometric_normal;
    const Vec3f normal = interpolate(mesh_.normals, primitive, b);
    return length_squared(normal) > sqr(shortest) ? normalize(normal) : geometric_normal;
}

Vec2f TriangleMesh::uv(std::uint32_t primitive, const Barycentric& b) const
{
    if (!mesh_.uvs.empty()) return interpolate(mesh_.uvs, primitive, b);
    const auto u = static_cast<float>(b.u), v = static_cast<float>(b.v);
    return corners_turned_ ? Vec2f(v, u) : Vec2f(u, v);
}

} // namespace plumb
