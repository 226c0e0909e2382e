// SPDX-License-Identifier: MIT
#include "base/terminal_text.h"
#include "cli/console.h"
#include "cli/verb_file.h"
#include "cli/verbs.h"
#include "reports/exit_codes.h"

#include "plumb/scene_file/scene_file.h"

#include <algorithm>

namespace plumb {

namespace {

int run(const VerbOptions& options)
{
    const std::string word = options.subjects.empty() ? "" : options.subject();
    const Verb* asked = find_verb(word);
    if (!asked) {
        const auto& types = known_types();
        const bool is_type =
            std::any_of(types.begin(), types.end(), [&](const TypeInfo& type) { return type.name == word; });
        throw UsageError(
            is_type ? fmt::format("'{0}' is not a verb; 'renderer types {0}' prints its manual", word)
                    : unknown_verb(word));
    }
    print_output(rewrapped(help_text(*asked), output_columns()));
    return exit_code::done;
}

} // namespace

struct HelpVerb {
    static Verb make()
    {
        return make_verb<VerbOptions>({"help", "[VERB]", "print this help, or that of a verb", "verb", 0, 1},
                                      help_option<VerbOptions>(), run);
    }
};
template const Verb& verb<HelpVerb>();

} // namespace plumb
