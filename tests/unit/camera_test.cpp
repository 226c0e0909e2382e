// SPDX-License-Identifier: MIT

#include "plumb/model/camera.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"

namespace plumb {
class FisheyeCamera;
class PerspectiveCamera;
class SphericalCamera;
} // namespace plumb

using namespace plumb;
using test::ParamsBuilder;

namespace {

ParamsBuilder camera_params()
{
    return std::move(ParamsBuilder("camera", "perspective")
                         .integer("width", 200)
                         .integer("height", 100)
                         .number("fov", 60.0));
}

std::unique_ptr<Camera> make(const ParamsBuilder& params)
{
    return params.build<PerspectiveCamera, Camera>();
}

// Where the ray meets the camera-space plane z = distance.
Vec3f on_plane(const Ray& ray, float distance)
{
    return ray.at((distance - ray.origin.z) / ray.direction.z);
}

constexpr Vec2f lens_centre{0.5f, 0.5f};

} // namespace

TEST_CASE("the perspective camera: fov is horizontal, +x is left, row 0 is up", "[unit][camera]")
{
    const auto camera = make(camera_params());
    const float half_width = std::tan(30.f * pi / 180.f);
    const Ray left = camera->sample_ray({0.f, 50.f}, lens_centre).ray;
    CHECK(on_plane(left, 1.f).x == Approx(half_width));
    CHECK(on_plane(left, 1.f).y == Approx(0.f).margin(1e-6));
    const Ray top = camera->sample_ray({100.f, 0.f}, lens_centre).ray;
    CHECK(on_plane(top, 1.f).x == Approx(0.f).margin(1e-6));
    CHECK(on_plane(top, 1.f).y == Approx(half_width / 2.f));
    CHECK(length(left.direction) == Approx(1.f));
    CHECK(left.t_min == 0.f);
    CHECK(left.t_max == infinity);
}

TEST_CASE("a mirrored view is the image flopped", "[unit][camera]")
{
    const auto plain = make(camera_params());
    const auto mirrored = make(camera_params().boolean("mirrored", true));
    const Ray a = plain->sample_ray({30.f, 20.f}, lens_centre).ray;
    const Ray b = mirrored->sample_ray({170.f, 20.f}, lens_centre).ray;
    CHECK(a.direction.x == Approx(b.direction.x));
    CHECK(a.direction.y == Approx(b.direction.y));
}

TEST_CASE("clipping planes are measured along z, and only act when given", "[unit][camera]")
{
    const auto camera = make(camera_params().number("nearClip", 2.0).number("farClip", 5.0));
    const Ray ray = camera->sample_ray({10.f, 90.f}, lens_centre).ray;
    CHECK(ray.at(ray.t_min).z == Approx(2.f));
    CHECK(ray.at(ray.t_max).z == Approx(5.f));
}

TEST_CASE("a thin lens is sharp in its plane of focus", "[unit][camera]")
{
    const Transform moved = Transform::translate({10.0, -3.0, 2.0}) * Transform::rotate({0, 1, 0}, 30.0);
    const auto camera = make(
        camera_params().number("lensRadius", 0.25).number("focalDistance", 4.0).transform("toWorld", moved));

    // All rays of one place of the image meet where the pinhole's ray crosses the plane of focus, and leave from a
    // disk of the lens's radius.
    const auto pinhole = make(camera_params().transform("toWorld", moved));
    const Transform to_camera = moved.inverse();
    test::TestRandom random(2);
    float largest = 0.f;
    for (int i = 0; i < 200; ++i) {
        const Vec2f raster(200.f * random.next_1d(), 100.f * random.next_1d());
        const Ray central = pinhole->sample_ray(raster, lens_centre).ray;
        const Ray ray = camera->sample_ray(raster, random.next_2d()).ray;
        const Ray local{to_camera.point(ray.origin), to_camera.vector(ray.direction)};
        const Ray local_central{to_camera.point(central.origin), to_camera.vector(central.direction)};
        const Vec3f focus = on_plane(local, 4.f);
        const Vec3f expected = on_plane(local_central, 4.f);
        CHECK(length(focus - expected) < 1e-4f);
        CHECK(std::abs(local.origin.z) < 1e-5f);
        largest = std::max(largest, length(local.origin));
    }
    CHECK(largest <= 0.25f + 1e-5f);
    CHECK(largest > 0.2f);
}

