// SPDX-License-Identifier: MIT
#include "cameras/clip_range.h"

namespace plumb {

ClipRange::ClipRange(const Params& params)
{
    if (params.has("nearClip")) near = params.number("nearClip", 0.f, Range::at_least(0.0));
    if (params.has("farClip")) far = params.number("farClip", infinity, Range::positive());
    if (!(near < far)) params.fail("nearClip", "must be less than farClip");
}

} // namespace plumb
