// SPDX-License-Identifier: MIT
#pragma once

// How much of the light a conductor reflects, as the constructors of BSDFs read it.

#include "plumb/model/params.h"
#include "plumb/model/texture.h"

namespace plumb {

// The exact Fresnel equations for a complex index of refraction, given by the name of a material or as textures.
class ConductorFresnel {
public:
    explicit ConductorFresnel(const Params& params);

    // Whether any of the parameters that ask for the exact equations is given.
    bool is_asked_for() const { return is_asked_for_; }

    // cos_i: between the direction and the normal, not negative.
    Color reflectance(const SurfacePoint& at, float cos_i) const;
    Color scale(const SurfacePoint& at) const
    {
        return scale_->color(at);
    } // of reflectance, which has it already

private:
    std::shared_ptr<const ColorTexture> eta_;
    std::shared_ptr<const ColorTexture> k_;
    std::shared_ptr<const ColorTexture> scale_;
    float exterior_ = 1.f;
    bool is_asked_for_ = false;
};

} // namespace plumb
