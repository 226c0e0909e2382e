// SPDX-License-Identifier: MIT
#pragma once

// What became of the entries of a suite: what the console and all reports are made from.

#include "cli/batch/plan.h"

#include "plumb/compare/compare.h"

namespace plumb {

// In the order of getting worse, but for not_run.
enum class BatchVerdict {
    not_run,  // after --fail-fast or a signal
    made,     // a reference
    rendered, // there is nothing to compare it with
    passes,
    undecided, // never agreement
    differs,
    error, // could not be rendered or compared
};

struct BatchResult {
    std::string title; // with the sample count, where it is known
    std::string scene;
    std::string command; // that renders the picture by hand
    std::string picture; // .exr; empty: there is none
    std::string screen_picture;
    std::string reference;  // empty: none
    std::string difference; // the picture of it; empty: none
    BatchVerdict verdict = BatchVerdict::not_run;
    bool up_to_date = false; // not rendered again
    double seconds = 0.0;    // for all of it
    int signal = 0;          // that ended the rendering; 0: none
    std::string problem;     // of an error: the text of all that is wrong
    std::vector<std::string> warnings;
    std::optional<double> noise; // the root mean squared error that the picture's own noise makes expect
    std::string biases;          // empty: none
    std::uint64_t left_out = 0;
    std::optional<Comparison> comparison;
    CompareSettings how;
};

struct BatchRun {
    std::string suite;
    std::string directory;
    std::vector<BatchResult> results;
    double seconds = 0.0;
    int signal = 0; // that ended it; 0: none

    std::size_t count(BatchVerdict verdict) const;
    int exit_code() const;
};

std::string_view verdict_word(BatchVerdict verdict); // passes, differs, not run, ...
// One line: why the verdict is not "passes".
std::string reason_text(const BatchResult& result);
std::string summary_text(const BatchRun& run); // "3 pass, 1 differs; 2 were up to date"

// A line of the table on the console.
std::string result_line(const BatchResult& result, std::size_t title_width);

// The whole reports.
std::string batch_json(const BatchRun& run);
std::string batch_junit(const BatchRun& run);
std::string batch_markdown(const BatchRun& run);
std::string batch_html(const BatchRun& run);

} // namespace plumb
