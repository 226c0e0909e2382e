// SPDX-License-Identifier: MIT

#include "plumb/image/false_color.h"

#include "support/catch.h"

using namespace plumb;

TEST_CASE("false colours are inside sRGB, and each is lighter than the last", "[unit][image]")
{
    double last = -1.0;
    for (int i = 0; i <= 1000; ++i) {
        const double t = static_cast<double>(i) / 1000.0;
        CAPTURE(t);
        const Vec3d rgb = linear_srgb(false_color_in_oklab(t));
        REQUIRE(std::min({rgb.x, rgb.y, rgb.z}) >= 0.0); // nothing is clipped
        REQUIRE(std::max({rgb.x, rgb.y, rgb.z}) <= 1.0);
        const double y = static_cast<double>(luminance(false_color(t)));
        REQUIRE(y > last);
        last = y;
    }
    CHECK(last > 0.75);
    CHECK(luminance(false_color(0.0)) < 0.03f);
}

TEST_CASE("equal steps of false colours are equally far apart in Oklab", "[unit][image]")
{
    const auto step = [](double t) {
        const Oklab a = false_color_in_oklab(t), b = false_color_in_oklab(t + 0.01);
        return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b);
    };
    for (int i = 1; i < 100; ++i) CHECK(step(i / 100.0) == Approx(step(0.0)).epsilon(1e-6));
}

TEST_CASE("Oklab has the author's values", "[unit][image]")
{
    // The table of the article gives Oklab of XYZ; these are its inverse for the corners of sRGB.
    const Vec3d white = linear_srgb({1.0, 0.0, 0.0});
    for (int i = 0; i < 3; ++i) CHECK(white[i] == Approx(1.0).epsilon(1e-6));
    const Vec3d red = linear_srgb({0.6279553606, 0.2248630611, 0.1258462986});
    CHECK(red.x == Approx(1.0).epsilon(1e-5));
    CHECK(red.y == Approx(0.0).margin(1e-5));
    CHECK(red.z == Approx(0.0).margin(1e-5));
}

TEST_CASE("numbers outside the range have the colours of its ends", "[unit][image]")
{
    CHECK(false_color(-3.0) == false_color(0.0));
    CHECK(false_color(7.0) == false_color(1.0));
}
