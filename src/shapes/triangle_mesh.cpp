// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/distribution.h"
#include "plumb/sampling/sampling.h"
#include "plumb/shapes/mesh.h"
#include "shapes/spherical_rectangle.h"
#include "shapes/triangle.h"
#include "shapes/triangle_tangents.h"

#include <utility>

namespace plumb {

/// A triangle mesh from a Wavefront OBJ file. Faces with more than three corners become triangles.
///
/// The front side of a triangle, which emitters shine from, is the one that its vertex normals point to; without
/// normals, the one from which its corners run counter-clockwise. Normals are interpolated for shading; without
/// them the mesh is faceted. Without texture coordinates, uv are the barycentric coordinates of the second and
/// third corner. toWorld may mirror: normals go through its inverse transpose, and the side follows them.
///
///     filename   string      the OBJ file, relative to the scene file   (required)
///     toWorld    transform   from the file's coordinates to the world   (default: the identity)
///
///         <mesh type="obj">
///             <string name="filename" value="meshes/teapot.obj"/>
///             <transform name="toWorld"><translate value="0, 1, 0"/></transform>
///         </mesh>
class TriangleMesh final : public Shape {
public:
    explicit TriangleMesh(const Params& params)
    {
        const std::filesystem::path file = params.file("filename");
        const Transform to_world = params.transform("toWorld");
        if (params.missing_file()) return;
        mesh_ = read_obj(file);
        mesh_.positions.reserve(mesh_.positions.size() + 1); // AccelBuilder
        if (!mesh_.warning.empty()) params.warn("filename", mesh_.warning);
        if (!to_world.is_identity()) apply(to_world);
        for (const Vec3f& p : mesh_.positions)
            if (!is_finite(p)) {
                params.fail("toWorld", "moves vertices farther than a 32-bit float can represent");
                return;
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
        if (!(area_ > 0.f)) throw Error("every triangle of '" + file.string() + "' has an area of 0");
        rectangle_ = rectangle();
    }

    void add_to(AccelBuilder& builder) const override
    {
        builder.add_triangles(mesh_.positions, mesh_.triangles);
    }

    SurfacePoint surface_at(const Ray& ray, std::uint32_t primitive) const override
    {
        const TriangleCorners t = corners(primitive);
        const TriangleEdges edges = t.edges();
        const Barycentric b = intersect_triangle(ray, edges);
        const Vec3d normal = triangle_cross(edges);
        const double normal_length = length(normal);

        const Vec3f geometric_normal = normal_length > 0.0
                                           ? front_normal(primitive, normal * (1.0 / normal_length))
                                           : normalize(-ray.direction);
        const Frame shading(shading_normal(primitive, b, geometric_normal));
        const float clearance = triangle_clearance(t, geometric_normal, normal_length);
        SurfacePoint at{position(edges, b), clearance, geometric_normal, primitive, shading, 0,
                        uv(primitive, b)};
        at.barycentric = Vec2f(static_cast<float>(b.u), static_cast<float>(b.v));
        return at;
    }

    Tangents tangents(const SurfacePoint& at) const override
    {
        const TriangleEdges e = corners(at.primitive).edges();
        if (mesh_.uvs.empty()) return {Vec3f(e.edge1), Vec3f(e.edge2)}; // by the barycentric coordinates
        const MeshData::Triangle& t = mesh_.triangles[at.primitive];
        return triangle_tangents(e, mesh_.uvs[t[0]], mesh_.uvs[t[1]], mesh_.uvs[t[2]]);
    }

    void prepare_sampling() override
    {
        std::vector<double> areas;
        areas.reserve(mesh_.triangles.size());
        for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) areas.push_back(triangle_area(i));
        choice_ = DiscreteDistribution(areas);
    }

    ShapeSample sample_area(double u_select, const Vec2f& u) const override
    {
        if (rectangle_) return sample_rectangle(u.x, u.y, 1.f / area_);
        const std::uint32_t primitive = choice_.sample(u_select).index;
        const Vec2f uv_in_triangle = square_to_triangle(u);
        const Barycentric b{uv_in_triangle.x, uv_in_triangle.y};
        return sample_at(primitive, face(primitive), b, 1.f / area_);
    }

    std::optional<ShapeSample> sample_solid_angle(const Vec3f& from, const Vec2f& u) const override
    {
        if (!rectangle_) return std::nullopt;
        const auto place = rectangle_->spherical.sample(from, u);
        if (!place) return std::nullopt;
        return sample_rectangle(place->along_edge1, place->along_edge2, place->pdf);
    }

    std::optional<float> solid_angle_pdf(const Vec3f& from) const override
    {
        return rectangle_ ? rectangle_->spherical.pdf(from) : std::nullopt;
    }

    bool has_solid_angle() const override { return rectangle_.has_value(); }

    float area() const override { return area_; }

    Box3f bounds() const override
    {
        Box3f box;
        for (const Vec3f& p : mesh_.positions) box.extendBy(p); // each belongs to a triangle
        return box;
    }

    DirectionCone normals() const override
    {
        Vec3d axis(0.0);
        for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
            axis += Vec3d(triangle_normal(i)) * triangle_area(i);
        const double size = length(axis);
        if (!(size > 0.0)) return {};
        double cosine = 1.0;
        for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
            if (triangle_area(i) > 0.0)
                cosine = std::min(cosine, dot(Vec3d(triangle_normal(i)), axis) / size);
        return cone_about(axis, cosine);
    }

