// SPDX-License-Identifier: MIT
#include "support/polygons.h"

#include <algorithm>

namespace plumb::test {

namespace {

Vec2f at(double x, double y)
{
    return {static_cast<float>(x), static_cast<float>(y)};
}

Vec2f on_circle(double radius, double angle)
{
    return at(radius * std::cos(angle), radius * std::sin(angle));
}

// The corners from the left end of hole number `hole` round it, by way of the holes behind it, and back to the left end.
void add_holes(int hole, int holes, int corners, Polygon& polygon)
{
    constexpr double radius = 0.5;
    const auto corner = [&](int i) { // clockwise from the left end
        const double x = 2.0 * hole + 1.5;
        if (i % corners == 0) return at(x - radius, 1.5);
        if (2 * i == corners) return at(x + radius, 1.5);
        const double angle = pi_d - 2.0 * pi_d * i / corners;
        return at(x + radius * std::cos(angle), 1.5 + radius * std::sin(angle));
    };
    for (int i = 0; i <= corners; ++i) {
        polygon.push_back(corner(i));
        if (2 * i != corners || hole + 1 == holes) continue;
        add_holes(hole + 1, holes, corners, polygon);
        polygon.push_back(corner(i));
    }
}

} // namespace

Polygon star_polygon(int corners, TestRandom& random)
{
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
        polygon.push_back(on_circle(random.between(0.2, 1.0), 2.0 * pi_d * i / corners));
    return polygon;
}

Polygon monotone_polygon(int corners, TestRandom& random)
{
    Polygon polygon = {at(0, 0)};
    const int lower = (corners - 2) / 2;
    const int upper = corners - 2 - lower;
    for (int i = 1; i <= lower; ++i)
        polygon.push_back(at(double(i) / (lower + 1), random.between(-1.0, -0.01)));
    polygon.push_back(at(1, 0));
    for (int i = upper; i >= 1; --i)
        polygon.push_back(at(double(i) / (upper + 1), random.between(0.01, 1.0)));
    return polygon;
}

Polygon comb_polygon(int corners, float bar)
{
    const int teeth = corners / 2;
    Polygon polygon = {at(0, 0), at(2 * teeth - 1, 0)};
    for (int i = teeth - 1; i >= 0; --i) {
        polygon.push_back(at(2 * i + 0.5, 10));
        if (i > 0) polygon.push_back(at(2 * i - 0.5, static_cast<double>(bar)));
    }
    return polygon;
}

Polygon spiral_polygon(int corners)
{
    const int side = corners / 2;
    constexpr int corners_of_a_turn = 64;
    const auto point = [&](int i, double inwards) {
        const double turns = double(i) / corners_of_a_turn;
        const double whole = double(side) / corners_of_a_turn + 1.0;
        return on_circle(whole - turns - inwards, 2.0 * pi_d * turns);
    };
    Polygon polygon;
    for (int i = 0; i < side; ++i) polygon.push_back(point(i, 0.0));
    for (int i = side - 1; i >= 0; --i) polygon.push_back(point(i, 0.5));
    return polygon;
}

Polygon flower_polygon(int corners)
{
    const int petals = corners / 3;
    Polygon polygon;
    for (int i = 0; i < petals; ++i) {
        polygon.push_back(at(0, 0));
        polygon.push_back(on_circle(1.0, 2.0 * pi_d * (i + 0.2) / petals));
        polygon.push_back(on_circle(1.0, 2.0 * pi_d * (i + 0.8) / petals));
    }
    return polygon;
}

Polygon holed_polygon(int holes, int corners_of_a_hole)
{
    const double width = 2.0 * holes + 1.0;
    Polygon polygon = {at(0, 1.5), at(0, 0), at(width, 0), at(width, 3), at(0, 3), at(0, 1.5)};
    add_holes(0, holes, corners_of_a_hole, polygon);
    return polygon;
}

Polygon with_collinear_corners(const Polygon& polygon, TestRandom& random)
{
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f& a = polygon[i];
        const Vec2f& b = polygon[(i + 1) % polygon.size()];
        result.push_back(a);
        if (random.next_1d() < 0.5f) result.push_back((a + b) * 0.5f);
    }
    return result;
}

Polygon with_doubled_corners(const Polygon& polygon, TestRandom& random)
{
    Polygon result;
    for (const Vec2f& p : polygon)
        for (float copies = 0.f, most = 3.f * random.next_1d(); copies < 1.f || copies < most; ++copies)
            result.push_back(p);
    return result;
}

double area_of(const Polygon& polygon)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f& a = polygon[i];
        const Vec2f& b = polygon[(i + 1) % polygon.size()];
        sum += double(a.x) * double(b.y) - double(a.y) * double(b.x);
    }
    return 0.5 * sum;
}

bool contains(const Polygon& polygon, double x, double y)
{
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f& a = polygon[i];
        const Vec2f& b = polygon[(i + 1) % polygon.size()];
        if ((double(a.y) > y) == (double(b.y) > y)) continue;
        inside ^=
            x < double(a.x) + (y - double(a.y)) * (double(b.x) - double(a.x)) / (double(b.y) - double(a.y));
    }
    return inside;
}

double distance_to_boundary(const Polygon& polygon, double x, double y)
{
    double nearest = infinity;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f& a = polygon[i];
        const Vec2f& b = polygon[(i + 1) % polygon.size()];
        const double dx = double(b.x) - double(a.x);
        const double dy = double(b.y) - double(a.y);
        const double length2 = dx * dx + dy * dy;
        const double along =
            length2 > 0.0 ? std::clamp(((x - double(a.x)) * dx + (y - double(a.y)) * dy) / length2, 0.0, 1.0)
                          : 0.0;
        nearest = std::min(nearest, std::hypot(double(a.x) + along * dx - x, double(a.y) + along * dy - y));
    }
    return nearest;
}

} // namespace plumb::test
