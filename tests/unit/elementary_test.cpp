// SPDX-License-Identifier: MIT

#include "plumb/math/elementary.h"

#include "support/catch.h"
#include "support/random.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace plumb::test {
namespace {

using Real = long double; // the reference: 64 bits of mantissa

constexpr float inf = std::numeric_limits<float>::infinity();

// The largest error over [low, high], in units in the last place of the true value as a float. The arguments are
// spread evenly over the floats, so that small ones get their share, and include the ends.
template <class Ours, class Reference>
double worst_ulp(const Ours& ours, const Reference& reference, float low, float high)
{
    const auto first = std::bit_cast<std::uint32_t>(low);
    const auto last = std::bit_cast<std::uint32_t>(high);
    constexpr std::uint32_t count = 20011;
    double worst = 0.0;
    for (std::uint32_t i = 0; i <= count; ++i) {
        const auto offset = static_cast<std::uint32_t>(static_cast<std::uint64_t>(last - first) * i / count);
        const auto x = std::bit_cast<float>(first + offset);
        const Real truth = reference(static_cast<Real>(x));
        const Real value = ours(x);
        if (truth == value) continue;
        const Real ulp = std::ldexp(1.0L, std::max(std::ilogb(truth) - 23, -149));
        worst = std::max(worst, static_cast<double>(std::abs(value - truth) / ulp));
    }
    return worst;
}

template <class Ours, class Reference>
double worst_relative(const Ours& ours, const Reference& reference, double low, double high)
{
    TestRandom random(5);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double x = random.between(low, high);
        const Real truth = reference(static_cast<Real>(x));
        worst = std::max(worst, static_cast<double>(std::abs((ours(x) - truth) / truth)));
    }
    return worst;
}

constexpr double float_limit = 0.501; // what the header promises
constexpr double double_limit = 1e-14;

} // namespace

TEST_CASE("elementary functions of floats are rounded almost perfectly", "[unit][elementary]")
{
    const auto check = [](const std::string& name, auto ours, auto reference, float low, float high) {
        INFO(name);
        CHECK(worst_ulp(ours, reference, low, high) <= float_limit);
        if (name != "log" && name != "pow" && name != "acos")
            CHECK(worst_ulp([&](float x) { return ours(-x); }, [&](Real x) { return reference(-x); }, low,
                            high) <= float_limit);
    };
    check(
        "sin", [](float x) { return plumb::sin(x); }, [](Real x) { return std::sin(x); }, 1e-30f, 1e5f);
    check(
        "cos", [](float x) { return plumb::cos(x); }, [](Real x) { return std::cos(x); }, 1e-30f, 1e5f);
    check(
        "tan", [](float x) { return plumb::tan(x); }, [](Real x) { return std::tan(x); }, 1e-30f, 1e5f);
    check(
        "exp", [](float x) { return plumb::exp(x); }, [](Real x) { return std::exp(x); }, 1e-30f, 87.3f);
    check(
        "log", [](float x) { return plumb::log(x); }, [](Real x) { return std::log(x); }, 1.2e-38f, 3.4e38f);
    check(
        "acos", [](float x) { return plumb::acos(x); }, [](Real x) { return std::acos(x); }, 1e-30f, 1.f);
    check(
        "atan2", [](float y) { return plumb::atan2(y, 0.7f); },
        [](Real y) { return std::atan2(y, static_cast<Real>(0.7f)); }, 1e-37f, 3e38f);
    check(
        "atan2", [](float y) { return plumb::atan2(y, -3.f); }, [](Real y) { return std::atan2(y, -3.0L); },
        1e-37f, 3e38f);
    check(
        "pow", [](float x) { return plumb::pow(x, 2.4f); },
        [](Real x) { return std::pow(x, static_cast<Real>(2.4f)); }, 1e-15f, 1e15f);
    check(
        "pow", [](float x) { return plumb::pow(x, -7.f); }, [](Real x) { return std::pow(x, -7.0L); }, 4e-5f,
        2e5f);
    CHECK(worst_ulp([](float x) { return plumb::acos(-x); }, [](Real x) { return std::acos(-x); }, 1e-30f,
                    1.f) <= float_limit);
}

TEST_CASE("sine and cosine keep their digits next to multiples of pi / 2", "[unit][elementary]")
{
    for (int k = 1; k < 63000; k = k * 3 / 2 + 1) {
        const auto x = static_cast<float>(k * (pi_d / 2.0));
        const Real exact = k % 2 == 0 ? std::sin(static_cast<Real>(x)) : std::cos(static_cast<Real>(x));
        const float ours = k % 2 == 0 ? plumb::sin(x) : plumb::cos(x);
        const double in_double =
            k % 2 == 0 ? sin_cos(static_cast<double>(x)).sin : sin_cos(static_cast<double>(x)).cos;
        CAPTURE(k, x);
        CHECK(std::abs(ours - exact) <= std::abs(exact) * 0x1p-24L * 1.01L);
        CHECK(std::abs(in_double - exact) <= std::abs(exact) * double_limit);
    }
}

