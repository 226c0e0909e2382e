// SPDX-License-Identifier: MIT
#pragma once

// What a shell offers for the word that is being typed.

#include "cli/verb.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct Completion {
    std::string word;
    std::string summary; // empty: none
};

struct Completions {
    std::vector<Completion> words;
    bool files = false; // and names of files
};

// words: what stands behind the program's name, up to the word that is being typed, which may be empty. Of a shell that
// splits words at "=", too.
Completions complete(std::vector<std::string> words);

// All values that an option takes, if they are words; else empty.
std::vector<std::string> words_of_option(std::string_view long_name);

} // namespace plumb
