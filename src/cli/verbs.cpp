// SPDX-License-Identifier: MIT
#include "cli/verbs.h"

#include "cli/commands.h"
#include "cli/manuals.h"
#include "cli/text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t any_number = 100000;

constexpr VerbRow rows[] = {
    {Verb::render, "", "SCENE [-o IMAGE]... [options]", "render an image", "scene file", 1, 1,
     render_command},
    {Verb::new_scene, "new", "FILE", "write a small scene to begin with", "scene file", 1, 1, new_command,
     new_manual},
    {Verb::help, "help", "[VERB]", "print this help, or that of a verb", "verb", 0, 1, help_command},
    {Verb::types, "types", "[NAME]", "list all types, or print a manual", "name", 0, 1, types_command},
    {Verb::info, "info", "IMAGE", "print the header of an image", "image", 1, 1, info_command},
    {Verb::replay, "replay", "SCENE --pixel X,Y --sample I [options]", "print the path of one sample",
     "scene file", 1, 1, replay_command},
    {Verb::rerun, "rerun", "IMAGE -o IMAGE [options]", "render an image again from its header", "image", 1, 1,
     rerun_command, rerun_manual},
    {Verb::merge, "merge", "PART... [-o IMAGE]... [--checkpoint FILE]", "merge parts of an image", "part", 1,
     any_number, merge_command, merge_manual},
    {Verb::check, "check", "SCENE [options]", "check a scene for likely mistakes", "scene file", 1, 1,
     check_command, check_manual},
    {Verb::compare, "compare", "A B [options]", "are two images equal except for noise?", "image", 2, 2,
     compare_command, compare_manual},
    {Verb::agree, "agree", "SCENE [options]", "do the estimators agree on a scene?", "scene file", 1, 1,
     agree_command, agree_manual},
    {Verb::race, "race", "SCENE [options]", "which estimator is the most efficient?", "scene file", 1, 1,
     race_command, race_manual},
    {Verb::test, "test", "FILE... [options]", "run a course's statistical tests", "test file", 1, any_number,
     test_command, test_manual},
    {Verb::batch, "batch", "SUITE [options]", "render and compare all images of a suite", "suite", 1, 1,
     batch_command, batch_manual},
};

} // namespace

std::string VerbRow::command() const
{
    return fmt::format("renderer {}{}{}", name, name.empty() ? "" : " ", arguments);
}

std::span<const VerbRow> verb_rows()
{
    return rows;
}

const VerbRow& row_of(Verb verb)
{
    for (const VerbRow& row : rows)
        if (row.verb == verb) return row;
    return rows[0];
}

bool is_no_file_name(std::string_view word)
{
    return word.find_first_of("./") == word.npos;
}

std::string unknown_verb(std::string_view word)
{
    const std::string_view verb = closest_verb(word);
    return verb.empty() ? fmt::format("unknown verb '{}'; 'renderer --help' lists the verbs", word)
                        : fmt::format("unknown verb '{}'; did you mean '{}'?", word, verb);
}

std::string_view closest_verb(std::string_view word)
{
    std::vector<std::string_view> names;
    for (const VerbRow& row : rows)
        if (!row.name.empty()) names.push_back(row.name);
    return closest_name(word, names);
}

} // namespace plumb
