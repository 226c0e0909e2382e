// SPDX-License-Identifier: MIT

// What emitters, filters, textures and cameras of the catalog promise (their headers in include/plumb), for each sample of
// their doc blocks. Shapes are in shape_catalog_test.cpp, BSDFs in bsdf_test.cpp, samplers in sampler_test.cpp.

#include "plumb/model/camera.h"
#include "plumb/model/emitter.h"
#include "plumb/model/filter.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/samples.h"
#include "support/statistics.h"

namespace plumb {
class Diffuse;
}

using namespace plumb;
using namespace plumb::test;

namespace {

// An emitter alone in a scene, on its shape if it has one.
struct LitScene {
    std::string name;
    Scene scene;
    SceneSphere sphere; // around it

    const Emitter& emitter() const { return *scene.emitters()[0]; }
    EmitterValue look(const Vec3f& from, const Vec3f& wi) const
    {
        const auto hit = scene.intersect({from, wi});
        return scene.emission({from}, wi, hit ? &*hit : nullptr);
    }
};

LitScene lit_scene(const Sample& sample)
{
    std::vector<SceneObject> objects;
    std::vector<std::unique_ptr<Emitter>> lights;
    if (sample.element().tag == "emitter") {
        lights.push_back(sample.build(emitter_types()));
        // What gives the scene a size.
        objects.push_back({ParamsBuilder("shape", "sphere").build_type(shape_types()),
                           ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "ball"});
    } else {
        std::unique_ptr<Shape> shape = sample.build(shape_types());
        const Element& inner = sample.element().children.back();
        std::unique_ptr<Emitter> emitter = sample.build(emitter_types(), inner, shape.get());
        objects.push_back({std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(),
                           std::move(emitter), "lamp"});
    }
    Scene scene(std::move(objects), std::move(lights));
    const Box3f box = scene.bounds();
    return {sample.text(), std::move(scene), {box.center(), 0.5f * length(box.size())}};
}

std::vector<LitScene> lit_scenes()
{
    std::vector<LitScene> scenes;
    for (const auto& sample : samples_of(emitter_types())) scenes.push_back(lit_scene(*sample));
    return scenes;
}

std::optional<EmitterSample> sample_once(const Emitter& emitter, const Vec3f& from, TestRandom& random)
{
    const double u_select = random.next_double();
    return emitter.sample({from}, u_select, random.next_2d(), Measure::best);
}

} // namespace

TEST_CASE("samples of every emitter follow the density of what rays see", "[statistical][emitter][catalog]")
{
    const std::vector<LitScene> scenes = lit_scenes();
    REQUIRE(scenes.size() >= 4);
    for (const LitScene& lit : scenes) {
        CAPTURE(lit.name);
        TestRandom random(3);
        // Spot lights and the like do not shine everywhere.
        Vec3f from = lit.sphere.center + random.direction() * (2.5f * lit.sphere.radius);
        for (int i = 0; i < 1000 && !sample_once(lit.emitter(), from, random); ++i)
            from = lit.sphere.center + random.direction() * (2.5f * lit.sphere.radius);
        int kept = 0, wrong = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto light = sample_once(lit.emitter(), from, random);
            if (!light) continue;
            ++kept;
            REQUIRE(light->pdf > 0.f);
            CHECK(std::abs(length(light->wi) - 1.f) < 1e-5f);
            CHECK(min_component(light->radiance) >= 0.f);
            CHECK(light->is_delta == lit.emitter().is_delta());
            if (light->is_delta) continue;
            if (light->distance != infinity && std::abs(dot(light->normal, light->wi)) < 0.05f) continue;
            if (light->distance == infinity && lit.scene.occluded({from, light->wi})) continue;
            const EmitterValue seen = lit.look(from, light->wi);
            wrong +=
                std::abs(seen.pdf - light->pdf) <= 2e-3f * light->pdf &&
                        std::abs(seen.radiance.g - light->radiance.g) <= 2e-3f * light->radiance.g + 1e-6f
                    ? 0
                    : 1;
        }
        CHECK(kept > 500);
        CHECK(wrong <= 2); // at edges
    }
}

