// SPDX-License-Identifier: MIT

// What every BSDF of the catalog promises (plumb/model/bsdf.h), in every configuration of tests/support/bsdf_cases.cpp.

#include "support/bsdf_cases.h"
#include "support/catch.h"

using namespace plumb;
using namespace plumb::test;

namespace {

const SurfacePoint somewhere;

std::optional<BsdfSample> sample_once(const Bsdf& bsdf, const Vec3f& wi, TestRandom& random)
{
    const float u_lobe = random.next_1d();
    const Vec2f u = random.next_2d();
    return bsdf.sample(somewhere, wi, u_lobe, u);
}

bool only_delta(const Bsdf& bsdf)
{
    return (bsdf.lobes().bits & ~delta_lobes.bits) == 0;
}

// The sides that a BSDF works from, at several angles.
std::vector<Vec3f> views(const Bsdf& bsdf, std::initializer_list<double> degrees)
{
    std::vector<Vec3f> result;
    for (const double angle : degrees) {
        result.push_back(direction_at(angle));
        if (bsdf.has_back()) result.push_back(direction_at(180.0 - angle));
    }
    return result;
}

// Directions everywhere, a few of them grazing.
Vec3f any_view(const Bsdf& bsdf, TestRandom& random)
{
    const double u = random.next_double();
    const double angle = random.next_double() < 0.1 ? 90.0 - 0.1 * u : 89.9 * u;
    const bool back = bsdf.has_back() && random.next_double() < 0.5;
    return direction_at(back ? 180.0 - angle : angle, random.between(0.0, 2.0 * pi_d));
}

std::string at_angle(const BsdfCase& test, const Vec3f& wi)
{
    return test.name() + " seen from wi = " + Catch::Detail::stringify(wi.x) + " " +
           Catch::Detail::stringify(wi.y) + " " + Catch::Detail::stringify(wi.z);
}

// Samples follow the density, and are refused as often as it lacks to 1.
void check_sampling(std::initializer_list<double> degrees, std::uint64_t samples)
{
    struct Run {
        const BsdfCase* test;
        std::shared_ptr<Bsdf> bsdf;
        Vec3f wi;
        LobeGrid grid;
    };
    std::vector<Run> runs;
    for (const auto& test : bsdf_cases()) {
        const std::shared_ptr<Bsdf> bsdf = test.build();
        if (only_delta(*bsdf)) continue;
        for (const Vec3f& wi : views(*bsdf, degrees))
            for (const auto& grid : lobe_grids(test, *bsdf, wi)) runs.push_back({&test, bsdf, wi, grid});
    }
    REQUIRE(!runs.empty());
    for (const Run& run : runs) {
        const auto sample = [&](TestRandom& random) -> std::optional<Vec3f> {
            const auto one = sample_once(*run.bsdf, run.wi, random);
            if (!one || one->is_delta() || !run.grid.covers(one->wo)) return std::nullopt;
            return one->wo;
        };
        const auto density = [&](const Vec3f& wo) {
            if (!run.grid.covers(wo)) return 0.0;
            return static_cast<double>(run.bsdf->evaluate(somewhere, run.wi, wo).pdf);
        };
        check_distribution(at_angle(*run.test, run.wi), run.grid.grid, sample, density, samples,
                           sidak_level(significance, runs.size()));
    }
}

// No more light leaves than arrives. Refraction scales radiance by 1 / eta^2; the factor does not count here.
void check_energy(std::initializer_list<double> degrees, std::uint64_t samples)
{
    std::size_t count = 0;
    for (const auto& test : bsdf_cases()) count += views(*test.build(), degrees).size();
    for (const auto& test : bsdf_cases()) {
        const auto bsdf = test.build();
        if (test.gains_energy || !bsdf->conserves_energy()) continue;
        for (const Vec3f& wi : views(*bsdf, degrees)) {
            const auto run = [&](std::uint64_t n, std::uint64_t seed) -> Outcome {
                TestRandom random(seed);
                MeanAndVariance albedo;
                for (std::uint64_t i = 0; i < n; ++i) {
                    const auto one = sample_once(*bsdf, wi, random);
                    albedo.add(one ? max_component(one->weight) * sqr(one->eta) : 0.0);
                }
                const Outcome against_1 = mean_outcome(albedo, 1.0, 1e-5);
                return albedo.mean() <= 1.0 ? Outcome{1.0, against_1.text} : against_1;
            };
            check_statistic("albedo of " + at_angle(test, wi), run, samples,
                            sidak_level(significance, count));
        }
    }
}

} // namespace

