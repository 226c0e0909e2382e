// SPDX-License-Identifier: MIT

// The choice among many emitters: the probabilities it says are those it has, and no light is forgotten.

#include "plumb/scene/light_tree.h"

#include "plumb/sampling/sampling.h"
#include "support/catch.h"
#include "support/choice_outcome.h"
#include "support/little_scene.h"

#include <memory>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// A light of which only the bounds are known; nothing else of it is asked for.
class Bounded final : public Emitter {
public:
    explicit Bounded(const LightBounds& bounds) : bounds_(bounds) {}
    std::optional<EmitterSample> sample(const LightReceiver&, double, const Vec2f&, Measure) const override
    {
        return std::nullopt;
    }
    EmitterValue evaluate(const LightReceiver&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }
    float power() const override { return static_cast<float>(bounds_->power); }
    std::optional<LightBounds> bounds() const override { return is_infinite_ ? std::nullopt : bounds_; }
    bool is_delta() const override { return bounds_->box.min == bounds_->box.max; }
    bool is_infinite() const override { return is_infinite_; }
    void be_infinite() { is_infinite_ = true; }

private:
    std::optional<LightBounds> bounds_;
    bool is_infinite_ = false;
};

constexpr SceneSphere unit_sphere{Vec3f(0.f), 1.f};

struct Lights {
    std::vector<std::unique_ptr<Bounded>> owned;
    std::vector<const Emitter*> emitters;

    Bounded& add(const LightBounds& bounds)
    {
        owned.push_back(std::make_unique<Bounded>(bounds));
        emitters.push_back(owned.back().get());
        return *owned.back();
    }
    LightTree tree(const SceneSphere& sphere = unit_sphere) const
    {
        return LightTree(emitters, LightTree::Among::all, sphere);
    }
    double sum(const LightTree& tree, const LightReceiver& receiver) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < emitters.size(); ++i)
            sum += static_cast<double>(tree.probability(receiver, i));
        return sum;
    }
};

Vec3f point_in_cube(TestRandom& random, double half)
{
    const double x = random.between(-half, half);
    const double y = random.between(-half, half);
    const double z = random.between(-half, half);
    return Vec3f(Vec3d(x, y, z));
}

// Flat, round and point-like lights of very different powers, some of them black.
LightBounds random_bounds(TestRandom& random)
{
    const Vec3f center = point_in_cube(random, 0.5);
    const Vec3f half = random.next_1d() < 0.2f ? Vec3f(0.f) : point_in_cube(random, 0.1);
    LightBounds bounds{Box3f(center), 0.0, DirectionCone()};
    bounds.box.extendBy(center + half);
    bounds.box.extendBy(center - half);
    bounds.normals.axis = random.direction();
    const double kind = random.next_double();
    bounds.normals.angle = kind < 0.3 ? 0.0 : kind < 0.6 ? pi_d : random.between(0.0, pi_d);
    const double exponent = random.between(-2.0, 2.0);
    if (random.next_1d() < 0.9f) bounds.power = std::pow(10.0, exponent);
    return bounds;
}

Lights random_lights(TestRandom& random, int count, int infinite)
{
    Lights lights;
    for (int i = 0; i < count + infinite; ++i) {
        Bounded& light = lights.add(random_bounds(random));
        if (i % (1 + count / (infinite + 1)) == 1 && infinite > 0) light.be_infinite();
    }
    return lights;
}

// Light from both sides counts for every third one; some are glossy.
LightReceiver random_receiver(TestRandom& random, double half)
{
    const Vec3f position = point_in_cube(random, half);
    const Vec3f normal = random.direction();
    const bool any_side = random.next_1d() < 0.33f;
    const bool is_glossy = random.next_1d() < 0.3f;
    return {position, any_side ? Vec3f(0.f) : normal, is_glossy};
}

