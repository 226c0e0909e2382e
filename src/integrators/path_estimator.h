// SPDX-License-Identifier: MIT
#pragma once

// The three classical estimators of all light that reaches the camera.

#include "integrators/direct_light.h"
#include "integrators/path_loop.h"
#include "integrators/sky_guide.h"
#include "plumb/model/integrator.h"

namespace plumb {

inline constexpr int largest_path_depth = 1'000'000'000;

// How long paths get.
struct PathLimits {
    int max_depth = -1;         // surface bounces; -1: any number
    int roulette_depth = 1;     // bounces before roulette starts
    bool count_passes = false;  // through null lobes, as bounces
    bool hide_emitters = false; // from the camera

    PathLimits() = default;
    explicit PathLimits(
        const Params& params); // the parameters maxDepth, rrDepth, countPasses and hideEmitters
};

class PathEstimator {
public:
    // Who finds the emitters: the path's own directions (and nothing is lost but speed), one emitter sample a vertex
    // (and the path counts only what no such sample could find), or both.
    enum class LightStrategy { path, emitter_samples, both };

    // candidates: with both, light samples at the first glossy vertex, of which one is followed.
    explicit PathEstimator(LightStrategy finder, PathLimits limits = {},
                           Heuristic heuristic = Heuristic::power, int candidates = 1)
        : strategy_(finder), limits_(limits), heuristic_(heuristic), candidates_(candidates)
    {}
    // Direct light only: one bounce.
    static PathEstimator direct_light(LightStrategy finder);

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const;
    std::string bias() const; // as of Integrator

    // Directions of the sky are chosen by what is learnt of it. The guide must live as long.
    void know_sky(const SkyGuide* guide) { sky_ = guide; }

    // The technique that path_loop.h asks for.
    SkyView sky_at(const Vertex& vertex) const
    {
        if (!sky_) [[likely]]
            return {};
        const LightReceiver receiver = vertex.receiver();
        return sky_->view_at(receiver.position, receiver.normal);
    }
    int max_depth() const { return limits_.max_depth; }
    bool counts_passes() const { return limits_.count_passes; }
    bool hides_emitters() const { return limits_.hide_emitters; }
    bool counts_emission(const PathState& path) const
    {
        return strategy_ != LightStrategy::emitter_samples || path.delta;
    }
    float emission_weight(const PathState& path, float light_pdf) const
    {
        return emission_weight(path, light_pdf, 1.f);
    }
    // The same of a path of look(), where there are so many of each sample. All of those that see a lamp chose their last direction at
    // the first surface that is glossy.
    float weight_of_look(const PathState& path, float light_pdf, int looks) const
    {
        return emission_weight(path, light_pdf, static_cast<float>(looks));
    }
    Color direct(Tracer& tracer, Sampler& sampler, const PathState& path, const Vertex& vertex) const;
    std::optional<BsdfSample> scatter(Sampler& sampler, const Vertex& vertex) const
    {
        const float u_lobe = sampler.next_1d();
        const Vec2f u = sampler.next_2d();
        return vertex.sample(u_lobe, u);
    }
    float survival(const PathState& path, int bounces) const;

    Heuristic heuristic() const { return heuristic_; }

private:
    float emission_weight(const PathState& path, float light_pdf, float directions) const
    {
        if (strategy_ != LightStrategy::both) return 1.f;
        const float samples = path.is_first_glossy ? static_cast<float>(candidates_) : 1.f;
        return mis_weight(heuristic_, directions * path.pdf, samples * light_pdf);
    }

    LightStrategy strategy_;
    PathLimits limits_;
    Heuristic heuristic_;
    int candidates_;
    const SkyGuide* sky_ = nullptr;
};

// An integrator that is no more than an estimator.
class EstimatorIntegrator : public Integrator {
public:
    explicit EstimatorIntegrator(const PathEstimator& estimator) : estimator_(estimator) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return estimator_.bias(); }
    bool notes_light() const override { return true; }

private:
    PathEstimator estimator_;
};

} // namespace plumb
