// SPDX-License-Identifier: MIT
#pragma once

// Every option, in one table: its names, its verbs, its line of --help, and what it does to Options.

#include "cli/options.h"

#include <span>

namespace plumb {

// Headings of --help, more or less.
enum class Topic { output, state, picture, scene, running, path, verdict, about };

// What an option does to a picture. A picture's header keeps the words that change it, and nothing else is taken from a
// header, which anybody may have written: whoever adds an option decides.
enum class Effect {
    undecided, // of no option
    samples,   // changes the scene, the seed or the samples: `renderer replay` needs it, too
    picture,   // changes which samples are taken, or how the file keeps them
    run        // names files to write, or is about this run alone
};

struct OptionRow {
    Topic topic;
    Effect effect;
    unsigned verbs;    // a set of verb_bit()
    const char* names; // "-o,--output": the long one last
    const char* value; // what --help calls it; empty: takes none
    const char* help;
    void (*apply)(Options& options, std::string_view name, const std::string& value); // throws UsageError
    bool repeatable = false;

    std::string_view long_name() const;
    bool takes_value() const { return *value != '\0'; }
    bool goes_with(Verb verb) const;
    bool changes_samples() const { return effect == Effect::samples; }
    bool changes_picture() const { return effect == Effect::samples || effect == Effect::picture; }
};

// In the order of --help.
std::span<const OptionRow> option_rows();

} // namespace plumb
