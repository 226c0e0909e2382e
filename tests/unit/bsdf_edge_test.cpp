// SPDX-License-Identifier: MIT

// BSDFs at the ends of their ranges: grazing directions, the corners of the random numbers, extreme parameters; the
// smooth ones against the laws of optics; and what they say of parameters out of range.

#include "base/float_mode.h"
#include "support/bsdf_cases.h"
#include "support/catch.h"

#include <cmath>

namespace plumb {
class Diffuse;
class Dielectric;
class Microfacet;
class RoughConductor;
class RoughSubstrate;
class RoughDielectric;
class Phong;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

const SurfacePoint somewhere;

ParamsBuilder bsdf(const std::string& type)
{
    return ParamsBuilder("bsdf", type);
}

std::vector<BsdfCase> extreme_cases()
{
    std::vector<BsdfCase> cases = bsdf_cases();
    for (const double alpha : {1e-30, 1e-4, 1.0}) {
        cases.push_back({bsdf("roughconductor").number("alpha", alpha)});
        for (const char* type : {"microfacet", "roughsubstrate", "roughdielectric"}) {
            cases.push_back({bsdf(type).number("alpha", alpha)});
            cases.push_back(
                {bsdf(type).number("alpha", alpha).number("intIOR", 100.0).number("extIOR", 0.01)});
            cases.push_back(
                {bsdf(type).number("alpha", alpha).number("intIOR", 1.0002).number("extIOR", 1.0)});
        }
    }
    cases.push_back({bsdf("phong").integer("exponent", 100'000'000)});
    cases.push_back({bsdf("phong").color("specular-coefficients", Color(0.f))});
    cases.push_back({bsdf("phong").color("specular-coefficients", Color(1e30f))});
    return cases;
}

// Whether what sample() gives for these numbers is usable, and evaluate() there, too.
bool is_sound(const Bsdf& test, const Vec3f& wi, float u_lobe, Vec2f u)
{
    const auto one = test.sample(somewhere, wi, u_lobe, u);
    if (!one) return true;
    const auto value = test.evaluate(somewhere, wi, one->wo);
    return is_finite(one->wo) && is_finite(one->weight) && std::isfinite(one->pdf) && one->pdf > 0.f &&
           std::isfinite(one->eta) && one->eta > 0.f && std::abs(length(one->wo) - 1.f) < 1e-5f &&
           same_hemisphere(wi, one->wo) != (one->is_transmission() || one->is_pass()) &&
           is_finite(value.f_cos) && std::isfinite(value.pdf);
}

bool is_sound(const Bsdf& test, const Vec3f& wi, const Vec3f& wo)
{
    const auto value = test.evaluate(somewhere, wi, wo);
    return is_finite(value.f_cos) && min_component(value.f_cos) >= 0.f && std::isfinite(value.pdf) &&
           value.pdf >= 0.f;
}

std::vector<Vec3f> extreme_directions()
{
    std::vector<Vec3f> result;
    for (const float z : {1.f, 0.9999f, 0.6f, 0.01f, 1e-4f, 1e-7f, 1e-15f, 1e-30f, 1.2e-38f, 1e-40f, 0.f})
        for (const float sign : {1.f, -1.f})
            for (const double azimuth : {0.0, 1.0, pi_d}) {
                const double sine = std::sqrt(1.0 - static_cast<double>(z) * z);
                result.push_back(Vec3f(static_cast<float>(sine * std::cos(azimuth)),
                                       static_cast<float>(sine * std::sin(azimuth)), sign * z));
            }
    return result;
}

void check_soundness()
{
    const float us[] = {0.f, 0x1p-24f, 0.5f, one_minus_epsilon};
    const auto directions = extreme_directions();
    for (const auto& test : extreme_cases()) {
        CAPTURE(test.name());
        const auto made = test.build();
        int unsound = 0;
        for (const Vec3f& wi : directions) {
            for (const float u_lobe : us)
                for (const float x : us)
                    for (const float y : us) unsound += is_sound(*made, wi, u_lobe, Vec2f(x, y)) ? 0 : 1;
            for (const Vec3f& wo : directions) unsound += is_sound(*made, wi, wo) ? 0 : 1;
        }
        CHECK(unsound == 0);
    }
}

} // namespace

