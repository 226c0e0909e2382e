// SPDX-License-Identifier: MIT
#pragma once

// One of several ways to find the light that reaches a vertex straight from emitters, named by parameters.

#include "integrators/direct_light.h"
#include "integrators/hemisphere_warp.h"

#include <functional>

namespace plumb {

class DirectTechnique {
public:
    enum class Kind { best, area, solid_angle, hemisphere, bsdf };

    // The arguments name the parameters; fallback: what an absent measure means.
    DirectTechnique(const Params& params, const char* measure, const char* samples, const char* warp,
                    Kind fallback);
    void prepare(const Scene& scene) const; // throws Error if the technique does not suit the scene's lights

    Kind kind() const { return kind_; }
    int samples() const { return samples_; }

    // All direct light, estimated by one sample: every emitter's, or one direction's.
    Color estimate(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const;

    // What light one sample found, for weighting by hand: f_cos times radiance, with the densities per unit solid
    // angle of this technique and of another. Lights that only emitter sampling can find are left out.
    struct Found {
        Color light;
        float pdf = 0.f;
        float other_pdf = 0.f;
        FoundBy by = FoundBy::direction;
        std::uint32_t emitter = 0; // as of LightNote
    };
    // Several only where light passes straight through an emitter.
    using Take = std::function<void(const Found&)>;
    void find(Tracer& tracer, Sampler& sampler, const Vertex& vertex, const DirectTechnique& other,
              const Take& take) const;

private:
    bool samples_emitters() const { return kind_ != Kind::hemisphere && kind_ != Kind::bsdf; }
    Measure measure() const;
    std::optional<BsdfSample> direction(Sampler& sampler, const Vertex& vertex) const;
    // The density with which this technique would have found the point (null: the environment) along wo.
    float density(const Scene& scene, const Vertex& vertex, const Vec3f& wo_world, const BsdfValue& value,
                  const SurfacePoint* hit) const;
    void find_by_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex, const DirectTechnique& other,
                         const Take& take) const;

    const char* parameter_;
    Kind kind_;
    HemisphereWarp warp_;
    int samples_;
};

} // namespace plumb
