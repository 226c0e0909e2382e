// SPDX-License-Identifier: MIT

#include "bsdfs/fresnel.h"

#include "support/catch.h"
#include "support/random.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

namespace {

// Fresnel's equations from the indices, with angles from Snell's law, in double precision.
double textbook_reflectance(double cos_i, double n_i, double n_t)
{
    const double sin_t = n_i / n_t * std::sqrt(1.0 - cos_i * cos_i);
    if (sin_t >= 1.0) return 1.0;
    const double a = std::acos(cos_i), b = std::asin(sin_t);
    if (a < 1e-7) return std::pow((n_i - n_t) / (n_i + n_t), 2);
    const double s = std::sin(a - b) / std::sin(a + b); // sine and tangent law
    const double p = std::tan(a - b) / std::tan(a + b);
    return 0.5 * (s * s + p * p);
}

} // namespace

TEST_CASE("dielectric reflectance agrees with the sine and tangent laws from both sides", "[unit][fresnel]")
{
    TestRandom random(1);
    for (const double eta : {1.5046 / 1.000277, 1.33, 1.0 / 1.5, 2.4, 1.01}) {
        for (int i = 0; i < 1000; ++i) {
            const auto cosine = static_cast<float>(random.between(0.001, 1.0));
            CAPTURE(eta, cosine);
            const auto front = fresnel_dielectric(cosine, static_cast<float>(eta));
            const auto back = fresnel_dielectric(-cosine, static_cast<float>(eta));
            CHECK(front.reflectance ==
                  Approx(textbook_reflectance(cosine, 1.0, eta)).epsilon(2e-3).margin(2e-6));
            CHECK(back.reflectance ==
                  Approx(textbook_reflectance(cosine, eta, 1.0)).epsilon(2e-3).margin(2e-6));
            CHECK(front.eta_ratio == Approx(1.0 / eta));
            CHECK(back.eta_ratio == Approx(eta));
        }
    }
}

TEST_CASE("dielectric reflectance along the normal, at Brewster's angle and at grazing angles",
          "[unit][fresnel]")
{
    CHECK(fresnel_dielectric(1.f, 1.5f).reflectance == Approx(0.04));
    CHECK(fresnel_dielectric(-1.f, 1.5f).reflectance == Approx(0.04));
    CHECK(fresnel_dielectric(1e-7f, 1.5f).reflectance == Approx(1.0).margin(1e-5));
    CHECK(fresnel_dielectric(0.f, 1.5f).reflectance == 1.f);
    // At Brewster's angle tan a = n only the perpendicular part is left: ((1 - n^2) / (1 + n^2))^2 / 2.
    const double n = 1.5;
    const double brewster = 1.0 / std::sqrt(1.0 + n * n);
    CHECK(fresnel_dielectric(static_cast<float>(brewster), 1.5f).reflectance ==
          Approx(0.5 * std::pow((1 - n * n) / (1 + n * n), 2)));
}

TEST_CASE("total internal reflection begins at the critical angle", "[unit][fresnel]")
{
    const double critical = std::sqrt(1.0 - 1.0 / (1.5 * 1.5));
    const auto inside = fresnel_dielectric(static_cast<float>(-critical + 1e-4), 1.5f);
    CHECK(inside.reflectance == 1.f);
    CHECK(inside.cos_t == 0.f);
    const auto outside = fresnel_dielectric(static_cast<float>(-critical - 1e-4), 1.5f);
    CHECK(outside.reflectance < 1.f);
    CHECK(outside.cos_t > 0.f);
    CHECK_FALSE(refract(Vec3f(std::sqrt(1.f - 0.01f), 0.f, -0.1f), Vec3f(0.f, 0.f, 1.f), 1.5f));
}

TEST_CASE("reflectance is the same along a refracted path and back", "[unit][fresnel]")
{
    for (const float eta : {1.5f, 0.7f, 1.001f, 3.f}) {
        for (float cosine = 0.05f; cosine <= 1.f; cosine += 0.05f) {
            const auto there = fresnel_dielectric(cosine, eta);
            if (there.cos_t == 0.f) continue;
            CHECK(there.cos_t < 0.f);
            const auto back = fresnel_dielectric(there.cos_t, eta);
            CHECK(back.reflectance == Approx(there.reflectance).epsilon(1e-3).margin(1e-6));
            CHECK(back.cos_t > 0.f);
            CHECK(sqr(back.cos_t) == Approx(sqr(cosine)).margin(3e-6));
        }
    }
}

TEST_CASE("equal indices are no boundary at any angle", "[unit][fresnel]")
{
    for (const float cosine : {1.f, -1.f, 0.3f, -1e-4f, 1e-7f}) {
        const auto refraction = fresnel_dielectric(cosine, 1.f);
        CHECK(refraction.reflectance == 0.f);
        CHECK(refraction.cos_t == -cosine);
        CHECK(refraction.eta_ratio == 1.f);
    }
}

TEST_CASE("reflection and refraction obey the laws of reflection and of Snell", "[unit][fresnel]")
{
    TestRandom random(2);
    for (int i = 0; i < 2000; ++i) {
        const Vec3f wi = random.direction();
        const Vec3f normal = random.direction();
        const auto eta = static_cast<float>(random.between(0.5, 2.0));
        CAPTURE(wi.x, wi.y, wi.z, normal.x, normal.y, normal.z, eta);

        const Vec3f mirrored = reflect(wi, normal);
        CHECK(dot(mirrored, normal) == Approx(dot(wi, normal)).margin(1e-6));
        CHECK(length(cross(mirrored + wi, normal)) == Approx(0.0).margin(1e-6));

        const auto wo = refract(wi, normal, eta);
        const double sine = length(cross(Vec3d(wi), Vec3d(normal)));
        const double n_i = dot(wi, normal) > 0.f ? 1.0 : eta;
        const double n_o = dot(wi, normal) > 0.f ? eta : 1.0;
        if (!wo) {
            CHECK(n_i * sine > n_o * (1.0 - 1e-6));
            continue;
        }
        CHECK(length(*wo) == Approx(1.0).epsilon(1e-6));
        CHECK(dot(*wo, normal) * dot(wi, normal) < 0.f);
        const Vec3d n(normal);
        const Vec3d snell = cross(Vec3d(wi), n) * n_i + cross(Vec3d(*wo), n) * n_o; // tangential parts cancel
        CHECK(length(snell) == Approx(0.0).margin(1e-6));
    }
}

TEST_CASE("Schlick's approximation is exact along the normal, 1 at grazing angles, and close between",
          "[unit][fresnel]")
{
    const Color r0(0.04f, 0.5f, 1.f);
    CHECK(fresnel_schlick(1.f, r0) == r0);
    CHECK(fresnel_schlick(0.f, r0) == Color(1.f));
    CHECK(fresnel_schlick(0.5f, r0).g == Approx(0.5 + 0.5 / 32.0));
    for (float cosine = 0.f; cosine <= 1.f; cosine += 0.01f) {
        const float exact = fresnel_dielectric(cosine, 1.5f).reflectance;
        CHECK(fresnel_schlick(cosine, Color(0.04f)).r == Approx(exact).margin(0.06));
    }
}