TEST_CASE("BSDF samples follow their density", "[statistical][bsdf]")
{
    check_sampling({0.0, 35.0, 80.0, 87.13}, 40'000); // the last: cosine 0.05
}

TEST_CASE("BSDF samples follow their density, at more angles with more samples", "[statistical][bsdf][slow]")
{
    check_sampling({0.5, 20.0, 60.0, 70.0, 85.0, 89.0, 89.9, 89.94}, 400'000);
}

TEST_CASE("no BSDF reflects and transmits more than it receives", "[statistical][bsdf]")
{
    check_energy({0.0, 30.0, 60.0, 80.0, 88.0}, 20'000);
}

TEST_CASE("a BSDF's samples agree with its value and density", "[statistical][bsdf]")
{
    for (const auto& test : bsdf_cases()) {
        CAPTURE(test.name());
        const auto bsdf = test.build();
        TestRandom random(3);
        int kept = 0;
        double worst = 0.0;
        for (int i = 0; i < 20'000; ++i) {
            const Vec3f wi = any_view(*bsdf, random);
            const auto one = sample_once(*bsdf, wi, random);
            if (!one || one->is_delta()) continue;
            ++kept;
            const auto [f_cos, pdf] = bsdf->evaluate(somewhere, wi, one->wo);
            worst = std::max(worst, std::abs(pdf - one->pdf) / static_cast<double>(pdf));
            for (int channel = 0; channel < 3; ++channel) {
                const double difference = std::abs(one->weight[channel] * one->pdf - f_cos[channel]);
                if (difference > 0.0) worst = std::max(worst, difference / f_cos[channel]);
            }
        }
        CHECK(worst <= 1e-4);
        CHECK(kept > (only_delta(*bsdf) ? -1 : 5'000));
    }
}

TEST_CASE("a BSDF's samples keep to their lobes", "[statistical][bsdf]")
{
    for (const auto& test : bsdf_cases()) {
        CAPTURE(test.name());
        const auto bsdf = test.build();
        TestRandom random(4);
        Lobes seen;
        int wrong = 0;
        for (int i = 0; i < 20'000; ++i) {
            const Vec3f wi = any_view(*bsdf, random);
            const auto one = sample_once(*bsdf, wi, random);
            if (!one) continue;
            seen = seen | one->lobe;
            const bool crossed = !same_hemisphere(wi, one->wo);
            const bool right =
                bsdf->lobes().has_any(one->lobe) && crossed == (one->is_transmission() || one->is_pass()) &&
                (crossed || one->eta == 1.f) && one->eta > 0.f && std::abs(length(one->wo) - 1.f) < 1e-5f &&
                min_component(one->weight) >= 0.f && one->pdf > 0.f;
            wrong += right ? 0 : 1;
            if (!one->is_delta()) continue;
            const auto at_delta = bsdf->evaluate(somewhere, wi, one->wo);
            wrong += only_delta(*bsdf) && !(at_delta.f_cos.is_black() && at_delta.pdf == 0.f) ? 1 : 0;
        }
        CHECK(wrong == 0);
        CHECK(seen.bits != 0);
    }
}

TEST_CASE("BSDFs are reciprocal", "[statistical][bsdf]")
{
    // f(wi, wo) = f(wo, wi); with refraction f(wi, wo) / eta_i^2 = f(wo, wi) / eta_o^2 (Veach 1997, equation 5.14).
    for (const auto& test : bsdf_cases()) {
        const auto bsdf = test.build();
        if (only_delta(*bsdf) || !bsdf->is_reciprocal()) continue;
        CAPTURE(test.name());
        // Lobes narrower than this amplify the rounding of directions.
        const double tolerance = 1e-4 + 2e-6 / test.narrowness;
        TestRandom random(6);
        int compared = 0, wrong = 0;
        for (int i = 0; i < 20'000; ++i) {
            const Vec3f wi = any_view(*bsdf, random);
            const auto one = sample_once(*bsdf, wi, random);
            if (!one || one->is_delta()) continue;
            const auto there = bsdf->evaluate(somewhere, wi, one->wo);
            const auto back = bsdf->evaluate(somewhere, one->wo, wi);
            for (int channel = 0; channel < 3; ++channel) {
                const double a = there.f_cos[channel] / std::abs(one->wo.z) * sqr(one->eta);
                const double b = back.f_cos[channel] / std::abs(wi.z);
                ++compared;
                wrong += std::abs(a - b) <= tolerance * std::max(a, b) + 1e-30 ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        CHECK(compared > 10'000);
    }
}

TEST_CASE("BSDFs without a back are black from behind", "[statistical][bsdf]")
{
    for (const auto& test : bsdf_cases()) {
        const auto bsdf = test.build();
        if (bsdf->has_back()) continue;
        CAPTURE(test.name());
        TestRandom random(7);
        int lit = 0;
        for (int i = 0; i < 1'000; ++i) {
            const Vec3f front = any_view(*bsdf, random);
            const Vec3f behind = -any_view(*bsdf, random);
            for (const auto& [wi, wo] :
                 {std::pair(front, behind), std::pair(behind, front), std::pair(behind, behind)}) {
                const auto value = bsdf->evaluate(somewhere, wi, wo);
                lit += value.f_cos.is_black() && value.pdf == 0.f ? 0 : 1;
            }
            const auto sampled = sample_once(*bsdf, behind, random);
            lit += sampled && !sampled->is_pass() ? 1 : 0;
        }
        CHECK(lit == 0);
    }
}
