// SPDX-License-Identifier: MIT

#include "plumb/math/transform.h"

#include "plumb/math/elementary.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb {
namespace {

using Rows = Transform::Rows;

constexpr Rows identity_rows = {
    {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}};

// A matrix whose determinant is below this part of the product of its rows' lengths is singular.
constexpr double singular_below = 1e-12;

Rows from_columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& origin)
{
    return {{{x.x, y.x, z.x, origin.x},
             {x.y, y.y, z.y, origin.y},
             {x.z, y.z, z.z, origin.z},
             {0.0, 0.0, 0.0, 1.0}}};
}

Vec3d linear_row(const Rows& m, std::size_t i)
{
    return {m[i][0], m[i][1], m[i][2]};
}

Vec3d column(const Rows& m, std::size_t j)
{
    return {m[0][j], m[1][j], m[2][j]};
}

Rows multiply(const Rows& a, const Rows& b)
{
    Rows product{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) product[i][j] += a[i][k] * b[k][j];
    return product;
}

// Length without over- or underflow of the squares.
double safe_length(const Vec3d& v)
{
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0.0 && std::isfinite(largest) ? largest * length(v / largest) : largest;
}

bool is_affine(const Rows& m)
{
    for (const auto& row : m)
        for (const double x : row)
            if (!std::isfinite(x)) return false;
    return m[3] == identity_rows[3];
}

// The inverse, by Gauss-Jordan elimination with partial pivoting, of the linear part after its rows were divided by
// their lengths: which makes the test for singularity independent of scale.
std::optional<Rows> inverted(const Rows& m)
{
    double left[3][3];
    double right[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double row_length[3];
    for (std::size_t i = 0; i < 3; ++i) {
        row_length[i] = safe_length(linear_row(m, i));
        if (!(row_length[i] > 0.0)) return {};
        for (std::size_t j = 0; j < 3; ++j) left[i][j] = m[i][j] / row_length[i];
    }

    double determinant = 1.0; // its absolute value
    for (std::size_t c = 0; c < 3; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c + 1; i < 3; ++i)
            if (std::abs(left[i][c]) > std::abs(left[pivot][c])) pivot = i;
        std::swap(left[c], left[pivot]);
        std::swap(right[c], right[pivot]);
        determinant *= std::abs(left[c][c]);
        if (!(determinant > singular_below)) return {};

        const double factor = 1.0 / left[c][c];
        for (std::size_t j = 0; j < 3; ++j) {
            left[c][j] *= factor;
            right[c][j] *= factor;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == c) continue;
            const double multiple = left[i][c];
            for (std::size_t j = 0; j < 3; ++j) {
                left[i][j] -= multiple * left[c][j];
                right[i][j] -= multiple * right[c][j];
            }
        }
    }

    Rows inverse = identity_rows;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) inverse[i][j] = right[i][j] / row_length[j];
        inverse[i][3] = -(inverse[i][0] * m[0][3] + inverse[i][1] * m[1][3] + inverse[i][2] * m[2][3]);
    }
    return is_affine(inverse) ? std::optional(inverse) : std::nullopt;
}

// Exact at multiples of 90 degrees.
SinCosD sin_cos_degrees(double degrees)
{
    const double quarters = std::floor(degrees / 90.0 + 0.5);
    const SinCosD rest = sin_cos((degrees - 90.0 * quarters) * (pi_d / 180.0));
    switch (static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0))) {
    case 0: return rest;
    case 1: return {rest.cos, -rest.sin};
    case 2: return {-rest.sin, -rest.cos};
    default: return {-rest.cos, rest.sin};
    }
}

Vec3f rounded(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace

Transform::Transform() : forward_(identity_rows), backward_(identity_rows) {}

std::optional<Transform> Transform::from_rows(const Rows& rows)
{
    if (!is_affine(rows)) return {};
    const std::optional<Rows> inverse = inverted(rows);
    if (!inverse) return {};
    return Transform(rows, *inverse);
}

Transform Transform::translate(const Vec3d& offset)
{
    Rows forward = identity_rows;
    Rows backward = identity_rows;
    for (int i = 0; i < 3; ++i) {
        forward[static_cast<std::size_t>(i)][3] = offset[i];
        backward[static_cast<std::size_t>(i)][3] = -offset[i];
    }
    return {forward, backward};
}

std::optional<Transform> Transform::scale(const Vec3d& factors)
{
    Rows forward = identity_rows;
    Rows backward = identity_rows;
    for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<std::size_t>(i);
        forward[row][row] = factors[i];
        backward[row][row] = 1.0 / factors[i];
        if (!std::isfinite(forward[row][row]) || !std::isfinite(backward[row][row])) return {};
    }
    return Transform(forward, backward);
}

