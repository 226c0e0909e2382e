// SPDX-License-Identifier: MIT

// Vertices with tilted normals, roulette, and the log that `renderer replay` prints.

#include "integrators/path_estimator.h"
#include "integrators/vertex.h"
#include "support/catch.h"
#include "support/integrators.h"

#include <cstdio>
#include <cstring>

using namespace plumb;
using namespace plumb::test;

namespace {

// The sum of the contributions that a log names: "... adds (r g b)".
Color sum_of(const std::vector<PathEvent>& log)
{
    Color sum(0.f);
    for (const PathEvent& event : log) {
        const char* numbers = std::strstr(event.text.c_str(), "adds (");
        Color c;
        if (numbers && std::sscanf(numbers, "adds (%f %f %f)", &c.r, &c.g, &c.b) == 3) sum += c;
    }
    return sum;
}

bool has(const std::vector<PathEvent>& log, PathEvent::Kind kind)
{
    return std::any_of(log.begin(), log.end(), [&](const PathEvent& event) { return event.kind == kind; });
}

} // namespace

TEST_CASE("a tilted shading normal decides what is reflected, and the geometry where the next ray starts",
          "[unit][integrator]")
{
    const auto bsdf = diffuse(0.5f)();
    SurfacePoint point;
    point.position = Vec3f(0.f);
    point.clearance = 1e-6f;
    point.geometric_normal = Vec3f(0, 0, 1);
    point.shading = Frame(normalize(Vec3f(1, 0, 1)));
    point.bsdf = bsdf.get();
    const Vertex vertex(point, Vec3f(0, 0, -1));

    CHECK(vertex.evaluate(normalize(Vec3f(1, 0, 0.2f))).f_cos.r > 0.f);
    // Above the shading horizon, below the surface: the BSDF's word counts, for samples as for given directions.
    CHECK(vertex.evaluate(normalize(Vec3f(1, 0, -0.2f))).f_cos.r > 0.f);
    // Above the surface, below the shading horizon.
    CHECK(vertex.evaluate(normalize(Vec3f(-1, 0, 0.2f))).f_cos.is_black());

    TestRandom random(3);
    int below = 0;
    for (int i = 0; i < 1000; ++i) {
        const float u_lobe = random.next_1d();
        const auto sampled = vertex.sample(u_lobe, random.next_2d());
        REQUIRE(sampled);
        const Vec3f wo = vertex.to_world(*sampled);
        CHECK(vertex.evaluate(wo).pdf == Approx(sampled->pdf).epsilon(1e-4));
        CHECK((point.spawn_ray(wo).origin.z > 0.f) == (wo.z >= 0.f));
        below += wo.z < 0.f;
    }
    // Of a cosine-distributed direction, the part beyond a plane tilted by 45 degrees: (1 - cos 45) / 2.
    CHECK(below == Approx(146.4).margin(3.3 * std::sqrt(146.4 * 0.8536)));
}

TEST_CASE("roulette looks at the light that is left, not at refraction's scaling of radiance",
          "[unit][integrator]")
{
    PathLimits limits;
    limits.roulette_depth = 2;
    const PathEstimator estimator(PathEstimator::LightStrategy::path, limits);
    PathState path(Vec3f(0.f));
    const std::unique_ptr<Bsdf> bsdf = glass()();
    SurfacePoint point;
    point.position = Vec3f(0.f);
    point.bsdf = bsdf.get();
    const Vertex vertex(point, Vec3f(0, 0, -1));
    BsdfSample refraction{Vec3f(0, 0, -1), Color(1.f / 2.25f), 1.f, Lobe::delta_transmission, 1.5f};
    path.extend(vertex, refraction);
    CHECK(estimator.survival(path, 1) == 1.f);
    CHECK(estimator.survival(path, 2) == 1.f);
    CHECK(estimator.survival(path, 3) == 1.f);
    CHECK(estimator.survival(path, 128) == 1.f);
    CHECK(estimator.survival(path, 129) == 0.99f); // some day it ends
    BsdfSample absorption{Vec3f(0, 0, 1), Color(0.1f, 0.3f, 0.2f), 1.f};
    path.extend(vertex, absorption);
    CHECK(estimator.survival(path, 3) == Approx(0.3f / 0.4f));
    BsdfSample way_out{Vec3f(0, 0, 1), Color(2.25f), 1.f, Lobe::delta_transmission, 1.f / 1.5f};
    path.extend(vertex, way_out);
    CHECK(estimator.survival(path, 3) == Approx(0.3f / 0.4f));
}

