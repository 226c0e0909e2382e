// SPDX-License-Identifier: MIT
#pragma once

// Every option, in one table: its names, its verbs, its line of --help, and what it does to Options. Those of settings
// are made of the settings' tables (settings.h).

#include "cli/options.h"

#include <functional>
#include <span>

namespace plumb {

// Headings of --help, more or less.
enum class Topic { output, state, picture, scene, running, path, verdict, about };

struct OptionRow {
    Topic topic;
    unsigned verbs;    // a set of verb_bit()
    std::string names; // "-o,--output": the long one last
    std::string value; // what --help calls it; empty: takes none
    std::string help;
    // Throws Error or UsageError. The value of a switch is "true".
    std::function<void(Options& options, std::string_view name, const std::string& value)> apply;
    bool repeatable = false;

    std::string_view long_name() const;
    bool takes_value() const { return !value.empty(); }
    bool goes_with(Verb verb) const;
};

// In the order of --help.
std::span<const OptionRow> option_rows();

} // namespace plumb
