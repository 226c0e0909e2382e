// SPDX-License-Identifier: MIT

#include "support/integrators.h"

#include "plumb/model/camera.h"
#include "plumb/model/guide.h"
#include "plumb/sampling/sampling.h"
#include "plumb/scene/scene.h"
#include "scene_file/catalog.h"

#include <stdexcept>

namespace plumb::test {
namespace {

using BuildIntegrator = decltype(Entry<Integrator>::build);

BuildIntegrator builder_of(std::string_view type)
{
    for (const Entry<Integrator>& entry : integrator_types())
        if (entry.name == type) return entry.build;
    throw std::logic_error("no integrator '" + std::string(type) + "'");
}

class CameraWithin final : public Camera {
public:
    explicit CameraWithin(const Scene& scene) : bounds_(scene.bounds()) {}

    CameraRay sample_ray(const Vec2f& raster, const Vec2f&) const override
    {
        const Vec3f origin = bounds_.isEmpty() ? Vec3f(0.f) : bounds_.center();
        return {Ray(origin, square_to_uniform_sphere(raster)), Color(1.f)};
    }
    Vec2i resolution() const override { return {1, 1}; }
    const Transform& to_world() const override { return to_world_; }

private:
    Box3f bounds_;
    Transform to_world_;
};

constexpr const char* warps[] = {"cosine-hemisphere", "uniform-hemisphere"};

} // namespace

std::unique_ptr<Integrator> make_integrator(const ParamsBuilder& params, const Scene& scene)
{
    auto integrator = params.build_with(builder_of(params.type()));
    integrator->prepare(scene);
    train(*integrator, scene, *camera_within(scene), 1);
    return integrator;
}

std::unique_ptr<Camera> camera_within(const Scene& scene)
{
    return std::make_unique<CameraWithin>(scene);
}

std::vector<std::string> integrator_complaints(const ParamsBuilder& params)
{
    std::vector<Diagnostic> found;
    params.build_with(builder_of(params.type()), found);
    std::vector<std::string> messages;
    for (const Diagnostic& diagnostic : found)
        messages.push_back((diagnostic.severity == Severity::error ? "error: " : "warning: ") +
                           diagnostic.message);
    return messages;
}

ParamsBuilder configured_path(bool is_explicit, const std::string& termination, double termination_param)
{
    return integrator_params("path")
        .boolean("isExplicit", is_explicit)
        .string("termination", termination)
        .number("termination-param", termination_param);
}

std::vector<NamedParams> path_tracers(int max_depth, bool with_area)
{
    std::vector<NamedParams> result;
    const auto add = [&](const std::string& name, ParamsBuilder params) {
        result.push_back({name, params.integer("maxDepth", max_depth)});
    };
    const auto configured = [&](bool is_explicit) {
        return max_depth < 0 ? configured_path(is_explicit, "russian-roulette", 0.2)
                             : configured_path(is_explicit, "max-depth", max_depth);
    };
    add("path", integrator_params("path"));
    add("path_mats from the first bounce", integrator_params("path_mats").integer("rrDepth", 0));
    add("path_mis", integrator_params("path_mis"));
    add("path_mis, balance",
        integrator_params("path_mis").string("heuristic", "balance").integer("rrDepth", 1));
    add("path_mis without a guide", integrator_params("path_mis").boolean("guide", false));
    for (const std::string warp : warps) {
        add("implicit, " + warp, configured(false).string("indirect-warp", warp));
        add("explicit by hemisphere, " + warp, configured(true)
                                                   .string("indirect-warp", warp)
                                                   .string("direct-measure", "hemisphere")
                                                   .string("direct-warp", warp));
    }
    if (!with_area) return result;
    add("path_nee", integrator_params("path_nee").integer("rrDepth", 2));
    add("explicit by area",
        configured(true).string("direct-measure", "area").string("indirect-warp", "cosine-hemisphere"));
    return result;
}

std::vector<NamedParams> direct_light_integrators()
{
    std::vector<NamedParams> result;
    for (const char* type : {"direct", "direct_ems", "direct_mats", "direct_mis", "direct_whitted"})
        result.push_back({type, integrator_params(type)});
    const std::vector<std::string> measures{"area", "hemisphere", "bsdf", "solid-angle"};
    for (const std::string& measure : measures) {
        result.push_back({"direct by " + measure,
                          integrator_params("direct").string("measure", measure).integer("nSamples", 2)});
        for (const std::string& other : measures) {
            if (measure == other) continue;
            // Each order of the two has parameters of its own.
            const bool sorted = measure < other;
            result.push_back({"direct-mis by " + measure + " and " + other,
                              integrator_params("direct-mis")
                                  .string("measure1", measure)
                                  .string("measure2", other)
                                  .integer(sorted ? "nSamples1" : "nSamples2", sorted ? 2 : 3)
                                  .string(sorted ? "warp-type2" : "warp-type1", "uniform-hemisphere")
                                  .string("heuristic", sorted ? "power" : "balance")});
        }
    }
    result.push_back({"direct by uniform hemisphere", integrator_params("direct")
                                                          .string("measure", "hemisphere")
                                                          .string("warp-type", "uniform-hemisphere")});
    result.push_back({"path_nee of one bounce", integrator_params("path_nee").integer("maxDepth", 1)});
    result.push_back({"explicit path of one bounce, by solid angle",
                      configured_path(true, "max-depth", 1).string("direct-measure", "solid-angle")});
    return result;
}

} // namespace plumb::test
