// SPDX-License-Identifier: MIT

// [1] Lambert 1760, Photometria; Baum, Rushmeier and Winget 1989, "Improving Radiosity Solutions Through the Use of
//     Analytically Determined Form-Factors", equation 3.
// [2] Siegel and Howell, "Thermal Radiation Heat Transfer": a differential element and a sphere.

#include "support/placed_lamp.h"

#include "plumb/model/shape.h"
#include "support/lamp.h"

#include <fmt/format.h>

namespace plumb::test {
namespace {

// Two unit vectors that make an orthonormal basis with n.
std::pair<Vec3d, Vec3d> tangents(TestRandom& random, const Vec3d& n)
{
    const Vec3d s = normalize(cross(n, Vec3d(random.direction())));
    return {s, cross(n, s)};
}

Vec3d axis_direction(TestRandom& random)
{
    Vec3d n(0.0);
    n[static_cast<int>(random.between(0, 3))] = random.next_1d() < 0.5f ? -1.0 : 1.0;
    return n;
}

// What is above the plane through the origin with this normal.
std::vector<Vec3d> cut_at_horizon(const std::vector<Vec3d>& corners, const Vec3d& normal)
{
    std::vector<Vec3d> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d& a = corners[i];
        const Vec3d& b = corners[(i + 1) % corners.size()];
        const double ha = dot(a, normal), hb = dot(b, normal);
        if (ha >= 0.0) kept.push_back(a);
        if ((ha >= 0.0) != (hb >= 0.0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    return kept;
}

std::string polygon_text(const PlacedLamp& lamp)
{
    std::string text;
    for (const Vec3f& p : lamp.corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    text += "f 1 2 3\n";
    if (lamp.corners.size() == 4) text += "f 1 3 4\n";
    return text;
}

} // namespace

const char* to_string(LampKind kind)
{
    switch (kind) {
    case LampKind::rectangle: return "rectangle";
    case LampKind::rectangle_mesh: return "mesh that is a rectangle";
    case LampKind::quad_mesh: return "mesh of two triangles";
    case LampKind::triangle: return "triangle";
    case LampKind::needle: return "needle";
    case LampKind::sphere: return "sphere";
    }
    return "";
}

std::string PlacedLamp::text() const
{
    return fmt::format("{} of {:.4g} at ({:.9g} {:.9g} {:.9g}), facing ({:.6g} {:.6g} {:.6g})",
                       to_string(kind), size, center.x, center.y, center.z, normal.x, normal.y, normal.z);
}

double awkward_coordinate(TestRandom& random)
{
    constexpr double list[] = {0.0, 1e-3, 0.1, 1.0, 1e3};
    const double sign = random.next_1d() < 0.5f ? -1.0 : 1.0;
    return sign * list[static_cast<std::size_t>(random.between(0, 5))];
}

PlacedLamp place_lamp(TestRandom& random, LampKind kind, double plane)
{
    PlacedLamp lamp;
    lamp.kind = kind;
    lamp.size = std::exp(random.between(std::log(0.05), std::log(20.0)));
    const bool along_axis = random.next_1d() < 0.67f;
    lamp.normal = along_axis ? axis_direction(random) : Vec3d(random.direction());
    for (int i = 0; i < 3; ++i)
        lamp.center[i] =
            static_cast<float>(!along_axis || lamp.normal[i] != 0.0 ? plane : awkward_coordinate(random));
    if (kind == LampKind::sphere) {
        lamp.radius = static_cast<float>(lamp.size * 0.5);
        lamp.normal = Vec3d(0.0);
        return lamp;
    }
    lamp.normal = Vec3d(Vec3f(normalize(lamp.normal)));

    auto [s, t] = tangents(random, normalize(lamp.normal));
    if (kind == LampKind::rectangle) { // as its manual says
        const Vec3d n = normalize(lamp.normal);
        const Vec3d projected = Vec3d(1.0, 0.0, 0.0) - n * n.x;
        s = length(projected) > 1e-6 ? normalize(projected) : Vec3d(0.0, 0.0, 1.0);
        t = cross(n, s);
    } else if (along_axis && random.next_1d() < 0.7f) { // sides along axes, too
        const int axis = std::abs(lamp.normal.x) > 0.5 ? 1 : std::abs(lamp.normal.y) > 0.5 ? 2 : 0;
        s = Vec3d(0.0);
        s[axis] = 1.0;
        t = cross(lamp.normal, s);
    }
    const double height = lamp.size * (kind == LampKind::needle ? std::pow(10.0, random.between(-3.5, -1.5))
                                                                : random.between(0.3, 1.0));
    const Vec3d a = s * (lamp.size * 0.5), b = t * (height * 0.5);
    const double skew = kind == LampKind::quad_mesh ? random.between(-0.4, 0.4) : 0.0;
    const Vec3d c(lamp.center);
    std::vector<Vec3d> corners = {c - a - b, c + a - b - a * skew, c + a + b, c - a + b + b * skew};
    if (kind == LampKind::triangle || kind == LampKind::needle) {
        corners.pop_back();
        corners[2] = c + b + a * random.between(-1.0, 1.0);
    }
    for (const Vec3d& corner : corners) lamp.corners.emplace_back(Vec3f(corner));
    // Far from the origin, a needle may round to nothing, or to one that faces elsewhere.
    return rounding_error(lamp, 1.0) < 0.1 ? lamp : place_lamp(random, kind, plane);
}

double height_of(const PlacedLamp& lamp)
{
    double lowest = infinity;
    for (std::size_t i = 2; i < lamp.corners.size(); ++i) {
        const Vec3d a = Vec3d(lamp.corners[i - 1]) - Vec3d(lamp.corners[0]);
        const Vec3d b = Vec3d(lamp.corners[i]) - Vec3d(lamp.corners[0]);
        lowest = std::min(lowest, length(cross(a, b)) / std::max(length(a), length(b)));
    }
    return lowest;
}

double rounding_error(const PlacedLamp& lamp, double steepness)
{
    if (lamp.kind == LampKind::sphere) return 0.0;
    double largest = 0.0;
    for (const Vec3f& p : lamp.corners)
        largest = std::max(largest, static_cast<double>(max_component(abs(p))));
    return 2.0 * unit_roundoff * largest / (height_of(lamp) * steepness);
}

std::unique_ptr<Shape> shape_of(const PlacedLamp& lamp)
{
    if (lamp.kind == LampKind::sphere) return ball(lamp.center, lamp.radius);
    if (lamp.kind != LampKind::rectangle) return mesh(polygon_text(lamp));
    const double width = length(Vec3d(lamp.corners[1]) - Vec3d(lamp.corners[0]));
    const double height = length(Vec3d(lamp.corners[3]) - Vec3d(lamp.corners[0]));
    return panel(lamp.center, width, height, Vec3f(lamp.normal));
}

Vec3d point_in_front(TestRandom& random, const PlacedLamp& lamp, double distance, double steepness)
{
    if (lamp.kind == LampKind::sphere)
        return Vec3d(lamp.center) + Vec3d(random.direction()) * (distance + static_cast<double>(lamp.radius));
    const Vec3d n = normalize(lamp.normal);
    const Vec3d along = tangents(random, n).first;
    return Vec3d(lamp.center) + (n * steepness + along * std::sqrt(1.0 - sqr(steepness))) * distance;
}

double form_factor(const PlacedLamp& lamp, const Vec3d& at, const Vec3d& normal)
{
    if (lamp.kind == LampKind::sphere) {
        const Vec3d to = Vec3d(lamp.center) - at;
        const double d = length(to);
        return sqr(static_cast<double>(lamp.radius) / d) * dot(to, normal) / d; // [2]
    }
    std::vector<Vec3d> corners;
    for (const Vec3f& corner : lamp.corners) corners.push_back(Vec3d(corner) - at);
    const std::vector<Vec3d> seen = cut_at_horizon(corners, normal);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) { // [1]
        const Vec3d& a = seen[i];
        const Vec3d& b = seen[(i + 1) % seen.size()];
        const Vec3d axis = cross(a, b);
        const double sine = length(axis);
        if (sine > 0.0) sum += dot(axis, normal) / sine * std::atan2(sine, dot(a, b));
    }
    return std::abs(sum) / (2.0 * pi_d);
}

} // namespace plumb::test
