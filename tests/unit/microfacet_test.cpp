// SPDX-License-Identifier: MIT

#include "bsdfs/microfacet_distribution.h"

#include "support/catch.h"
#include "support/statistics.h"

#include <cmath>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

Vec3f direction(double theta, double phi = 0.3)
{
    return Vec3f(Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
}

// Of directions that see microfacets, from straight above to grazing.
constexpr double cosines[] = {1.0, 0.9, 0.5, 0.2, 0.05, 0.001};

// Cells whose size follows that of the lobe.
SphereGrid grid_for(double alpha)
{
    return {Vec3f(0, 0, 1), std::max(1.0, 2.0 * std::log2(1.0 / alpha)), 20, 4};
}

} // namespace

TEST_CASE("Beckmann microfacets cover the surface: D cos integrates to 1", "[unit][microfacet]")
{
    for (const float alpha : {1e-4f, 1e-3f, 0.01f, 0.1f, 0.5f, 1.f}) {
        CAPTURE(alpha);
        const auto beckmann = MicrofacetDistribution::beckmann(alpha);
        const auto covered = [&](const Vec3f& wh) {
            return static_cast<double>(beckmann.d(wh) * std::max(0.f, wh.z));
        };
        CHECK(integrate_sphere(grid_for(alpha), covered) == Approx(1.0).epsilon(1e-4));
        for (const double cosine : cosines) {
            CAPTURE(cosine);
            const Vec3f v = direction(std::acos(cosine));
            const auto density = [&](const Vec3f& wh) {
                return static_cast<double>(beckmann.visible_pdf(v, wh));
            };
            CHECK(integrate_sphere(grid_for(alpha), density) == Approx(1.0).epsilon(1e-4));
        }
    }
}

TEST_CASE("Beckmann's D agrees with its formula and is finite everywhere", "[unit][microfacet]")
{
    for (const float alpha : {0.05f, 0.3f, 1.f}) {
        for (double theta = 0.0; theta < 1.5; theta += 0.05) {
            const double a = alpha, c = std::cos(theta), t = std::tan(theta) / a;
            const double expected = std::exp(-t * t) / (pi_d * a * a * c * c * c * c);
            CAPTURE(alpha, theta);
            CHECK(MicrofacetDistribution::beckmann(alpha).d(direction(theta)) ==
                  Approx(expected).epsilon(3e-5).margin(1e-30));
        }
    }
    for (const float alpha : {1e-4f, 0.1f, 1.f}) {
        for (const float z : {1.f, 0.5f, 1e-3f, 1e-6f, 1e-12f, 1e-20f, 1e-38f}) {
            const float d = MicrofacetDistribution::beckmann(alpha).d(Vec3f(std::sqrt(1.f - z * z), 0.f, z));
            CHECK(std::isfinite(d));
            CHECK(d >= 0.f);
        }
        CHECK(MicrofacetDistribution::beckmann(alpha).d(Vec3f(1.f, 0.f, 0.f)) == 0.f);
        CHECK(MicrofacetDistribution::beckmann(alpha).d(Vec3f(0.f, 0.f, -1.f)) == 0.f);
        CHECK(MicrofacetDistribution::beckmann(alpha).d(Vec3f(0.f, 0.f, 1.f)) ==
              Approx(1.0 / (pi_d * double(alpha) * double(alpha))));
    }
}

TEST_CASE("the rational fit of Beckmann's shadowing is close to the exact Smith function",
          "[unit][microfacet]")
{
    // Walter et al. 2007, section 5.2: G1 = 2 / (1 + erf(a) + exp(-a^2) / (a sqrt(pi))); the fit's relative error
    // is below 0.35 %.
    const Vec3f normal(0.f, 0.f, 1.f);
    for (const float alpha : {0.1f, 0.5f, 1.f}) {
        for (double theta = 0.01; theta < 1.57; theta += 0.01) {
            const double a = 1.0 / (alpha * std::tan(theta));
            const double exact = 2.0 / (1.0 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi_d)));
            CAPTURE(alpha, theta);
            CHECK(MicrofacetDistribution::beckmann(alpha).g1(direction(theta), normal) ==
                  Approx(exact).epsilon(0.0036));
            CHECK(MicrofacetDistribution::beckmann(alpha).g1(-direction(theta), normal) ==
                  Approx(exact).epsilon(0.0036));
        }
    }
}

