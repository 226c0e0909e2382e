// SPDX-License-Identifier: MIT
#pragma once

// Differences of two images as they are, and without what noise adds.

#include "compare/estimate.h"

namespace plumb {

NonFinite count_non_finite(const ComparedImage& a, const ComparedImage& b);
Metrics measure(const ComparedImage& a, const ComparedImage& b); // without FLIP
std::optional<NoiseCorrected> correct_for_noise(const ComparedImage& a, const ComparedImage& b);

} // namespace plumb
