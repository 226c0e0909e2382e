// SPDX-License-Identifier: MIT
#include "cli/verb.h"

#include "base/shell_words.h"
#include "cli/verbs.h"
#include "plumb/base/error.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string_view title_of(const VerbHelp& verb)
{
    return verb.name.empty() ? "rendering" : verb.name;
}

// What other renderers call our options, where the spelling is too far off to guess.
constexpr std::pair<std::string_view, std::string_view> foreign_names[] = {
    {"--outfile", "--output"},   {"-out", "--output"},        {"--output-file", "--output"},
    {"--samples", "--spp"},      {"--cropwindow", "--crop"},  {"--pixelbounds", "--crop"},
    {"--width", "--size"},       {"--height", "--size"},      {"--resolution", "--size"},
    {"--nthreads", "--threads"}, {"--scene_var", "--define"}, {"--debugstart", "replay"},
};

// "-o" and "--output".
std::vector<std::string_view> names_of(const OptionHelp& option)
{
    std::vector<std::string_view> all;
    for (std::string_view names = option.names; !names.empty();) {
        const std::size_t comma = std::min(names.find(','), names.size());
        all.push_back(names.substr(0, comma));
        names.remove_prefix(std::min(comma + 1, names.size()));
    }
    return all;
}

[[noreturn]] void reject_option(const VerbHelp& verb, std::span<const OptionHelp> options,
                                std::string_view word)
{
    const std::string_view name = word.substr(0, word.find('='));
    if (name == "--no-gui") throw UsageError("Plumb has no window; omit '--no-gui'");
    for (const Verb* other : all_verbs())
        for (const OptionHelp& option : other->options)
            for (const std::string_view one : names_of(option))
                if (one == name)
                    throw UsageError(fmt::format("option '{}' cannot be used with {}", name, title_of(verb)));
    std::vector<std::string_view> known;
    for (const OptionHelp& option : options)
        for (const std::string_view one : names_of(option)) known.push_back(one);
    std::string_view near = closest_name(name, known);
    for (const auto& [foreign, ours] : foreign_names)
        if (foreign == name) near = ours;
    throw UsageError(near.empty()
                         ? fmt::format("unknown option '{}'; 'renderer --help' lists the options", name)
                         : fmt::format("unknown option '{}'; did you mean '{}'?", name, near));
}

// CLI11 says "--spp: 1 required TEXT missing" or "quiet was given a disallowed flag override".
[[noreturn]] void reject_values(std::span<const OptionHelp> options, const std::string& problem)
{
    std::string name = problem.substr(0, problem.find_first_of(": "));
    if (!name.starts_with('-')) name = "--" + name;
    for (const OptionHelp& option : options)
        if (option.long_name() == name)
            throw UsageError(
                fmt::format("option '{}' {} value", name, option.takes_value() ? "needs a" : "takes no"));
    throw UsageError(problem);
}

} // namespace

std::string_view OptionHelp::long_name() const
{
    const std::string_view all = names;
    return all.substr(all.rfind(',') + 1); // npos + 1 is 0
}