// Cells: whether the first or the second half is left of u, for each emitter; and nothing.
Outcome choices_outcome(const Lights& lights, const LightTree& tree, const LightReceiver& receiver,
                        std::uint64_t samples, std::uint64_t seed)
{
    const std::size_t count = lights.emitters.size();
    std::vector<double> chosen(2 * count + 1, 0.0);
    std::vector<double> chances(2 * count + 1, 0.0);
    chances.back() = std::max(1.0 - lights.sum(tree, receiver), 0.0);
    for (std::size_t i = 0; i < 2 * count; ++i)
        chances[i] = 0.5 * static_cast<double>(tree.probability(receiver, i / 2));

    TestRandom random(seed);
    for (std::uint64_t i = 0; i < samples; ++i) {
        const auto choice = tree.choose(receiver, random.next_double());
        if (!choice) {
            ++chosen.back();
            continue;
        }
        if (!(choice->u >= 0.0 && choice->u < 1.0)) return {0.0, fmt::format("u = {}", choice->u)};
        if (!(choice->probability > 0.f) || choice->probability != tree.probability(receiver, choice->index))
            return {0.0, fmt::format("emitter {} was chosen with probability {} and has {}", choice->index,
                                     choice->probability, tree.probability(receiver, choice->index))};
        ++chosen[2 * choice->index + (choice->u < 0.5 ? 0 : 1)];
    }

    return choice_outcome(chosen, chances, samples);
}

} // namespace

TEST_CASE("lights are chosen with the probability that is said", "[statistical][scene][light_tree]")
{
    TestRandom random(11);
    constexpr int receivers = 6;
    const std::vector<std::pair<int, int>> counts{{1, 1}, {2, 0}, {3, 1}, {8, 0}, {9, 2}, {60, 1}, {700, 3}};
    for (const auto& [count, infinite] : counts) {
        const Lights lights = random_lights(random, count, infinite);
        const LightTree tree = lights.tree();
        for (int i = 0; i < receivers; ++i) {
            const LightReceiver receiver = random_receiver(random, i == 0 ? 0.05 : i == 1 ? 20.0 : 1.0);
            CHECK(lights.sum(tree, receiver) <= 1.0 + 1e-5);
            check_statistic(
                fmt::format("{} lights, receiver {}", count, i),
                [&](std::uint64_t samples, std::uint64_t seed) {
                    return choices_outcome(lights, tree, receiver, samples, seed);
                },
                10000, sidak_level(significance, counts.size() * receivers));
        }
    }
}

TEST_CASE("a light that may reach the receiver can be chosen", "[statistical][scene][light_tree]")
{
    TestRandom random(12);
    int reached = 0;
    int culled = 0;
    for (int i = 0; i < 40; ++i) {
        const Lights lights = random_lights(random, 1 << (i % 9), i % 3);
        const LightTree tree = lights.tree();
        if (!tree.can_sample()) continue;
        for (int j = 0; j < 200; ++j) {
            const LightReceiver receiver = random_receiver(random, j % 2 == 0 ? 0.5 : 3.0);
            for (std::size_t k = 0; k < lights.emitters.size(); k += 1 + lights.emitters.size() / 8) {
                const float probability = tree.probability(receiver, k);
                const auto bounds = lights.emitters[k]->bounds();
                if (!(lights.emitters[k]->power() > 0.f)) {
                    CHECK(probability == 0.f);
                    continue;
                }
                // A point of the box, and a normal in the cone.
                bool reaches = !bounds;
                if (bounds) {
                    const Vec3f size = bounds->box.size();
                    const Vec3f u = point_in_cube(random, 0.5) + Vec3f(0.5f);
                    const Vec3f point = bounds->box.min + Vec3f(u.x * size.x, u.y * size.y, u.z * size.z);
                    const Vec3d axis(bounds->normals.axis);
                    const Vec3d side = normalize(cross(axis, Vec3d(random.direction())));
                    const double angle = bounds->normals.angle * random.next_double();
                    const Vec3d normal = axis * std::cos(angle) + side * std::sin(angle);
                    const Vec3d there = Vec3d(point) - Vec3d(receiver.position);
                    reaches = dot(there, normal) < 0.0 &&
                              (receiver.normal == Vec3f(0.f) || dot(there, Vec3d(receiver.normal)) > 0.0);
                }
                if (reaches) {
                    ++reached;
                    if (!(probability > 0.f)) FAIL("light " << k << " of " << lights.emitters.size());
                } else if (!(probability > 0.f)) {
                    ++culled;
                }
            }
        }
    }
    CHECK(reached > 5000);
    CHECK(culled > 5000);
}

