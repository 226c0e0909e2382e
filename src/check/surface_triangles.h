// SPDX-License-Identifier: MIT
#pragma once

// A shape as it describes itself to the acceleration structure: triangles, or a ball. Of other shapes nothing is known.

#include "plumb/shape.h"
#include "shapes/triangle.h"

#include <optional>

namespace plumb {

// Must not outlive the shape.
class SurfaceTriangles final : public AccelBuilder {
public:
    explicit SurfaceTriangles(const Shape& shape) : shape_(&shape), ball_(shape.as_ball())
    {
        shape.add_to(*this);
    }

    void add_triangles(std::span<const Vec3f> positions, std::span<const Triangle> triangles) override
    {
        positions_ = positions;
        triangles_ = triangles;
    }
    void add_user(const Primitives&) override {}

    const std::optional<Ball>& ball() const { return ball_; }
    std::size_t size() const { return triangles_.size(); }
    TriangleCorners corners(std::size_t i) const
    {
        const Triangle& triangle = triangles_[i];
        return {positions_[triangle[0]], positions_[triangle[1]], positions_[triangle[2]]};
    }
    // The unit normal of the front of a triangle that has an area, asked of the shape where a ray meets its middle.
    Vec3d front(std::size_t i) const;

private:
    const Shape* shape_;
    std::span<const Vec3f> positions_;
    std::span<const Triangle> triangles_;
    std::optional<Ball> ball_;
};

} // namespace plumb
