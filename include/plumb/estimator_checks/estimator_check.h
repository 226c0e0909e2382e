// SPDX-License-Identifier: MIT
#pragma once

// Running the tests of a test file.
//
// The p-values are those of the courses' own statistic. What differs is the policy: a test that rejects is repeated
// once with 100 times the samples and other random numbers, and that result counts. A t-test assumes a variance; with
// next-event estimation between walls that touch there is none, and it rejects right code more often than its level.

#include "plumb/test_file/test_file.h"

namespace plumb {

struct TestOptions {
    std::uint64_t seed = 0;
    int threads = 0; // 0: all
};

// One look at one quantity.
struct TestRun {
    std::uint64_t samples = 0;
    double mean = 0.0;      // of the luminance (ttest)
    double variance = 0.0;  // of one sample of it
    double statistic = 0.0; // t or chi-square
    double degrees_of_freedom = 0.0;
    double p = 0.0;
    std::string problem; // why p is 0 without a look at the statistic; empty if it is not
};

struct TestResult {
    std::string name;          // what was tested
    double reference = 0.0;    // ttest
    double level = 0.0;        // p below it: rejected
    std::vector<TestRun> runs; // one, or two if the first one rejected
    bool passed() const { return runs.back().p >= level; }
};

// The level of each test, by Sidak's correction.
double test_level(const TestFile& file);

// In the order of the file. Results depend on the file and the seed, not on threads. each: called after each test.
std::vector<TestResult> run_tests(const TestFile& file, const TestOptions& options,
                                  const std::function<void(const TestResult&)>& each = {});

} // namespace plumb
