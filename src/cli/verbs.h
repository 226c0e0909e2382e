// SPDX-License-Identifier: MIT
#pragma once

// Every verb, in one table.

#include "cli/verb.h"

#include <span>

namespace plumb {

// In the order of --help; rendering first.
std::span<const Verb* const> all_verbs();
// The verb that the words begin with; rendering if they begin with none.
const Verb& verb_of(const std::vector<std::string>& words);
// Null: there is none of that name. "render" is rendering, too.
const Verb* find_verb(std::string_view name);

// "renderer rerun IMAGE -o IMAGE [options]"
std::string command_of(const VerbHelp& verb);
// What --help prints.
std::string help_text(const Verb& verb);

// Whether nobody would call a file so: it has neither a directory nor an ending.
bool is_no_file_name(std::string_view word);

// The verb that `word` is or could be a slip of; else empty.
std::string_view closest_verb(std::string_view word);

// "unknown verb 'chek'; did you mean 'check'?"
std::string unknown_verb(std::string_view word);

} // namespace plumb
