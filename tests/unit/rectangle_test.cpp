// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"

namespace plumb {
class Rectangle;
}

namespace plumb::test {
namespace {

ParamsBuilder rectangle()
{
    return ParamsBuilder("shape", "rectangle");
}

// The corner at uv, by sampling.
Vec3f corner(const Shape& shape, float u, float v)
{
    return shape.sample_area(0.0, Vec2f(u, v)).position;
}

void check_near(const Vec3f& a, const Vec3f& b)
{
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(length(a - b) < 1e-6f);
}

// Where the middle of each edge lies from the centre: u = 1 is the end of the width, v = 1 of the height.
void check_axes(const Shape& shape, const Vec3f& width, const Vec3f& height)
{
    const Vec3f center = corner(shape, 0.5f, 0.5f);
    check_near(corner(shape, 1.f, 0.5f) - center, width * 0.5f);
    check_near(corner(shape, 0.5f, 1.f) - center, height * 0.5f);
}

} // namespace

TEST_CASE("a rectangle without parameters is the unit square facing +z", "[unit][shape]")
{
    const auto square = rectangle().build<Rectangle, Shape>();
    CHECK(square->area() == 1.f);
    CHECK(square->bounds().min == Vec3f(-0.5f, -0.5f, 0));
    CHECK(square->bounds().max == Vec3f(0.5f, 0.5f, 0));
    CHECK(square->triangle_count() == 2);
    check_axes(*square, Vec3f(1, 0, 0), Vec3f(0, 1, 0));
    const SurfacePoint at = square->surface_at(Ray{Vec3f(0.25f, -0.25f, 2), Vec3f(0, 0, -1)}, 0);
    CHECK(at.position == Vec3f(0.25f, -0.25f, 0));
    CHECK(at.geometric_normal == Vec3f(0, 0, 1));
    CHECK(at.shading.n == Vec3f(0, 0, 1));
    CHECK(at.uv == Vec2f(0.75f, 0.25f));
    CHECK(at.clearance < 1e-30f); // exactly in the plane z = 0
}

TEST_CASE("width runs along x in the plane, height along normal x width", "[unit][shape]")
{
    const auto facing = [](const Vec3f& normal) {
        return rectangle()
            .number("width", 2)
            .number("height", 3)
            .vector("normal", normal)
            .build<Rectangle, Shape>();
    };
    check_axes(*facing(Vec3f(0, 5, 0)), Vec3f(2, 0, 0), Vec3f(0, 0, -3));
    check_axes(*facing(Vec3f(0, -1, 0)), Vec3f(2, 0, 0), Vec3f(0, 0, 3));
    check_axes(*facing(Vec3f(0, 0, -1)), Vec3f(2, 0, 0), Vec3f(0, -3, 0));
    // Along z if the normal is +-x.
    check_axes(*facing(Vec3f(1, 0, 0)), Vec3f(0, 0, 2), Vec3f(0, -3, 0));
    check_axes(*facing(Vec3f(-1, 0, 0)), Vec3f(0, 0, 2), Vec3f(0, 3, 0));
    // x projected onto the plane perpendicular to (1, 1, 0) is (1, -1, 0).
    const float h = std::sqrt(0.5f);
    check_axes(*facing(Vec3f(1, 1, 0)), Vec3f(2 * h, -2 * h, 0), Vec3f(0, 0, -3));
}

TEST_CASE("uv of a rectangle agree between hits and samples", "[unit][shape]")
{
    const auto shape = rectangle()
                           .point("center", Vec3f(1, 2, 3))
                           .number("width", 2)
                           .number("height", 0.5)
                           .vector("normal", Vec3f(1, -2, 0.5f))
                           .transform("toWorld", Transform::rotate(Vec3d(1, 1, 0), 20))
                           .build<Rectangle, Shape>();
    TestRandom random;
    for (int i = 0; i < 200; ++i) {
        const Vec2f u = random.next_2d();
        const ShapeSample sample = shape->sample_area(0.0, u);
        CHECK(sample.uv == u);
        CHECK(sample.pdf == Approx(1.0));
        const Vec3f origin = sample.position + sample.normal;
        const std::uint32_t triangle = u.y <= u.x ? 0 : 1;
        const SurfacePoint at = shape->surface_at(Ray{origin, sample.position - origin}, triangle);
        CHECK((at.uv - u).length() < 1e-5f);
        CHECK(length(at.position - sample.position) < 1e-5f);
        CHECK(at.geometric_normal == sample.normal);
    }
}

TEST_CASE("toWorld is applied last and may shear or mirror a rectangle", "[unit][shape]")
{
    const auto sheared =
        rectangle()
            .transform("toWorld",
                       *Transform::from_rows({{{2, 1, 0, 0}, {0, 3, 0, 0}, {0, 0, 1, 4}, {0, 0, 0, 1}}}))
            .build<Rectangle, Shape>();
    CHECK(sheared->area() == 6.f);
    // Points keep away from edges by some roundings of the coordinates.
    const Vec3f corner = sheared->sample_area(0.0, Vec2f(0.f)).position;
    CHECK(length(corner - Vec3f(-1.5f, -1.5f, 4)) < 1e-5f);
    CHECK(corner.y > -1.5f);
    CHECK(sheared->sample_area(0.0, Vec2f(0.f)).normal == Vec3f(0, 0, 1));

    // Mirrored along x: the front still faces +z. Along z: -z.
    const auto mirrored = [](const Vec3d& factors) {
        const auto shape =
            rectangle().transform("toWorld", *Transform::scale(factors)).build<Rectangle, Shape>();
        return shape->sample_area(0.0, Vec2f(0.5f)).normal;
    };
    CHECK(mirrored(Vec3d(-1, 1, 1)) == Vec3f(0, 0, 1));
    CHECK(mirrored(Vec3d(1, 1, -1)) == Vec3f(0, 0, -1));
    CHECK(mirrored(Vec3d(-1, 1, -1)) == Vec3f(0, 0, -1));
}

// The part of the solid angle between the planes x = 0, y = 0 and the corner (x, y, z) of a rectangle at height z.
double corner_angle(double x, double y, double z)
{
    return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z));
}

