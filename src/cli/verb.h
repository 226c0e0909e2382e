// SPDX-License-Identifier: MIT
#pragma once

// A verb of the command line is one file below src/cli/verbs and one row of src/cli/verbs.cpp. It has a struct of options,
// and a table that says which words fill it.

#include "cli/usage_error.h"

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb {

// --help has an empty line between two of them.
enum class Topic { output, state, image, scene, running, path, verdict, about };

// An option, whatever it fills.
struct OptionHelp {
    Topic topic;
    std::string names; // "-o,--output": the long one last
    std::string value; // what --help calls it; empty: takes none
    std::string help;
    bool repeatable = false;
    bool required = false;
    bool value_is_optional = false; // given as --name or --name=VALUE; without one it is "true"

    std::string_view long_name() const;
    bool takes_value() const { return !value.empty(); }
};

template <class Options>
struct Option : OptionHelp {
    // Throws Error or UsageError. name: the long one. The value of a switch is "true".
    std::function<void(Options& options, std::string_view name, const std::string& value)> apply;
};

// In the order of --help.
template <class Options>
using OptionTable = std::vector<Option<Options>>;

// What the options of every verb have.
struct VerbOptions {
    std::vector<std::string> subjects; // the words that are no options: scenes, images, the name of a plugin
    std::string typed;                 // all words, quoted for a shell: " s.xml --seed 7"
    bool help = false;
    bool version = false;
    bool quiet = false;
    bool verbose = false;

    const std::string& subject() const { return subjects.front(); }
};

constexpr std::size_t any_number = 100000;

struct VerbHelp {
    std::string_view name;      // empty: rendering
    std::string_view arguments; // "IMAGE -o IMAGE [options]"
    std::string_view summary;   // a line of --help
    std::string_view subject;   // what its words are, for messages: "scene file"
    std::size_t min_subjects;
    std::size_t max_subjects;
    std::string manual = {}; // what its own --help prints below the usage
};

struct Verb : VerbHelp {
    std::vector<OptionHelp> options;
    // What the words ask for, to be done later: it returns the exit code. words: without the program's name; the verb's own
    // name comes first. A pure function: nothing is printed or read. Throws UsageError.
    std::function<std::function<int()>(const std::vector<std::string>& words)> parse;
};

// The words of a command line by what they are.
struct ParsedWords {
    struct Given {
        std::size_t option; // of the table
        std::vector<std::string> values;
    };
    std::vector<Given> given; // in the order of the table
    std::vector<std::string> subjects;
    std::vector<std::string> unknown; // look like options
    // A word behind an option whose value is optional, "--tev HOST" for "--tev=HOST", and the option.
    std::map<std::string, std::string> behind_optional;
    std::string typed;
    std::string first; // behind the verb's name
};

ParsedWords parse_words(const VerbHelp& verb, std::span<const OptionHelp> options,
                        const std::vector<std::string>& words);
// Throws UsageError for values that are doubled or look like options.
void check_values(const OptionHelp& option, const std::vector<std::string>& values);
// Throws UsageError for words that nobody knows, and for words of which there are too many.
void reject_words(const VerbHelp& verb, std::span<const OptionHelp> options, const ParsedWords& words);
// Throws UsageError for what is not there.
void require_words(const VerbHelp& verb, std::span<const OptionHelp> options, const ParsedWords& words);
// Calls it with what Error says as a UsageError.
void as_usage_errors(const std::function<void()>& apply);
// Prints help or version if they are asked for; else does the work. With --quiet, the warnings of a SceneError are left out.
int run_verb(std::string_view verb, const VerbOptions& options, const std::function<int()>& work);

// settle: checks what options go together. Throws UsageError.
template <class Options>
Options parse_into(const VerbHelp& verb, const OptionTable<Options>& table, void (*settle)(Options&),
                   const std::vector<std::string>& words)
{
    const std::vector<OptionHelp> all(table.begin(), table.end());
    const ParsedWords parsed = parse_words(verb, all, words);
    Options options;
    options.subjects = parsed.subjects;
    options.typed = parsed.typed;
    for (const auto& [index, values] : parsed.given) {
        const Option<Options>& option = table[index];
        check_values(option, values);
        for (const std::string& value : values)
            as_usage_errors(
                [&] { option.apply(options, option.long_name(), option.takes_value() ? value : "true"); });
    }
    reject_words(verb, all, parsed);
    if (options.help || options.version) return options;
    require_words(verb, all, parsed);
    if (settle) settle(options);
    if (options.quiet && options.verbose) throw UsageError("--quiet and --verbose cannot be used together");
    return options;
}

template <class Options>
Verb make_verb(const VerbHelp& help, const OptionTable<Options>& table, int (*run)(const Options&),
               void (*settle)(Options&) = nullptr)
{
    Verb verb{help, {table.begin(), table.end()}, {}};
    verb.parse = [help, table, run, settle](const std::vector<std::string>& words) -> std::function<int()> {
        Options options = parse_into(help, table, settle, words);
        return [name = help.name, options = std::move(options), run] {
            return run_verb(name, options, [&] { return run(options); });
        };
    };
    return verb;
}

// The verb that a file makes: Maker has `static Verb make()`. Such a file ends in `template const Verb& verb<Maker>();`.
template <class Maker>
const Verb& verb();

} // namespace plumb
