// SPDX-License-Identifier: MIT

#include "plumb/sampling/sampling.h"

#include "support/catch.h"
#include "support/random.h"

#include <cmath>
#include <functional>

using namespace plumb;
using namespace plumb::test;

namespace {

const float corners[] = {0.f, 0x1p-24f, 0.25f, 0.5f, 0.75f, one_minus_epsilon};

void for_each_corner(const std::function<void(Vec2f)>& check)
{
    for (const float x : corners)
        for (const float y : corners) check({x, y});
}

} // namespace

TEST_CASE("warps of the square's corners and centre stay in their domain", "[unit][sampling]")
{
    for_each_corner([](Vec2f u) {
        CAPTURE(u.x, u.y);
        const Vec2f disk = square_to_concentric_disk(u);
        CHECK(disk.x * disk.x + disk.y * disk.y <= 1.f + 3e-7f);

        const Vec2f triangle = square_to_triangle(u);
        CHECK(triangle.x >= 0.f);
        CHECK(triangle.y >= 0.f);
        CHECK(triangle.x + triangle.y <= 1.f);

        const Vec3f hemispheres[] = {square_to_cosine_hemisphere(u), square_to_uniform_hemisphere(u),
                                     square_to_cosine_power(u, 0.f), square_to_cosine_power(u, 1e6f),
                                     square_to_uniform_cone(u, 1.f), square_to_uniform_cone(u, 1e-12f)};
        for (const Vec3f& w : hemispheres) {
            CHECK(length(w) == Approx(1.0).epsilon(5e-7));
            CHECK(w.z >= 0.f);
        }
        CHECK(length(square_to_uniform_sphere(u)) == Approx(1.0).epsilon(5e-7));
    });
}

TEST_CASE("the concentric map keeps the centre, the axes and the corners' directions", "[unit][sampling]")
{
    CHECK(square_to_concentric_disk({0.5f, 0.5f}) == Vec2f(0.f, 0.f));
    const float edge = 0x1p-24f;
    const Vec2f right = square_to_concentric_disk({1.f - edge, 0.5f});
    CHECK(right.x == Approx(1.0));
    CHECK(right.y == Approx(0.0).margin(1e-6));
    const Vec2f top = square_to_concentric_disk({0.5f, 1.f - edge});
    CHECK(top.x == Approx(0.0).margin(1e-6));
    CHECK(top.y == Approx(1.0));
    const Vec2f corner = square_to_concentric_disk({0.f, 0.f});
    CHECK(corner.x == Approx(-std::sqrt(0.5)));
    CHECK(corner.y == Approx(-std::sqrt(0.5)));
    const Vec2f other = square_to_concentric_disk({1.f - edge, 0.f});
    CHECK(other.x == Approx(std::sqrt(0.5)));
    CHECK(other.y == Approx(-std::sqrt(0.5)));
}

TEST_CASE("densities are those of the textbook, and 0 where a warp cannot reach", "[unit][sampling]")
{
    const Vec3f up(0.f, 0.6f, 0.8f), down(0.f, 0.6f, -0.8f);
    CHECK(cosine_hemisphere_pdf(up) == Approx(0.8 / pi_d));
    CHECK(cosine_hemisphere_pdf(down) == 0.f);
    CHECK(uniform_hemisphere_pdf(up) == Approx(0.5 / pi_d));
    CHECK(uniform_hemisphere_pdf(down) == 0.f);
    CHECK(uniform_sphere_pdf() == Approx(0.25 / pi_d));
    CHECK(uniform_cone_pdf(0.25f) == Approx(1.0 / (2.0 * pi_d * 0.25)));
    CHECK(uniform_cone_pdf(1e-12f) == Approx(1e12 / (2.0 * pi_d)));
    CHECK(concentric_disk_pdf({0.5f, -0.5f}) == Approx(1.0 / pi_d));
    CHECK(concentric_disk_pdf({0.9f, 0.9f}) == 0.f);
    CHECK(cosine_power_pdf(up, 20.f) == Approx(21.0 / (2.0 * pi_d) * std::pow(0.8, 20)).epsilon(1e-5));
    CHECK(cosine_power_pdf(up, 0.f) == Approx(0.5 / pi_d));
    CHECK(cosine_power_pdf(down, 20.f) == 0.f);
}

TEST_CASE("narrow cones and lobes keep their digits", "[unit][sampling]")
{
    // The sine of the angle is sqrt(2 (1 - cos)) to first order.
    const Vec3f w = square_to_uniform_cone({0.5f, 0.f}, 1e-12f);
    CHECK(w.x == Approx(std::sqrt(2.0 * 0.5e-12)).epsilon(1e-5));
    const Vec3f lobe = square_to_cosine_power({0.5f, 0.f}, 1e8f);
    CHECK(lobe.x == Approx(std::sqrt(2.0 * std::log(2.0) / (1e8 + 1.0))).epsilon(1e-5));
    CHECK(cosine_power_pdf(lobe, 1e8f) == Approx((1e8 + 1.0) / (2.0 * pi_d) * 0.5).epsilon(1e-4));
}

TEST_CASE("multiple importance sampling weights sum to 1, and survive large densities", "[unit][sampling]")
{
    TestRandom random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto a = static_cast<float>(std::exp(random.between(-80.0, 80.0)));
        const auto b = static_cast<float>(std::exp(random.between(-80.0, 80.0)));
        CAPTURE(a, b);
        CHECK(balance_heuristic(a, b) + balance_heuristic(b, a) == Approx(1.0));
        CHECK(power_heuristic(a, b) + power_heuristic(b, a) == Approx(1.0));
    }
    CHECK(balance_heuristic(1.f, 3.f) == Approx(0.25));
    CHECK(power_heuristic(1.f, 3.f) == Approx(0.1));
    CHECK(power_heuristic(1.f, 0.f) == 1.f);
    CHECK(power_heuristic(0.f, 1.f) == 0.f);
    CHECK(balance_heuristic(0.f, 0.f) == 0.f);
    CHECK(power_heuristic(1e30f, 1e30f) == Approx(0.5));
}
