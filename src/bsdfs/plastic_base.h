// SPDX-License-Identifier: MIT
#pragma once

// The diffuse base of a plastic: light that enters through the coat, is scattered below it and leaves again.

#include "bsdfs/refraction_indices.h"
#include "plumb/model/params.h"
#include "plumb/model/texture.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

// Parameters intIOR, extIOR, diffuseReflectance, specularReflectance and nonlinear.
class PlasticBase {
public:
    explicit PlasticBase(const Params& params)
        : eta_(RefractionIndices(params, RefractionIndices::polypropylene).eta()),
          diffuse_(params.color_texture("diffuseReflectance", Color(0.5f), Range::closed(0.0, 1.0))),
          specular_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0))),
          nonlinear_(params.boolean("nonlinear", false))
    {}

    float eta() const { return eta_; }
    Color specular(const SurfacePoint& at) const { return specular_->color(at); }

    // The base's f times cos_o, where the fractions enter and leave of light pass the coat at wi and at wo, and the coat
    // reflects the mean fraction `inside` of the light back down. Each time it meets the base again: in `nonlinear` plastics
    // with its colour each time, else with its colour once.
    Color f_cos(const SurfacePoint& at, float enter, float leave, float inside, float cos_o) const
    {
        const Color rho = diffuse_->color(at);
        const auto channel = [&](float r) {
            return r / (1.f - (nonlinear_ ? r : 1.f) * inside) * (enter * leave * cos_o * inv_pi / sqr(eta_));
        };
        return {channel(rho.r), channel(rho.g), channel(rho.b)};
    }

    // With which probability a sample is of the coat, which reflects the fraction `reflected`: by what both reflect, but
    // neither is starved.
    float coat_chance(const SurfacePoint& at, float reflected) const
    {
        const float coat = luminance(specular_->color(at)) * reflected;
        const float base = luminance(diffuse_->color(at)) * (1.f - reflected);
        if (!(coat > 0.f)) return 0.f;
        return base > 0.f ? std::clamp(coat / (coat + base), 0.1f, 0.9f) : 1.f;
    }

private:
    float eta_; // interior / exterior
    std::shared_ptr<const ColorTexture> diffuse_;
    std::shared_ptr<const ColorTexture> specular_;
    bool nonlinear_;
};

} // namespace plumb
