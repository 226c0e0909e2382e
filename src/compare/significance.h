// SPDX-License-Identifier: MIT
#pragma once

// The verdict on two noisy images: tests of pixels, of squares of 2^k pixels and of the whole.

#include "compare/estimate.h"

namespace plumb {

Significance test_significance(const ComparedImage& a, const ComparedImage& b,
                               const CompareSettings& options);

} // namespace plumb
