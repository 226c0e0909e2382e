// SPDX-License-Identifier: MIT
#pragma once

// What became of a suite, for people and for other programs.

#include "plumb/experiments/suite_run.h"

#include <string>
#include <string_view>

namespace plumb {

// 1: an image could not be rendered or compared; else 3: one differs; else 4: one is undecided; else 0. 128 and the number of
// the signal that interrupted it.
int exit_code_of(const SuiteRun& run);

// The verdict, or how far it came: passes, differs, not run, ...
std::string_view result_word(const SuiteResult& result);
// One line: why the verdict is not "passes".
std::string reason_text(const SuiteResult& result);
std::string stale_text(const SuiteResult& result); // one line; empty: the reference is not stale
std::string summary_text(const SuiteRun& run);     // "3 pass, 1 differs; 2 were up to date"

// The order of reports: errors, differences, what is undecided, and the rest.
std::vector<const SuiteResult*> failures_first(const SuiteRun& run);

// A line of a table.
std::string result_line(const SuiteResult& result, std::size_t title_width);

// What report.html shows: kept of each image while the suite runs.
class ShownImages {
public:
    // Of so many, references included: the more there are, the smaller they are shown.
    explicit ShownImages(std::size_t count);
    void add(const SuiteResult& result, const SuiteImages& images);

    struct Shown {
        int width = 0;
        int height = 0;
        int reduction = 1;
        std::string image, reference; // of image_data.h; empty: none
    };
    const Shown* find(const std::string& title) const;

private:
    std::size_t count_;
    std::map<std::string, Shown> shown_; // by title
};

// The whole reports.
std::string suite_json(const SuiteRun& run);
std::string suite_junit(const SuiteRun& run);
std::string suite_markdown(const SuiteRun& run);
// history: of earlier runs and this one, a line of JSON each.
std::string suite_html(const SuiteRun& run, const ShownImages& images,
                       const std::vector<std::string>& history = {});

// All of them, as report.json, junit.xml, summary.md and report.html; and history.json, with this run added. Throws Error.
void write_suite_reports(const SuiteRun& run, const ShownImages& images,
                         const std::filesystem::path& directory);
// Makes the directory, and touches no file in it. Throws Error if one of them cannot be written.
void check_suite_reports(const std::filesystem::path& directory);

} // namespace plumb
