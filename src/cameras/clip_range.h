// SPDX-License-Identifier: MIT
#pragma once

// Between which distances a camera sees: its parameters nearClip and farClip. The camera says what they are measured along.

#include "plumb/model/params.h"

namespace plumb {

struct ClipRange {
    explicit ClipRange(const Params& params);

    float near = 0.f;
    float far = infinity;
};

} // namespace plumb
