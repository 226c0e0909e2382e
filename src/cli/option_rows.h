// SPDX-License-Identifier: MIT
#pragma once

// Every option, in one table: its names, its verbs, its line of --help, and what it does to Options.

#include "cli/options.h"

#include <span>

namespace plumb {

// Headings of --help, more or less.
enum class Topic { output, state, picture, scene, running, path, verdict, about };

struct OptionRow {
    Topic topic;
    unsigned verbs;    // a set of verb_bit()
    const char* names; // "-o,--output": the long one last
    const char* value; // what --help calls it; empty: takes none
    const char* help;
    void (*apply)(Options& options, std::string_view name, const std::string& value); // throws UsageError
    bool repeatable = false;

    std::string_view long_name() const;
    bool takes_value() const { return *value != '\0'; }
    bool goes_with(Verb verb) const;
    bool changes_scene() const;   // or the seed: `renderer replay` needs it too
    bool changes_picture() const; // or its file: `renderer rerun` needs it
};

// In the order of --help.
std::span<const OptionRow> option_rows();

} // namespace plumb