TEST_CASE("shadowing is 0 where a direction does not see the microfacet, and G is the product",
          "[unit][microfacet]")
{
    const auto beckmann = MicrofacetDistribution::beckmann(0.5f);
    const Vec3f tilted = direction(1.0, 0.0);
    CHECK(beckmann.g1(direction(1.2, pi_d), tilted) == 0.f); // above the surface, behind the microfacet
    CHECK(beckmann.g1(direction(2.0, 0.0), tilted) == 0.f);  // below the surface, before the microfacet
    CHECK(beckmann.g1(Vec3f(1.f, 0.f, 0.f), tilted) == 0.f); // in the surface
    CHECK(beckmann.g1(Vec3f(0.f, 0.f, 1.f), tilted) == 1.f); // along the normal

    const Vec3f wi = direction(1.3, 0.1), wo = direction(1.4, 0.7);
    CHECK(beckmann.g(wi, wo, tilted) == beckmann.g1(wi, tilted) * beckmann.g1(wo, tilted));
    CHECK(beckmann.g(wi, wo, tilted) < 1.f);
}

TEST_CASE("microfacets cover what is seen of the surface, by Smith's exact shadowing", "[unit][microfacet]")
{
    // Heitz 2014, equation 23, with G1 as above.
    for (const float alpha : {1e-4f, 0.1f, 0.5f, 1.f})
        for (double theta = 0.01; theta < 1.5708; theta += 0.01) {
            const double a = 1.0 / (alpha * std::tan(theta));
            const double g1 = 2.0 / (1.0 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi_d)));
            CAPTURE(alpha, theta);
            CHECK(MicrofacetDistribution::beckmann(alpha).visible_area(direction(theta)) ==
                  Approx(std::cos(theta) / g1).epsilon(1e-5));
        }
    CHECK(MicrofacetDistribution::beckmann(0.5f).visible_area(Vec3f(0.f, 0.f, 1.f)) == 1.f);
    CHECK(MicrofacetDistribution::beckmann(0.5f).visible_area(Vec3f(1.f, 0.f, 0.f)) ==
          Approx(0.25 / std::sqrt(pi_d)));
}

TEST_CASE("visible microfacets are sampled by their density", "[statistical][microfacet]")
{
    const float alphas[] = {1e-4f, 0.01f, 0.1f, 0.4f, 1.f};
    for (const float alpha : alphas)
        for (const double cosine : cosines) {
            const auto beckmann = MicrofacetDistribution::beckmann(alpha);
            const Vec3f v = direction(std::acos(cosine));
            auto grid = grid_for(alpha);
            grid.phi_cells = 16;
            check_distribution(
                "Beckmann, alpha = " + std::to_string(alpha) + ", cosine = " + std::to_string(cosine), grid,
                [&](TestRandom& random) { return beckmann.sample_visible(v, random.next_2d()); },
                [&](const Vec3f& wh) { return beckmann.visible_pdf(v, wh); }, 40'000,
                sidak_level(significance, std::size(alphas) * std::size(cosines)));
        }
}

TEST_CASE("the slope of a visible microfacet inverts its distribution", "[unit][microfacet]")
{
    // Along the azimuth of v, slopes x (in units of alpha) have the distribution that is integrated here in closed form.
    for (const float alpha : {0.01f, 0.3f, 1.f})
        for (const double cosine : {0.9, 0.5, 0.2, 0.05, 1e-3, 1e-6, 1e-20}) {
            const double sine = std::sqrt(1.0 - cosine * cosine);
            const Vec3f v(Vec3d(sine, 0.0, cosine));
            const auto seen = [&](double x) {
                return cosine * std::erfc(-x) + alpha * sine * std::exp(-x * x) / std::sqrt(pi_d);
            };
            for (const float u : {0.f, 1e-6f, 1e-3f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 0.99f}) {
                CAPTURE(alpha, cosine, u);
                const Vec3d wh(MicrofacetDistribution::beckmann(alpha).sample_visible(v, Vec2f(u, 0.5f)));
                const double x = -wh.x / wh.z / alpha;
                const double expected = static_cast<double>(u) + 0x1p-25;
                CHECK(seen(x) / seen(cosine / (alpha * sine)) == Approx(expected).epsilon(3e-5));
            }
        }
}

