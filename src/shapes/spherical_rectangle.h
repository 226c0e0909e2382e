// SPDX-License-Identifier: MIT
#pragma once

// A flat rectangle as part of the sphere of directions around a point: sampled uniformly by solid angle.
//
// Conventions. World space, double precision. A place on the rectangle is given by the fractions of its two edges,
// (0, 0) at the corner and (1, 1) opposite to it.

#include "plumb/math/math.h"

#include <optional>

namespace plumb {

class SphericalRectangle {
public:
    struct Place {
        double along_edge1; // in [0, 1]
        double along_edge2;
        float pdf; // per unit solid angle
    };

    // How skew a rectangle may be because its corners are floats: the relative error of the density.
    static constexpr double tolerance = 1e-5;

    // Nothing unless the edges are perpendicular. front: points to the front side.
    static std::optional<SphericalRectangle> from(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2,
                                                  const Vec3f& front);

    // Nothing from behind, and where the rectangle is seen so small that a point uniform in its area is as good: both
    // functions agree about where.
    std::optional<Place> sample(const Vec3f& from, const Vec2f& u) const
    {
        if (is_far(from)) return std::nullopt;
        return sample_near(from, u);
    }
    std::optional<float> pdf(const Vec3f& from) const
    {
        if (is_far(from)) return std::nullopt;
        return pdf_near(from);
    }

private:
    struct View;

    SphericalRectangle(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2, const Vec3f& front);
    // Most receivers are so far away that this tells.
    bool is_far(const Vec3f& from) const { return length_squared(from - middle_) > far2_; }
    std::optional<Place> sample_near(const Vec3f& from, const Vec2f& u) const;
    std::optional<float> pdf_near(const Vec3f& from) const;
    std::optional<View> view_from(const Vec3f& from) const;

    Vec3f middle_;
    float far2_; // square of a distance from there
    Vec3d corner_;
    Vec3d axis1_; // an orthonormal basis: along the edges, and away from the front
    Vec3d axis2_;
    Vec3d back_;
    double length1_;
    double length2_;
};

} // namespace plumb
