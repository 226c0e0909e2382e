// SPDX-License-Identifier: MIT
#pragma once

// A comparison for people, and as JSON.

#include "plumb/compare/compare.h"

#include <string>
#include <string_view>

namespace plumb {

std::string comparison_text(const Comparison& comparison, const CompareSettings& settings);
// a, b: the names of the pictures.
std::string comparison_json(const Comparison& comparison, const CompareSettings& settings,
                            const std::string& a, const std::string& b);

std::string_view outcome_word(CompareOutcome outcome); // passes, differs, undecided
int exit_code_of(CompareOutcome outcome);              // 0, 3 or 4

} // namespace plumb
