// SPDX-License-Identifier: MIT
#pragma once

// The indices of refraction of dielectric BSDFs, as their constructors read them.

#include "plumb/model/params.h"

namespace plumb {

struct RefractionIndices {
    float interior;
    float exterior; // the side that the normal points to

    static constexpr float borosilicate_glass = 1.5046f;
    static constexpr float polypropylene = 1.49f;

    explicit RefractionIndices(const Params& params, float default_interior = borosilicate_glass)
        : interior(params.number("intIOR", default_interior, Range::closed(0.01, 100.0))),
          exterior(params.number("extIOR", 1.000277f, Range::closed(0.01, 100.0))) // air
    {}

    float eta() const { return interior / exterior; }
};

} // namespace plumb
