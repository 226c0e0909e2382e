// SPDX-License-Identifier: MIT

#include "plumb/frame.h"

#include "support/catch.h"
#include "support/random.h"

using namespace plumb;
using plumb::test::TestRandom;

namespace {

void check_orthonormal(const Vec3f& normal)
{
    const Frame frame(normal);
    CAPTURE(normal.x, normal.y, normal.z);
    constexpr double margin = 4e-7;
    CHECK(frame.n == normal);
    CHECK(dot(frame.s, frame.t) == Approx(0.0).margin(margin));
    CHECK(dot(frame.s, frame.n) == Approx(0.0).margin(margin));
    CHECK(dot(frame.t, frame.n) == Approx(0.0).margin(margin));
    CHECK(length(frame.s) == Approx(1.0).margin(margin));
    CHECK(length(frame.t) == Approx(1.0).margin(margin));
    CHECK(dot(cross(frame.s, frame.t), frame.n) == Approx(1.0).margin(margin)); // right-handed
}

} // namespace

TEST_CASE("a frame is orthonormal about any normal", "[unit][frame]")
{
    TestRandom random;
    for (int i = 0; i < 2000; ++i) check_orthonormal(random.direction());
    for (const float z : {1.f, -1.f}) {
        check_orthonormal(Vec3f(0, 0, z));
        check_orthonormal(Vec3f(0, z, 0));
        check_orthonormal(Vec3f(z, 0, 0));
        check_orthonormal(Vec3f(0, z, -0.f));
        check_orthonormal(normalize(Vec3f(1e-5f, -1e-6f, z)));
    }
}

TEST_CASE("a frame is turned along a direction", "[unit][frame]")
{
    TestRandom random(3);
    for (int i = 0; i < 500; ++i) {
        const Vec3f normal = random.direction(), along = random.direction() * 100.f;
        const Frame frame(normal, along);
        constexpr double margin = 4e-7;
        CHECK(frame.n == normal);
        CHECK(length(frame.s) == Approx(1.0).margin(margin));
        CHECK(dot(frame.s, frame.n) == Approx(0.0).margin(1e-4)); // where they are nearly parallel
        CHECK(dot(cross(frame.n, frame.s), frame.t) == Approx(1.0).margin(1e-6));
        CHECK(dot(cross(along, normal), frame.s) == Approx(0.0).margin(1e-3));
        CHECK(dot(along, frame.s) > 0.f);
    }
    // Where it has no meaning, the frame is any.
    const Vec3f up(0, 0, 1);
    for (const Vec3f& along : {Vec3f(0.f), Vec3f(0, 0, 5), Vec3f(infinity, 0, 0), Vec3f(0, 0, -1e-30f)})
        CHECK(Frame(up, along).s == Frame(up).s);
}

TEST_CASE("local and world directions are inverse to each other", "[unit][frame]")
{
    TestRandom random(2);
    for (int i = 0; i < 100; ++i) {
        const Frame frame(random.direction());
        const Vec3f v = random.direction() * 3.f;
        CHECK(length(frame.to_world(frame.to_local(v)) - v) < 3e-6f);
        CHECK(frame.to_local(v).z == Approx(dot(v, frame.n)).margin(1e-6));
    }
    const Frame identity;
    CHECK(identity.to_local(Vec3f(1, 2, 3)) == Vec3f(1, 2, 3));
}

TEST_CASE("trigonometry of local directions", "[unit][frame]")
{
    const Vec3f w(0.6f, 0.f, -0.8f);
    CHECK(cos_theta(w) == -0.8f);
    CHECK(abs_cos_theta(w) == 0.8f);
    CHECK(sin_theta_squared(w) == Approx(0.36));
    CHECK(tan_theta_squared(w) == Approx(0.5625));
    CHECK(sin_theta_squared(Vec3f(0, 0, 1.0000001f)) == 0.f);
    CHECK(tan_theta_squared(Vec3f(1, 0, 0)) == infinity);
    CHECK(same_hemisphere(w, Vec3f(0, 0, -1)));
    CHECK_FALSE(same_hemisphere(w, Vec3f(0, 0, 1)));
    CHECK_FALSE(same_hemisphere(Vec3f(1, 0, 0), Vec3f(0, 0, 1)));
}
