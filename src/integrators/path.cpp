// SPDX-License-Identifier: MIT

// [1] Kajiya 1986, "The Rendering Equation", section 3
// [2] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation"

#include "integrators/configured_path.h"
#include "integrators/path_estimator.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

#include <variant>

namespace plumb {

/// All light, by paths that follow the BSDFs until they meet an emitter.
///
/// At each surface a direction is sampled from the BSDF and the path continues there (Kajiya 1986, section 3), until it
/// leaves the scene or Russian roulette ends it. Every emitter that it meets counts. Point and directional lights,
/// which no path can meet, are sampled directly at each surface. Simple, correct, and slow where lights are small.
///
/// With one of the parameters of the second table it is the configurable path tracer of the McGill course instead.
/// Implicit mode counts every emitter that the path meets. Explicit mode samples all emitters at each surface, once
/// each, and counts an emitter that the path meets only if the camera sees it, directly or by delta bounces
/// (mirror, smooth glass); so it is unbiased. Delta and transmitting BSDFs choose their directions themselves,
/// whatever the warps say.
///
/// Parameters:
///
///     maxDepth            integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth             integer   bounces before roulette starts   (default 1; with termination-param 0)
///     countPasses   boolean   whether passing straight through a mask costs a bounce, of shadow rays as well   (default false)
///     hideEmitters        boolean   the camera sees through surfaces that emit, and no environment; mirrors show them   (default false)
///
/// A path of throughput t (undone what refraction does to radiance) survives roulette with probability
/// min(max(t) / 0.4, 1), and with no more than 0.99 after 128 bounces.
///
/// Parameters of the configurable path tracer:
///
///     isExplicit          boolean   sample emitters at each surface   (default false)
///     termination         string    max-depth or russian-roulette   (required)
///     termination-param   float or integer   the number of surface bounces (default 2), or the probability, in (0, 1), that a path ends at a surface (required)
///     direct-measure      string    how explicit mode samples emitters: solid-angle (spheres and rectangles only), area, hemisphere, or none   (default none: by solid angle where possible)
///     direct-warp         string    for direct-measure hemisphere: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///     indirect-measure    string    hemisphere   (default hemisphere)
///     indirect-warp       string    how the path continues: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///     nSamples            integer   accepted and not used   (default 1)
///
/// Shading normals: the interpolated normal decides what a surface does, the geometry only where the next ray starts. An
/// emitter is met on its dark side too where emitters absorb.
///
///         <integrator type="path"/>
///         <integrator type="path">
///             <boolean name="isExplicit" value="true"/>
///             <string name="termination" value="russian-roulette"/>
///             <float name="termination-param" value="0.2"/>
///             <string name="direct-measure" value="solid-angle"/>
///             <string name="indirect-warp" value="cosine-hemisphere"/>
///         </integrator>
class Path final : public Integrator {
public:
    explicit Path(const Params& params) : estimator_(estimator(params)) {}

    void prepare(const Scene& scene) override
    {
        if (const auto* configured = std::get_if<ConfiguredPath>(&estimator_)) configured->prepare(scene);
    }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return std::visit([&](const auto& estimator) { return estimator.radiance(tracer, sampler, ray); },
                          estimator_);
    }

    std::string bias() const override
    {
        return std::visit([](const auto& estimator) { return estimator.bias(); }, estimator_);
    }

    bool notes_light() const override { return true; }

private:
    using Estimator = std::variant<PathEstimator, ConfiguredPath>;

    static Estimator estimator(const Params& params)
    {
        if (ConfiguredPath::is_asked_for(params)) return ConfiguredPath(params);
        return PathEstimator(PathEstimator::LightStrategy::path, PathLimits(params));
    }

    Estimator estimator_;
};

template std::unique_ptr<Integrator> build<Path>(const Params&);

} // namespace plumb
