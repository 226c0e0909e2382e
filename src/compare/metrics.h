// SPDX-License-Identifier: MIT
#pragma once

// Differences of two pictures as they are, and without what noise adds.

#include "compare/estimate.h"

namespace plumb {

NonFinite count_non_finite(const Picture& a, const Picture& b);
Metrics measure(const Picture& a, const Picture& b); // without FLIP
std::optional<NoiseCorrected> correct_for_noise(const Picture& a, const Picture& b);

} // namespace plumb