ParsedWords parse_words(const VerbHelp& verb, std::span<const OptionHelp> options,
                        const std::vector<std::string>& words)
{
    ParsedWords parsed;
    for (const std::string& word : words) parsed.typed += " " + shell_quote(word);
    std::vector<std::string> rest(words.begin() + (verb.name.empty() ? 0 : 1), words.end());
    if (!rest.empty()) parsed.first = rest.front();

    for (std::size_t i = 0; i + 1 < rest.size(); ++i)
        for (const OptionHelp& option : options)
            if (option.value_is_optional && option.long_name() == rest[i])
                parsed.behind_optional.try_emplace(rest[i + 1], rest[i]);

    CLI::App app;
    app.set_help_flag();
    app.allow_extras();
    CLI::Option* subject = app.add_option("WORD")->allow_extra_args(false);
    std::vector<CLI::Option*> added;
    for (const OptionHelp& option : options) {
        if (option.value_is_optional)
            added.push_back(app.add_flag(option.names));
        else
            added.push_back(option.takes_value() ? app.add_option(option.names)->allow_extra_args(false)
                                                 : app.add_flag(option.names)->disable_flag_override());
        added.back()->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        // CLI11 would take the next word for the value of "--spp=".
        const std::string empty = fmt::format("{}=", option.long_name());
        if (std::find(rest.begin(), rest.end(), empty) != rest.end())
            reject_values(options, std::string(option.long_name()) + ":");
    }
    try {
        std::reverse(rest.begin(), rest.end()); // as CLI11 wants them
        app.parse(std::move(rest));
    } catch (const CLI::ArgumentMismatch& problem) {
        reject_values(options, problem.what());
    } catch (const CLI::ParseError& problem) {
        throw UsageError(problem.what());
    }
    parsed.subjects = subject->results();
    for (const std::string& word : app.remaining())
        (word.size() > 1 && word.front() == '-' ? parsed.unknown : parsed.subjects).push_back(word);
    for (std::size_t i = 0; i < added.size(); ++i)
        if (added[i]->count() > 0) parsed.given.push_back({i, added[i]->results()});
    return parsed;
}

void check_values(const OptionHelp& option, const std::vector<std::string>& values)
{
    if (!option.takes_value()) return;
    const std::string_view name = option.long_name();
    if (!option.repeatable && values.size() > 1)
        throw UsageError(fmt::format("option '{}' is given twice", name));
    // "-o --spp 4" is a forgotten value, not a file named "--spp".
    for (const std::string& value : values)
        if (value.starts_with("--"))
            throw UsageError(
                fmt::format("option '{}' needs a value, and '{}' looks like an option", name, value));
}

void as_usage_errors(const std::function<void()>& apply)
{
    try {
        apply();
    } catch (const Error& problem) {
        throw UsageError(problem.what());
    }
}

void reject_words(const VerbHelp& verb, std::span<const OptionHelp> options, const ParsedWords& words)
{
    const std::vector<std::string>& subjects = words.subjects;
    const bool has_more = !words.unknown.empty() || subjects.size() > verb.max_subjects;
    const std::string& first = words.first;
    if (verb.name.empty() && has_more && !subjects.empty() && subjects.front() == first &&
        is_no_file_name(first) && (subjects.size() > 1 || !closest_verb(first).empty()))
        throw UsageError(unknown_verb(first));
    for (const std::string& word : words.unknown)
        if (word != "--") reject_option(verb, options, word);
    if (subjects.size() <= verb.max_subjects) return;
    const std::string& word = subjects[verb.max_subjects];
    for (const Verb* other : all_verbs())
        if (!other->name.empty() && word == other->name)
            throw UsageError(fmt::format("the verb '{}' must come first", word));
    if (const auto option = words.behind_optional.find(word); option != words.behind_optional.end())
        throw UsageError(fmt::format("unexpected argument '{0}'; write '{1}={0}'", word, option->second));
    throw UsageError(
        fmt::format("unexpected argument '{}' after '{}'", word, subjects[verb.max_subjects - 1]));
}

void require_words(const VerbHelp& verb, std::span<const OptionHelp> options, const ParsedWords& words)
{
    if (words.subjects.size() < verb.min_subjects)
        throw UsageError(verb.min_subjects == 1
                             ? fmt::format("no {} given; 'renderer --help' shows how", verb.subject)
                             : fmt::format("{} needs two {}s; 'renderer {} --help' shows how", verb.name,
                                           verb.subject, verb.name));
    for (std::size_t i = 0; i < options.size(); ++i) {
        const bool is_given = std::any_of(words.given.begin(), words.given.end(),
                                          [i](const ParsedWords::Given& given) { return given.option == i; });
        if (options[i].required && !is_given)
            throw UsageError(fmt::format("{} needs {} {}", verb.name, options[i].names, options[i].value));
    }
}

} // namespace plumb
