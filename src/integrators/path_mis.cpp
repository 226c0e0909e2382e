// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/guided_path.h"
#include "integrators/look_path.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

#include <algorithm>
#include <mutex>

namespace plumb {

/// All light, by paths that find emitters in two ways: one emitter sample at each surface, and the path itself.
///
/// Both are weighted by multiple importance sampling (Veach 1997, section 9.2), so each does what it is good at. What
/// only one of them can find (point lights; what is seen after a delta bounce) has weight 1. The integrator to
/// use when in doubt.
///
/// Caustics, which light reaches through mirrors, glass, metals and rough glass, are found in a third way. Before the first sample,
/// photons from emitters that have a size follow such bounces to the first surface that has a diffuse part; they depend on the scene
/// alone, and their number on how many pixels the image has. Where they arrive,
/// a surface also looks into directions that they came from, weighted by multiple importance sampling like the
/// others: the image converges to the same with and without. Where nothing is learnt, nothing changes.
///
/// In the same way, paths from the camera learn through which openings surfaces see an environment. In a room it is then looked
/// for there, not behind the walls.
///
/// Where the camera sees the outline of a lamp, directly, in a mirror or in a surface nearly as smooth, most of the noise is
/// whether a sample meets the lamp. There each sample looks for it with rays of its own, which are followed no further.
///
///     maxDepth    integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth     integer   bounces before Russian roulette starts   (default 1)
///     countPasses   boolean   whether passing straight through a mask costs a bounce, of shadow rays as well   (default false)
///     hideEmitters   boolean   the camera sees through surfaces that emit, and no environment; mirrors show them
///                              (default false)
///     heuristic   string    how the two share: power or balance   (default power)
///     candidates  integer   emitter samples at the first glossy surface of a path; one of them is followed, chosen by what it
///                           would add if nothing were in the way   (default 4)
///     outlineRays   integer   how many times each sample looks for a lamp where its outline is seen; half as often, or less, where a
///                           look takes many bounces; 0 or 1: not at all   (default 16)
///     guide       boolean   whether caustics are also looked for in directions learnt from photons, and environments through openings
///                           learnt from paths   (default true)
///
///         <integrator type="path_mis">
///             <string name="heuristic" value="balance"/>
///         </integrator>
class PathMis final : public Integrator, public Guided {
public:
    explicit PathMis(const Params& params)
        : outline_rays_(static_cast<int>(params.integer("outlineRays", 16, Range::closed(0, 64)))),
          estimator_(PathEstimator::LightStrategy::both, PathLimits(params), heuristic_of(params),
                     static_cast<int>(params.integer("candidates", 4, Range::closed(1, 64)))),
          may_guide_(params.boolean("guide", true) && estimator_.max_depth() != 0)
    {}

    void train(const Scene& scene, const Camera& camera, int threads) const override
    {
        if (!may_guide_) return;
        std::call_once(trained_, [&] {
            sky_ = SkyGuide::learn(scene, camera, threads);
            if (sky_.is_on()) estimator_.know_sky(&sky_);
            if (estimator_.max_depth() != 1)
                caustics_ = CausticGuide::learn(scene, photons_for(camera), threads);
            if (caustics_.is_on()) guided_.emplace(estimator_, caustics_);
        });
    }

    std::optional<GuideFacts> guide() const override
    {
        GuideFacts facts = caustics_.facts();
        facts.paths = sky_.paths();
        facts.windows = sky_.windows();
        facts.seconds += sky_.seconds();
        return facts.emitted > 0 || facts.paths > 0 ? std::optional(facts) : std::nullopt;
    }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return guided_ ? guided_->radiance(tracer, sampler, ray) : estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return estimator_.bias(); }
    bool notes_light() const override { return true; }
    int outline_rays() const override { return estimator_.hides_emitters() ? 0 : outline_rays_; }
    Color look(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return LookPath(estimator_, tracer.looks()).look(tracer, sampler, ray);
    }

private:
    static std::size_t photons_for(const Camera& camera)
    {
        const Vec2i size = camera.resolution();
        const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
        return std::clamp(pixels, CausticGuide::fewest_emitted, CausticGuide::most_emitted);
    }

    int outline_rays_;
    mutable PathEstimator estimator_;
    bool may_guide_;
    mutable std::once_flag trained_;
    // What is learnt.
    mutable SkyGuide sky_;
    mutable CausticGuide caustics_;
    mutable std::optional<GuidedPath> guided_; // where there are caustics
};

template std::unique_ptr<Integrator> build<PathMis>(const Params&);

} // namespace plumb
