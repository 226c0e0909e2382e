// SPDX-License-Identifier: MIT
#pragma once

// An affine map of space and its inverse, both in double precision.
//
// Conventions. Matrices act on column vectors: point(p) = M * (p, 1). a * b applies b first. Three names, three
// rules: a point is moved by the translation, a vector is not, and a normal goes through the inverse transpose
// (its length is not kept: normalise where that matters).

#include "plumb/math/math.h"

#include <array>
#include <optional>

namespace plumb {

class Transform {
public:
    using Rows = std::array<std::array<double, 4>, 4>; // rows[i][j]: row i, column j; the last row is 0 0 0 1

    Transform();                                                 // the identity
    static std::optional<Transform> from_rows(const Rows& rows); // nothing if singular or not affine
    static Transform translate(const Vec3d& offset);
    static std::optional<Transform> scale(const Vec3d& factors); // nothing if a factor is 0
    static Transform rotate(const Vec3d& axis, double degrees); // counter-clockwise about the axis; axis != 0
    // Maps camera space to the world: +z looks from origin to target, +y is up, +x is LEFT (scene grammar,
    // section 2). Nothing if origin = target or up is parallel to the direction.
    static std::optional<Transform> look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

    Vec3f point(const Vec3f& p) const;
    Vec3f vector(const Vec3f& v) const;
    Vec3f normal(const Vec3f& n) const;
    Vec3d point(const Vec3d& p) const;
    Vec3d vector(const Vec3d& v) const;

    Transform inverse() const;
    friend Transform operator*(const Transform& a, const Transform& b);

    const Rows& rows() const { return forward_; }
    double determinant() const; // of the linear part; negative: a mirror
    bool is_identity() const;
    // The factor if the linear part is a rotation (or mirror) times one positive scale, within 1e-5; else nothing.
    std::optional<double> uniform_scale() const;

private:
    Transform(const Rows& forward, const Rows& backward) : forward_(forward), backward_(backward) {}
    Rows forward_;
    Rows backward_;
};

} // namespace plumb
