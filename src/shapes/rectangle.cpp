// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/shape.h"
#include "shapes/spherical_rectangle.h"
#include "shapes/triangle.h"
#include "shapes/width_axis.h"

#include <fmt/format.h>

namespace plumb {

/// A flat rectangle; toWorld may make a parallelogram of it.
///
/// Width runs along the world x axis projected onto the rectangle's plane (along z if the normal is parallel to x),
/// height along normal x width. The front side, which emitters shine from, is where `normal` points; toWorld is
/// applied last, to normals by its inverse transpose. uv run from (0, 0) to (1, 1) along width and height.
///
///     center    point       the middle                                (default 0 0 0)
///     width     float       greater than 0                            (default 1)
///     height    float       greater than 0                            (default 1)
///     normal    vector      any length but 0                          (default 0 0 1)
///     toWorld   transform   from these coordinates to the world       (default: the identity)
///     flipNormals   boolean   turn the front side to the back         (default false)
///
///         <shape type="rectangle">
///             <point name="center" value="0 2 0"/>
///             <float name="width" value="0.5"/>
///             <vector name="normal" value="0 -1 0"/>
///         </shape>
class Rectangle final : public Shape {
public:
    explicit Rectangle(const Params& params)
    {
        const Vec3d center(params.point("center", Vec3f(0.f)));
        const double width = params.number("width", 1.f, Range::positive());
        const double height = params.number("height", 1.f, Range::positive());
        const Vec3f given_normal = params.vector("normal", Vec3f(0.f, 0.f, 1.f));
        const Transform to_world = params.transform("toWorld");
        const bool flip_normals = params.boolean("flipNormals", false);
        if (!(max_component(abs(given_normal)) > 0.f)) {
            params.fail("normal", "must not be 0: it gives the front side");
            return;
        }

        const Vec3f unit_normal = normalize(given_normal);
        const Vec3d normal = normalize(Vec3d(unit_normal));
        const Vec3d along_width = width_axis(normal);
        const Vec3d u = along_width * (width * 0.5);
        const Vec3d v = cross(normal, along_width) * (height * 0.5);
        const Vec3d in_order[4] = {center - u - v, center + u - v, center + u + v, center - u + v};
        for (std::size_t i = 0; i < 4; ++i) corners_[i] = Vec3f(to_world.point(in_order[i]));

        for (std::uint32_t i = 0; i < 2; ++i) edges_[i] = triangle(i).edges();
        halves_ = {edges_[0], TriangleEdges(corners_[0], corners_[3], corners_[2])};

        const Vec3d edge1 = Vec3d(corners_[1]) - Vec3d(corners_[0]);
        const Vec3d edge2 = Vec3d(corners_[3]) - Vec3d(corners_[0]);
        const Vec3d crossed = cross(edge1, edge2);
        const double area = length(crossed);
        area_ = static_cast<float>(area);
        if (!(area_ > 0.f) || !std::isfinite(1.f / area_) || !std::isfinite(area_)) {
            params.fail(
                params.has("toWorld") ? "toWorld" : "width",
                fmt::format(
                    "gives the rectangle area {:.6g}, which must be positive and a number that a float "
                    "can hold; scale the scene",
                    area));
            return;
        }
        area_pdf_ = 1.f / area_;
        normal_ = Vec3f(crossed / area);
        if ((dot(normal_, to_world.normal(unit_normal)) < 0.f) != flip_normals) normal_ = -normal_;
        shading_ = Frame(normal_);
        clearance_ = std::max(triangle_clearance(triangle(0), normal_, area),
                              triangle_clearance(triangle(1), normal_, area));
        // The diagonal is no edge. A height is the area by the side.
        const double distance = edge_clearance(largest_coordinate(bounds()));
        margin_x_ = std::min(distance * length(edge2) / area, 0.5);
        margin_y_ = std::min(distance * length(edge1) / area, 0.5);
        spherical_ = SphericalRectangle::from(Vec3d(corners_[0]), edge1, edge2, normal_);
    }

    void add_to(AccelBuilder& builder) const override { builder.add_triangles(corners_, triangles_); }

