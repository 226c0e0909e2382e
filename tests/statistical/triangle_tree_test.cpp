// SPDX-License-Identifier: MIT

// The choice among the triangles of a mesh that emits: the probabilities it says are those it has, no triangle that a receiver
// sees is forgotten, and what is chosen makes less noise than choosing by area.

#include "shapes/triangle_lanes.h"
#include "shapes/triangle_tree.h"

#include "plumb/sampling/sampling.h"
#include "support/catch.h"
#include "support/choice_outcome.h"
#include "support/random.h"
#include "support/statistics.h"

#include <cmath>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// A mesh, and what is known of its triangles.
struct Triangles {
    MeshData mesh;
    std::vector<Facet> facets;

    void add(const Vec3f& a, const Vec3f& b, const Vec3f& c)
    {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3f& corner : {a, b, c}) mesh.positions.push_back(corner);
        mesh.triangles.push_back({first, first + 1, first + 2});
        const Vec3d normal = cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
        const double size = length(normal);
        facets.push_back({{a, b, c}, size > 0.0 ? Vec3f(normal / size) : Vec3f(0.f), size * 0.5});
    }
    // Vertex normals that turn the front to the other side.
    void turn()
    {
        for (Facet& facet : facets) {
            facet.normal = -facet.normal;
            mesh.normals.insert(mesh.normals.end(), 3, facet.normal);
        }
    }
    TriangleTree tree() const { return TriangleTree(mesh); }
    double sum(const TriangleTree& tree, const LightReceiver& receiver) const
    {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < facets.size(); ++i) sum += tree.probability(receiver, i);
        return sum;
    }
};

Vec3f in_cube(TestRandom& random, double half)
{
    const double x = random.between(-half, half);
    const double y = random.between(-half, half);
    const double z = random.between(-half, half);
    return Vec3f(Vec3d(x, y, z));
}

// A ball of 4 rows^2 - 4 rows triangles that face outwards.
Triangles ball(int rows, const Vec3f& center = Vec3f(0.f), double radius = 1.0)
{
    const auto point = [&](int row, int column) {
        const double theta = pi_d * row / rows, phi = pi_d * column / rows;
        const Vec3d p(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        return Vec3f(Vec3d(center) + p * radius);
    };
    Triangles triangles;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            if (i > 0) triangles.add(point(i, j), point(i, j + 1), point(i + 1, j));
            if (i + 1 < rows) triangles.add(point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
        }
    return triangles;
}

// Of all sizes: slivers, points and lines among them.
Triangles random_triangles(TestRandom& random, int count)
{
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
        const Vec3f a = in_cube(random, 0.5);
        const double size = std::pow(10.0, random.between(-3.0, -0.5));
        const Vec3f b = a + in_cube(random, size);
        const double kind = random.next_double();
        const Vec3f c = kind < 0.1   ? b
                        : kind < 0.2 ? a + (b - a) * 0.5f + in_cube(random, 1e-4)
                                     : a + in_cube(random, size);
        triangles.add(a, b, c);
    }
    return triangles;
}

// Light from both sides counts for every third one.
LightReceiver receiver_within(TestRandom& random, double half)
{
    const Vec3f position = in_cube(random, half);
    const Vec3f normal = random.direction();
    const bool any_side = random.next_1d() < 0.33f;
    return {position, any_side ? Vec3f(0.f) : normal};
}

// Cells: the triangles, and nothing.
Outcome triangles_outcome(const Triangles& mesh, const TriangleTree& tree, const LightReceiver& receiver,
                          std::uint64_t samples, std::uint64_t seed)
{
    const std::size_t count = mesh.facets.size();
    std::vector<double> chosen(count + 1, 0.0);
    std::vector<double> chances(count + 1, 0.0);
    chances.back() = std::max(1.0 - mesh.sum(tree, receiver), 0.0);
    for (std::uint32_t i = 0; i < count; ++i) chances[i] = tree.probability(receiver, i);

    TestRandom random(seed);
    for (std::uint64_t i = 0; i < samples; ++i) {
        const auto choice = tree.choose(receiver, random.next_double());
        if (choice && (!(choice->probability > 0.0) || choice->probability != chances[choice->triangle]))
            return {0.0, fmt::format("triangle {} was chosen with probability {} and has {}",
                                     choice->triangle, choice->probability, chances[choice->triangle])};
        ++chosen[choice ? choice->triangle : count];
    }

    return choice_outcome(chosen, chances, samples);
}

} // namespace

TEST_CASE("triangles are chosen with the probability that is said", "[statistical][shape][light_tree]")
{
    TestRandom random(21);
    constexpr int receivers = 7;
    std::vector<Triangles> meshes;
    for (const int count : {2, 3, 8, 9, 17, 65, 700}) meshes.push_back(random_triangles(random, count));
    for (const int rows : {2, 5, 16, 40}) meshes.push_back(ball(rows));
    for (const Triangles& mesh : meshes) {
        const TriangleTree tree = mesh.tree();
        for (int i = 0; i < receivers; ++i) {
            const double half = i == 0 ? 0.05 : i == 1 ? 20.0 : i == 2 ? 1e9 : 2.0;
            const LightReceiver receiver = receiver_within(random, half);
            CHECK(mesh.sum(tree, receiver) <= 1.0 + 1e-9);
            check_statistic(
                fmt::format("{} triangles, receiver {}", mesh.facets.size(), i),
                [&](std::uint64_t samples, std::uint64_t seed) {
                    return triangles_outcome(mesh, tree, receiver, samples, seed);
                },
                10000, sidak_level(significance, meshes.size() * receivers));
        }
    }
}