TEST_CASE("the contributions in a replay's log add up to the value", "[unit][integrator]")
{
    const Scene scene =
        LittleScene()
            .room(diffuse(Color(0.8f, 0.5f, 0.3f)))
            .rectangle(Vec3f(0.f, 0.9f, 0.f), 1.f, 1.f, Vec3f(0, -1, 0), diffuse(0.5f), Color(5.f))
            .sphere(Vec3f(0.2f, -0.3f, 0.f), 0.4f, glass())
            .point_light(Vec3f(0.5f, 0.5f, 0.5f), Color(0.3f))
            .build();
    std::vector<NamedParams> integrators = path_tracers(-1);
    integrators.push_back({"direct-mis", integrator_params("direct-mis")});
    integrators.push_back({"whitted", integrator_params("whitted")});
    const auto sampler = independent_sampler();
    const Ray ray{Vec3f(0.f, 0.f, 0.9f), normalize(Vec3f(-1.f, -0.6f, -0.7f))};
    for (const NamedParams& named : integrators) {
        INFO(named.name);
        const auto integrator = make_integrator(named.params, scene);
        bool ever_bright = false;
        for (std::uint64_t i = 0; i < 50; ++i) {
            std::vector<PathEvent> log;
            Tracer logged(scene, {.log = &log}), silent(scene);
            sampler->start(7, {3, 4}, i);
            const Color value = integrator->radiance(logged, *sampler, ray);
            const Color sum = sum_of(log);
            ever_bright = ever_bright || !value.is_black();
            CHECK(sum.r == Approx(value.r).epsilon(1e-4));
            CHECK(sum.g == Approx(value.g).epsilon(1e-4));
            CHECK(sum.b == Approx(value.b).epsilon(1e-4));
            CHECK(has(log, PathEvent::Kind::hit));
            CHECK(has(log, PathEvent::Kind::end));
            // Logging changes nothing.
            sampler->start(7, {3, 4}, i);
            CHECK(integrator->radiance(silent, *sampler, ray) == value);
            CHECK(silent.counts().total() == logged.counts().total());
        }
        CHECK(ever_bright);
    }
}

TEST_CASE("a path that can no longer count is not traced", "[unit][integrator]")
{
    const Scene scene =
        LittleScene().room(diffuse(0.5f)).sphere(Vec3f(0.f), 0.2f, diffuse(0.5f), Color(1.f)).build();
    const auto rays = [&](const ParamsBuilder& params) {
        const auto integrator = make_integrator(params, scene);
        const auto sampler = independent_sampler();
        Tracer tracer(scene);
        sampler->start(1, {0, 0}, 0);
        integrator->radiance(tracer, *sampler, {Vec3f(0.5f, 0.5f, 0.5f), Vec3f(0, 1, 0)});
        return tracer.counts();
    };
    const RayCounts nee = rays(integrator_params("path_nee").integer("maxDepth", 1));
    CHECK(nee.camera == 1);
    CHECK(nee.bounce == 0);
    const RayCounts naive = rays(integrator_params("path").integer("maxDepth", 3).integer("rrDepth", 9));
    CHECK(naive.camera == 1);
    CHECK(naive.bounce <= 3);
    CHECK(naive.bounce >= 1);
    CHECK(naive.shadow == 0);
}
