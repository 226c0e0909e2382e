// SPDX-License-Identifier: MIT

// A shape of many primitives that Embree does not know, added by one call.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "shapes/intersection.h"
#include "support/catch.h"
#include "support/params.h"

namespace plumb {
class Diffuse;
}

using namespace plumb;
using namespace plumb::test;

namespace {

// Balls of radius 1 at x = 0, 3, 6, ...
class Beads final : public Shape, private Primitives {
public:
    explicit Beads(std::size_t count) : count_(count) {}

    void add_to(AccelBuilder& builder) const override { builder.add_user(*this); }
    SurfacePoint surface_at(const RayD& ray, std::uint32_t primitive) const override
    {
        SurfacePoint at;
        const double t = intersect_sphere(ray, center(primitive), 1.f).value();
        at.position = Vec3f(Vec3d(ray.origin) + Vec3d(ray.direction) * t);
        at.geometric_normal = normalize(at.position - center(primitive));
        at.clearance = 1e-5f;
        return at;
    }
    Tangents tangents(const SurfacePoint&) const override { return {}; }
    ShapeSample sample_area(double, const Vec2f&) const override { return {}; }
    float area() const override { return 4.f * pi * static_cast<float>(count_); }
    Box3f bounds() const override
    {
        return {Vec3f(-1.f), Vec3f(3.f * static_cast<float>(count_ - 1) + 1.f, 1.f, 1.f)};
    }
    DirectionCone normals() const override { return {}; }

private:
    static Vec3f center(std::uint32_t i) { return {3.f * static_cast<float>(i), 0.f, 0.f}; }

    std::size_t count() const override { return count_; }
    Box3f bounds(std::uint32_t i) const override { return {center(i) - Vec3f(1.f), center(i) + Vec3f(1.f)}; }
    std::optional<double> intersect(const Ray& ray, std::uint32_t i) const override
    {
        return intersect_sphere(ray, center(i), 1.f);
    }

    std::size_t count_;
};

Scene beads(std::size_t count)
{
    std::vector<SceneObject> objects;
    for (int i = 0; i < 2; ++i)
        objects.push_back({ParamsBuilder("shape", i == 0 ? "rectangle" : "sphere")
                               .point("center", Vec3f(-10, static_cast<float>(i), 0))
                               .build_type(shape_types()),
                           ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "other"});
    objects.push_back({std::make_unique<Beads>(count),
                       ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "beads"});
    return Scene(std::move(objects), {});
}

} // namespace

TEST_CASE("a shape of many user primitives is met at the nearest one", "[unit][shape]")
{
    const Scene scene = beads(100);
    for (int i = 0; i < 100; ++i) {
        const Vec3f middle(3.f * static_cast<float>(i), 0, 0);
        const auto from_above = scene.intersect({middle + Vec3f(0, 5, 0), Vec3f(0, -1, 0)});
        REQUIRE(from_above);
        CHECK(from_above->primitive == static_cast<std::uint32_t>(i));
        CHECK(from_above->shape == scene.objects()[2].shape.get());
        CHECK(from_above->position == middle + Vec3f(0, 1, 0));
        // Along the string: the next one, from inside the far side of this one.
        const auto along = scene.intersect({middle, Vec3f(1, 0, 0)});
        REQUIRE(along);
        CHECK(along->primitive == static_cast<std::uint32_t>(i));
        CHECK(along->position.x == middle.x + 1.f);
        CHECK(scene.occluded({middle + Vec3f(0, 5, 0), Vec3f(0, -1, 0)}));
        CHECK_FALSE(scene.occluded({middle + Vec3f(0, 5, 0), Vec3f(0, -1, 0), 0.f, 3.9f}));
        CHECK_FALSE(scene.occluded({middle + Vec3f(1.5f, 5, 0), Vec3f(0, -1, 0)}));
    }
    const auto first = scene.intersect({Vec3f(400, 0, 0), Vec3f(-1, 0, 0)});
    REQUIRE(first);
    CHECK(first->primitive == 99);
}
