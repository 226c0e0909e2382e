// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/verbs.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

int help_command(const std::string& word)
{
    const auto rows = verb_rows();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const VerbRow& verb) {
        return verb.name == word || (verb.verb == Verb::render && word == "render"); // it has no name
    });
    if (row == rows.end()) {
        const auto& types = known_types();
        const bool is_type =
            std::any_of(types.begin(), types.end(), [&](const TypeInfo& type) { return type.name == word; });
        throw UsageError(
            is_type ? fmt::format("'{0}' is not a verb; 'renderer types {0}' prints its manual", word)
                    : unknown_verb(word));
    }
    print_output(help_text(row->verb));
    return exit_code::done;
}

} // namespace plumb