double solid_angle(double x0, double x1, double y0, double y1, double z)
{
    return corner_angle(x1, y1, z) - corner_angle(x0, y1, z) - corner_angle(x1, y0, z) +
           corner_angle(x0, y0, z);
}

TEST_CASE("a rectangle knows its solid angle", "[unit][shape]")
{
    // From above it, beside it, close to it and in its corners, but not behind it.
    TestRandom random(5);
    int sampled = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto power = [&](double low, double high) { return std::pow(10.0, random.between(low, high)); };
        const double width = power(-2, 2), height = power(-2, 2), z = power(-3, 1);
        const Vec3f center(Vec3d(random.between(-1, 1) * width, random.between(-1, 1) * height, z));
        const auto shape = rectangle()
                               .point("center", center)
                               .number("width", width)
                               .number("height", height)
                               .vector("normal", Vec3f(0, 0, -1))
                               .build<Rectangle, Shape>();
        CHECK(shape->has_solid_angle());
        const Vec3f from(0.f);
        const Vec2f u = random.next_2d();
        const auto sample = shape->sample_solid_angle(from, u);
        const auto pdf = shape->solid_angle_pdf(from);
        REQUIRE(sample.has_value() == pdf.has_value());
        if (!sample) continue;
        ++sampled;
        CAPTURE(width, height, center.x, center.y, center.z, u.x, u.y);
        CHECK(sample->pdf == *pdf);
        const Vec3f low = shape->bounds().min, high = shape->bounds().max;
        const double whole = solid_angle(low.x, high.x, low.y, high.y, center.z);
        CHECK(1.0 / *pdf == Approx(whole).epsilon(1e-6));

        // The point is where its uv say.
        CHECK(length(sample->position - shape->sample_area(0.0, sample->uv).position) <=
              1e-6f * length(high - low));
        CHECK(sample->normal == Vec3f(0, 0, -1));
    }
    CHECK(sampled > 1000);
}

TEST_CASE("where the solid angle of a rectangle is not sampled", "[unit][shape]")
{
    const auto square = rectangle().build<Rectangle, Shape>();
    const auto samples = [&](const Vec3f& from) {
        const bool has_pdf = square->solid_angle_pdf(from).has_value();
        CHECK(square->sample_solid_angle(from, Vec2f(0.3f)).has_value() == has_pdf);
        return has_pdf;
    };
    CHECK(samples(Vec3f(0, 0, 1)));
    CHECK(samples(Vec3f(0, 0, 1e-6f)));
    CHECK(samples(Vec3f(1.5f, 0.7f, 0.1f)));
    CHECK_FALSE(samples(Vec3f(0, 0, -1))); // behind
    CHECK_FALSE(samples(Vec3f(0, 0, 0)));  // in it, and beside it in its plane
    CHECK_FALSE(samples(Vec3f(0.7f, 0, 0)));
    CHECK_FALSE(samples(Vec3f(0, 0, 10))); // far away
    CHECK(square->sample_solid_angle(Vec3f(0, 0, 1), Vec2f(0.5f))->position == Vec3f(0.f));

    const auto sheared =
        rectangle()
            .transform("toWorld",
                       *Transform::from_rows({{{1, 0.001, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}))
            .build<Rectangle, Shape>();
    CHECK_FALSE(sheared->has_solid_angle());
    CHECK_FALSE(sheared->sample_solid_angle(Vec3f(0, 0, 1), Vec2f(0.5f)));
}

TEST_CASE("bad rectangles are errors", "[unit][shape]")
{
    CHECK_THAT((rectangle().number("width", 0).complaints<Rectangle, Shape>().at(0)),
               ContainsSubstring("width must be greater than 0"));
    CHECK_THAT((rectangle().number("height", -2).complaints<Rectangle, Shape>().at(0)),
               ContainsSubstring("height must be greater than 0"));
    CHECK_THAT((rectangle().vector("normal", Vec3f(0.f)).complaints<Rectangle, Shape>().at(0)),
               ContainsSubstring("normal must not be 0"));
    CHECK(
        (rectangle().number("width", 1e-30).number("height", 1e-30).complaints<Rectangle, Shape>().size()) ==
        1);
}

} // namespace plumb::test
