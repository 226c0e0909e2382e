// SPDX-License-Identifier: MIT
#include "cli/verbs.h"

#include "cli/commands.h"
#include "cli/manuals.h"
#include "cli/text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t any_number = 100000;

// What a verb is asked for, of what the command line says.

ReplayRequest replay_request(const Options& options)
{
    ReplayRequest request = options.replay;
    static_cast<SceneRequest&>(request) = options;
    return request;
}

RerunRequest rerun_request(const Options& options)
{
    return {options.subject, options.rerun.scene, options.outputs, options.json,
            options.threads, options.quiet,       options.verbose};
}

MergeRequest merge_request(const Options& options)
{
    return {
        options.subjects, options.outputs, options.checkpoint.file, options.json, options.merge.allow_missing,
        options.quiet};
}

TestRequest test_request(const Options& options)
{
    return {options.subjects, options.settings, options.threads, options.json, options.quiet};
}

CompareRequest compare_request(const Options& options)
{
    CompareRequest request = options.compare;
    request.a = options.subjects;
    if (request.b.empty()) {
        request.b = {request.a.back()};
        request.a.pop_back();
    }
    request.json = options.json;
    request.quiet = options.quiet;
    return request;
}

RaceRequest race_request(const Options& options)
{
    RaceRequest request = options.race;
    static_cast<SceneRequest&>(request) = options;
    request.how = options.compare.how;
    request.threads = options.threads;
    request.json = options.json;
    return request;
}

BatchRequest batch_request(const Options& options)
{
    BatchRequest request = options.batch;
    request.suite = options.subject;
    request.definitions = options.settings.scene.definitions;
    request.threads = options.threads;
    request.quiet = options.quiet;
    return request;
}

constexpr VerbRow rows[] = {
    {Verb::render, "", "SCENE [-o IMAGE]... [options]", "render an image", "scene file", 1, 1,
     [](const Options& o) { return render_command(o); }},
    {Verb::new_scene, "new", "FILE", "write a small scene to begin with", "scene file", 1, 1,
     [](const Options& o) { return new_command(o.subject, o.quiet); }, new_manual},
    {Verb::help, "help", "[VERB]", "print this help, or that of a verb", "verb", 0, 1,
     [](const Options& o) { return help_command(o.subject); }},
    {Verb::types, "types", "[NAME]", "list all types, or print a manual", "name", 0, 1,
     [](const Options& o) { return types_command(o.subject); }},
    {Verb::info, "info", "IMAGE", "print the header of an image", "image", 1, 1,
     [](const Options& o) { return info_command(o.subject); }},
    {Verb::replay, "replay", "SCENE --pixel X,Y --sample I [options]", "print the path of one sample",
     "scene file", 1, 1, [](const Options& o) { return replay_command(replay_request(o)); }},
    {Verb::rerun, "rerun", "IMAGE -o IMAGE [options]", "render an image again from its header", "image", 1, 1,
     [](const Options& o) { return rerun_command(rerun_request(o)); }, rerun_manual},
    {Verb::merge, "merge", "PART... [-o IMAGE]... [--checkpoint FILE]", "merge parts of an image", "part", 1,
     any_number, [](const Options& o) { return merge_command(merge_request(o)); }, merge_manual},
    {Verb::check, "check", "SCENE [options]", "check a scene for likely mistakes", "scene file", 1, 1,
     [](const Options& o) { return check_command(o); }, check_manual},
    {Verb::compare, "compare", "A B [options]", "are two images equal except for noise?", "image", 1,
     any_number, [](const Options& o) { return compare_command(compare_request(o)); }, compare_manual},
    {Verb::agree, "agree", "SCENE [options]", "do the estimators agree on a scene?", "scene file", 1, 1,
     [](const Options& o) { return agree_command(race_request(o)); }, agree_manual},
    {Verb::race, "race", "SCENE [options]", "which estimator is the most efficient?", "scene file", 1, 1,
     [](const Options& o) { return race_command(race_request(o)); }, race_manual},
    {Verb::test, "test", "FILE... [options]", "run a course's statistical tests", "test file", 1, any_number,
     [](const Options& o) { return test_command(test_request(o)); }, test_manual},
    {Verb::batch, "batch", "SUITE [options]", "render and compare all images of a suite", "suite", 1, 1,
     [](const Options& o) { return batch_command(batch_request(o)); }, batch_manual},
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
