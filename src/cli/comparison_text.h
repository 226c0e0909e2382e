// SPDX-License-Identifier: MIT
#pragma once

// A comparison for people, and as JSON.

#include "cli/json.h"

#include "plumb/compare/compare.h"

#include <string>

namespace plumb {

std::string comparison_text(const Comparison& comparison, const CompareSettings& options);
std::string comparison_json(const Comparison& comparison, const CompareSettings& options,
                            const std::vector<std::string>& a, const std::vector<std::string>& b);

// The members of comparison_json() but for the names of the pictures.
void write_comparison(JsonWriter& json, const Comparison& comparison, const CompareSettings& options);

// "0.0123", or "< 1e-300" for what is smaller: a p-value is never 0. digits: significant ones.
std::string p_text(double p, int digits = 2);

std::string_view outcome_word(CompareOutcome outcome); // passes, differs, undecided
int exit_code_of(CompareOutcome outcome);

} // namespace plumb