TEST_CASE("what a pinhole camera says of a box holds all that it sees of it", "[unit][camera]")
{
    test::TestRandom random(3);
    const auto between = [&](float low, float high) { return low + (high - low) * random.next_1d(); };
    for (int i = 0; i < 500; ++i) {
        auto params = camera_params()
                          .boolean("mirrored", i % 2 == 0)
                          .number("principalPointOffsetX", static_cast<double>(between(-0.4f, 0.4f)))
                          .number("principalPointOffsetY", static_cast<double>(between(-0.4f, 0.4f)))
                          .transform("toWorld", *Transform::look_at(Vec3d(between(-2, 2), 1.0, between(3, 5)),
                                                                    Vec3d(0.0), Vec3d(0, 1, 0)));
        if (i % 3 == 0)
            params.integer("cropOffsetX", 30)
                .integer("cropOffsetY", 20)
                .integer("cropWidth", 60)
                .integer("cropHeight", 50);
        const auto camera = make(params);
        const Vec2f raster(between(-100.f, 300.f), between(-100.f, 200.f));
        const Vec3f seen = camera->sample_ray(raster, lens_centre).ray.at(between(0.5f, 10.f));
        const Vec3f size(between(0.f, 3.f), between(0.f, 3.f), between(0.f, 12.f));
        const Vec3f part(random.next_1d(), random.next_1d(), random.next_1d());
        const Vec3f low = seen - size * part; // boxes before, beside and around the camera
        const auto bounds = camera->bounds_of(Box3f(low, low + size));
        REQUIRE(bounds);
        CAPTURE(i, raster.x, raster.y, bounds->min.x, bounds->max.x, bounds->min.y, bounds->max.y);
        CHECK(raster.x >= bounds->min.x - 0.01f);
        CHECK(raster.x <= bounds->max.x + 0.01f);
        CHECK(raster.y >= bounds->min.y - 0.01f);
        CHECK(raster.y <= bounds->max.y + 0.01f);
    }
    const auto camera = make(camera_params());
    const auto behind = camera->bounds_of(Box3f(Vec3f(-1.f, -1.f, -5.f), Vec3f(1.f, 1.f, -4.f)));
    REQUIRE(behind);
    CHECK_FALSE(behind->min.x <= behind->max.x);
    CHECK_FALSE(make(camera_params().number("lensRadius", 0.1))->bounds_of(Box3f(Vec3f(0.f), Vec3f(1.f))));
}

TEST_CASE("cameras refuse what makes no image", "[unit][camera]")
{
    const auto complaints = [](const ParamsBuilder& params) {
        const auto found = params.complaints<PerspectiveCamera, Camera>();
        return found.empty() ? std::string() : found.front();
    };
    CHECK_THAT(complaints(ParamsBuilder("camera", "perspective").number("fov", 180.0)),
               ContainsSubstring("fov"));
    CHECK_THAT(complaints(ParamsBuilder("camera", "perspective").integer("width", 0)),
               ContainsSubstring("width"));
    CHECK_THAT(
        complaints(
            ParamsBuilder("camera", "perspective").number("lensRadius", 0.1).number("focalDistance", 0.0)),
        ContainsSubstring("must be greater than 0 where the lens has a radius"));
    CHECK_THAT(
        complaints(ParamsBuilder("camera", "perspective").number("nearClip", 3.0).number("farClip", 2.0)),
        ContainsSubstring("must be less than farClip"));
}

