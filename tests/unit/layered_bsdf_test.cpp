// SPDX-License-Identifier: MIT

// BSDFs that are made of others, and of layers, beside closed forms.

#include "plumb/model/bsdf.h"
#include "support/catch.h"
#include "support/samples.h"
#include "support/statistics.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr double cosines[] = {1.0, 0.8, 0.5, 0.2, 0.05};

std::unique_ptr<Bsdf> made(const std::string& type, const std::string& inner)
{
    return Sample(fmt::format("<bsdf type=\"{}\">{}</bsdf>\n", type, inner)).build(bsdf_types());
}

std::string number(const std::string& name, double value)
{
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
}

std::string diffuse(double albedo)
{
    return fmt::format("<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"{0} {0} {0}\"/></bsdf>",
                       albedo);
}

Vec3f tilted(double cosine, double side = 1.0)
{
    return Vec3f(Vec3d(std::sqrt(1.0 - cosine * cosine), 0.0, side * cosine));
}

// Fresnel's equations, from outside an index.
double reflectance(double cosine, double index)
{
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (s * s + p * p);
}

// What a surface reflects of diffuse light that comes from inside: Walsh 1926, as in Duncan 1942, for light from outside;
// and as much goes out as comes in by equal radiance, which is spread over n^2 as much inside.
double diffuse_reflectance_inside(double n)
{
    const double n2 = n * n, n4 = n2 * n2;
    const double outside = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                           n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
                           2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
                           8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
    return 1.0 - (1.0 - outside) / n2;
}

// Of what is not delta.
double albedo(const Bsdf& bsdf, const Vec3f& wi)
{
    return integrate_sphere(SphereGrid{Vec3f(0, 0, 1), 1, 60, 8}, [&](const Vec3f& wo) {
        return static_cast<double>(bsdf.evaluate({}, wi, wo).f_cos.g);
    });
}

} // namespace

TEST_CASE("a coated diffuse surface reflects the first term of the series of its internal reflections",
          "[unit][bsdf]")
{
    for (const double index : {1.2, 1.5, 2.4})
        for (const double rho : {1.0, 0.6}) {
            const std::string indices = number("intIOR", index) + number("extIOR", 1.0);
            const auto coating = made("coating", indices + diffuse(rho));
            const auto plastic =
                made("plastic",
                     indices + "<boolean name=\"nonlinear\" value=\"true\"/>" +
                         fmt::format("<color name=\"diffuseReflectance\" value=\"{0} {0} {0}\"/>", rho));
            const double inside = diffuse_reflectance_inside(index);
            for (const double cosine : cosines) {
                CAPTURE(index, rho, cosine);
                const Vec3f wi = tilted(cosine);
                const double mirrored = reflectance(cosine, index);
                const double first = (1.0 - mirrored) * rho * (1.0 - inside);
                CHECK(albedo(*coating, wi) == Approx(first).epsilon(2e-4));
                double series = 0.0;
                for (int i = 0; i < 1000; ++i) series += first * std::pow(rho * inside, i);
                CHECK(albedo(*plastic, wi) == Approx(series).epsilon(2e-4));
                const auto coat = coating->sample({}, wi, 0.f, Vec2f(0.5f));
                REQUIRE((coat && coat->is_delta()));
                CHECK(coat->wo == Vec3f(-wi.x, -wi.y, wi.z));
                CHECK(static_cast<double>(coat->weight.g * coat->pdf) == Approx(mirrored).epsilon(1e-4));
                // Seen through the coat, f is that of the surface below it, radiance by radiance.
                const Vec3f wo = tilted(0.7);
                CHECK(static_cast<double>(coating->evaluate({}, wi, wo).f_cos.g) ==
                      Approx((1.0 - mirrored) * (1.0 - reflectance(0.7, index)) * rho * 0.7 /
                             (pi_d * index * index))
                          .epsilon(1e-4));
            }
        }
}

TEST_CASE("a coat absorbs after Beer and Lambert, along the refracted way", "[unit][bsdf]")
{
    const double index = 1.5, rho = 0.9, thickness = 2.0, sigma = 0.3;
    const auto coating =
        made("coating", number("intIOR", index) + number("extIOR", 1.0) + number("thickness", thickness) +
                            fmt::format("<color name=\"sigmaA\" value=\"0 {} 9\"/>", sigma) + diffuse(rho));
    const auto inside_of = [&](double cosine) {
        return std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    };
    for (const double cosine : cosines) {
        CAPTURE(cosine);
        // Over the directions inside, where the surface is diffuse: those within the critical angle come out.
        const double critical = inside_of(0.0);
        double out = 0.0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double inside = critical + (1.0 - critical) * (i + 0.5) / steps;
            const double outside = std::sqrt(1.0 - index * index * (1.0 - inside * inside));
            out += 2.0 * inside * (1.0 - reflectance(outside, index)) *
                   std::exp(-sigma * thickness / inside) * (1.0 - critical) / steps;
        }
        const double in =
            (1.0 - reflectance(cosine, index)) * std::exp(-sigma * thickness / inside_of(cosine));
        CHECK(albedo(*coating, tilted(cosine)) == Approx(in * rho * out).epsilon(5e-4));
    }
}