TEST_CASE("BSDFs are finite at grazing directions and at the corners of the random numbers", "[unit][bsdf]")
{
    SECTION("with denormal numbers")
    {
        check_soundness();
    }
    SECTION("with denormal numbers flushed to zero, as while rendering")
    {
        const FlushDenormals flush;
        check_soundness();
    }
}

TEST_CASE("a mirror reflects all light on its front side, about the normal", "[unit][bsdf]")
{
    const auto mirror = bsdf("mirror").build_type(bsdf_types());
    const auto one = mirror->sample(somewhere, Vec3f(0.48f, 0.6f, 0.64f), 0.3f, {0.1f, 0.9f});
    REQUIRE(one);
    CHECK(one->wo == Vec3f(-0.48f, -0.6f, 0.64f));
    CHECK(one->weight == Color(1.f));
    CHECK(one->pdf == 1.f);
    CHECK(one->is_delta());
    CHECK_FALSE(one->is_transmission());
    CHECK_FALSE(mirror->sample(somewhere, Vec3f(0.48f, 0.6f, -0.64f), 0.3f, {0.1f, 0.9f}));
}

TEST_CASE("a dielectric splits light by Fresnel's equations and bends it by Snell's law", "[unit][bsdf]")
{
    const double inside = 1.6, outside = 1.1;
    const auto made =
        bsdf("dielectric").number("intIOR", inside).number("extIOR", outside).build_type(bsdf_types());
    for (const double angle : {0.0, 20.0, 60.0, 85.0, 110.0, 130.0, 138.0, 160.0, 180.0}) {
        CAPTURE(angle);
        const Vec3f wi = direction_at(angle);
        const double n_i = wi.z > 0.f ? outside : inside, n_t = wi.z > 0.f ? inside : outside;
        const double cosine = std::abs(wi.z);
        const double sin_t = n_i / n_t * std::sqrt(1.0 - cosine * cosine);

        double reflectance = 1.0;
        if (sin_t < 1.0) {
            const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
            const double s = (n_i * cosine - n_t * cos_t) / (n_i * cosine + n_t * cos_t);
            const double p = (n_i * cos_t - n_t * cosine) / (n_i * cos_t + n_t * cosine);
            reflectance = 0.5 * (s * s + p * p);
            const auto refracted =
                made->sample(somewhere, wi, static_cast<float>(reflectance + 1e-4), {0.f, 0.f});
            REQUIRE(refracted);
            CHECK(refracted->is_transmission());
            CHECK(refracted->pdf == Approx(1.0 - reflectance).epsilon(1e-5));
            CHECK(refracted->weight.g == Approx(n_i * n_i / (n_t * n_t)));
            CHECK(refracted->eta == Approx(n_t / n_i));
            CHECK(refracted->wo.z == Approx(wi.z > 0.f ? -cos_t : cos_t).epsilon(1e-5));
            CHECK(refracted->wo.x * n_t == Approx(-wi.x * n_i).margin(1e-6));
            CHECK(refracted->wo.y * n_t == Approx(-wi.y * n_i).margin(1e-6));
        } else {
            CHECK_FALSE(made->sample(somewhere, wi, one_minus_epsilon, {0.f, 0.f})->is_transmission());
        }
        const auto reflected =
            made->sample(somewhere, wi, static_cast<float>(reflectance - 1e-4), {0.f, 0.f});
        REQUIRE(reflected);
        CHECK_FALSE(reflected->is_transmission());
        CHECK(reflected->wo == Vec3f(-wi.x, -wi.y, wi.z));
        CHECK(reflected->pdf == Approx(reflectance).epsilon(1e-4));
        CHECK(reflected->weight == Color(1.f));
        CHECK(reflected->eta == 1.f);
    }
}

