// SPDX-License-Identifier: MIT
#pragma once

// How much light the microfacets of a rough dielectric boundary let in and keep inside.

#include "bsdfs/microfacet_distribution.h"

#include <array>

namespace plumb {

// What the microfacets refract from the outside, with the shadowing of the refracted light. Integrated by midpoints over the
// square that visible normals are sampled from, for 64 directions whose cosines are equally spaced from 0 to 1, and linear
// between them, which Mitsuba 3 also does.
class RoughTransmittance {
public:
    RoughTransmittance(const MicrofacetDistribution& microfacets, float eta); // eta: interior / exterior

    float at(float cosine) const; // in [0, 1]

private:
    std::array<float, 64> values_{};
};

// What they reflect from the inside, with the shadowing of the reflected light: twice the mean of reflectance times cosine
// over the same 64 directions. That is about 1 % below the integral, and makes plastics as bright as Mitsuba's.
float mean_inside_reflectance(const MicrofacetDistribution& microfacets, float eta);

} // namespace plumb
