// SPDX-License-Identifier: MIT

// BSDFs that bend the normal: path tracing with and without light sampling agree, also where the normal is tilted by 66
// degrees and the lamp stands at the horizon. If light passed between the bent and the true horizon (bsdf.h), light sampling
// would miss it: without that rule in `normalmap`, path_nee gives 0.105 in place of 0.147 for the first of these floors.

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/samples.h"

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr const char* tilt = "<color name='normal' value='0.05 0.5 0.7'/>";

MakeBsdf from_xml(const std::string& xml)
{
    return [xml] { return Sample(xml + "\n").build(bsdf_types()); };
}

// A floor with the BSDF, and a lamp that is half below its horizon.
Scene floor_and_lamp(const MakeBsdf& bsdf)
{
    LittleScene little;
    little.rectangle(Vec3f(0.f), 2.f, 2.f, Vec3f(0, 1, 0), bsdf);
    little.sphere(Vec3f(-2.5f, 0.2f, 0.f), 0.6f, diffuse(0.f), Color(5.f));
    little.sphere(Vec3f(2.5f, 0.2f, 0.f), 0.6f, diffuse(0.f), Color(1.f));
    little.environment(Color(0.1f));
    return little.build();
}

void check_bent(const std::string& name, const std::string& xml, const Vec3f& eye, std::uint64_t samples)
{
    const FlushDenormals mode;
    const Scene scene = floor_and_lamp(from_xml(xml));
    const ChooseRay rays = rays_around(eye, Vec3f(0.f), 0.3f);
    for (const char* other : {"path_nee", "path_mis", "direct_mis", "direct_ems"}) {
        const auto integrator = make_integrator(integrator_params(other), scene);
        const auto truth = std::string_view(other).starts_with("direct")
                               ? make_integrator(integrator_params("direct_mats"), scene)
                               : make_integrator(integrator_params("path_mats"), scene);
        check_same_mean(
            name + ": " + other,
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *integrator, rays, n, seed); },
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *truth, rays, n, seed); },
            samples, sidak_level(significance, 24));
    }
}

std::string map_around(const std::string& inner)
{
    return "<bsdf type='normalmap'>" + std::string(tilt) + inner + "</bsdf>";
}

} // namespace

TEST_CASE("path tracers agree where normals are bent", "[statistical][bent_normal]")
{
    const std::string matt = "<bsdf type='diffuse'/>";
    const std::string metal = "<bsdf type='roughconductor'><float name='alpha' value='0.3'/></bsdf>";
    const Vec3f above(0.3f, 1.f, 0.2f), below(0.3f, -1.f, 0.2f), grazing(1.f, 0.15f, 0.2f);
    check_bent("diffuse", map_around(matt), above, 20'000);
    check_bent("diffuse at a grazing angle", map_around(matt), grazing, 20'000);
    check_bent("conductor", map_around(metal), above, 20'000);
    check_bent("two-sided", "<bsdf type='twosided'>" + map_around(matt) + map_around(metal) + "</bsdf>",
               above, 20'000);
    check_bent("two-sided from behind",
               "<bsdf type='twosided'>" + map_around(matt) + map_around(metal) + "</bsdf>", below, 20'000);
    check_bent("around two-sided", map_around("<bsdf type='twosided'>" + matt + "</bsdf>"), below, 20'000);
}

TEST_CASE("a normal map bends the normal as it says", "[unit][bent_normal]")
{
    // Tilted by 45 degrees towards +x: a diffuse BSDF is brightest there, and black beyond its own horizon.
    const Sample sample("<bsdf type='normalmap'><color name='normal' value='0.8535534 0.5 0.8535534'/>"
                        "<bsdf type='diffuse'><color name='albedo' value='1 1 1'/></bsdf></bsdf>\n");
    const auto bsdf = sample.build(bsdf_types());
    const SurfacePoint at;
    const Vec3f up(0, 0, 1), right = normalize(Vec3f(1, 0, 1)), left = normalize(Vec3f(-1, 0, 0.9f));
    CHECK(bsdf->evaluate(at, up, right).f_cos.r == Approx(inv_pi));
    CHECK(bsdf->evaluate(at, up, up).f_cos.r == Approx(inv_pi * std::sqrt(0.5)));
    CHECK(bsdf->evaluate(at, up, left).f_cos.is_black());
    // Above the bent horizon, but below the surface's.
    const Vec3f under = normalize(Vec3f(1, 0, -0.5f));
    CHECK(bsdf->evaluate(at, up, under).f_cos.is_black());
    CHECK(bsdf->evaluate(at, up, under).pdf == 0.f);
    // Seen from where the bent normal turns away, it is mirrored.
    const Vec3f from_left = normalize(Vec3f(-1, 0, 0.2f));
    CHECK(bsdf->evaluate(at, from_left, normalize(Vec3f(-1, 0, 1))).f_cos.r == Approx(inv_pi));

    const auto flat = Sample("<bsdf type='normalmap'><bsdf type='diffuse'/></bsdf>\n").build(bsdf_types());
    CHECK(flat->evaluate(at, up, right).f_cos.r == Approx(0.5 * inv_pi * std::sqrt(0.5)));
}
