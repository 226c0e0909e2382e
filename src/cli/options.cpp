// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include "cli/option_rows.h"
#include "cli/text.h"
#include "cli/verbs.h"
#include "plumb/base/error.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string_view name_of(Verb verb)
{
    return verb == Verb::render ? "rendering" : row_of(verb).name;
}

// What other renderers call our options, where the spelling is too far off to guess.
constexpr std::pair<std::string_view, std::string_view> foreign_names[] = {
    {"--outfile", "--output"},   {"-out", "--output"},        {"--output-file", "--output"},
    {"--samples", "--spp"},      {"--cropwindow", "--crop"},  {"--pixelbounds", "--crop"},
    {"--width", "--size"},       {"--height", "--size"},      {"--resolution", "--size"},
    {"--nthreads", "--threads"}, {"--scene_var", "--define"}, {"--debugstart", "replay"},
};

[[noreturn]] void reject_option(Verb verb, std::string_view word)
{
    const std::string_view name = word.substr(0, word.find('='));
    if (name == "--no-gui") throw UsageError("Plumb has no window; omit '--no-gui'");
    std::vector<std::string_view> known;
    for (const OptionRow& row : option_rows()) {
        for (std::string_view names = row.names; !names.empty();) {
            const std::size_t comma = std::min(names.find(','), names.size());
            const std::string_view one = names.substr(0, comma);
            names.remove_prefix(std::min(comma + 1, names.size()));
            if (one == name)
                throw UsageError(fmt::format("option '{}' cannot be used with {}", name, name_of(verb)));
            if (row.goes_with(verb)) known.push_back(one);
        }
    }
    std::string_view near = closest_name(name, known);
    for (const auto& [foreign, ours] : foreign_names)
        if (foreign == name) near = ours;
    throw UsageError(near.empty()
                         ? fmt::format("unknown option '{}'; 'renderer --help' lists the options", name)
                         : fmt::format("unknown option '{}'; did you mean '{}'?", name, near));
}

// Words that look like options and are none of ours, and words of which there are too many.
// first: of all words.
void reject_words(const Options& options, const std::string& first, const std::vector<std::string>& remaining)
{
    const VerbRow& verb = row_of(options.verb);
    const bool has_more = !remaining.empty() || options.subjects.size() > verb.max_subjects;
    if (options.verb == Verb::render && has_more && options.subject == first && is_no_file_name(first) &&
        (options.subjects.size() > 1 || !closest_verb(first).empty()))
        throw UsageError(unknown_verb(first));
    for (const std::string& word : remaining)
        if (word.size() > 1 && word.front() == '-' && word != "--") reject_option(options.verb, word);
    if (options.subjects.size() <= verb.max_subjects) return;
    const std::string& word = options.subjects[verb.max_subjects];
    for (const VerbRow& row : verb_rows())
        if (!row.name.empty() && word == row.name)
            throw UsageError(fmt::format("the verb '{}' must come first", word));
    throw UsageError(
        fmt::format("unexpected argument '{}' after '{}'", word, options.subjects[verb.max_subjects - 1]));
}

void check_outputs(const Options& options)
{
    std::vector<std::pair<std::filesystem::path, std::string>> seen;
    const auto check = [&](const std::string& file, const char* option) {
        if (file.empty()) throw UsageError(fmt::format("{} needs a file name", option));
        const auto path = std::filesystem::path(file).lexically_normal();
        for (const auto& [other, name] : seen)
            if (other == path) throw UsageError(fmt::format("'{}' is listed as an output twice", name));
        seen.emplace_back(path, file);
    };
    for (const std::string& file : options.outputs) check(file, "--output");
    if (!options.json.empty() && options.json != "-") check(options.json, "--json");
    if (!options.compare.difference.empty()) check(options.compare.difference, "--diff");
    if (!options.part && !options.checkpoint.file.empty()) check(options.checkpoint.file, "--checkpoint");
}

// A and the reference, or the replicas of A and those of a reference that --against names.
void check_images(const Options& options)
{
    if (!options.compare.b.empty() || options.subjects.size() == 2) return;
    if (options.subjects.size() < 2)
        throw UsageError("compare needs two images; 'renderer compare --help' shows how");
    throw UsageError(
        fmt::format("{} images are given; pass the reference with --against FILE, the others are then "
                    "replicas of A",
                    options.subjects.size()));
}

// A part is no picture yet: its output is the state file. What goes with what.
void settle_state_file(Options& options)
{
    CheckpointRequest& checkpoint = options.checkpoint;
    if (options.part_by && !options.part) throw UsageError("--part-by needs --part K/N");
    if (options.part) {
        options.part->by = options.part_by.value_or(PartBy::tiles);
        if (!checkpoint.file.empty())
            throw UsageError(
                "--part and --checkpoint cannot be used together: the output of a part is its checkpoint");
        if (options.outputs.size() != 1) throw UsageError("--part needs one -o,--output FILE.exr");
        if (options.settings.stop != StopSettings())
            throw UsageError(
                "a part is a fixed set of samples: use --part with --spp, not with --time or --target-error");
        checkpoint.file = options.outputs.front();
    }
    if (checkpoint.resume && checkpoint.file.empty()) throw UsageError("--resume needs --checkpoint FILE");
    if (!checkpoint.file.empty() && !checkpoint.file.ends_with(".exr"))
        throw UsageError(
            fmt::format("'{}' must end in .exr: checkpoints and parts are .exr files", checkpoint.file));
}

