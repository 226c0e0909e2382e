// SPDX-License-Identifier: MIT
#include "cli/verbs.h"

#include "base/terminal_text.h"
#include "cli/console.h"
#include "reports/exit_codes.h"

#include "plumb/base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

// A row for each.
static constexpr const Verb& (*const rows[])() = {
    verb<struct RenderVerb>,     //
    verb<struct NewVerb>,        //
    verb<struct HelpVerb>,       //
    verb<struct TypesVerb>,      //
    verb<struct SchemaVerb>,     //
    verb<struct InfoVerb>,       //
    verb<struct ViewVerb>,       //
    verb<struct DenoiseVerb>,    //
    verb<struct ReplayVerb>,     //
    verb<struct RerunVerb>,      //
    verb<struct MergeVerb>,      //
    verb<struct CheckVerb>,      //
    verb<struct CompareVerb>,    //
    verb<struct AgreeVerb>,      //
    verb<struct RaceVerb>,       //
    verb<struct TestVerb>,       //
    verb<struct BatchVerb>,      //
    verb<struct CompletionVerb>, //
    verb<struct ManVerb>,        //
};

std::span<const Verb* const> all_verbs()
{
    static const std::vector<const Verb*> verbs = [] {
        std::vector<const Verb*> all;
        for (const auto& row : rows) all.push_back(&row());
        return all;
    }();
    return verbs;
}

const Verb& verb_of(const std::vector<std::string>& words)
{
    for (const Verb* one : all_verbs())
        if (!words.empty() && !one->name.empty() && words.front() == one->name) return *one;
    return *all_verbs().front();
}

const Verb* find_verb(std::string_view name)
{
    for (const Verb* one : all_verbs())
        if (one->name == name || (one->name.empty() && name == "render")) return one;
    return nullptr;
}

std::string command_of(const VerbHelp& verb)
{
    return fmt::format("renderer {}{}{}", verb.name, verb.name.empty() ? "" : " ", verb.arguments);
}

std::string help_text(const Verb& asked)
{
    std::string text;
    if (asked.name.empty()) {
        constexpr std::size_t width = 32; // of a command with its summary beside it
        for (const Verb* one : all_verbs()) {
            const std::string command = command_of(*one);
            text += fmt::format("{} {:<{}}", text.empty() ? "usage:" : "      ", command, width);
            text += command.size() > width ? fmt::format("\n{:<{}}", "", width + 8) : " ";
            text += fmt::format("{}\n", one->summary);
        }
        text += "If a scene file has the name of a verb, write it as ./types.\n";
    } else {
        text = fmt::format("usage: {}\n{}", command_of(asked), asked.manual);
    }
    const OptionHelp* last = nullptr;
    for (const OptionHelp& option : asked.options) {
        if (!last || option.topic != last->topic) text += "\n";
        last = &option;
        std::string names = option.names;
        names = names.starts_with("--") ? "    " + names : names.replace(2, 1, ", ");
        std::string_view help = option.help;
        const std::string value =
            option.value_is_optional ? fmt::format("[={}]", option.value) : " " + option.value;
        text += fmt::format("  {:<24} {}\n", names + value, help.substr(0, help.find('\n')));
        while (help.find('\n') != std::string_view::npos) {
            help.remove_prefix(help.find('\n') + 1);
            text += fmt::format("  {:<24} {}\n", "", help.substr(0, help.find('\n')));
        }
    }
    return text;
}

int run_verb(std::string_view name, const VerbOptions& options, const std::function<int()>& work)
{
    if (options.help || options.version) {
        print_output(options.help ? rewrapped(help_text(*find_verb(name)), output_columns())
                                  : "Plumb " PLUMB_VERSION "\n");
        return exit_code::done;
    }
    try {
        return work();
    } catch (const SceneError& error) {
        if (!options.quiet) throw;
        std::vector<Diagnostic> errors = error.diagnostics();
        std::erase_if(errors, [](const Diagnostic& one) { return one.severity != Severity::error; });
        throw SceneError(std::move(errors));
    }
}

bool is_no_file_name(std::string_view word)
{
    return word.find_first_of("./") == word.npos;
}

std::string unknown_verb(std::string_view word)
{
    const std::string_view near = closest_verb(word);
    return near.empty() ? fmt::format("unknown verb '{}'; 'renderer --help' lists the verbs", word)
                        : fmt::format("unknown verb '{}'; did you mean '{}'?", word, near);
}

std::string_view closest_verb(std::string_view word)
{
    std::vector<std::string_view> names;
    for (const Verb* one : all_verbs())
        if (!one->name.empty()) names.push_back(one->name);
    return closest_name(word, names);
}

} // namespace plumb
