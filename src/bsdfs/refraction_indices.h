// SPDX-License-Identifier: MIT
#pragma once

// The indices of refraction of dielectric BSDFs, as their constructors read them.

#include "plumb/model/params.h"

namespace plumb {

struct RefractionIndices {
    float interior;
    float exterior; // the side that the normal points to

    explicit RefractionIndices(const Params& params)
        : interior(params.number("intIOR", 1.5046f, Range::closed(0.01, 100.0))),  // borosilicate glass
          exterior(params.number("extIOR", 1.000277f, Range::closed(0.01, 100.0))) // air
    {}

    float eta() const { return interior / exterior; }
};

} // namespace plumb