// CLI11 says "--spp: 1 required TEXT missing" or "quiet was given a disallowed flag override".
[[noreturn]] void reject_values(const std::string& problem)
{
    std::string name = problem.substr(0, problem.find_first_of(": "));
    if (!name.starts_with('-')) name = "--" + name;
    for (const OptionRow& row : option_rows())
        if (row.long_name() == name)
            throw UsageError(
                fmt::format("option '{}' {} value", name, row.takes_value() ? "needs a" : "takes no"));
    throw UsageError(problem);
}

void apply(const OptionRow& row, const std::vector<std::string>& values, Options& options)
{
    const std::string_view name = row.long_name();
    if (row.takes_value() && !row.repeatable && values.size() > 1)
        throw UsageError(fmt::format("option '{}' is given twice", name));
    for (const std::string& value : values) {
        // "-o --spp 4" is a forgotten value, not a file named "--spp".
        if (row.takes_value() && value.starts_with("--"))
            throw UsageError(
                fmt::format("option '{}' needs a value, and '{}' looks like an option", name, value));
        try {
            row.apply(options, name, row.takes_value() ? value : "true");
        } catch (const Error& problem) {
            throw UsageError(problem.what());
        }
    }
}

// The options among the words, and the words that are none.
struct Sorted {
    std::vector<std::pair<const OptionRow*, std::vector<std::string>>> given; // with their values
    std::vector<std::string> others;
    std::vector<std::string> unknown; // look like options
};

Sorted sort_words(std::vector<std::string> words, const std::vector<const OptionRow*>& known)
{
    CLI::App app;
    app.set_help_flag();
    app.allow_extras();
    CLI::Option* subject = app.add_option("WORD")->allow_extra_args(false);
    std::vector<std::pair<const OptionRow*, CLI::Option*>> options;
    for (const OptionRow* row : known) {
        CLI::Option* option = row->takes_value() ? app.add_option(row->names)->allow_extra_args(false)
                                                 : app.add_flag(row->names)->disable_flag_override();
        option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        options.emplace_back(row, option);
        // CLI11 would take the next word for the value of "--spp=".
        const std::string empty = fmt::format("{}=", row->long_name());
        if (std::find(words.begin(), words.end(), empty) != words.end())
            reject_values(std::string(row->long_name()) + ":");
    }
    try {
        std::reverse(words.begin(), words.end()); // as CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ArgumentMismatch& problem) {
        reject_values(problem.what());
    } catch (const CLI::ParseError& problem) {
        throw UsageError(problem.what());
    }
    Sorted sorted;
    sorted.others = subject->results();
    for (const std::string& word : app.remaining())
        (word.size() > 1 && word.front() == '-' ? sorted.unknown : sorted.others).push_back(word);
    for (const auto& [row, option] : options)
        if (option->count() > 0) sorted.given.emplace_back(row, option->results());
    return sorted;
}

} // namespace

Options parse_options(std::vector<std::string> words)
{
    Options options;
    for (const std::string& word : words) options.typed += " " + shell_quote(word);
    for (const VerbRow& row : verb_rows())
        if (!words.empty() && !row.name.empty() && words.front() == row.name) options.verb = row.verb;
    const VerbRow& verb = row_of(options.verb);
    if (options.verb != Verb::render) words.erase(words.begin());

    const std::string first = words.empty() ? "" : words.front();
    std::vector<const OptionRow*> known;
    for (const OptionRow& row : option_rows())
        if (row.goes_with(options.verb)) known.push_back(&row);
    Sorted sorted = sort_words(std::move(words), known);
    options.subjects = std::move(sorted.others);
    if (!options.subjects.empty()) options.scene = options.subject = options.subjects.front();
    for (const auto& [row, values] : sorted.given) apply(*row, values, options);
    reject_words(options, first, sorted.unknown);
    if (options.help || options.version) return options;

    if (options.subjects.size() < verb.min_subjects)
        throw UsageError(verb.min_subjects == 1
                             ? fmt::format("no {} given; 'renderer --help' shows how", verb.subject)
                             : fmt::format("{} needs two {}s; 'renderer {} --help' shows how", verb.name,
                                           verb.subject, verb.name));
    if (options.verb == Verb::compare) check_images(options);
    if (options.verb == Verb::rerun && options.outputs.empty())
        throw UsageError("rerun needs -o,--output FILE; it has no default output");
    if (options.verb == Verb::replay)
        for (const OptionRow* row : known)
            if (row->topic == Topic::path &&
                std::none_of(sorted.given.begin(), sorted.given.end(),
                             [row](const auto& given) { return given.first == row; }))
                throw UsageError(fmt::format("replay needs {} {}", row->names, row->value));
    options.one_pixel = options.verb == Verb::replay;
    if (options.verb == Verb::render) settle_state_file(options);
    if (options.verb == Verb::merge && options.outputs.empty() && options.checkpoint.file.empty())
        throw UsageError(
            "merge needs -o,--output IMAGE, or --checkpoint FILE to merge the result with more parts");
    if (options.quiet && options.verbose) throw UsageError("--quiet and --verbose cannot be used together");
    check_outputs(options);
    return options;
}

} // namespace plumb
