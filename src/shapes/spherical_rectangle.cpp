// SPDX-License-Identifier: MIT

// [1] Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles".

#include "shapes/spherical_rectangle.h"

#include "plumb/math/elementary.h"

#include <utility>

namespace plumb {
namespace {

// An angle as a complex number of any length, so that sums need no arc tangents.
struct Angle {
    double cos;
    double sin;
};

Angle operator+(const Angle& a, const Angle& b)
{
    return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

Angle operator-(const Angle& a, const Angle& b)
{
    return {a.cos * b.cos + a.sin * b.sin, a.sin * b.cos - a.cos * b.sin};
}

} // namespace

// The rectangle [x0, x1] x [y0, y1] in the plane at distance z, the receiver being the origin.
struct SphericalRectangle::View {
    double x0, x1, y0, y1, z;
    bool exchanged; // x runs along edge2 and y along edge1
    Angle left;     // the solid angle between the y axis and x = x0, from y0 to y1, with the sign of x0
    double solid_angle;
    float pdf;
};

std::optional<SphericalRectangle> SphericalRectangle::from(const Vec3d& corner, const Vec3d& edge1,
                                                           const Vec3d& edge2, const Vec3f& front)
{
    const double lengths = length(edge1) * length(edge2);
    if (!(lengths > 0.0 && std::abs(dot(edge1, edge2)) <= tolerance * lengths)) return std::nullopt;
    return SphericalRectangle(corner, edge1, edge2, front);
}

SphericalRectangle::SphericalRectangle(const Vec3d& corner, const Vec3d& edge1, const Vec3d& edge2,
                                       const Vec3f& front)
    : middle_(corner + (edge1 + edge2) * 0.5),
      far2_(static_cast<float>(sqr(1.5) * (length_squared(edge1) + length_squared(edge2)))), // see view_from
      corner_(corner),
      axis1_(normalize(edge1)),
      axis2_(normalize(edge2 - axis1_ * dot(edge2, axis1_))),
      back_(cross(axis1_, axis2_)),
      length1_(length(edge1)),
      length2_(length(edge2))
{
    if (dot(back_, Vec3d(front)) > 0.0) back_ = -back_;
}

std::optional<SphericalRectangle::View> SphericalRectangle::view_from(const Vec3f& from) const
{
    constexpr double smallest_solid_angle = 1e-5; // below, differences lose their digits

    const Vec3d to_corner = corner_ - Vec3d(from);
    const double z = dot(to_corner, back_);
    if (!(z > 0.0)) return std::nullopt;
    double x0 = dot(to_corner, axis1_);
    double y0 = dot(to_corner, axis2_);
    double x1 = x0 + length1_;
    double y1 = y0 + length2_;
    const double beside_x = std::max({x0, -x1, 0.0});
    const double beside_y = std::max({y0, -y1, 0.0});
    const double nearest2 = sqr(beside_x) + sqr(beside_y) + sqr(z);
    // The density of area sampling goes with the cube of the distance. Further away than the diagonal is long, it is
    // even enough: what solid angles gain there in the Cornell box is less than they cost. (And nothing that is nearer is
    // further than one and a half diagonals from the middle.)
    if (sqr(length1_) + sqr(length2_) < nearest2) return std::nullopt;

    // Along y the rectangle must not reach around a receiver that is beside it in x: the angle `left` would be close to
    // pi near its plane, where its sine has no digits left.
    const bool exchanged = beside_x > beside_y;
    if (exchanged) {
        std::swap(x0, y0);
        std::swap(x1, y1);
    }

    // The part of the solid angle between the axes and a corner is atan(x y / (z r)): [1], equation 3, by corners.
    const auto to_axes = [z](double x, double y) {
        return Angle{z * std::sqrt(sqr(x) + sqr(y) + sqr(z)), x * y};
    };
    const Angle left = to_axes(x0, y1) - to_axes(x0, y0);
    const Angle right = to_axes(x1, y1) - to_axes(x1, y0);
    const Angle whole = right - left;
    const double angle = atan2(whole.sin, whole.cos);
    const double solid_angle = angle < 0.0 ? angle + 2.0 * pi_d : angle;
    if (!(solid_angle > smallest_solid_angle)) return std::nullopt;
    return View{x0, x1, y0, y1, z, exchanged, left, solid_angle, static_cast<float>(1.0 / solid_angle)};
}

std::optional<SphericalRectangle::Place> SphericalRectangle::sample_near(const Vec3f& from,
                                                                         const Vec2f& u) const
{
    const std::optional<View> view = view_from(from);
    if (!view) return std::nullopt;
    const auto [x0, x1, y0, y1, z, exchanged, left, solid_angle, pdf] = *view;

    // The x that has u.x of the solid angle to its left. phi: as View::left, for that x.
    const SinCosD part = sin_cos(u.x * solid_angle);
    const double left_length = std::sqrt(sqr(left.cos) + sqr(left.sin));
    const Angle turned = left + Angle{part.cos, part.sin};
    const double sin_phi = turned.sin / left_length;
    const double cos_phi = turned.cos / left_length;
    // [1], equations 7 and 8, multiplied out: x = z sin(phi) / sqrt(f), where b0 and b1 are [1]'s normals' z.
    const double b0 = y0 / std::sqrt(sqr(y0) + sqr(z));
    const double b1 = y1 / std::sqrt(sqr(y1) + sqr(z));
    const double one_minus_cos = cos_phi > 0.0 ? sqr(sin_phi) / (1.0 + cos_phi) : 1.0 - cos_phi;
    const double f = sqr(b1 - b0) + 2.0 * b0 * b1 * one_minus_cos - sqr(sin_phi);
    const double x = std::clamp(f > 0.0 ? z * sin_phi / std::sqrt(f) : sin_phi * infinity, x0, x1);

    // [1], equations 10 and 11: between y0 and y1 the sine of the elevation is uniform.
    const double d2 = sqr(x) + sqr(z);
    const double h0 = y0 / std::sqrt(d2 + sqr(y0));
    const double h1 = y1 / std::sqrt(d2 + sqr(y1));
    const double h = h0 + u.y * (h1 - h0);
    const double cos2 = (1.0 - h) * (1.0 + h);
    const double y = std::clamp(cos2 > 0.0 ? h * std::sqrt(d2 / cos2) : h * infinity, y0, y1);
    const double along_x = std::min((x - x0) / (x1 - x0), 1.0);
    const double along_y = std::min((y - y0) / (y1 - y0), 1.0);
    return exchanged ? Place{along_y, along_x, pdf} : Place{along_x, along_y, pdf};
}

std::optional<float> SphericalRectangle::pdf_near(const Vec3f& from) const
{
    const std::optional<View> view = view_from(from);
    if (!view) return std::nullopt;
    return view->pdf;
}

} // namespace plumb
