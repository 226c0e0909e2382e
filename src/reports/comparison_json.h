// SPDX-License-Identifier: MIT
#pragma once

#include "base/json.h"
#include "plumb/reports/comparison_report.h"

namespace plumb {

// The members of comparison_json() but for the names of the images.
void write_comparison(JsonWriter& json, const Comparison& comparison, const CompareSettings& settings);

} // namespace plumb