TEST_CASE("a coat of the index of the air is not there", "[unit][bsdf]")
{
    const auto coating = made("coating", number("intIOR", 1.0) + number("extIOR", 1.0) + diffuse(0.7));
    const auto below = made("diffuse", "<color name=\"albedo\" value=\"0.7 0.7 0.7\"/>");
    for (const double cosine : cosines) {
        const Vec3f wi = tilted(cosine), wo = tilted(0.6);
        const BsdfValue coated = coating->evaluate({}, wi, wo), plain = below->evaluate({}, wi, wo);
        CHECK(coated.f_cos.g == Approx(plain.f_cos.g).epsilon(1e-5));
        CHECK(coated.pdf == Approx(plain.pdf).epsilon(1e-5));
    }
}

TEST_CASE("a mixture is the sum of its parts, and absorbs what their weights leave", "[unit][bsdf]")
{
    const auto mixture = made("mixture", "<string name=\"weights\" value=\"0.5, 0.3\"/>" + diffuse(1.0) +
                                             "<bsdf type=\"mirror\"/>");
    for (const double cosine : cosines) {
        CAPTURE(cosine);
        const Vec3f wi = tilted(cosine);
        CHECK(albedo(*mixture, wi) == Approx(0.5).epsilon(1e-4));
        double mirrored = 0.0;
        constexpr int strata = 1000;
        for (int i = 0; i < strata; ++i) {
            const float u_lobe = (static_cast<float>(i) + 0.5f) / strata;
            const auto sample = mixture->sample({}, wi, u_lobe, Vec2f(0.3f, 0.6f));
            if (sample && sample->is_delta()) mirrored += static_cast<double>(sample->weight.g) / strata;
        }
        CHECK(mirrored == Approx(0.3).epsilon(2e-3));
    }
}

TEST_CASE("each side of a two-sided surface is its BSDF, seen from the front", "[unit][bsdf]")
{
    const auto both = made("twosided", diffuse(0.8) + diffuse(0.3)), one = made("twosided", diffuse(0.8));
    for (const double cosine : cosines)
        for (const double side : {1.0, -1.0}) {
            CAPTURE(cosine, side);
            const Vec3f wi = tilted(cosine, side), wo = tilted(0.5, side), opposite = tilted(0.5, -side);
            const double expected = 0.5 / pi_d;
            CHECK(static_cast<double>(both->evaluate({}, wi, wo).f_cos.g) ==
                  Approx((side > 0.0 ? 0.8 : 0.3) * expected).epsilon(1e-5));
            CHECK(static_cast<double>(one->evaluate({}, wi, wo).f_cos.g) ==
                  Approx(0.8 * expected).epsilon(1e-5));
            CHECK(one->evaluate({}, wi, opposite).f_cos.is_black());
        }
}

TEST_CASE("what a thin sheet lets through glossily is its reflection on the other side", "[unit][bsdf]")
{
    // Burley 2015, section 5.3, with GGX and Smith's shadowing, each in double precision. Mitsuba 3.9.1 tests the shadowing
    // with the direction that is not mirrored and so loses light at grazing angles.
    const double eta = 1.33, roughness = 0.5, scaled = (0.65 * eta - 0.35) * roughness,
                 alpha = scaled * scaled;
    const auto sheet =
        made("principledthin", "<color name=\"baseColor\" value=\"1 1 1\"/>" + number("eta", eta) +
                                   number("specTrans", 1.0) + number("roughness", roughness));
    const auto g1 = [&](const Vec3d& v) {
        return 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * (v.x * v.x + v.y * v.y) / (v.z * v.z)));
    };
    for (const double cosine : {0.95, 0.7, 0.3})
        for (const double out : {0.9, 0.5, 0.2, 0.1})
            for (const double azimuth : {0.0, 1.0, pi_d}) {
                CAPTURE(cosine, out, azimuth);
                const Vec3d wi(tilted(cosine));
                const double sine = std::sqrt(1.0 - out * out);
                const Vec3d above(sine * std::cos(azimuth), sine * std::sin(azimuth), out);
                const Vec3d h = normalize(wi + above);
                const double slope = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
                const double d = 1.0 / (pi_d * alpha * alpha * slope * slope);
                const double expected =
                    (1.0 - reflectance(dot(wi, h), eta)) * d * g1(wi) * g1(above) / (4.0 * wi.z);
                const Vec3f below(Vec3d(above.x, above.y, -above.z));
                CHECK(static_cast<double>(sheet->evaluate({}, Vec3f(wi), below).f_cos.g) ==
                      Approx(expected).epsilon(1e-3));
            }
}
