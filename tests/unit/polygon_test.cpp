// SPDX-License-Identifier: MIT
// Cutting polygons into triangles, whatever their kind, size, plane and first corner.

#include "shapes/obj/obj_polygon.h"
#include "shapes/obj/point_tree.h"
#include "support/catch.h"
#include "support/polygons.h"

#include <algorithm>
#include <string_view>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Kind {
    const char* name;
    Polygon (*make)(int corners, TestRandom& random);
};
constexpr Kind kinds[] = {
    {"star", [](int n, TestRandom& random) { return star_polygon(n, random); }},
    {"monotone", [](int n, TestRandom& random) { return monotone_polygon(n, random); }},
    {"comb", [](int n, TestRandom&) { return comb_polygon(n, 1.f); }},
    {"touching comb", [](int n, TestRandom&) { return comb_polygon(n, 0.f); }},
    {"spiral", [](int n, TestRandom&) { return spiral_polygon(n); }},
    {"flower", [](int n, TestRandom&) { return flower_polygon(n); }},
    {"square holes", [](int n, TestRandom&) { return holed_polygon(std::max(n / 6, 1), 4); }},
    {"one round hole", [](int n, TestRandom&) { return holed_polygon(1, n / 2 * 2); }},
};

enum class Change { none, collinear, doubled };

Polygon changed(const Polygon& polygon, Change change, TestRandom& random)
{
    if (change == Change::collinear) return with_collinear_corners(polygon, random);
    if (change == Change::doubled) return with_doubled_corners(polygon, random);
    return polygon;
}

// The polygon in a plane somewhere in space, from another first corner.
struct Placed {
    Polygon flat;
    std::vector<Vec3f> corners;
};

Placed placed(Polygon polygon, bool in_any_plane, TestRandom& random)
{
    const auto first =
        static_cast<std::ptrdiff_t>(random.next_double() * static_cast<double>(polygon.size()));
    std::rotate(polygon.begin(), polygon.begin() + first, polygon.end());
    Placed result{std::move(polygon), {}};
    Vec3d x(1, 0, 0), y(0, 1, 0), origin(0.0);
    if (in_any_plane) {
        x = Vec3d(random.direction());
        y = normalize(cross(x, Vec3d(random.direction())));
        origin = Vec3d(random.direction());
    }
    for (const Vec2f& p : result.flat)
        result.corners.emplace_back(
            Vec3f(origin + x * static_cast<double>(p.x) + y * static_cast<double>(p.y)));
    return result;
}

Vec3d area_vector(const std::vector<Vec3f>& corners, const PolygonTriangle& t)
{
    const Vec3d a(corners[t[0]]);
    return cross(Vec3d(corners[t[1]]) - a, Vec3d(corners[t[2]]) - a) * 0.5;
}

double largest_coordinate(const Polygon& polygon)
{
    float largest = 0.f;
    for (const Vec2f& p : polygon) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    return static_cast<double>(largest);
}

// How many triangles the point lies in.
int coverage(const Polygon& polygon, const std::vector<PolygonTriangle>& triangles, double x, double y)
{
    int count = 0;
    for (const PolygonTriangle& t : triangles) {
        int inside = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec2f& a = polygon[t[i]];
            const Vec2f& b = polygon[t[(i + 1) % 3]];
            inside += turn({double(a.x), double(a.y)}, {double(b.x), double(b.y)}, {x, y}) > 0.0;
        }
        count += inside == 3;
    }
    return count;
}

std::vector<PlanePoint> plane_points(const Polygon& polygon)
{
    std::vector<PlanePoint> points;
    for (const Vec2f& p : polygon) points.push_back({double(p.x), double(p.y)});
    return points;
}

} // namespace

TEST_CASE("polygons of every kind are cut into triangles that fill them once", "[unit][obj]")
{
    const int corners = GENERATE(6, 12, 40, 130, 300, 1000);
    const Change change = GENERATE(Change::none, Change::collinear, Change::doubled);
    TestRandom random(static_cast<std::uint64_t>(corners));
    for (const Kind& kind : kinds) {
        for (int plane = 0; plane < (corners < 100 ? 20 : 4); ++plane) {
            const Placed polygon =
                placed(changed(kind.make(corners, random), change, random), plane > 0, random);
            CAPTURE(kind.name, corners, change, plane);
            std::vector<PolygonTriangle> triangles;
            triangulate_polygon(polygon.corners, triangles);
            REQUIRE(triangles.size() == polygon.corners.size() - 2);

            // Together they have the area, none of it folded back.
            const Vec3d normal = normalize(newell_normal(polygon.corners));
            double area = 0.0;
            double folded = 0.0;
            for (const PolygonTriangle& t : triangles) {
                area += length(area_vector(polygon.corners, t));
                folded += std::max(-dot(area_vector(polygon.corners, t), normal), 0.0);
            }
            CHECK(area == Approx(area_of(polygon.flat)).epsilon(plane > 0 ? 1e-4 : 1e-9));
            CHECK(folded <= (plane > 0 ? 1e-5 : 0.0) * area);

            // Each point of the polygon lies in one of them.
            const double size = largest_coordinate(polygon.flat);
            for (int i = 0; i < 40; ++i) {
                const double x = random.between(-size, size);
                const double y = random.between(-size, size) * (kind.name[0] == 's' ? 1.0 : 10.0 / size);
                if (distance_to_boundary(polygon.flat, x, y) < 1e-5 * size) continue;
                const int covered = coverage(polygon.flat, triangles, x, y);
                if (covered != 0 || contains(polygon.flat, x, y))
                    CHECK(covered == contains(polygon.flat, x, y)); // an edge of a triangle is unlikely
            }

            std::vector<PolygonTriangle> again;
            triangulate_polygon(polygon.corners, again);
            CHECK(again == triangles);
        }
    }
}

