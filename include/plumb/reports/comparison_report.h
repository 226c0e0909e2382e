// SPDX-License-Identifier: MIT
#pragma once

// A comparison for people, and as JSON.

#include "plumb/compare/compare.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

std::string comparison_text(const Comparison& comparison, const CompareSettings& settings);
// a, b: the names of the images; several of one side are replicas.
std::string comparison_json(const Comparison& comparison, const CompareSettings& settings,
                            const std::vector<std::string>& a, const std::vector<std::string>& b);

// "0.0123", or "< 1e-300" for what is smaller: a p-value is never 0. digits: significant ones.
std::string p_text(double p, int digits = 2);
double p_number(double p); // likewise for JSON: at least 1e-300

std::string_view verdict_word(Verdict verdict); // passes, differs, undecided
int exit_code_of(Verdict verdict);              // 0, 3 or 4

} // namespace plumb
