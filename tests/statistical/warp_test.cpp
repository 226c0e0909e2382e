// SPDX-License-Identifier: MIT

// Every warp against its density.

#include "plumb/sampling/sampling.h"

#include "support/catch.h"
#include "support/statistics.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace plumb;
using namespace plumb::test;

namespace {

struct SphericalWarp {
    std::string name;
    std::function<Vec3f(Vec2f)> warp;
    DirectionDensity density;
    SphereGrid grid;
};

std::vector<SphericalWarp> spherical_warps()
{
    std::vector<SphericalWarp> warps = {
        {"cosine hemisphere", square_to_cosine_hemisphere, cosine_hemisphere_pdf, {}},
        {"uniform hemisphere", square_to_uniform_hemisphere, uniform_hemisphere_pdf, {}},
        {"uniform sphere", square_to_uniform_sphere, [](const Vec3f&) { return uniform_sphere_pdf(); }, {}},
    };
    for (const float exponent : {0.f, 1.f, 7.f, 100.f, 10'000.f}) {
        SphereGrid grid;
        grid.concentration = std::max(1.0, std::log2(static_cast<double>(exponent)));
        warps.push_back({"cosine power " + std::to_string(exponent),
                         [=](Vec2f u) { return square_to_cosine_power(u, exponent); },
                         [=](const Vec3f& w) { return cosine_power_pdf(w, exponent); }, grid});
    }
    for (const float one_minus_cos : {1.5f, 0.2f, 0.0009765625f, 1e-6f}) {
        // The cone's rim is the border of a cell: (k / 20)^concentration = (1 - cos) / 2, with k = 16.
        SphereGrid grid;
        grid.concentration = std::log(one_minus_cos / 2.0) / std::log(16.0 / 20.0);
        const auto density = [=](const Vec3f& w) {
            const double sine_squared = static_cast<double>(w.x) * w.x + static_cast<double>(w.y) * w.y;
            const double one_minus =
                w.z > 0.f ? sine_squared / (1.0 + std::sqrt(1.0 - sine_squared)) : 1.0 - w.z;
            return one_minus <= one_minus_cos * (1.0 + 1e-6)
                       ? static_cast<double>(uniform_cone_pdf(one_minus_cos))
                       : 0.0;
        };
        warps.push_back({"uniform cone " + std::to_string(one_minus_cos),
                         [=](Vec2f u) { return square_to_uniform_cone(u, one_minus_cos); }, density, grid});
    }
    return warps;
}

void check_spherical_warps(std::uint64_t samples)
{
    const auto warps = spherical_warps();
    for (const SphericalWarp& one : warps) {
        const auto sample = [&](TestRandom& random) { return one.warp(random.next_2d()); };
        check_distribution(one.name, one.grid, sample, one.density, samples,
                           sidak_level(significance, warps.size()));
    }
}

void check_plane_warps(std::uint64_t samples)
{
    const double level = sidak_level(significance, 2);
    check_distribution(
        "concentric disk", Grid{-1, 1, -1, 1, 16, 16},
        [](TestRandom& random) { return Imath::V2d(square_to_concentric_disk(random.next_2d())); },
        [](double x, double y) {
            return concentric_disk_pdf({static_cast<float>(x), static_cast<float>(y)});
        },
        samples, level);
    check_distribution(
        "triangle", Grid{0, 1, 0, 1, 16, 16},
        [](TestRandom& random) { return Imath::V2d(square_to_triangle(random.next_2d())); },
        [](double x, double y) { return x + y <= 1.0 ? 2.0 : 0.0; }, samples, level);
}

} // namespace

TEST_CASE("directions of warps follow their densities", "[statistical][warp]")
{
    check_spherical_warps(100'000);
}

TEST_CASE("points of warps follow their densities", "[statistical][warp]")
{
    check_plane_warps(100'000);
}

TEST_CASE("warps follow their densities, with many samples", "[statistical][warp][slow]")
{
    check_spherical_warps(2'000'000);
    check_plane_warps(2'000'000);
}
