// SPDX-License-Identifier: MIT

#include "plumb/math/math.h"

#include "support/catch.h"
#include "support/random.h"

using namespace plumb;

TEST_CASE("dot and cross products", "[unit][math]")
{
    const Vec3f x(1, 0, 0);
    const Vec3f y(0, 1, 0);
    CHECK(cross(x, y) == Vec3f(0, 0, 1)); // right-handed
    CHECK(cross(y, x) == Vec3f(0, 0, -1));
    CHECK(dot(Vec3f(1, 2, 3), Vec3f(4, -5, 6)) == 12.f);
    CHECK(abs_dot(Vec3f(1, 2, 3), Vec3f(0, -1, 0)) == 2.f);
    CHECK(length(Vec3f(2, 3, 6)) == 7.f);
    CHECK(length_squared(Vec3f(2, 3, 6)) == 49.f);
}

TEST_CASE("normalize takes tiny and huge vectors", "[unit][math]")
{
    for (const float size : {1e-37f, 1e-20f, 1.f, 1e20f, 1e38f}) {
        CAPTURE(size);
        const Vec3f unit = normalize(Vec3f(1.f, -2.f, 2.f) * size);
        CHECK(unit.x == Approx(1.0 / 3.0).epsilon(1e-6));
        CHECK(unit.y == Approx(-2.0 / 3.0).epsilon(1e-6));
        CHECK(unit.z == Approx(2.0 / 3.0).epsilon(1e-6));
    }
    CHECK(normalize(Vec3f(0, 0, -5)) == Vec3f(0, 0, -1));
}

TEST_CASE("lerp meets both ends exactly", "[unit][math]")
{
    CHECK(plumb::lerp(0.1f, 1e7f, 0.f) == 0.1f);
    CHECK(plumb::lerp(0.1f, 1e7f, 1.f) == 1e7f);
    CHECK(plumb::lerp(2.f, 4.f, 0.25f) == 2.5f);
}

TEST_CASE("small helpers of vectors", "[unit][math]")
{
    CHECK(safe_sqrt(-1e-9f) == 0.f);
    CHECK(safe_sqrt(4.f) == 2.f);
    CHECK(plumb::abs(Vec3f(-1, 2, -3)) == Vec3f(1, 2, 3));
    CHECK(max_component(Vec3f(-1, 2, 1)) == 2.f);
    CHECK(is_finite(Vec3f(1, 2, 3)));
    CHECK_FALSE(is_finite(Vec3f(1, infinity, 3)));
    CHECK_FALSE(is_finite(Vec3f(std::numeric_limits<float>::quiet_NaN(), 0, 0)));
    CHECK(one_minus_epsilon < 1.f);
    CHECK(std::nextafter(one_minus_epsilon, 2.f) == 1.f);
}
