// SPDX-License-Identifier: MIT

#include "plumb/model/instance_map.h"

namespace plumb {
namespace {

// What the linear part can do to a vector, per axis.
template <class Row>
double largest_row_sum(const std::array<Row, 3>& rows)
{
    double largest = 0.0;
    for (const Row& row : rows) {
        double sum = 0.0;
        for (std::size_t j = 0; j < 3; ++j) sum += std::abs(static_cast<double>(row[j]));
        largest = std::max(largest, sum);
    }
    return largest;
}

template <class Row>
double linear(const Row& row, const Vec3d& v)
{
    return static_cast<double>(row[0]) * v.x + static_cast<double>(row[1]) * v.y +
           static_cast<double>(row[2]) * v.z;
}

Vec3d absolute(const Vec3f& v)
{
    return Vec3d(abs(v));
}

} // namespace

std::optional<InstanceMap> InstanceMap::from(const Transform& to_world)
{
    Transform::Rows rows = to_world.rows();
    for (std::size_t i = 0; i < 3; ++i)
        for (double& x : rows[i]) {
            if (!(std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max()))) return {};
            x = static_cast<double>(static_cast<float>(x));
        }
    const std::optional<Transform> rounded = Transform::from_rows(rows);
    if (!rounded) return {};
    InstanceMap map;
    const Transform inverse = rounded->inverse();
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            map.forward_[i][j] = static_cast<float>(rows[i][j]);
            map.inverse_[i][j] = inverse.rows()[i][j];
        }
    if (!(largest_row_sum(map.forward_) <= largest_scale) ||
        !(largest_row_sum(map.inverse_) <= largest_scale))
        return {};
    return map;
}

RayD InstanceMap::to_object(const RayD& ray) const
{
    RayD moved = ray;
    for (int i = 0; i < 3; ++i) {
        const std::array<double, 4>& row = inverse_[static_cast<std::size_t>(i)];
        moved.origin[i] = linear(row, ray.origin) + row[3];
        moved.direction[i] = linear(row, ray.direction);
    }
    return moved;
}

SurfacePoint InstanceMap::to_object(const SurfacePoint& at) const
{
    SurfacePoint moved = at;
    const Vec3d position(at.position), normal(at.geometric_normal);
    Vec3d object_normal(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<std::size_t>(i);
        moved.position[i] = static_cast<float>(linear(inverse_[row], position) + inverse_[row][3]);
        // The inverse transpose of the inverse is the transpose.
        for (int j = 0; j < 3; ++j)
            object_normal[j] += static_cast<double>(forward_[row][static_cast<std::size_t>(j)]) * normal[i];
    }
    moved.geometric_normal = Vec3f(normalize(object_normal));
    moved.shading = Frame(moved.geometric_normal);
    moved.instance = nullptr;
    return moved;
}

Vec3d InstanceMap::to_world(const Vec3d& point) const
{
    Vec3d moved = vector_to_world(point);
    for (int i = 0; i < 3; ++i) moved[i] += static_cast<double>(forward_[static_cast<std::size_t>(i)][3]);
    return moved;
}

Vec3d InstanceMap::vector_to_world(const Vec3d& v) const
{
    return {linear(forward_[0], v), linear(forward_[1], v), linear(forward_[2], v)};
}

Vec3d InstanceMap::through_inverse_transpose(const Vec3d& n) const
{
    Vec3d moved(0.0);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            moved[j] += inverse_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * n[i];
    return moved;
}

Vec3d InstanceMap::normal_to_world(const Vec3d& n) const
{
    return normalize(through_inverse_transpose(n));
}

Box3f InstanceMap::to_world(const Box3f& box) const
{
    Box3f moved;
    if (box.isEmpty()) return moved;
    for (int i = 0; i < 3; ++i) {
        const std::array<float, 4>& row = forward_[static_cast<std::size_t>(i)];
        double least = row[3], most = row[3];
        for (int j = 0; j < 3; ++j) {
            const double factor = row[static_cast<std::size_t>(j)];
            const double a = factor * static_cast<double>(box.min[j]),
                         b = factor * static_cast<double>(box.max[j]);
            least += std::min(a, b);
            most += std::max(a, b);
        }
        moved.min[i] = next_float(static_cast<float>(least), false);
        moved.max[i] = next_float(static_cast<float>(most), true);
    }
    return moved;
}

Tangents InstanceMap::to_world(const Tangents& tangents) const
{
    return {Vec3f(vector_to_world(Vec3d(tangents.dp_du))), Vec3f(vector_to_world(Vec3d(tangents.dp_dv)))};
}

// A ray that starts here goes to object space in double precision and is rounded to floats there. So the point must be as
// far from the plane as the shape asks for, and that rounding of the origin more; a distance along the normal is `stretch`
// times as long in object space as in the world. In the world, the moved point is rounded, and a ray nearly in the plane may
// take its direction's rounding across it: over as much as the primitive, whose coordinates bound both.
// tests/statistical/instance_self_intersection_test.cpp shows that it suffices.
void InstanceMap::move_to_world(SurfacePoint& at, const Box3f& around) const
{
    const Vec3d object_normal(at.geometric_normal);
    const Vec3d normal = through_inverse_transpose(object_normal);
    const double stretch = length(normal);
    const double in_object = static_cast<double>(at.clearance) +
                             unit_roundoff * dot(absolute(at.geometric_normal), absolute(at.position));

    at.position = Vec3f(to_world(Vec3d(at.position)));
    at.geometric_normal = Vec3f(normal * (1.0 / stretch));
    at.shading = Frame(Vec3f(normal_to_world(Vec3d(at.shading.n))));

    const Box3f box = to_world(around);
    Vec3f largest;
    for (int i = 0; i < 3; ++i) largest[i] = std::max(std::abs(box.min[i]), std::abs(box.max[i]));
    constexpr double rounded_up = 1.0 + 4.0 * unit_roundoff;
    at.clearance = static_cast<float>(in_object / stretch * rounded_up) +
                   clearance(Vec3f(0.f), largest, at.geometric_normal);
    at.instance = this;
}

} // namespace plumb
