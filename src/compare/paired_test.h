// SPDX-License-Identifier: MIT
#pragma once

// The verdict where an image has no error bars: tests of the differences d = a - b in squares and in the whole.
// Numbers of papers: see plumb/compare/compare.h. Why it is made so: docs/comparing.md.

#include "compare/estimate.h"

namespace plumb {

// At most one of the images knows its noise.
Significance test_paired(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options);

} // namespace plumb
