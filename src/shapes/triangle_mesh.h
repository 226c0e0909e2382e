// SPDX-License-Identifier: MIT
#pragma once

// What the shapes that are triangle meshes have in common; the plugins only say where the triangles come from.

#include "plumb/model/params.h"
#include "plumb/model/shape.h"
#include "plumb/shapes/mesh.h"
#include "shapes/spherical_rectangle.h"
#include "shapes/triangle.h"
#include "shapes/triangle_tree.h"

#include <functional>
#include <memory>
#include <utility>

namespace plumb {

class TriangleMesh : public Shape {
public:
    void add_to(AccelBuilder& builder) const final;
    SurfacePoint surface_at(const RayD& ray, std::uint32_t primitive) const final;
    Tangents tangents(const SurfacePoint& at) const final;
    void prepare_sampling() final;
    ShapeSample sample_area(double u_select, const Vec2f& u) const final;
    std::optional<ShapeSample> sample_solid_angle(const Vec3f& from, const Vec2f& u) const final;
    std::optional<float> solid_angle_pdf(const Vec3f& from) const final;
    bool has_solid_angle() const final { return rectangle_.has_value(); }
    std::optional<ShapeSample> sample_for(const LightReceiver& receiver, double u_select,
                                          const Vec2f& u) const final;
    double pdf_for(const LightReceiver& receiver, std::uint32_t primitive) const final;
    bool has_parts() const final { return !rectangle_ && mesh_.triangles.size() > 1; }
    float area() const final { return area_; }
    Box3f bounds() const final;
    Box3f primitive_bounds(std::uint32_t primitive) const final;
    DirectionCone normals() const final;
    std::uint64_t triangle_count() const final { return mesh_.triangles.size(); }
    std::uint64_t memory_bytes() const final;
    FaceMaterials take_face_materials() final { return std::move(mesh_.materials); }
    std::vector<std::string> attribute_names() const final;
    std::optional<Color> attribute(std::string_view name, const SurfacePoint& at) const final;

protected:
    using Read = std::function<MeshData(const std::filesystem::path&)>;

    // What a mesh that a file names is to be: the parameters filename, toWorld, smooth, faceNormals, flipV, flipNormals.
    TriangleMesh(const Params& params, const Read& read);
    // A mesh in object space, all of whose triangles have an area: the parameters toWorld and flipNormals.
    TriangleMesh(const Params& params, MeshData mesh);
    void forget_material_files() { mesh_.materials.libraries.clear(); }

private:
    // What points of a triangle have in common.
    struct Face {
        TriangleEdges edges;
        Vec3f normal;
        float clearance;
    };

    // Two triangles that make a rectangle, as most lamps do. Its first corner is the right angle of triangle 0, and its
    // edges go to that triangle's next two corners.
    struct MeshRectangle {
        SphericalRectangle spherical;
        std::array<Face, 2> faces;
        std::size_t first;    // in triangle 0
        std::size_t opposite; // in triangle 1
        std::size_t end1;     // the end of edge 1, in triangle 1

        // The primitive and its barycentric coordinates at fractions (x, y) of the edges.
        std::pair<std::uint32_t, Barycentric> at(double x, double y) const;
    };

    void apply(const Transform& to_world);
    void flip();
    bool measure(const Params& params);
    std::optional<MeshRectangle> rectangle() const;
    Face face(std::uint32_t primitive) const;
    ShapeSample sample_rectangle(double x, double y, float pdf) const;
    ShapeSample sample_triangle(std::uint32_t primitive, const Vec2f& u, float pdf) const;
    ShapeSample sample_at(std::uint32_t primitive, const Face& face, const Barycentric& b, float pdf) const;
    Vec3f position(const TriangleEdges& edges, const Barycentric& b) const;
    double triangle_area(std::uint32_t primitive) const;
    Vec3f triangle_normal(std::uint32_t primitive) const;
    Vec3f front_normal(std::uint32_t primitive, const Vec3d& unit) const;
    Vec3f shading_normal(std::uint32_t primitive, const Barycentric& b, const Vec3f& geometric_normal) const;
    Vec2f uv(std::uint32_t primitive, const Barycentric& b) const;

    TriangleCorners corners(std::uint32_t primitive) const
    {
        const MeshData::Triangle& t = mesh_.triangles[primitive];
        return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
    }

    template <class T>
    T interpolate(const std::vector<T>& values, std::uint32_t primitive, const Barycentric& b) const
    {
        const MeshData::Triangle& t = mesh_.triangles[primitive];
        return values[t[0]] * static_cast<float>(1.0 - b.u - b.v) + values[t[1]] * static_cast<float>(b.u) +
               values[t[2]] * static_cast<float>(b.v);
    }

    MeshData mesh_;                            // world space
    std::unique_ptr<const TriangleTree> tree_; // once sampling is prepared
    std::optional<MeshRectangle> rectangle_;
    float area_ = 0.f;
    bool corners_turned_ =
        false; // the file has the second and third corner of each triangle the other way round
    double edge_clearance_ = 0.0; // how far points stay from edges
    double edge_margin_ = 0.0;    // edge_margin() of the triangle with the largest one
};

} // namespace plumb
