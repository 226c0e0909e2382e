// SPDX-License-Identifier: MIT
#pragma once

// The verdict on two noisy pictures: tests of pixels, of squares of 2^k pixels and of the whole.

#include "compare/estimate.h"

namespace plumb {

Significance test_significance(const Picture& a, const Picture& b, const CompareSettings& options);

} // namespace plumb