Transform Transform::rotate(const Vec3d& axis, double degrees)
{
    // Rodrigues' formula: v cos + (axis x v) sin + axis (axis . v) (1 - cos). The diagonal is written so that
    // rotations about a coordinate axis leave that axis where it is.
    const Vec3d a = axis / safe_length(axis);
    const auto [s, c] = sin_cos_degrees(degrees);
    const double k = 1.0 - c;
    const double xx = a.x * a.x;
    const double yy = a.y * a.y;
    const double zz = a.z * a.z;
    const Vec3d x(xx + c * (yy + zz), k * a.x * a.y + s * a.z, k * a.x * a.z - s * a.y);
    const Vec3d y(k * a.x * a.y - s * a.z, yy + c * (xx + zz), k * a.y * a.z + s * a.x);
    const Vec3d z(k * a.x * a.z + s * a.y, k * a.y * a.z - s * a.x, zz + c * (xx + yy));
    const Rows forward = from_columns(x, y, z, Vec3d(0.0));
    Rows backward = identity_rows;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) backward[i][j] = forward[j][i];
    return {forward, backward};
}

std::optional<Transform> Transform::look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up)
{
    constexpr double parallel_below = 1e-9; // sine of the angle between up and the direction
    const Vec3d towards = target - origin;
    const double distance = safe_length(towards);
    const double up_length = safe_length(up);
    if (!(distance > 0.0) || !(up_length > 0.0) || !std::isfinite(distance) || !std::isfinite(up_length))
        return {};

    const Vec3d direction = normalize(towards / distance);
    const Vec3d sideways = cross(normalize(up / up_length), direction);
    if (!(length(sideways) > parallel_below)) return {};
    const Vec3d left = normalize(sideways);
    const Vec3d new_up = normalize(cross(direction, left));
    const Rows forward = from_columns(left, new_up, direction, origin);
    Rows backward = identity_rows;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) backward[i][j] = forward[j][i];
        backward[i][3] = -dot(linear_row(backward, i), origin);
    }
    return Transform(forward, backward);
}

Vec3d Transform::point(const Vec3d& p) const
{
    return vector(p) + column(forward_, 3);
}

Vec3d Transform::vector(const Vec3d& v) const
{
    return {dot(linear_row(forward_, 0), v), dot(linear_row(forward_, 1), v),
            dot(linear_row(forward_, 2), v)};
}

Vec3f Transform::point(const Vec3f& p) const
{
    return rounded(point(Vec3d(p)));
}

Vec3f Transform::vector(const Vec3f& v) const
{
    return rounded(vector(Vec3d(v)));
}

Vec3f Transform::normal(const Vec3f& n) const
{
    const Vec3d d(n);
    return rounded(
        {dot(column(backward_, 0), d), dot(column(backward_, 1), d), dot(column(backward_, 2), d)});
}

Transform Transform::inverse() const
{
    return {backward_, forward_};
}

Transform operator*(const Transform& a, const Transform& b)
{
    return {multiply(a.forward_, b.forward_), multiply(b.backward_, a.backward_)};
}

double Transform::determinant() const
{
    return dot(linear_row(forward_, 0), cross(linear_row(forward_, 1), linear_row(forward_, 2)));
}

bool Transform::is_identity() const
{
    return forward_ == identity_rows;
}

std::optional<double> Transform::uniform_scale() const
{
    constexpr double tolerance = 1e-5;
    const double lengths[3] = {safe_length(column(forward_, 0)), safe_length(column(forward_, 1)),
                               safe_length(column(forward_, 2))};
    const double mean = (lengths[0] + lengths[1] + lengths[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(std::abs(lengths[i] - mean) <= tolerance * mean)) return {};
        const Vec3d here = column(forward_, i) / mean;
        const Vec3d next = column(forward_, (i + 1) % 3) / mean;
        if (!(std::abs(dot(here, next)) <= tolerance)) return {};
    }
    return mean;
}

} // namespace plumb