    std::uint64_t triangle_count() const override { return mesh_.triangles.size(); }

    std::uint64_t memory_bytes() const override
    {
        return mesh_.positions.capacity() * sizeof(Vec3f) + mesh_.normals.capacity() * sizeof(Vec3f) +
               mesh_.uvs.capacity() * sizeof(Vec2f) + mesh_.triangles.capacity() * sizeof(MeshData::Triangle);
    }

private:
    // What points of a triangle have in common.
    struct Face {
        TriangleEdges edges;
        Vec3f normal;
        float clearance;
    };

    Face face(std::uint32_t primitive) const
    {
        const TriangleCorners t = corners(primitive);
        const TriangleEdges edges = t.edges();
        const Vec3d normal = triangle_cross(edges);
        const double normal_length = length(normal);
        const Vec3f front = front_normal(primitive, normal * (1.0 / normal_length));
        return {edges, front, triangle_clearance(t, front, normal_length)};
    }

    // Two triangles that make a rectangle, as most lamps do. Its first corner is the right angle of triangle 0, and its
    // edges go to that triangle's next two corners.
    struct MeshRectangle {
        SphericalRectangle spherical;
        std::array<Face, 2> faces;
        std::size_t first;    // in triangle 0
        std::size_t opposite; // in triangle 1
        std::size_t end1;     // the end of edge 1, in triangle 1

        // The primitive and its barycentric coordinates at fractions (x, y) of the edges.
        std::pair<std::uint32_t, Barycentric> at(double x, double y) const
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
    };

    std::optional<MeshRectangle> rectangle() const
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
    ShapeSample sample_rectangle(double x, double y, float pdf) const
    {
        const auto [primitive, b] = rectangle_->at(x, y);
        return sample_at(primitive, rectangle_->faces[primitive], b, pdf);
    }

    ShapeSample sample_at(std::uint32_t primitive, const Face& face, const Barycentric& b, float pdf) const
    {
        return {position(face.edges, b), face.clearance, face.normal, pdf, uv(primitive, b)};
    }

    void apply(const Transform& to_world)
    {
        for (Vec3f& p : mesh_.positions) p = to_world.point(p);
        for (Vec3f& n : mesh_.normals) n = normalize(to_world.normal(n));
    }

    Vec3f position(const TriangleEdges& edges, const Barycentric& b) const
    {
        if (std::min(std::min(b.u, b.v), 1.0 - b.u - b.v) < edge_margin_) [[unlikely]]
            return point_off_edges(edges, b, edge_clearance_);
        return triangle_point(edges, b);
    }

    TriangleCorners corners(std::uint32_t primitive) const
    {
        const MeshData::Triangle& t = mesh_.triangles[primitive];
        return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
    }

    double triangle_area(std::uint32_t primitive) const
    {
        return length(triangle_cross(corners(primitive).edges())) * 0.5;
    }

    // Zero for triangles without area.
    Vec3f triangle_normal(std::uint32_t primitive) const
    {
        const Vec3d normal = triangle_cross(corners(primitive).edges());
        const double size = length(normal);
        return size > 0.0 ? front_normal(primitive, normal * (1.0 / size)) : Vec3f(0.f);
    }

    // On the side of the vertex normals.
    Vec3f front_normal(std::uint32_t primitive, const Vec3d& unit) const
    {
        const Vec3f normal(static_cast<float>(unit.x), static_cast<float>(unit.y),
                           static_cast<float>(unit.z));
        if (mesh_.normals.empty()) return normal;
        const MeshData::Triangle& t = mesh_.triangles[primitive];
        const Vec3f sum = mesh_.normals[t[0]] + mesh_.normals[t[1]] + mesh_.normals[t[2]];
        return dot(sum, normal) < 0.f ? -normal : normal;
    }

    Vec3f shading_normal(std::uint32_t primitive, const Barycentric& b, const Vec3f& geometric_normal) const
    {
        constexpr float shortest = 1e-3f; // below, the three normals cancel and have no direction
        if (mesh_.normals.empty()) return geometric_normal;
        const Vec3f normal = interpolate(mesh_.normals, primitive, b);
        return length_squared(normal) > sqr(shortest) ? normalize(normal) : geometric_normal;
    }

    Vec2f uv(std::uint32_t primitive, const Barycentric& b) const
    {
        if (mesh_.uvs.empty()) return {static_cast<float>(b.u), static_cast<float>(b.v)};
        return interpolate(mesh_.uvs, primitive, b);
    }

    template <class T>
    T interpolate(const std::vector<T>& values, std::uint32_t primitive, const Barycentric& b) const
    {
        const MeshData::Triangle& t = mesh_.triangles[primitive];
        return values[t[0]] * static_cast<float>(1.0 - b.u - b.v) + values[t[1]] * static_cast<float>(b.u) +
               values[t[2]] * static_cast<float>(b.v);
    }

    MeshData mesh_; // world space
    DiscreteDistribution choice_;
    std::optional<MeshRectangle> rectangle_;
    float area_ = 0.f;
    double edge_clearance_ = 0.0; // how far points stay from edges
    double edge_margin_ = 0.0;    // edge_margin() of the triangle with the largest one
};

template std::unique_ptr<Shape> build<TriangleMesh>(const Params&);

} // namespace plumb
