// SPDX-License-Identifier: MIT

// A diffuse receiver under one lamp, by every integrator that samples emitters, against Lambert's formula: lamps of every
// kind in coordinate planes, close to them and far away, along axes and in any direction, small and large, near and far,
// also seen nearly edge-on (support/placed_lamp.h).

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/lamp.h"
#include "support/placed_lamp.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// One lamp above one receiver, and where the receiver is looked at.
struct Setting {
    PlacedLamp lamp;
    Scene scene;
    Ray ray;
    double expected; // luminance along the ray
    double rounding; // its relative error
    std::string text;
};

// A rectangle that an instance's map, which turns, shears and mirrors, puts to `place`. About as large as told.
void add_in_instance(LittleScene& little, TestRandom& random, const Vec3d& place, double size,
                     const Vec3d& normal)
{
    const auto factor = [&] {
        return std::pow(10.0, random.between(-1, 1)) * (random.next_1d() < 0.5f ? -1.0 : 1.0);
    };
    const double reach = length(place) + 1.0;
    const Vec3d offset(random.between(-reach, reach), random.between(-reach, reach),
                       random.between(-reach, reach));
    const Vec3d axes[2] = {Vec3d(random.direction()), Vec3d(random.direction())};
    const double angles[2] = {random.between(0, 360), random.between(0, 360)};
    const double x = factor(), y = factor(), z = factor();
    const Transform map = Transform::translate(offset) * Transform::rotate(axes[0], angles[0]) *
                          *Transform::scale({x, y, z}) * Transform::rotate(axes[1], angles[1]);
    // The transpose takes the normal back.
    Vec3d object_normal(0.0);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            object_normal[j] +=
                map.rows()[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * normal[i];
    const double object_size = size / std::max({std::abs(x), std::abs(y), std::abs(z)});
    little.instance(ParamsBuilder("shape", "rectangle")
                        .point("center", Vec3f(map.inverse().point(place)))
                        .number("width", object_size)
                        .number("height", object_size)
                        .vector("normal", Vec3f(normalize(object_normal)))
                        .build<Rectangle, Shape>(),
                    diffuse(1.f), map);
}

std::optional<Setting> random_setting(TestRandom& random, LampKind kind, double plane, bool in_instance)
{
    const PlacedLamp lamp = place_lamp(random, kind, plane);
    // Close above a large lamp, choosing points by area has too heavy a tail for a t test.
    const bool edge_on = random.next_1d() < 0.25f;
    const double steepness = edge_on ? std::pow(10.0, random.between(-2.5, -0.7)) : random.between(0.2, 1.0);
    const double distance = std::max(std::exp(random.between(std::log(0.4), std::log(1e3))),
                                     edge_on ? lamp.size : 0.1 * lamp.size);
    const double rounding = rounding_error(lamp, steepness);
    if (rounding > 0.01) return std::nullopt; // floats do not hold the lamp
    const Vec3d place = point_in_front(random, lamp, distance, steepness);
    const Vec3d to_lamp = Vec3d(lamp.center) - place;

    // The receiver faces the lamp more or less; of a sphere it must see all.
    Vec3d facing = normalize(to_lamp);
    const Vec3d tilted = normalize(facing + Vec3d(random.direction()) * random.between(0.0, 0.8));
    const double horizon =
        kind == LampKind::sphere ? static_cast<double>(lamp.radius) / length(to_lamp) : 0.1;
    if (dot(tilted, facing) > horizon * 1.1 + 0.05) facing = tilted;
    const Vec3f normal(facing);

    // Smaller than what is between it and the lamp, and looked at from within that, too.
    const double size = std::min({0.1 * distance, 0.1 * lamp.size, 0.3 * steepness * distance});
    LittleScene little;
    if (in_instance)
        add_in_instance(little, random, place, size * 0.5, facing);
    else
        little.rectangle(Vec3f(place), static_cast<float>(size), static_cast<float>(size), normal,
                         diffuse(1.f));
    auto shape = shape_of(lamp);
    little.add_shape(std::move(shape), diffuse(0.f), Color(1.f));
    Scene scene = little.build();

    const Vec3f eye(place +
                    (facing + normalize(cross(facing, Vec3d(random.direction()))) * 0.5) * size * 0.4);
    const Ray ray{eye, normalize(Vec3f(place) - eye)};
    const auto hit = scene.intersect(ray);
    if (!hit || hit->emitter) return std::nullopt; // floats do not hold so small a receiver so far away
    const double expected = form_factor(lamp, Vec3d(hit->position), normalize(Vec3d(hit->geometric_normal)));
    return Setting{
        lamp,     std::move(scene),
        ray,      expected,
        rounding, fmt::format("{}, seen from {:.4g} with cosine {:.3g}", lamp.text(), distance, steepness)};
}

std::vector<NamedParams> emitter_samplers(const Scene& scene)
{
    std::vector<NamedParams> result = {
        {"direct_ems", integrator_params("direct_ems")},
        {"direct_mis", integrator_params("direct_mis")},
        {"direct_whitted", integrator_params("direct_whitted")},
        {"direct by area", integrator_params("direct").string("measure", "area")},
        {"whitted", integrator_params("whitted")},
        {"path_nee", integrator_params("path_nee").integer("maxDepth", 1)},
        {"path_mis", integrator_params("path_mis").integer("maxDepth", 1)},
        {"path_mis, balance",
         integrator_params("path_mis").integer("maxDepth", 1).string("heuristic", "balance")},
        {"explicit by area", configured_path(true, "max-depth", 1).string("direct-measure", "area")},
    };
    if (scene.emitters()[0]->has_solid_angle())
        result.push_back(
            {"direct by solid angle", integrator_params("direct").string("measure", "solid-angle")});
    return result;
}

void check_lamps(int settings_of_a_kind, std::uint64_t samples, std::uint64_t seed, bool in_instance = false)
{
    const FlushDenormals mode;
    TestRandom random(seed);
    constexpr double planes[] = {0.0, 1e-3, -1e-3, 0.1, -0.1, 1.0, -1.0, 1e3, -1e3};
    const double level = sidak_level(significance, std::size(all_lamp_kinds) *
                                                       static_cast<std::size_t>(settings_of_a_kind) * 10);
    for (const LampKind kind : all_lamp_kinds) {
        int lit = 0;
        for (int i = 0; i < settings_of_a_kind; ++i) {
            const auto setting = random_setting(
                random, kind, planes[static_cast<std::size_t>(i) % std::size(planes)], in_instance);
            if (!setting || !(setting->expected > 0.0)) continue;
            ++lit;
            for (const NamedParams& named : emitter_samplers(setting->scene)) {
                const auto integrator = make_integrator(named.params, setting->scene);
                check_mean(
                    named.name + ": " + setting->text, setting->expected,
                    [&](std::uint64_t n, std::uint64_t with_seed) {
                        return estimate(
                            setting->scene, *integrator, [&](Sampler&) { return setting->ray; }, n,
                            with_seed);
                    },
                    samples, level, 1, 1e-4 + setting->rounding);
            }
        }
        CAPTURE(to_string(kind));
        CHECK(lit > settings_of_a_kind / 4);
    }
}

} // namespace

TEST_CASE("lamps anywhere light a receiver as Lambert says", "[statistical][shadow_ray]")
{
    check_lamps(45, 400, 31);
}

TEST_CASE("lamps anywhere light a receiver inside an instance as Lambert says",
          "[statistical][shadow_ray][instance]")
{
    check_lamps(45, 400, 33, true);
}

TEST_CASE("many lamps anywhere light a receiver as Lambert says", "[statistical][shadow_ray][slow]")
{
    check_lamps(900, 4000, 32);
}