    SurfacePoint surface_at(const Ray& ray, std::uint32_t primitive) const override
    {
        const TriangleEdges& edges = edges_[primitive];
        const Barycentric b = intersect_triangle(ray, edges);
        const auto first = static_cast<float>(b.u);
        const auto second = static_cast<float>(b.v);
        const float both = std::min(static_cast<float>(b.u + b.v), 1.f);

        const Vec2f uv(select(primitive == 0, both, first), select(primitive == 0, second, both));
        return {position(primitive, b), clearance_, normal_, primitive, shading_, 0, uv};
    }

    Tangents tangents(const SurfacePoint&) const override
    {
        return {corners_[1] - corners_[0], corners_[3] - corners_[0]};
    }

    ShapeSample sample_area(double /*u_select*/, const Vec2f& u) const override
    {
        return {point(u.x, u.y), clearance_, normal_, area_pdf_, u};
    }

    std::optional<ShapeSample> sample_solid_angle(const Vec3f& from, const Vec2f& u) const override
    {
        if (!spherical_) return std::nullopt;
        const auto place = spherical_->sample(from, u);
        if (!place) return std::nullopt;
        const Vec2f uv(static_cast<float>(place->along_edge1), static_cast<float>(place->along_edge2));
        return ShapeSample{point(place->along_edge1, place->along_edge2), clearance_, normal_, place->pdf,
                           uv};
    }

    std::optional<float> solid_angle_pdf(const Vec3f& from) const override
    {
        return spherical_ ? spherical_->pdf(from) : std::nullopt;
    }

    bool has_solid_angle() const override { return spherical_.has_value(); }

    float area() const override { return area_; }

    Box3f bounds() const override
    {
        Box3f box;
        for (const Vec3f& p : corners_) box.extendBy(p);
        return box;
    }

    DirectionCone normals() const override { return cone_about(Vec3d(normal_), 1.0); }

    std::uint64_t triangle_count() const override { return triangles_.size(); }

private:
    // The point of a triangle, or as close to it as points may be to edges.
    Vec3f position(std::uint32_t primitive, const Barycentric& b) const
    {
        const double margin = std::max(margin_x_, margin_y_);
        const double both = b.u + b.v;
        if (std::min(b.u, b.v) >= margin && both <= 1.0 - margin) [[likely]]
            return triangle_point(edges_[primitive], b);
        return primitive == 0 ? point(both, b.v) : point(b.u, both);
    }

    // The point at uv = (x, y), or as close to it as points may be to edges: see edge_clearance().
    Vec3f point(double x, double y) const
    {
        x = std::clamp(x, margin_x_, 1.0 - margin_x_);
        y = std::clamp(y, margin_y_, 1.0 - margin_y_);
        // The triangle that it lies in has the diagonal from the first corner to the third, and a corner of its own.
        const double difference = std::abs(x - y);
        const double smaller = std::min(x, y); // without a jump
        const TriangleEdges& half = halves_[static_cast<std::size_t>(y > x)];
        return triangle_point(half, {difference, smaller});
    }

    TriangleCorners triangle(std::uint32_t primitive) const
    {
        const AccelBuilder::Triangle& t = triangles_[primitive];
        return {corners_[t[0]], corners_[t[1]], corners_[t[2]]};
    }

    static constexpr std::array<AccelBuilder::Triangle, 2> triangles_ = {{{0, 1, 2}, {0, 2, 3}}};
    std::array<Vec3f, 4> corners_;                // at uv = (0, 0), (1, 0), (1, 1), (0, 1)
    std::array<TriangleEdges, 2> edges_;          // of triangles_
    std::array<TriangleEdges, 2> halves_;         // below and above the diagonal, which comes last in both
    std::optional<SphericalRectangle> spherical_; // unless it is a parallelogram
    Vec3f normal_{0.f, 0.f, 1.f};
    float clearance_ = 0.f;
    double margin_x_ = 0.0; // how far points stay from the edges at uv.x = 0 and 1, as part of the width
    double margin_y_ = 0.0;
    Frame shading_;
    float area_ = 1.f;
    float area_pdf_ = 1.f;
};

template std::unique_ptr<Shape> build<Rectangle>(const Params&);

} // namespace plumb
