// SPDX-License-Identifier: MIT
#pragma once

// Differences of two images as they are, and without what noise adds.

#include "compare/estimate.h"

namespace plumb {

NonFinite count_non_finite(const Image& a, const Image& b);
Metrics measure(const Image& a, const Image& b); // without FLIP
std::optional<NoiseCorrected> correct_for_noise(const Image& a, const Image& b);

} // namespace plumb
