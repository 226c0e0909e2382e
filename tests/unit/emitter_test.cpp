// SPDX-License-Identifier: MIT

// Emitters without random numbers: light of points and directions, power, defaults and errors.

#include "plumb/model/emitter.h"
#include "plumb/model/shape.h"

#include "support/catch.h"
#include "support/lamp.h"

namespace plumb {
class DirectionalEmitter;
class PointEmitter;
} // namespace plumb

namespace plumb::test {

TEST_CASE("light of point and directional emitters arrives in its closed form", "[unit][emitter]")
{
    const auto radiance = [](const Emitter& emitter, const Vec3f& from) {
        const auto sample = emitter.sample({from}, 0.3, Vec2f(0.2f, 0.7f), Measure::best);
        REQUIRE(sample);
        CHECK(sample->is_delta);
        CHECK(sample->pdf == 1.f);
        return *sample;
    };
    const auto lamp = ParamsBuilder("emitter", "point")
                          .point("position", Vec3f(0, 3, 4))
                          .color("radiance", Color(50.f, 25.f, 0.f))
                          .build<PointEmitter, Emitter>();
    const EmitterSample seen = radiance(*lamp, Vec3f(0.f));
    CHECK(seen.radiance.r == Approx(2.0)); // I / d^2
    CHECK(seen.radiance.g == Approx(1.0));
    CHECK(seen.radiance.b == 0.f);
    CHECK(seen.distance == 5.f);
    CHECK(length(seen.wi - Vec3f(0, 0.6f, 0.8f)) < 1e-6f);
    CHECK_FALSE(lamp->sample({Vec3f(0, 3, 4)}, 0.0, Vec2f(0.5f), Measure::best)); // at the light itself
    CHECK(lamp->evaluate({Vec3f(0.f)}, seen.wi, nullptr, Measure::best).radiance.is_black());
    CHECK((lamp->is_delta() && !lamp->is_infinite()));

    const auto by_power = ParamsBuilder("emitter", "point")
                              .point("position", Vec3f(0, 0, 5))
                              .color("power", Color(static_cast<float>(4.0 * pi_d)))
                              .build<PointEmitter, Emitter>();
    CHECK(radiance(*by_power, Vec3f(0, 0, 3)).radiance.r == Approx(0.25)); // power / (4 pi d^2)
    CHECK(by_power->power() == Approx(4.0 * pi_d).epsilon(1e-5));

    const auto sun = ParamsBuilder("emitter", "directional")
                         .vector("direction", Vec3f(0, -3, -4))
                         .color("radiance", Color(7.f))
                         .build<DirectionalEmitter, Emitter>();
    sun->prepare({Vec3f(0.f), 10.f});
    const EmitterSample sunlight = radiance(*sun, Vec3f(1, 2, 3));
    CHECK(length(sunlight.wi - Vec3f(0, 0.6f, 0.8f)) < 1e-6f); // against the direction
    CHECK(sunlight.radiance == Color(7.f));
    CHECK(sunlight.distance == infinity);
    CHECK((sun->is_delta() && sun->is_infinite()));
    CHECK(sun->power() == Approx(7.0 * pi_d * 100.0).epsilon(1e-5));
}

TEST_CASE("the direction of directional light is where it goes, unless it points to the light",
          "[unit][emitter]")
{
    const bool points_to_light = GENERATE(false, true);
    const auto sun = ParamsBuilder("emitter", "directional")
                         .vector("direction", Vec3f(0, -2, 0))
                         .boolean("pointsToLight", points_to_light)
                         .build<DirectionalEmitter, Emitter>();
    const auto light = sun->sample({}, 0.5, Vec2f(0.5f), Measure::best);
    REQUIRE(light);
    CHECK(light->wi == Vec3f(0, points_to_light ? -1 : 1, 0));
}

TEST_CASE("the power of area emitters is what they send out", "[unit][emitter]")
{
    CHECK(white(ball(Vec3f(0.f), 2.0), 3.f).emitter().power() ==
          Approx(pi_d * 16.0 * pi_d * 3.0).epsilon(1e-5));
    CHECK(white(panel(Vec3f(0.f), 2.0, 4.0, Vec3f(0, 0, 1))).emitter().power() ==
          Approx(pi_d * 8.0 * 2.0).epsilon(1e-5));
    const Lamp textured(panel(Vec3f(0.f), 1.0, 1.0, Vec3f(0, 0, 1)), [](ParamsBuilder& p) {
        p.texture("radiance", two_tone_texture(Color(0.f), Color(4.f))).number("scale", 2);
    });
    CHECK(textured.emitter().power() == Approx(pi_d * 4.0).epsilon(1e-5)); // pi times the mean radiance of 4
    CHECK(white(panel(Vec3f(0.f), 1.0, 1.0, Vec3f(0, 0, 1)), 0.f).emitter().power() == 0.f);
}

TEST_CASE("bad emitters are errors", "[unit][emitter]")
{
    const auto area = ParamsBuilder("emitter", "area").complaints<AreaEmitter, Emitter>();
    REQUIRE(area.size() == 1);
    CHECK_THAT(area[0], ContainsSubstring("inside a <mesh> or <shape>"));
    const auto both =
        ParamsBuilder("emitter", "point").color("radiance", Color(1.f)).color("power", Color(1.f));
    CHECK_THAT((both.complaints<PointEmitter, Emitter>().at(0)), ContainsSubstring("keep one"));
    const auto still = ParamsBuilder("emitter", "directional").vector("direction", Vec3f(0.f));
    CHECK_THAT((still.complaints<DirectionalEmitter, Emitter>().at(0)), ContainsSubstring("must not be 0"));
    CHECK_THAT((ParamsBuilder("emitter", "directional").complaints<DirectionalEmitter, Emitter>().at(0)),
               ContainsSubstring("must be given"));
}

} // namespace plumb::test
