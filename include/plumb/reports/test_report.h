// SPDX-License-Identifier: MIT
#pragma once

// How the tests of test files went, for people and as JSON.

#include "plumb/estimator_checks/estimator_check.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// A file, and how its tests went.
struct TestReport {
    std::string path;
    TestFile file;
    std::vector<TestResult> results;

    std::size_t passed() const;
};

std::string_view type_name(TestType type);                        // "ttest"
std::string result_text(const TestResult& result, TestType type); // a line or two
std::string test_json(const std::vector<TestReport>& reports, std::uint64_t seed);

} // namespace plumb