TEST_CASE("where the indices are equal light goes straight through", "[unit][bsdf]")
{
    for (const char* type : {"dielectric", "roughdielectric"}) {
        CAPTURE(type);
        const auto made = bsdf(type).number("intIOR", 1.5).number("extIOR", 1.5).build_type(bsdf_types());
        for (const double angle : {0.0, 40.0, 89.99, 120.0}) {
            const Vec3f wi = direction_at(angle);
            for (const float u_lobe : {0.f, one_minus_epsilon}) {
                const auto one = made->sample(somewhere, wi, u_lobe, {0.7f, 0.3f});
                REQUIRE(one);
                CHECK(one->wo == -wi);
                CHECK(one->weight == Color(1.f));
                CHECK(one->lobe == Lobe::delta_transmission);
                CHECK(one->eta == 1.f);
            }
        }
    }
}

TEST_CASE("a rough dielectric tends to the smooth one as its roughness goes to 0", "[unit][bsdf]")
{
    const auto smooth = bsdf("dielectric").build_type(bsdf_types());
    const auto rough = bsdf("roughdielectric").number("alpha", 1e-4).build_type(bsdf_types());
    for (const double angle : {0.0, 30.0, 70.0, 100.0, 150.0, 180.0}) {
        const Vec3f wi = direction_at(angle);
        for (const float u_lobe : {1e-4f, 0.9999f}) {
            CAPTURE(angle, u_lobe);
            const auto a = smooth->sample(somewhere, wi, u_lobe, {0.5f, 0.5f});
            const auto b = rough->sample(somewhere, wi, u_lobe, {0.5f, 0.5f});
            REQUIRE((a && b));
            CHECK(a->is_transmission() == b->is_transmission());
            CHECK(length(a->wo - b->wo) < 2e-3f);
            CHECK(b->weight.g == Approx(a->weight.g).epsilon(1e-3));
            CHECK(b->eta == a->eta);
        }
    }
}

TEST_CASE("BSDFs reject parameters out of range, with the value and the way out", "[unit][bsdf]")
{
    const auto only = [](const std::vector<std::string>& found) {
        return found.size() == 1 ? found[0] : "not one message";
    };
    CHECK(only(bsdf("diffuse").color("albedo", Color(0.5f, 1.5f, 0.5f)).complaints<Diffuse, Bsdf>()) ==
          "error: albedo must be in [0, 1], not 0.5 1.5 0.5");
    CHECK(only(bsdf("microfacet").number("alpha", 1.5).complaints<Microfacet, Bsdf>()) ==
          "error: alpha must be in [0, 1], not 1.5");
    CHECK(only(bsdf("roughconductor").number("alpha", -0.1).complaints<RoughConductor, Bsdf>()) ==
          "error: alpha must be in [0, 1], not -0.1");
    CHECK(only(bsdf("roughconductor").color("R0", Color(2.f)).complaints<RoughConductor, Bsdf>()) ==
          "error: R0 must be in [0, 1], not 2 2 2");
    CHECK(only(bsdf("dielectric").number("intIOR", -1.5).complaints<Dielectric, Bsdf>()) ==
          "error: intIOR must be in [0.01, 100], not -1.5");
    CHECK(only(bsdf("roughdielectric").number("extIOR", 0.0).complaints<RoughDielectric, Bsdf>()) ==
          "error: extIOR must be in [0.01, 100], not 0");
    CHECK(only(bsdf("phong").integer("exponent", -1).complaints<Phong, Bsdf>()) ==
          "error: exponent must be in [0, 100000000], not -1");
    CHECK(only(bsdf("roughsubstrate")
                   .number("intIOR", 1.0)
                   .number("extIOR", 1.5)
                   .complaints<RoughSubstrate, Bsdf>()) ==
          "warning: intIOR is below extIOR: beyond the critical angle this model reflects more light than it "
          "receives");
    CHECK_THAT(only(bsdf("diffuse").color("albdo", Color(0.5f)).complaints<Diffuse, Bsdf>()),
               ContainsSubstring("did you mean 'albedo'?"));
    const auto bright = two_tone_texture(Color(0.5f), Color(3.f));
    CHECK_THAT(only(bsdf("roughsubstrate").texture("kd", bright).complaints<RoughSubstrate, Bsdf>()),
               ContainsSubstring("kd must be in [0, 1] everywhere, but the texture reaches 3"));
}
