// SPDX-License-Identifier: MIT
#pragma once

// Which test the noise of two images allows, and what it finds.

#include "compare/estimate.h"

namespace plumb {

std::uint64_t tolerated_pixels(const ComparedImage& a, const CompareSettings& options);
Significance find_significance(const ComparedImage& a, const ComparedImage& b,
                               const CompareSettings& options);

} // namespace plumb
