// SPDX-License-Identifier: MIT
#pragma once

// The interface of reconstruction filters.

#include "plumb/math/math.h"

namespace plumb {

// Where inside the filter's support a sample is taken, relative to the pixel's centre, and what it counts.
// The offset has a density proportional to |f|; so weight is f / (pdf * integral of f): +-(integral of |f|) /
// (integral of f), which is exactly 1 for filters without negative lobes.
struct FilterSample {
    Vec2f offset;
    float weight;
};

// Filter importance sampling (Ernst, Stamminger and Greiner 2006): a sample adds to its own pixel only.
// Conventions. Offsets in pixels. Filters are separable and even.
class Filter {
public:
    virtual ~Filter() = default;
    virtual float radius() const = 0;
    virtual float evaluate(const Vec2f& offset) const = 0; // not normalised; 0 beyond the radius
    virtual FilterSample sample(const Vec2f& u) const = 0;
};

} // namespace plumb
