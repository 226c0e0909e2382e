// SPDX-License-Identifier: MIT

// Elementary functions: an argument reduction that loses nothing, then a Taylor series, all in double precision.
//
// [1] Cody and Waite 1980, Software Manual for the Elementary Functions: a constant in parts short enough for the
//     products with a small integer to be exact.
// [2] Knuth, The Art of Computer Programming, volume 2, section 4.2.2: what an addition has rounded away.

#include "plumb/math/elementary.h"

#include "math/series.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace plumb {
namespace {

constexpr double infinity_d = std::numeric_limits<double>::infinity();
constexpr double ln2_high = 0x1.62e42feep-1; // times a small integer, this part of ln 2 is exact [1]
constexpr double ln2_low = 0x1.a39ef35793c76p-33;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// size terms: sign^i / (2 i + 3).
template <std::size_t size>
constexpr std::array<double, size> inverse_odd_numbers(double sign)
{
    std::array<double, size> terms{};
    for (std::size_t i = 0; i < size; ++i)
        terms[i] = (i % 2 == 0 ? 1.0 : sign) / static_cast<double>(2 * i + 3);
    return terms;
}

// 2^k for -1022 <= k <= 1023.
inline double power_of_two(std::int64_t k)
{
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

// x = quadrant pi/2 + high + low, with |high| <= pi/4 and low what high could not hold.
struct Reduced {
    std::int64_t quadrant;
    double high;
    double low;
};

inline Reduced reduce_angle(double x)
{
    // pi/2 in parts of 33, 33, 33 and 53 bits [1]; k has at most 17 bits.
    constexpr double half_pi_1 = 0x1.921fb544p+0;
    constexpr double half_pi_2 = 0x1.0b4611a6p-34;
    constexpr double half_pi_3 = 0x1.3198a2ep-69;
    constexpr double half_pi_4 = 0x1.b839a252049c1p-104;

    const double k = std::floor(x * two_over_pi + 0.5);
    const double a = x - k * half_pi_1; // exact
    const double b = k * half_pi_2;     // exact
    const double high = a - b;
    const double bb = a - high; // [2], algorithm of theorem B for a - b
    const double lost = (a - (high + bb)) + (bb - b);
    const double low = (lost - k * half_pi_3) - k * half_pi_4;
    return {static_cast<std::int64_t>(k), high, low};
}

// Relative errors of the series: (pi/4)^16 / 17! = 6e-17 and (pi/4)^18 / 18! = 2e-18.
inline double sin_near_zero(double x, double low)
{
    static constexpr auto terms = inverse_factorials<7>(3, 2, -1.0);
    const double x2 = x * x;
    return x + (low * (1.0 - 0.5 * x2) - x * x2 * polynomial(terms, x2));
}

inline double cos_near_zero(double x, double low)
{
    static constexpr auto terms = inverse_factorials<8>(2, 2, -1.0);
    const double x2 = x * x;
    return 1.0 - (x2 * polynomial(terms, x2) + x * low);
}

// Sine and cosine of an angle that is `quadrant` quarter turns beyond one with the given sine and cosine. Without
// branches, which would be mispredicted half of the time.
inline SinCosD rotate_quadrants(double sin, double cos, std::int64_t quadrant)
{
    const auto q = static_cast<std::uint64_t>(quadrant);
    const auto s = std::bit_cast<std::uint64_t>(sin);
    const auto c = std::bit_cast<std::uint64_t>(cos);
    const std::uint64_t exchanged = (s ^ c) & (0 - (q & 1)); // all bits in odd quadrants, none in even ones
    const std::uint64_t negative_sin = (q & 2) << 62;
    const std::uint64_t negative_cos = ((q + 1) & 2) << 62;
    return {std::bit_cast<double>(s ^ exchanged ^ negative_sin),
            std::bit_cast<double>(c ^ exchanged ^ negative_cos)};
}

// Sine and cosine of any x, for results that will be rounded to float. No float below 1e5 is closer than 1e-9 to a multiple of pi/2 (but 0), so that 33 + 53 bits of
// pi/2 are enough.
inline SinCosD sin_cos_for_float(double x)
{
    constexpr double half_pi_high = 0x1.921fb544p+0;
    constexpr double half_pi_low = 0x1.0b4611a626331p-34;
    const double k = std::floor(x * two_over_pi + 0.5);
    const SinCosD r = sin_cos_near_zero_for_float((x - k * half_pi_high) - k * half_pi_low);
    return rotate_quadrants(r.sin, r.cos, static_cast<std::int64_t>(k));
}

// atan of num / den for 0 <= num <= den, den > 0.
inline double atan_in_first_octant(double num, double den)
{
    // atan(j / 8)
    static constexpr std::array<double, 9> table = {0.0,
                                                    0x1.fd5ba9aac2f6ep-4,
                                                    0x1.f5b75f92c80ddp-3,
                                                    0x1.6f61941e4def1p-2,
                                                    0x1.dac670561bb4fp-2,
                                                    0x1.1e00babdefeb4p-1,
                                                    0x1.4978fa3269ee1p-1,
                                                    0x1.700a7c5784634p-1,
                                                    0x1.921fb54442d18p-1};
    // atan a = atan c + atan((a - c) / (1 + a c)) with c = j / 8 nearest to a: the second argument is below 1/16,
    // and the first term that is left out below (1/16)^16 / 17 = 3e-21.
    static constexpr auto terms = inverse_odd_numbers<7>(-1.0);
    const double j = std::floor(num / den * 8.0 + 0.5);
    const double c = j * 0.125;
    const double t = (num - c * den) / (den + c * num);
    const double t2 = t * t;
    return table[static_cast<std::size_t>(j)] + (t - t * t2 * polynomial(terms, t2));
}

} // namespace

SinCosD sin_cos(double x)
{
    if (!std::isfinite(x)) return {not_a_number, not_a_number};
    const Reduced r = reduce_angle(x);
    const double s = sin_near_zero(r.high, r.low);
    const double c = cos_near_zero(r.high, r.low);
    return rotate_quadrants(s, c, r.quadrant);
}

double exp(double x)
{
    constexpr double log2_e = 0x1.71547652b82fep+0;
    if (std::isnan(x)) return x;
    if (x > 0x1.62e42fefa39efp+9) return infinity_d;
    if (x < -0x1.6232bdd7abcd2p+9) return 0.0; // the result is below the smallest normal number

    // e^x = 2^k e^r, |r| <= ln(2) / 2: the first term left out is 0.347^14 / 14! = 4e-18.
    static constexpr auto terms = inverse_factorials<12>(2, 1, 1.0);
    const double k = std::floor(x * log2_e + 0.5);
    const double r = (x - k * ln2_high) - k * ln2_low;
    const double exp_r = 1.0 + (r + r * r * polynomial(terms, r));
    // In two steps, because 2^1024 is not a number.
    const auto power = static_cast<std::int64_t>(k);
    return exp_r * power_of_two(power >> 1) * power_of_two(power - (power >> 1));
}

double log(double x)
{
    constexpr double sqrt_2 = 0x1.6a09e667f3bcdp+0;
    if (!(x > 0.0)) return x == 0.0 ? -infinity_d : not_a_number;
    if (x == infinity_d) return x;

    // x = 2^k m with m in [sqrt(1/2), sqrt(2)).
    double k = 0.0;
    if (x < std::numeric_limits<double>::min()) {
        x *= 0x1p54;
        k = -54.0;
    }
    const auto bits = std::bit_cast<std::uint64_t>(x);
    k += static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023);
    double m = std::bit_cast<double>((bits & 0xfffffffffffffu) | 0x3ff0000000000000u);
    if (m >= sqrt_2) {
        m *= 0.5;
        k += 1.0;
    }
    // ln m = 2 atanh s with s = (m - 1) / (m + 1), |s| < 0.172: the first term left out is s^22 / 23 = 6e-19.
    static constexpr auto terms = inverse_odd_numbers<10>(1.0);
    const double f = m - 1.0;
    const double s = f / (2.0 + f);
    const double s2 = s * s;
    return k * ln2_high + (2.0 * s + (2.0 * s * s2 * polynomial(terms, s2) + k * ln2_low));
}

