// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".
// [2] Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs".
// [3] Jakob 2014, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution".
// [4] Abramowitz and Stegun 1964, Handbook of Mathematical Functions.
// [5] Wichura 1988, "Algorithm AS 241: The Percentage Points of the Normal Distribution".
// [6] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".

#include "bsdfs/microfacet_distribution.h"

#include "math/series.h"
#include "plumb/math/elementary.h"

#include <array>

namespace plumb {
namespace {

constexpr double inv_sqrt_pi = 0.56418958354775628695;

// [4], equation 7.1.26, for x >= 0, given exp(-x^2): absolute error below 1.5e-7.
double erf_of_positive(double x, double falloff)
{
    static constexpr std::array terms = {0.254829592, -0.284496736, 1.421413741, -1.453152027, 1.061405429};
    const double t = 1.0 / (1.0 + 0.3275911 * x);
    return 1.0 - t * polynomial(terms, t) * falloff;
}

// [5], PPND7 over sqrt(2): relative error below 1.2e-7 for 1 - |b| > 3e-11.
double inverse_erf(double b)
{
    constexpr double inv_sqrt_2 = 0.70710678118654752440;
    constexpr double tails_from = 0.85;
    const double magnitude = std::abs(b);
    if (magnitude <= tails_from) {
        static constexpr std::array above = {3.3871327179, 50.434271938, 159.29113202, 59.109374720};
        static constexpr std::array below = {1.0, 17.895169469, 78.757757664, 67.187563600};
        const double q = 0.5 * b;
        const double r = 0.180625 - q * q;
        return inv_sqrt_2 * q * polynomial(above, r) / polynomial(below, r);
    }
    static constexpr std::array above = {1.4234372777, 2.7568153900, 1.3067284816, 0.17023821103};
    static constexpr std::array below = {1.0, 0.73700164250, 0.12021132975};
    const double r = std::sqrt(-log(0.5 * (1.0 - magnitude))) - 1.6;
    return std::copysign(inv_sqrt_2 * polynomial(above, r) / polynomial(below, r), b);
}

// What v sees of slopes along its azimuth, in units of alpha: density (cosine - tilt x) exp(-x^2), for positive values.
struct View {
    double cosine;
    double tilt;         // alpha sin(theta)
    double end;          // erf of the largest slope that can be seen, cosine / tilt
    double doubled_area; // [2], equation 19 times 2 cos(theta)
};

View beckmann_view(const Vec3f& v, float alpha)
{
    const double cosine = v.z;
    const double tilt = alpha * std::sqrt(sqr<double>(v.x) + sqr<double>(v.y));
    // Nothing steep enough to be seen from behind: exact to 10 digits.
    if (cosine > 4.0 * tilt) return {cosine, tilt, 1.0, 2.0 * cosine};
    const double largest = cosine / tilt;
    const double falloff = exp(-sqr(largest));
    const double end = erf_of_positive(largest, falloff);
    return {cosine, tilt, end, cosine * (1.0 + end) + tilt * inv_sqrt_pi * falloff};
}

constexpr double half_step = 0x1p-25; // of random numbers: neither 0 nor 1

// A normal, not of unit length, by numerical inversion as in [3], but a fixed number of steps, and in proportions that stay
// finite where v grazes the surface.
Vec3d sample_beckmann(const Vec3f& v, float alpha, const Vec2f& u)
{
    const auto [cosine, tilt, end, doubled_area] = beckmann_view(v, alpha);

    // Solve P(x) = u.x for b = erf(x) by Halley's method: two steps leave an error of about 1e-7, as inverse_erf has.
    const double target = u.x + half_step;
    const double rest = 1.0 - target;
    const double curved = tilt / (tilt + 3.0 * cosine); // 0: P is linear in b; 1: quadratic near the end
    double b = end - (1.0 + end) * ((1.0 - curved) * rest + curved * std::sqrt(rest));
    double x = inverse_erf(b);
    for (int step = 0; step < 2; ++step) {
        const double falloff = exp(-sqr(x));
        const double excess = cosine * (1.0 + b) + tilt * inv_sqrt_pi * falloff - target * doubled_area;
        const double slope = cosine - tilt * x;
        const double halved_bend = -0.25 * tilt / (inv_sqrt_pi * falloff);
        if (!(slope > 0.0)) break;
        b -= excess * slope / (sqr(slope) - excess * halved_bend);
        b = std::clamp(b, -1.0 + 0x1p-40, 1.0 - 0x1p-40);
        x = inverse_erf(b);
    }
    const double y = inverse_erf(2.0 * (u.y + half_step) - 1.0); // across, slopes are seen evenly

    const double sine = std::sqrt(sqr<double>(v.x) + sqr<double>(v.y));
    const double cos_phi = sine > 0.0 ? v.x / sine : 1.0;
    const double sin_phi = sine > 0.0 ? v.y / sine : 0.0;
    return {alpha * (y * sin_phi - x * cos_phi), -alpha * (x * sin_phi + y * cos_phi), 1.0};
}

// [6], section 3: GGX is a hemisphere made flat, and the normals of the hemisphere that v sees are halfway between v and
// the directions of a spherical cap about the vertical, which are chosen uniformly.
Vec3d sample_ggx(const Vec3f& v, float alpha, const Vec2f& u)
{
    const Vec3d view = normalize(Vec3d(alpha * double(v.x), alpha * double(v.y), v.z));
    const double sum_z =
        (1.0 - u.x) * (1.0 + view.z); // z of the cap's direction, from -view.z to 1, plus view.z
    const double z = sum_z - view.z;
    const double sine = std::sqrt(std::max((1.0 - z) * (1.0 + z), 0.0));
    const SinCosD angle = sin_cos(2.0 * pi_d * u.y);
    return {alpha * (sine * angle.cos + view.x), alpha * (sine * angle.sin + view.y), sum_z};
}

} // namespace

float MicrofacetDistribution::d(const Vec3f& wh) const
{
    if (wh.z <= 0.f) return 0.f;

    // The tangent from x and y: 1 - z^2 has no digits left where the surface is smooth.
    const float cos_squared = sqr(wh.z);
    const float sin_squared = sqr(wh.x) + sqr(wh.y * stretch_);
    if (kind_ == Kind::ggx)
        return 1.f / (pi * area_ * sqr(cos_squared + sin_squared / sqr(alpha_))); // [1], equation 33
    const float falloff = exp(-(sin_squared / cos_squared) / sqr(alpha_));
    if (falloff == 0.f) return 0.f;                   // and cos_squared may be 0, too
    return falloff / (pi * area_ * sqr(cos_squared)); // [1], equation 25
}

float MicrofacetDistribution::g1(const Vec3f& v, const Vec3f& wh) const
{
    const float cos_h = dot(v, wh);
    if (!(v.z > 0.f ? cos_h > 0.f : v.z < 0.f && cos_h < 0.f)) return 0.f; // a product could underflow
    const float sine = std::sqrt(sqr(v.x) + sqr(v.y / stretch_));
    if (kind_ == Kind::ggx) {
        const float cosine = std::abs(v.z);
        return 2.f * cosine / (cosine + std::sqrt(sqr(cosine) + sqr(alpha_ * sine))); // [1], equation 34
    }
    const float a = std::abs(v.z) / (alpha_ * sine); // infinite along the normal
    if (!(a < 1.6f)) return 1.f;
    return (3.535f * a + 2.181f * sqr(a)) / (1.f + 2.276f * a + 2.577f * sqr(a)); // [1], equation 27
}

Vec3f MicrofacetDistribution::sample_visible(const Vec3f& v, const Vec2f& u) const
{
    Vec3d normal =
        kind_ == Kind::ggx ? sample_ggx(stretched(v), alpha_, u) : sample_beckmann(stretched(v), alpha_, u);
    normal.y /= stretch_;
    return Vec3f(normalize(normal));
}

float MicrofacetDistribution::visible_area(const Vec3f& v) const
{
    const Vec3f view = stretched(v);
    if (kind_ == Kind::beckmann) return static_cast<float>(0.5 * beckmann_view(view, alpha_).doubled_area);
    const double sine_squared = sqr<double>(view.x) + sqr<double>(view.y);
    return static_cast<float>(0.5 *
                              (view.z + std::sqrt(sqr<double>(view.z) + sqr<double>(alpha_) * sine_squared)));
}

float MicrofacetDistribution::visible_pdf(const Vec3f& v, const Vec3f& wh) const
{
    return d(wh) * std::max(dot(v, wh), 0.f) / visible_area(v);
}

} // namespace plumb
