// SPDX-License-Identifier: MIT
#pragma once

// Every verb, in one table.

#include "cli/options.h"

#include <span>

namespace plumb {

struct VerbRow {
    Verb verb;
    std::string_view name;      // empty: rendering
    std::string_view arguments; // "IMAGE -o IMAGE [options]"
    std::string_view summary;   // a line of --help
    std::string_view subject;   // what its words are, for messages: "scene file"
    std::size_t min_subjects;
    std::size_t max_subjects;
    int (*run)(const Options&);
    std::string_view (*manual)() = nullptr; // what its own --help prints below the usage

    std::string command() const; // "renderer rerun IMAGE -o IMAGE [options]"
};

// In the order of --help; rendering first.
std::span<const VerbRow> verb_rows();
const VerbRow& row_of(Verb verb);

// Whether nobody would call a file so: it has neither a directory nor an ending.
bool is_no_file_name(std::string_view word);

// The verb that `word` is or could be a slip of; else empty.
std::string_view closest_verb(std::string_view word);

// "unknown verb 'chek'; did you mean 'check'?"
std::string unknown_verb(std::string_view word);

} // namespace plumb