TEST_CASE("lights that cannot reach the receiver are not chosen", "[statistical][scene][light_tree]")
{
    // A ceiling of panels that face down.
    Lights lights;
    for (int i = 0; i < 100; ++i) {
        LightBounds panel{Box3f(Vec3f(static_cast<float>(i % 10), 3.f, static_cast<float>(i / 10))), 1.0,
                          DirectionCone{Vec3f(0, -1, 0), 0.0}};
        panel.box.extendBy(panel.box.min + Vec3f(0.3f, 0.f, 0.3f));
        lights.add(panel);
    }
    const LightTree tree = lights.tree({Vec3f(5, 3, 5), 7.f});
    for (const double u : {0.0, 0.3, 0.999999}) {
        CHECK(tree.choose({Vec3f(5, 0, 5), Vec3f(0, 1, 0)}, u));
        CHECK(tree.choose({Vec3f(5, 0, 5), Vec3f(0)}, u));
        CHECK_FALSE(tree.choose({Vec3f(5, 0, 5), Vec3f(0, -1, 0)}, u)); // they are behind
        CHECK_FALSE(tree.choose({Vec3f(5, 6, 5), Vec3f(0)}, u));        // they shine the other way
    }
    CHECK(lights.sum(tree, {Vec3f(5, 0, 5), Vec3f(0, 1, 0)}) == Approx(1.0).epsilon(1e-4));
    CHECK(lights.sum(tree, {Vec3f(5, 0, 5), Vec3f(0, -1, 0)}) == 0.0);
}

TEST_CASE("infinite lights are chosen as often as their power says, or half of the time, at least",
          "[statistical][scene][light_tree]")
{
    TestRandom random(15);
    int at_the_bound = 0;
    for (int i = 0; i < 50; ++i) {
        const Lights lights = random_lights(random, 20, 2);
        double power = 0.0;
        double infinite_power = 0.0;
        for (const Emitter* emitter : lights.emitters) {
            power += static_cast<double>(emitter->power());
            if (emitter->is_infinite()) infinite_power += static_cast<double>(emitter->power());
        }
        if (!(infinite_power > 0.0)) continue;
        const double least = std::min(infinite_power / power, 0.5);
        const LightTree tree = lights.tree();
        for (int j = 0; j < 20; ++j) {
            const LightReceiver receiver = random_receiver(random, 1.0);
            double sum = 0.0;
            for (std::size_t k = 0; k < lights.emitters.size(); ++k)
                if (lights.emitters[k]->is_infinite())
                    sum += static_cast<double>(tree.probability(receiver, k));
            CHECK(sum > least * (1.0 - 1e-5));
            if (sum < least * (1.0 + 1e-5)) ++at_the_bound;
        }
    }
    CHECK(at_the_bound > 100);
}

TEST_CASE("one light is always chosen, and none never", "[statistical][scene][light_tree]")
{
    Lights lights;
    CHECK_FALSE(lights.tree().can_sample());
    lights.add({Box3f(Vec3f(0.f)), 0.0, DirectionCone()});
    CHECK_FALSE(lights.tree().can_sample());
    lights.add({Box3f(Vec3f(0.f)), 2.0, DirectionCone()});
    const LightTree tree = lights.tree();
    REQUIRE(tree.can_sample());
    const auto choice = tree.choose({Vec3f(1.f)}, 0.25);
    REQUIRE(choice);
    CHECK(choice->index == 1);
    CHECK(choice->probability == 1.f);
    CHECK(choice->u == 0.25);
    CHECK(tree.probability({Vec3f(1.f)}, 0) == 0.f);
    CHECK(tree.probability({Vec3f(1.f)}, 1) == 1.f);
}

TEST_CASE("lights at one place, receivers in them and scenes of any size have probabilities",
          "[statistical][scene][light_tree]")
{
    TestRandom random(13);
    for (const double scale : {1e-12, 1.0, 1e6, 1e15}) {
        const Vec3f origin = Vec3f(Vec3d(0.3, -0.2, 0.1) * scale);
        Lights lights;
        for (int i = 0; i < 300; ++i) // two places
            lights.add({Box3f(i % 3 == 0 ? origin : -origin), i % 2 == 0 ? 1.0 : 1e-20, DirectionCone()});
        const LightTree tree = lights.tree({Vec3f(0.f), static_cast<float>(scale)});
        for (const double distance : {0.0, 1e-10, 1e-3, 1.0, 1e4}) {
            const Vec3f offset = random.direction() * static_cast<float>(distance * scale);
            const LightReceiver receiver{origin + offset};
            INFO("scale " << scale << ", distance " << distance);
            CHECK(lights.sum(tree, receiver) == Approx(1.0).epsilon(1e-4));
            for (int i = 0; i < 50; ++i) {
                const auto choice = tree.choose(receiver, random.next_double());
                REQUIRE(choice);
                REQUIRE(choice->probability > 0.f);
                REQUIRE(choice->probability == tree.probability(receiver, choice->index));
            }
        }
    }
}