TEST_CASE("the density of every emitter is that of its samples", "[statistical][emitter][catalog]")
{
    const std::vector<LitScene> scenes = lit_scenes();
    for (const LitScene& lit : scenes) {
        if (lit.emitter().is_delta()) continue;
        // Nothing is in the way on this side: the emitter is asked, not the scene.
        const Vec3f from = lit.sphere.center + Vec3f(1.3f, 1.1f, 0.7f) * lit.sphere.radius;
        const auto density = [&](const Vec3f& wi) {
            if (lit.emitter().is_infinite())
                return lit.emitter().evaluate({from}, wi, nullptr, Measure::best).pdf;
            const auto hit = lit.scene.intersect({from, wi});
            return hit ? lit.emitter().evaluate({from}, wi, &*hit, Measure::best).pdf : 0.f;
        };
        for (int k = 0; k < 4; ++k) { // 1, x, y, z
            const auto quantity = [k](const Vec3f& wi) {
                return k == 0 ? 1.0 : static_cast<double>(wi[k - 1]);
            };
            check_statistic(
                "density " + std::to_string(k) + " of " + lit.name,
                [&](std::uint64_t n, std::uint64_t seed) {
                    TestRandom random(seed);
                    MeanAndVariance sampled, integrated;
                    for (std::uint64_t i = 0; i < n; ++i) {
                        const auto light = sample_once(lit.emitter(), from, random);
                        sampled.add(light ? quantity(light->wi) : 0.0);
                        const Vec3f wi = random.direction();
                        integrated.add(4.0 * pi_d * static_cast<double>(density(wi)) * quantity(wi));
                    }
                    return same_mean_outcome(sampled, integrated, 1e-4);
                },
                40'000, sidak_level(significance, 4 * scenes.size()));
        }
    }
}

TEST_CASE("the power of every emitter is the light that passes a sphere", "[statistical][emitter][catalog]")
{
    const std::vector<LitScene> scenes = lit_scenes();
    for (const LitScene& lit : scenes) {
        const Emitter& emitter = lit.emitter();
        const auto bounds = emitter.bounds();
        REQUIRE(bounds.has_value() != emitter.is_infinite());
        // Around the lamp; of infinite emitters the scene's.
        const Vec3f center = bounds ? bounds->box.center() : lit.sphere.center;
        const float radius = bounds ? std::max(1.f, 2.f * length(bounds->box.size())) : lit.sphere.radius;
        check_mean(
            "power of " + lit.name, static_cast<double>(emitter.power()),
            [&](std::uint64_t n, std::uint64_t seed) {
                TestRandom random(seed);
                MeanAndVariance power;
                for (std::uint64_t i = 0; i < n; ++i) {
                    const Vec3f out = random.direction();
                    const auto light = sample_once(emitter, center + out * radius, random);
                    const float cosine = light ? dot(light->wi, bounds ? -out : out) : 0.f;
                    power.add(cosine > 0.f
                                  ? static_cast<double>(luminance(light->radiance) * cosine / light->pdf) *
                                        4.0 * pi_d * sqr<double>(radius)
                                  : 0.0);
                    if (!light || !bounds) continue;
                    for (int axis = 0; axis < 3; ++axis) {
                        const float slack = 1e-5f * radius;
                        if (light->position[axis] < bounds->box.min[axis] - slack ||
                            light->position[axis] > bounds->box.max[axis] + slack)
                            FAIL("a sample outside the bounds");
                    }
                }
                return power;
            },
            40'000, sidak_level(significance, scenes.size()), 1, 1e-4);
    }
}

TEST_CASE("every filter samples in proportion to its absolute value", "[statistical][filter][catalog]")
{
    const auto samples = samples_of(filter_types());
    for (const auto& sample : samples) {
        const std::unique_ptr<Filter> filter = sample->build(filter_types());
        const double radius = filter->radius();
        const auto value = [&](double x, double y) {
            return static_cast<double>(filter->evaluate({static_cast<float>(x), static_cast<float>(y)}));
        };
        // Separable: f(x, y) = f(x, 0) f(0, y) / f(0, 0).
        double integral = 0.0, absolute = 0.0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double one = value(radius * (2.0 * (i + 0.5) / steps - 1.0), 0.0);
            integral += one * 2.0 * radius / steps;
            absolute += std::abs(one) * 2.0 * radius / steps;
        }
        const double scale = value(0.0, 0.0) / sqr(absolute);
        const Grid grid{-radius, radius, -radius, radius, 16, 16};
        check_distribution(
            sample->text(), grid,
            [&](TestRandom& random) -> std::optional<Imath::V2d> {
                const FilterSample one = filter->sample(random.next_2d());
                return Imath::V2d(one.offset.x, one.offset.y);
            },
            [&](double x, double y) { return std::abs(value(x, y)) * scale; }, 50'000,
            sidak_level(significance, samples.size()), 5);
        TestRandom random(6);
        for (int i = 0; i < 500; ++i) {
            const FilterSample one = filter->sample(random.next_2d());
            const double there = value(one.offset.x, one.offset.y);
            CHECK(static_cast<double>(std::abs(one.weight)) ==
                  Approx(sqr(absolute / integral)).epsilon(1e-3));
            if (std::abs(there) > 1e-3) CHECK((one.weight > 0.f) == (there > 0.0));
        }
    }
    CHECK(samples.size() >= 4);
}

TEST_CASE("every texture has the mean and the bounds that it says", "[statistical][texture][catalog]")
{
    const auto samples = samples_of(texture_types());
    CHECK(samples.size() >= 5);
    for (const auto& sample : samples) {
        CAPTURE(sample->text());
        const std::unique_ptr<Texture> texture = sample->build(texture_types());
        TestRandom anywhere(2);
        for (int i = 0; i < 2000; ++i) {
            const Vec2f uv(static_cast<float>(anywhere.between(-5, 5)),
                           static_cast<float>(anywhere.between(-5, 5)));
            const Color color = texture->color(uv);
            CHECK(min_component(color) >= texture->min_value() - 1e-6f);
            CHECK(max_component(color) <= texture->max_value() + 1e-6f);
            CHECK(texture->number(uv) == number_of(color));
        }
        if (texture->reads_attributes()) continue; // the mean is that of a mesh
        for (int channel = 0; channel < 3; ++channel)
            check_mean(
                "mean of " + sample->text(), static_cast<double>(texture->mean()[channel]),
                [&](std::uint64_t n, std::uint64_t seed) {
                    TestRandom random(seed);
                    MeanAndVariance mean;
                    for (std::uint64_t i = 0; i < n; ++i)
                        mean.add(static_cast<double>(texture->color(random.next_2d())[channel]));
                    return mean;
                },
                20'000, sidak_level(significance, 3 * samples.size()), 3, 1e-5);
    }
}

TEST_CASE("every camera sees its image upright", "[statistical][camera][catalog]")
{
    const auto samples = samples_of(camera_types());
    CHECK(!samples.empty());
    for (const auto& sample : samples) {
        CAPTURE(sample->text());
        const std::unique_ptr<Camera> camera = sample->build(camera_types());
        const Transform to_camera = camera->to_world().inverse();
        const Vec2f size(static_cast<float>(camera->resolution().x),
                         static_cast<float>(camera->resolution().y));
        // The mean over the lens of where rays are at depth 1, in camera space (+x is left), for a place in the image.
        const auto towards = [&](float x, float y) {
            TestRandom random(4);
            Vec3d sum(0.0);
            for (int i = 0; i < 2000; ++i) {
                const CameraRay seen = camera->sample_ray({x * size.x, y * size.y}, random.next_2d());
                CHECK(std::abs(length(seen.ray.direction) - 1.f) < 1e-6f);
                CHECK(is_traceable(seen.ray));
                CHECK(min_component(seen.weight) >= 0.f);
                const Vec3d direction = to_camera.vector(Vec3d(seen.ray.direction));
                CHECK(direction.z > 0.0);
                sum += to_camera.point(Vec3d(seen.ray.origin)) + direction / direction.z;
            }
            return sum / 2000.0;
        };
        // At the edges; but near the middle of one whose edges see backwards, where every view is flat.
        const CameraRay edge = camera->sample_ray({0.f, 0.5f * size.y}, {0.5f, 0.5f});
        const bool is_wide =
            !(to_camera.vector(Vec3d(edge.ray.direction)).z > 1e-3) || edge.weight == Color(0.f);
        const float reach = is_wide ? 0.002f : 0.5f;
        const Vec3d middle = towards(0.5f, 0.5f), left = towards(0.5f - reach, 0.5f),
                    right = towards(0.5f + reach, 0.5f), top = towards(0.5f, 0.5f - reach),
                    bottom = towards(0.5f, 0.5f + reach);
        CHECK(length(middle - Vec3d(0, 0, 1)) < 1e-2);
        CHECK(left.x > middle.x);
        CHECK(right.x < middle.x);
        CHECK(top.y > middle.y);
        CHECK(bottom.y < middle.y);
        CHECK((left.x - right.x) / (top.y - bottom.y) ==
              Approx(static_cast<double>(size.x / size.y)).epsilon(is_wide ? 3e-4 : 1e-4));
    }
}
