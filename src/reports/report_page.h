// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace plumb {

// The text of report.html. {{title}}, {{data}} and {{images}} stand for what a run puts there.
extern const std::string_view report_page;

} // namespace plumb