TEST_CASE("elementary functions of doubles have relative errors below 1e-14", "[unit][elementary]")
{
    const auto sine = [](double x) { return sin_cos(x).sin; };
    const auto cosine = [](double x) { return sin_cos(x).cos; };
    const auto true_sine = [](Real x) { return std::sin(x); };
    const auto true_cosine = [](Real x) { return std::cos(x); };
    CHECK(worst_relative(sine, true_sine, -4.0, 4.0) <= double_limit);
    CHECK(worst_relative(sine, true_sine, -1e5, 1e5) <= double_limit);
    CHECK(worst_relative(cosine, true_cosine, -4.0, 4.0) <= double_limit);
    CHECK(worst_relative(cosine, true_cosine, -1e5, 1e5) <= double_limit);

    const auto exponential = [](double x) { return plumb::exp(x); };
    const auto true_exponential = [](Real x) { return std::exp(x); };
    CHECK(worst_relative(exponential, true_exponential, -1.0, 1.0) <= double_limit);
    CHECK(worst_relative(exponential, true_exponential, -708.0, 709.7) <= double_limit);

    const auto logarithm = [](double x) { return plumb::log(x); };
    const auto true_logarithm = [](Real x) { return std::log(x); };
    CHECK(worst_relative(logarithm, true_logarithm, 0.9, 1.1) <= double_limit);
    CHECK(worst_relative(logarithm, true_logarithm, 0.0, 10.0) <= double_limit);
    CHECK(worst_relative(
              [](double x) { return plumb::log(std::ldexp(1.3, static_cast<int>(x))); },
              [](Real x) { return std::log(std::ldexp(static_cast<Real>(1.3), static_cast<int>(x))); },
              -1021.0, 1023.0) <= double_limit);

    for (const double x : {1.0, -1.0, 1e-9, -1e9})
        CHECK(worst_relative([x](double y) { return plumb::atan2(y, x); },
                             [x](Real y) { return std::atan2(y, static_cast<Real>(x)); }, -3.0,
                             3.0) <= double_limit);
}

TEST_CASE("the error function is right to 1e-12", "[unit][elementary]")
{
    for (double x = -7.0; x <= 7.0; x += 0.0037)
        CHECK(std::abs(plumb::erf(x) - std::erf(static_cast<Real>(x))) < 1e-12L);
    CHECK(plumb::erf(0.0) == 0.0);
    CHECK(plumb::erf(30.0) == 1.0);
    CHECK(plumb::erf(-30.0) == -1.0);
}

TEST_CASE("elementary functions at the ends of their ranges", "[unit][elementary]")
{
    CHECK(plumb::sin(0.f) == 0.f);
    CHECK(plumb::cos(0.f) == 1.f);
    CHECK(std::isnan(plumb::sin(inf)));

    CHECK(plumb::acos(1.f) == 0.f);
    CHECK(plumb::acos(-1.f) == pi);
    CHECK(plumb::acos(1.5f) == 0.f);
    CHECK(plumb::acos(-1.5f) == pi);

    CHECK(plumb::atan2(0.f, 0.f) == 0.f);
    CHECK(plumb::atan2(0.f, 1.f) == 0.f);
    CHECK(plumb::atan2(0.f, -1.f) == pi);
    CHECK(plumb::atan2(-0.f, -1.f) == pi); // never -pi
    CHECK(plumb::atan2(1.f, 0.f) == half_pi);
    CHECK(plumb::atan2(-1.f, 0.f) == -half_pi);
    CHECK(plumb::atan2(1.f, 1.f) == pi / 4.f);
    CHECK(plumb::atan2(inf, inf) == pi / 4.f);
    CHECK(plumb::atan2(1.f, -inf) == pi);

    CHECK(plumb::exp(0.f) == 1.f);
    CHECK(plumb::exp(-104.5f) == 0.f);
    CHECK(plumb::exp(89.f) == inf);
    CHECK(plumb::exp(-inf) == 0.f);
    CHECK(plumb::exp(inf) == inf);
    CHECK(plumb::exp(-1000.0) == 0.0);

    CHECK(plumb::log(1.f) == 0.f);
    CHECK(plumb::log(0x1p-1074) == Approx(-744.44007192138126));
    CHECK(plumb::log(0.f) == -inf);
    CHECK(plumb::log(inf) == inf);
    CHECK(std::isnan(plumb::log(-1.f)));

    CHECK(plumb::pow(0.f, 0.f) == 1.f);
    CHECK(plumb::pow(0.f, 2.f) == 0.f);
    CHECK(plumb::pow(0.f, -1.f) == inf);
    CHECK(plumb::pow(1.f, inf) == 1.f);
    CHECK(plumb::pow(2.f, 10.f) == 1024.f);
    CHECK(plumb::pow(inf, -1.f) == 0.f);
}

TEST_CASE("elementary functions give these bits on every machine", "[unit][elementary]")
{
    // The same arithmetic with 200 bits, rounded once: any machine that differs breaks the promise.
    CHECK(std::bit_cast<std::uint32_t>(plumb::sin(1.f)) == 0x3f576aa4u);
    CHECK(std::bit_cast<std::uint32_t>(plumb::cos(1.f)) == 0x3f0a5140u);
    CHECK(std::bit_cast<std::uint32_t>(plumb::exp(1.f)) == 0x402df854u);
    CHECK(std::bit_cast<std::uint32_t>(plumb::log(2.f)) == 0x3f317218u);
    CHECK(std::bit_cast<std::uint32_t>(plumb::pow(2.f, 0.5f)) == 0x3fb504f3u);
}

} // namespace plumb::test
