// SPDX-License-Identifier: MIT
#pragma once

// Parts of report.json that report.html holds, too: members of the object that is open.

#include "base/json.h"
#include "plumb/reports/suite_report.h"

namespace plumb {

void write_summary(JsonWriter& json, const SuiteRun& run);
void write_result(JsonWriter& json, const SuiteResult& result);

} // namespace plumb