double atan2(double y, double x)
{
    if (std::isnan(x) || std::isnan(y)) return not_a_number;
    double a = std::abs(x);
    double b = std::abs(y);
    if (a == infinity_d || b == infinity_d) {
        a = a == infinity_d ? 1.0 : 0.0;
        b = b == infinity_d ? 1.0 : 0.0;
    }
    if (a == 0.0 && b == 0.0) return 0.0;

    constexpr double right_angle = 0x1.921fb54442d18p+0;
    constexpr double straight_angle = 0x1.921fb54442d18p+1;
    double angle = atan_in_first_octant(std::min(a, b), std::max(a, b));
    if (b > a) angle = right_angle - angle;
    if (x < 0.0) angle = straight_angle - angle;
    return y < 0.0 ? -angle : angle;
}

SinCos sin_cos(float x)
{
    if (!std::isfinite(x)) return {static_cast<float>(not_a_number), static_cast<float>(not_a_number)};
    const SinCosD result = sin_cos_for_float(static_cast<double>(x));
    return {static_cast<float>(result.sin), static_cast<float>(result.cos)};
}

float sin(float x)
{
    return sin_cos(x).sin;
}

float cos(float x)
{
    return sin_cos(x).cos;
}

float tan(float x)
{
    if (!std::isfinite(x)) return static_cast<float>(not_a_number);
    const SinCosD result = sin_cos_for_float(static_cast<double>(x));
    return static_cast<float>(result.sin / result.cos);
}

float acos(float x)
{
    // acos x = 2 atan(sqrt((1 - x) / (1 + x))); 1 - x and 1 + x are exact.
    const double d = std::clamp(static_cast<double>(x), -1.0, 1.0);
    return static_cast<float>(2.0 * atan2(std::sqrt(1.0 - d), std::sqrt(1.0 + d)));
}

float atan2(float y, float x)
{
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}

float exp(float x)
{
    return static_cast<float>(exp(static_cast<double>(x)));
}

float log(float x)
{
    return static_cast<float>(log(static_cast<double>(x)));
}

float pow(float base, float exponent)
{
    if (base == 1.f || exponent == 0.f) return 1.f;
    return static_cast<float>(exp(static_cast<double>(exponent) * log(static_cast<double>(base))));
}

} // namespace plumb
