// SPDX-License-Identifier: MIT

// What the scene answers: emitters as often as their density says, densities that agree, light that scales.

#include "support/catch.h"
#include "support/scene_text.h"
#include "support/statistics.h"

#include <fmt/format.h>

using namespace plumb;

namespace {

constexpr const char* lamps = R"(
<scene dialect="plumb">
    <integrator type="path_mis"/> <camera type="perspective"/>
    <mesh type="sphere">
        <point name="center" value="0,3,0"/> <float name="radius" value="0.5"/>
        <emitter type="area"><color name="radiance" value="2,2,2"/></emitter>
    </mesh>
    <mesh type="rectangle">
        <point name="center" value="3,2,0"/> <vector name="normal" value="-1,0,0"/>
        <emitter type="area"><color name="radiance" value="3,1,0"/></emitter>
    </mesh>
    <mesh type="sphere"> <point name="center" value="0,-20,0"/> <float name="radius" value="19"/> </mesh>
    <emitter type="pointlight"><point name="position" value="0,1,2"/><color name="radiance" value="0.5,0.5,0.5"/></emitter>
    <emitter type="directional"><vector name="direction" value="0,-1,0"/><color name="radiance" value="0.01,0,0"/></emitter>
    <emitter type="environment"><color name="radiance" value="0.001,0.001,0.002"/></emitter>
</scene>)";

} // namespace

TEST_CASE("each emitter is chosen as often as the density of its samples says", "[statistical][scene]")
{
    const LoadedScene loaded = test::load_text(lamps);
    const Scene& scene = *loaded.job.scene;
    REQUIRE(scene.emitters().size() == 5);
    // Every lamp can be seen from here, so that no sample is refused, but half of the environment's where a normal is:
    // those below the horizon.
    const Vec3f from(0.f, 0.5f, 0.f);
    const std::uint32_t environment = 4;

    // The share of the pdf that is the choice: the rest is the emitter's own.
    const auto probability = [&](const EmitterSample& light) {
        if (light.is_delta) return light.pdf;
        SurfacePoint at;
        at.position = light.position;
        at.geometric_normal = light.normal;
        const SurfacePoint* hit = light.distance == infinity ? nullptr : &at;
        return light.pdf / light.emitter->evaluate({from}, light.wi, hit, Measure::best).pdf;
    };
    for (std::uint32_t i = 0; i < 5; ++i)
        for (const Vec3f& normal : {Vec3f(0.f), Vec3f(0.6f, 0.8f, 0.f)})
            test::check_mean(
                fmt::format("choice of emitter {}, normal {}", i, normal.x),
                i == environment && normal != Vec3f(0.f) ? 0.5 : 1.0,
                [&](std::uint64_t samples, std::uint64_t seed) {
                    test::TestRandom random(seed);
                    MeanAndVariance ones;
                    for (std::uint64_t k = 0; k < samples; ++k) {
                        const double u_choice = random.next_double();
                        const auto light = scene.sample_emitter({from, normal}, u_choice, random.next_2d());
                        const bool chosen = light && light->emitter_index == i;
                        if (chosen) CHECK(light->emitter == scene.emitters()[i]);
                        ones.add(chosen ? 1.0 / static_cast<double>(probability(*light)) : 0.0);
                    }
                    return ones;
                },
                20000, test::sidak_level(test::significance, 10));
}

TEST_CASE("what a ray sees has the density with which it would have been sampled", "[statistical][scene]")
{
    const LoadedScene loaded = test::load_text(lamps);
    const Scene& scene = *loaded.job.scene;
    test::TestRandom random(4);
    int compared = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3f from(static_cast<float>(random.between(-1, 1)), static_cast<float>(random.between(0, 1)),
                         static_cast<float>(random.between(-1, 1)));
        const double u_choice = random.next_double();
        const auto light = scene.sample_emitter({from}, u_choice, random.next_2d());
        if (!light || light->is_delta) continue;
        const auto hit = scene.intersect({from, light->wi});
        if (hit && hit->emitter != light->emitter) continue; // something is in between
        const EmitterValue seen = scene.emission({from}, light->wi, hit ? &*hit : nullptr);
        CHECK(seen.pdf == Approx(light->pdf).epsilon(2e-3));
        CHECK(seen.radiance.r == Approx(light->radiance.r).epsilon(2e-3));
        ++compared;
    }
    CHECK(compared > 1000);
}

TEST_CASE("a scene of another scale gives the same image", "[statistical][scene][scale]")
{
    // A floor, a glass and a matte ball, a sphere lamp and a point light, everything scaled alike; the point light's
    // intensity by the square. The same seed draws the same paths, so means agree far within the noise of one image.
    const auto mean_at_scale = [](double s) {
        const auto scaled = [s](double x) { return fmt::format("{:.9g}", x * s); };
        const std::string xml = fmt::format(
            R"(<scene dialect="plumb"><integrator type="path_mis"/>
            <sampler type="independent"><integer name="sampleCount" value="64"/></sampler>
            <camera type="perspective"><integer name="width" value="32"/><integer name="height" value="24"/>
                <float name="fov" value="45"/><rfilter type="box"/>
                <transform name="toWorld"><lookat origin="{0},{1},{2}" target="{0},{3},0" up="0,1,0"/></transform></camera>
            <mesh type="rectangle"><vector name="normal" value="0,1,0"/><float name="width" value="{4}"/>
                <float name="height" value="{4}"/><point name="center" value="{0},0,0"/></mesh>
            <mesh type="sphere"><point name="center" value="{5},{6},0"/><float name="radius" value="{6}"/><bsdf type="dielectric"/></mesh>
            <mesh type="sphere"><point name="center" value="{7},{6},0"/><float name="radius" value="{6}"/></mesh>
            <mesh type="sphere"><point name="center" value="{0},{8},{6}"/><float name="radius" value="{9}"/>
                <emitter type="area"><color name="radiance" value="20,20,20"/></emitter></mesh>
            <emitter type="pointlight"><point name="position" value="{5},{8},{8}"/>
                <color name="radiance" value="{10:.9g},{10:.9g},{10:.9g}"/></emitter></scene>)",
            scaled(0.0), scaled(2.0), scaled(6.0), scaled(0.5), scaled(20.0), scaled(-1.1), scaled(0.8),
            scaled(1.1), scaled(3.0), scaled(0.3), 4.0 * s * s);
        const LoadedScene loaded = test::load_text(xml);
        const RenderState result = render(loaded.job, {});
        CHECK(result.left_out.count == 0);
        const Image image = result.film.develop();
        MeanAndVariance mean;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x) mean.add(luminance(image.color(x, y)));
        return mean.mean();
    };
    const double reference = mean_at_scale(1.0);
    for (const double scale : {1e-4, 1e-2, 1e3, 1e5}) {
        INFO("scale " << scale);
        CHECK(mean_at_scale(scale) == Approx(reference).epsilon(2e-3));
    }
}