// A thousand lamps of all kinds in a room, and light at a surface point estimated by single lamps.
TEST_CASE("the light of a thousand lamps has little noise", "[statistical][scene][light_tree]")
{
    TestRandom random(14);
    LittleScene room;
    room.room(diffuse(0.5f));
    for (int i = 0; i < 1000; ++i) {
        const Vec3f center = point_in_cube(random, 0.9);
        const Color radiance(static_cast<float>(std::pow(10.0, random.between(0.0, 2.0))));
        if (i % 2 == 0)
            room.rectangle(center, 0.02f, 0.01f, random.direction(), diffuse(0.5f), radiance);
        else
            room.sphere(center, 0.005f, diffuse(0.5f), radiance);
    }
    const Scene scene = room.build();
    std::vector<double> powers;
    for (const Emitter* emitter : scene.emitters()) powers.push_back(static_cast<double>(emitter->power()));
    const DiscreteDistribution by_power(powers);

    // Irradiance by one sample of a light.
    const auto irradiance = [&](const SurfacePoint& at, const std::optional<EmitterSample>& light) {
        if (!light) return 0.0;
        const float cosine = dot(at.geometric_normal, light->wi);
        if (!(cosine > 0.f) || scene.occluded(Scene::shadow_ray(at, *light))) return 0.0;
        return static_cast<double>(cosine * luminance(light->radiance) / light->pdf);
    };
    double variance = 0.0;
    double variance_by_power = 0.0;
    for (int i = 0; i < 20; ++i) {
        const auto at = scene.intersect({Vec3f(0.f), random.direction()});
        REQUIRE(at);
        const LightReceiver receiver{at->position, at->geometric_normal};
        const auto by_tree = [&](std::uint64_t samples, std::uint64_t seed) {
            TestRandom numbers(seed);
            MeanAndVariance light;
            for (std::uint64_t k = 0; k < samples; ++k) {
                const double u_choice = numbers.next_double();
                light.add(irradiance(*at, scene.sample_emitter(receiver, u_choice, numbers.next_2d())));
            }
            return light;
        };
        const auto of_power = [&](std::uint64_t samples, std::uint64_t seed) {
            TestRandom numbers(seed);
            MeanAndVariance light;
            for (std::uint64_t k = 0; k < samples; ++k) {
                const auto choice = by_power.sample(numbers.next_double());
                const Vec2f u = numbers.next_2d();
                const Emitter& emitter = *scene.emitters()[choice.index];
                const auto sample = emitter.sample({at->position}, choice.u, u, Measure::best);
                light.add(irradiance(*at, sample) / static_cast<double>(choice.probability));
            }
            return light;
        };
        // All lamps at once, for the mean.
        const auto all_at_once = [&](std::uint64_t samples, std::uint64_t seed) {
            TestRandom numbers(seed);
            MeanAndVariance light;
            for (std::uint64_t k = 0; k < samples; ++k) {
                double sum = 0.0;
                for (const Emitter* emitter : scene.emitters()) {
                    const double u_choice = numbers.next_double();
                    const Vec2f u = numbers.next_2d();
                    sum += irradiance(*at, emitter->sample({at->position}, u_choice, u, Measure::area));
                }
                light.add(sum);
            }
            return light;
        };
        variance += by_tree(4000, 5).variance();
        variance_by_power += of_power(4000, 6).variance();
        check_statistic(
            fmt::format("receiver {}", i),
            [&](std::uint64_t samples, std::uint64_t seed) {
                return same_mean_outcome(by_tree(samples, seed), all_at_once(samples / 200, seed + 1));
            },
            4000, sidak_level(significance, 20), 7);
    }
    INFO("variance " << variance << ", by power " << variance_by_power);
    CHECK(variance < variance_by_power / 5.0);
}