TEST_CASE("visible microfacets of the corners of the square are finite unit vectors", "[unit][microfacet]")
{
    for (const float alpha : {1e-4f, 1.f})
        for (const float z : {1.f, 0.5f, 1e-3f, 1e-20f, 1e-40f})
            for (const float x : {0.f, one_minus_epsilon})
                for (const float y : {0.f, one_minus_epsilon}) {
                    CAPTURE(alpha, z, x, y);
                    const Vec3f v(std::sqrt(1.f - z * z), 0.f, z);
                    const Vec3f wh = MicrofacetDistribution::beckmann(alpha).sample_visible(v, {x, y});
                    CHECK(length(wh) == Approx(1.0).epsilon(1e-6));
                    CHECK(wh.z > 0.f);
                    CHECK(std::isfinite(MicrofacetDistribution::beckmann(alpha).visible_pdf(v, wh)));
                }
}

TEST_CASE("GGX and stretched microfacets cover the surface, and what is seen of it",
          "[statistical][microfacet]")
{
    for (const auto kind : {MicrofacetDistribution::Kind::beckmann, MicrofacetDistribution::Kind::ggx})
        for (const auto& [alpha_u, alpha_v] :
             {std::pair(0.2f, 0.2f), std::pair(1.f, 1.f), std::pair(0.5f, 0.2f), std::pair(0.2f, 0.6f)}) {
            CAPTURE(alpha_u, alpha_v);
            const MicrofacetDistribution microfacets(kind, alpha_u, alpha_v);
            const SphereGrid grid{Vec3f(0, 0, 1), 4.0, 40, 40};
            const auto covered = [&](const Vec3f& wh) {
                return static_cast<double>(microfacets.d(wh) * std::max(0.f, wh.z));
            };
            CHECK(integrate_sphere(grid, covered) == Approx(1.0).epsilon(1e-3));
            for (const double cosine : {1.0, 0.5, 0.05})
                for (const double phi : {0.3, 2.0}) {
                    CAPTURE(cosine, phi);
                    const Vec3f v = direction(std::acos(cosine), phi);
                    const auto seen = [&](const Vec3f& wh) {
                        return static_cast<double>(microfacets.visible_pdf(v, wh));
                    };
                    CHECK(integrate_sphere(grid, seen) == Approx(1.0).epsilon(1e-3));
                    // Heitz 2014, equation 16: the exact G1 gives the projected area.
                    if (kind == MicrofacetDistribution::Kind::ggx)
                        CHECK(microfacets.g1(v, Vec3f(0, 0, 1)) * microfacets.visible_area(v) ==
                              Approx(cosine).epsilon(1e-5));
                }
        }
}

TEST_CASE("D of GGX agrees with its formula, and its samples with D", "[statistical][microfacet]")
{
    for (const double theta : {0.0, 0.4, 1.2}) {
        // Walter et al. 2007, equation 33, and Heitz 2014, equation 85, with tan(theta) stretched.
        const double au = 0.3, av = 0.7, phi = 0.9, t = std::tan(theta), c = std::cos(theta);
        const double stretched = sqr(t) * (sqr(std::cos(phi) / au) + sqr(std::sin(phi) / av));
        const double expected = 1.0 / (pi_d * au * av * c * c * c * c * sqr(1.0 + stretched));
        const MicrofacetDistribution ggx(MicrofacetDistribution::Kind::ggx, 0.3f, 0.7f);
        CHECK(ggx.d(direction(theta, phi)) == Approx(expected).epsilon(1e-5));
    }
    const std::pair<float, float> alphas[] = {{0.05f, 0.05f}, {1.f, 1.f}, {0.5f, 0.2f}, {0.2f, 0.6f}};
    for (const auto kind : {MicrofacetDistribution::Kind::beckmann, MicrofacetDistribution::Kind::ggx})
        for (const auto& [alpha_u, alpha_v] : alphas)
            for (const double cosine : cosines) {
                const MicrofacetDistribution microfacets(kind, alpha_u, alpha_v);
                const Vec3f v = direction(std::acos(cosine), 0.8);
                auto grid = grid_for(std::min(alpha_u, alpha_v));
                grid.phi_cells = 16;
                check_distribution(
                    fmt::format("alphas {} {}, cosine {}", alpha_u, alpha_v, cosine), grid,
                    [&](TestRandom& random) { return microfacets.sample_visible(v, random.next_2d()); },
                    [&](const Vec3f& wh) { return microfacets.visible_pdf(v, wh); }, 40'000,
                    sidak_level(significance, 2 * std::size(alphas) * std::size(cosines)));
            }
}