TEST_CASE("the time to cut a polygon grows little faster than its corners", "[unit][obj]")
{
    TestRandom random;
    for (const Kind& kind : kinds) {
        CAPTURE(kind.name);
        const auto steps = [&](int corners) {
            return static_cast<double>(cut_polygon(plane_points(kind.make(corners, random))).steps);
        };
        // The petals of a flower all touch in one point, and are counted there: that takes longer, up to a limit.
        const bool touches_in_a_point = kind.name == std::string_view("flower");
        const int corners = touches_in_a_point ? 512 : 4096;
        const double few = steps(corners);
        const double many = steps(8 * corners);
        // n log n: 10. The worst of the tree is n sqrt(n): 22.6.
        CHECK(many / few < (touches_in_a_point ? 70.0 : 23.0));
        CHECK(many < (touches_in_a_point ? 256.0 : 16.0) * 8.0 * corners * 16.0);
    }
}

TEST_CASE("corners on a line are shared with the triangles beside them", "[unit][obj]")
{
    // The gaps of a comb lie on a line; the bar below has triangles that end there, not a long edge past all of them.
    for (const int corners : {40, 1000}) {
        const std::vector<PlanePoint> comb = plane_points(comb_polygon(corners, 1.f));
        const PolygonCut cut = cut_polygon(comb);
        CHECK(std::none_of(cut.triangles.begin(), cut.triangles.end(), [&](const PolygonTriangle& t) {
            return turn(comb[t[0]], comb[t[1]], comb[t[2]]) == 0.0;
        }));
    }
}

TEST_CASE("polygons that cross themselves are cut in bounded time", "[unit][obj]")
{
    TestRandom random;
    for (const int corners : {5, 50, 20000}) {
        std::vector<Vec3f> polygon;
        for (int i = 0; i < corners; ++i) polygon.emplace_back(random.next_1d(), random.next_1d(), 0.f);
        std::vector<PolygonTriangle> triangles;
        triangulate_polygon(polygon, triangles);
        CHECK(triangles.size() == polygon.size() - 2);
        for (const PolygonTriangle& t : triangles)
            for (const std::uint32_t corner : t) REQUIRE(corner < polygon.size());
    }
}

TEST_CASE("polygons without an area are cut, too", "[unit][obj]")
{
    for (const std::size_t corners : {5u, 200u}) {
        std::vector<Vec3f> line;
        for (std::size_t i = 0; i < corners; ++i)
            line.emplace_back(static_cast<float>(i * 7 % corners), 0.f, 0.f);
        std::vector<PolygonTriangle> triangles;
        triangulate_polygon(line, triangles);
        CHECK(triangles.size() == corners - 2);
        triangles.clear();
        triangulate_polygon(std::vector<Vec3f>(corners, Vec3f(1.f, 2.f, 3.f)), triangles);
        CHECK(triangles.size() == corners - 2);
    }
}

TEST_CASE("the side of a line is exact", "[unit][obj]")
{
    // Points on the line y = x, and next to it by the last bit of a float; the rounded area is wrong for many.
    TestRandom random;
    for (int i = 0; i < 10000; ++i) {
        const auto coordinate = [&random](float exponent) {
            return static_cast<double>((random.next_1d() + 0.5f) * std::exp2(exponent * random.next_1d()));
        };
        const double a = coordinate(-60.f);
        const double b =
            coordinate(-20.f) + a == a ? 2.0 : static_cast<double>(static_cast<float>(coordinate(-20.f)));
        const double c = coordinate(-60.f);
        REQUIRE(turn_sign({a, a}, {b, b}, {c, c}) == 0);
        const double above = static_cast<double>(std::nextafter(static_cast<float>(c), infinity));
        const int side = a < b ? 1 : a > b ? -1 : 0;
        REQUIRE(turn_sign({a, a}, {b, b}, {c, above}) == side);
        REQUIRE(turn_sign({a, a}, {b, b}, {above, c}) == -side);
    }
}

TEST_CASE("the points of a triangle are found, and those that were removed are not", "[unit][obj]")
{
    TestRandom random;
    std::vector<PlanePoint> points;
    std::vector<std::uint32_t> members;
    for (std::uint32_t i = 0; i < 500; ++i) {
        points.push_back({double(random.next_1d()), double(random.next_1d())});
        if (i % 3 != 0) members.push_back(i);
    }
    PointTree tree(points, members);
    for (std::uint32_t i = 0; i < 500; i += 5) tree.remove(i);
    for (int k = 0; k < 200; ++k) {
        PlaneTriangle triangle;
        for (PlanePoint& p : triangle) p = {double(random.next_1d()), double(random.next_1d())};
        if (turn(triangle[0], triangle[1], triangle[2]) < 0.0) std::swap(triangle[0], triangle[1]);
        const auto is_inside = [&](std::uint32_t i) {
            for (std::size_t e = 0; e < 3; ++e)
                if (turn(triangle[e], triangle[(e + 1) % 3], points[i]) < 0.0) return false;
            return true;
        };
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < 500; ++i)
            if (i % 3 != 0 && i % 5 != 0 && is_inside(i)) expected.push_back(i);
        std::vector<std::uint32_t> found;
        CHECK_FALSE(tree.any_in(triangle, 0.0, [&](std::uint32_t i) {
            if (is_inside(i)) found.push_back(i);
            return false;
        }));
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
        CHECK(tree.any_in(triangle, 0.0, is_inside) == !expected.empty());
    }
}