TEST_CASE("the spherical camera's columns are longitudes, its rows latitudes", "[unit][camera]")
{
    const auto camera = ParamsBuilder("camera", "spherical")
                            .integer("width", 400)
                            .integer("height", 200)
                            .build<SphericalCamera, Camera>();
    const auto direction = [&](float x, float y) {
        return camera->sample_ray({x, y}, lens_centre).ray.direction;
    };
    const auto is = [](const Vec3f& a, const Vec3f& b) { return length(a - b) < 1e-6f; };
    CHECK(is(direction(200.f, 100.f), {0.f, 0.f, 1.f}));
    CHECK(is(direction(100.f, 100.f), {1.f, 0.f, 0.f})); // +x is left
    CHECK(is(direction(300.f, 100.f), {-1.f, 0.f, 0.f}));
    CHECK(is(direction(0.f, 100.f), {0.f, 0.f, -1.f}));
    CHECK(is(direction(400.f, 100.f), {0.f, 0.f, -1.f}));
    CHECK(is(direction(37.f, 0.f), {0.f, 1.f, 0.f}));
    CHECK(is(direction(37.f, 200.f), {0.f, -1.f, 0.f}));
    CHECK(is(direction(200.f, 50.f), {0.f, std::sqrt(0.5f), std::sqrt(0.5f)}));
    // Across the pole: the other side.
    CHECK(is(direction(120.f, -10.f), direction(320.f, 10.f)));
}

TEST_CASE("the fisheye sees a cap of directions in a circle", "[unit][camera]")
{
    const std::string mapping = GENERATE("equidistant", "equisolid");
    const float fov = GENERATE(90.f, 180.f, 360.f);
    CAPTURE(mapping, fov);
    const auto camera = ParamsBuilder("camera", "fisheye")
                            .integer("width", 300)
                            .integer("height", 200)
                            .number("fov", fov)
                            .string("mapping", mapping)
                            .build<FisheyeCamera, Camera>();
    const auto angle = [&](float x, float y) {
        const CameraRay seen = camera->sample_ray({x, y}, lens_centre);
        CHECK(seen.weight == Color(1.f));
        CHECK(length(seen.ray.direction) == Approx(1.f));
        return std::acos(std::clamp(seen.ray.direction.z, -1.f, 1.f)) * 360.f / pi; // of the whole field
    };
    CHECK(angle(150.f, 100.f) == Approx(0.f).margin(0.05));
    // The whole sphere's edge is a single direction, where the angle is a square root of the distance.
    const double tolerance = mapping == "equisolid" && fov == 360.f ? 5e-3 : 1e-3;
    CHECK(angle(150.f, 0.001f) == Approx(fov).epsilon(tolerance));
    CHECK(angle(50.001f, 100.f) == Approx(fov).epsilon(tolerance));
    const float half = mapping == "equidistant"
                           ? 0.5f * fov
                           : 4.f * 180.f / pi * std::asin(0.5f * std::sin(fov * pi / 720.f));
    CHECK(angle(150.f, 50.f) == Approx(half).epsilon(1e-3));
    const Ray left = camera->sample_ray({100.f, 100.f}, lens_centre).ray,
              up = camera->sample_ray({150.f, 50.f}, lens_centre).ray;
    CHECK(left.direction.x > 0.f);
    CHECK(up.direction.y > 0.f);
    // Outside the circle nothing is seen.
    const CameraRay outside = camera->sample_ray({20.f, 100.f}, lens_centre);
    CHECK(outside.weight == Color(0.f));
    CHECK(outside.ray.t_max == 0.f);
}

TEST_CASE("equal areas of an equisolid image are equal solid angles", "[unit][camera]")
{
    const auto camera = ParamsBuilder("camera", "fisheye")
                            .integer("width", 100)
                            .integer("height", 100)
                            .number("fov", 240.0)
                            .string("mapping", "equisolid")
                            .build<FisheyeCamera, Camera>();
    // Of directions uniform on a cap, the cosines are uniform from cos 120 to 1: Archimedes.
    double sum = 0.0, sum_of_squares = 0.0, count = 0.0;
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 400; ++x) {
            const Vec2f raster(static_cast<float>(x) / 4.f + 0.125f, static_cast<float>(y) / 4.f + 0.125f);
            const CameraRay seen = camera->sample_ray(raster, lens_centre);
            if (seen.weight == Color(0.f)) continue;
            sum += seen.ray.direction.z;
            sum_of_squares += seen.ray.direction.z * seen.ray.direction.z;
            ++count;
        }
    }
    CHECK(count / 160'000.0 == Approx(pi / 4.0).epsilon(2e-3));
    CHECK(sum / count == Approx(0.25).epsilon(2e-3));
    CHECK(sum_of_squares / count - 0.0625 == Approx(1.5 * 1.5 / 12.0).epsilon(2e-3));
}
