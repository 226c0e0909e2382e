// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/man_page.h"
#include "cli/usage_error.h"
#include "cli/verb_file.h"
#include "cli/verbs.h"
#include "reports/exit_codes.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    bool list = false;
};

int run(const Options& options)
{
    if (options.list) {
        for (const Verb* one : all_verbs()) print_output(man_name(*one) + "\n");
        return exit_code::done;
    }
    std::string word = options.subjects.empty() ? "render" : options.subject();
    if (word == "renderer") word = "render";
    if (word.starts_with("renderer-")) word.erase(0, std::string_view("renderer-").size());
    const Verb* asked = find_verb(word);
    if (!asked) throw UsageError(unknown_verb(word));
    print_output(man_page(*asked));
    return exit_code::done;
}

} // namespace

struct ManVerb {
    static Verb make()
    {
        return make_verb<Options>(
            {"man", "[VERB]", "print the manual page of a verb", "verb", 0, 1,
             "Prints a page for man(1), which `cmake --install` also installs:\n"
             "\n"
             "    renderer man compare | man -l -\n"},
            join<Options>({switch_option<Options>(Topic::output, "--list", "print the names of all pages",
                                                  &Options::list),
                           help_option<Options>()}),
            run);
    }
};
template const Verb& verb<ManVerb>();

} // namespace plumb
