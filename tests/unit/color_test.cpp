// SPDX-License-Identifier: MIT

#include "plumb/math/color.h"

#include "support/catch.h"

using namespace plumb;

TEST_CASE("colours add and multiply by channel", "[unit][color]")
{
    const Color a(1.f, 2.f, 3.f);
    const Color b(0.5f, 4.f, -1.f);
    CHECK(a + b == Color(1.5f, 6.f, 2.f));
    CHECK(a - b == Color(0.5f, -2.f, 4.f));
    CHECK(a * b == Color(0.5f, 8.f, -3.f));
    CHECK(a * 2.f == Color(2.f, 4.f, 6.f));
    CHECK(2.f * a == a * 2.f);
    CHECK(a / 2.f == Color(0.5f, 1.f, 1.5f));
    CHECK(Color(0.25f) == Color(0.25f, 0.25f, 0.25f));
    CHECK((a[0] == 1.f && a[1] == 2.f && a[2] == 3.f));
    CHECK(max_component(b) == 4.f);
    CHECK(min_component(b) == -1.f);
    CHECK(Color().is_black());
    CHECK_FALSE(Color(0.f, 0.f, 1e-30f).is_black());
    CHECK_FALSE(is_finite(Color(0.f, infinity, 0.f)));
}

TEST_CASE("luminance of grey is the grey", "[unit][color]")
{
    CHECK(luminance(Color(1.f)) == Approx(1.0).epsilon(1e-6));
    CHECK(luminance(Color(0.f, 1.f, 0.f)) == 0.715160f);
}

TEST_CASE("the sRGB curve", "[unit][color]")
{
    // IEC 61966-2-1, with the reference in double precision.
    for (int i = 0; i <= 1000; ++i) {
        const float x = static_cast<float>(i) / 1000.f;
        const double d = x;
        const double encoded = d <= 0.0031308 ? 12.92 * d : 1.055 * std::pow(d, 1.0 / 2.4) - 0.055;
        CHECK(srgb_from_linear(x) == Approx(encoded).margin(2e-7));
        CHECK(linear_from_srgb(srgb_from_linear(x)) == Approx(d).margin(5e-7));
    }
    CHECK(srgb_from_linear(0.f) == 0.f);
    CHECK(srgb_from_linear(1.f) == Approx(1.0).margin(1e-7));
    CHECK(linear_from_srgb(0.5f) == Approx(0.214041140482).epsilon(1e-6));
}