TEST_CASE("a triangle that may light the receiver can be chosen", "[statistical][shape][light_tree]")
{
    TestRandom random(22);
    int reached = 0;
    int culled = 0;
    for (int i = 0; i < 30; ++i) {
        Triangles mesh = i % 3 == 0 ? ball(4 + i) : random_triangles(random, 1 << (i % 10));
        if (i % 4 == 0) mesh.turn();
        const TriangleTree tree = mesh.tree();
        for (int j = 0; j < 200; ++j) {
            const LightReceiver receiver = receiver_within(random, j % 2 == 0 ? 0.5 : 4.0);
            for (std::uint32_t k = 0; k < mesh.facets.size();
                 k += 1 + static_cast<std::uint32_t>(mesh.facets.size() / 8)) {
                const Facet& facet = mesh.facets[k];
                const Vec2f u = random.next_2d();
                const Vec2f b = square_to_triangle(u);
                const Vec3d point = Vec3d(facet.corners[0]) * (1.0 - b.x - b.y) +
                                    Vec3d(facet.corners[1]) * static_cast<double>(b.x) +
                                    Vec3d(facet.corners[2]) * static_cast<double>(b.y);
                const Vec3d there = point - Vec3d(receiver.position);
                const bool reaches =
                    facet.area > 0.0 && dot(there, Vec3d(facet.normal)) < 0.0 &&
                    (receiver.normal == Vec3f(0.f) || dot(there, Vec3d(receiver.normal)) > 0.0);
                const double probability = tree.probability(receiver, k);
                if (reaches) {
                    ++reached;
                    if (!(probability > 0.0)) FAIL("triangle " << k << " of " << mesh.facets.size());
                } else if (!(probability > 0.0)) {
                    ++culled;
                }
            }
        }
    }
    CHECK(reached > 5000);
    CHECK(culled > 5000);
}

TEST_CASE("the back of a ball is not chosen", "[statistical][shape][light_tree]")
{
    const Triangles mesh = ball(16);
    const TriangleTree tree = mesh.tree();
    const LightReceiver receiver{Vec3f(0.f, -4.f, 0.f), Vec3f(0, 1, 0)};
    double turned_away = 0.0;
    for (std::uint32_t i = 0; i < mesh.facets.size(); ++i)
        if (mesh.facets[i].normal.y > 0.1f) turned_away += tree.probability(receiver, i);
    CHECK(turned_away < 0.01);
    CHECK(mesh.sum(tree, receiver) > 0.8); // few choices lead nowhere
}

TEST_CASE("the light of a ball of triangles has little noise", "[statistical][shape][light_tree]")
{
    TestRandom random(23);
    const Triangles mesh = ball(8);
    const TriangleTree tree = mesh.tree();
    double total = 0.0;
    for (const auto& facet : mesh.facets) total += facet.area;
    double variance = 0.0;
    double variance_by_area = 0.0;
    for (int i = 0; i < 20; ++i) {
        const Vec3f position = random.direction() * (1.5f + 3.f * random.next_1d());
        const LightReceiver receiver{position, normalize(-position + in_cube(random, 0.3))};
        const auto irradiance = [&](std::uint32_t triangle, const Vec2f& u, double pdf) {
            const auto& facet = mesh.facets[triangle];
            const Vec2f b = square_to_triangle(u);
            const Vec3d point = Vec3d(facet.corners[0]) * (1.0 - b.x - b.y) +
                                Vec3d(facet.corners[1]) * static_cast<double>(b.x) +
                                Vec3d(facet.corners[2]) * static_cast<double>(b.y);
            const Vec3d there = point - Vec3d(receiver.position);
            const double distance2 = length_squared(there);
            const double cosines = std::max(dot(there, Vec3d(receiver.normal)), 0.0) *
                                   std::max(-dot(there, Vec3d(facet.normal)), 0.0) / distance2;
            return cosines / distance2 / pdf;
        };
        const auto by_tree = [&](std::uint64_t samples, std::uint64_t seed) {
            TestRandom numbers(seed);
            MeanAndVariance light;
            for (std::uint64_t k = 0; k < samples; ++k) {
                const auto choice = tree.choose(receiver, numbers.next_double());
                const Vec2f u = numbers.next_2d();
                light.add(choice ? irradiance(choice->triangle, u,
                                              choice->probability / mesh.facets[choice->triangle].area)
                                 : 0.0);
            }
            return light;
        };
        const auto by_area = [&](std::uint64_t samples, std::uint64_t seed) {
            TestRandom numbers(seed);
            MeanAndVariance light;
            for (std::uint64_t k = 0; k < samples; ++k) {
                const std::uint32_t triangle = tree.choose_by_area(numbers.next_double());
                light.add(irradiance(triangle, numbers.next_2d(), 1.0 / total));
            }
            return light;
        };
        variance += by_tree(4000, 5).variance();
        variance_by_area += by_area(4000, 6).variance();
        check_statistic(
            fmt::format("receiver {}", i),
            [&](std::uint64_t samples, std::uint64_t seed) {
                return same_mean_outcome(by_tree(samples, seed), by_area(samples, seed + 1));
            },
            4000, sidak_level(significance, 20), 7);
    }
    INFO("variance " << variance << ", by area " << variance_by_area);
    CHECK(variance < variance_by_area / 5.0);
}

TEST_CASE("a tree of triangles takes at most 16 bytes a triangle, and 12 for the choice by area; a small one "
          "41 more",
          "[statistical][shape][light_tree]")
{
    for (const int rows : {20, 60, 91, 130, 140, 200}) {
        const Triangles mesh = ball(rows);
        const TriangleTree tree = mesh.tree();
        INFO(mesh.facets.size() << " triangles");
        const std::size_t each = mesh.facets.size() <= 16384 ? 69 : 28;
        CHECK(tree.memory_bytes() <= each * mesh.facets.size());
    }
}
