// SPDX-License-Identifier: MIT
#pragma once

// Parts of report.json that report.html holds, too: members of the object that is open.

#include "cli/batch/result.h"
#include "cli/json.h"

namespace plumb {

void write_summary(JsonWriter& json, const BatchRun& run);
void write_result(JsonWriter& json, const BatchResult& result);

} // namespace plumb
