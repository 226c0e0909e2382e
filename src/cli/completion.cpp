// SPDX-License-Identifier: MIT
#include "cli/completion.h"

#include "cli/verbs.h"
#include "reports/type_summary.h"

#include "plumb/image/development.h"
#include "plumb/model/dialect.h"
#include "plumb/render/aovs.h"
#include "plumb/scene/instruction_set.h"
#include "plumb/scene_file/scene_file.h"

#include <algorithm>

namespace plumb {

namespace {

using Words = std::vector<std::string>;

std::vector<Completion> types_of(std::string_view kind)
{
    std::vector<Completion> types;
    for (const TypeInfo& type : known_types())
        if (kind.empty() || type.kind == kind)
            types.push_back({std::string(type.name), summary_of(type.manual)});
    return types;
}

Words names_of(const std::vector<Completion>& completions)
{
    Words names;
    for (const Completion& one : completions) names.push_back(one.word);
    return names;
}

Words dialects()
{
    Words names = {"auto"};
    for (const DialectName name : all_dialects) names.emplace_back(to_string(name));
    return names;
}

Words instruction_sets()
{
    const auto names = instruction_set_names();
    return {names.begin(), names.end()};
}

Words tone_curves()
{
    const auto names = tone_curve_names();
    return {names.begin(), names.end()};
}

struct OptionWords {
    std::string_view option;
    Words (*words)();
};

// cli_completion_test.cpp compares them with what the options themselves take.
constexpr OptionWords option_words[] = {
    {"--aov", aov_names},
    {"--dialect", dialects},
    {"--diff-of",
     [] {
         return Words{"error", "flip"};
     }},
    {"--emitters",
     [] {
         return Words{"scatter", "absorb"};
     }},
    {"--exact",
     [] {
         return Words{"A", "B"};
     }},
    {"--flip",
     [] {
         return Words{"ldr", "hdr", "none"};
     }},
    {"--integrator", [] { return names_of(types_of("integrator")); }},
    {"--integrators", [] { return names_of(types_of("integrator")); }},
    {"--isa", instruction_sets},
    {"--mirror",
     [] {
         return Words{"on", "off"};
     }},
    {"--part-by",
     [] {
         return Words{"tiles", "samples"};
     }},
    {"--sampler", [] { return names_of(types_of("sampler")); }},
    {"--samplers", [] { return names_of(types_of("sampler")); }},
    {"--split",
     [] {
         return Words{"depth", "technique", "light"};
     }},
    {"--tonemap", tone_curves},
    {"--variance-of",
     [] {
         return Words{"sample", "mean"};
     }},
};

std::string in_one_line(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

bool is_called(const OptionHelp& option, std::string_view word)
{
    const std::size_t comma = option.names.find(',');
    return word == option.long_name() ||
           (comma != std::string::npos && word == std::string_view(option.names).substr(0, comma));
}

const OptionHelp* find_option(const Verb& verb, std::string_view word)
{
    for (const OptionHelp& option : verb.options)
        if (is_called(option, word)) return &option;
    return nullptr;
}

bool names_files(std::string_view value)
{
    return value.find("FILE") != value.npos || value.find("IMAGE") != value.npos ||
           value.find("DIRECTORY") != value.npos;
}

// Of a list, the last item.
Completions values_of(const OptionHelp& option, std::string_view typed)
{
    Completions result;
    result.files = names_files(option.value);
    const std::size_t comma = option.value.ends_with(",...") ? typed.rfind(',') : typed.npos;
    const std::string before(typed.substr(0, comma == typed.npos ? 0 : comma + 1));
    for (const std::string& word : words_of_option(option.long_name()))
        result.words.push_back({before + word, {}});
    return result;
}

Completions options_of(const Verb& verb, const Words& words)
{
    Completions result;
    for (const OptionHelp& option : verb.options) {
        const bool given = std::any_of(words.begin(), words.end() - 1,
                                       [&](const std::string& word) { return is_called(option, word); });
        if (!given || option.repeatable)
            result.words.push_back({std::string(option.long_name()), in_one_line(option.help)});
    }
    return result;
}

// Of "[rng|xsd]".
std::vector<Completion> alternatives(std::string_view arguments)
{
    std::vector<Completion> words;
    while (!arguments.empty()) {
        const std::size_t end = std::min(arguments.find_first_of("[]|"), arguments.size());
        if (end > 0) words.push_back({std::string(arguments.substr(0, end)), {}});
        arguments.remove_prefix(std::min(end + 1, arguments.size()));
    }
    return words;
}

Completions subjects_of(const Verb& verb)
{
    Completions result;
    if (verb.name == "help") {
        for (const Verb* one : all_verbs())
            if (!one->name.empty())
                result.words.push_back({std::string(one->name), std::string(one->summary)});
    } else if (verb.name == "types") {
        result.words = types_of({});
    } else if (verb.arguments.find('|') != verb.arguments.npos) {
        result.words = alternatives(verb.arguments);
    } else {
        result.files = true;
    }
    return result;
}

// bash makes three words of --update=all.
Words joined_at_equals(const Words& words)
{
    Words joined;
    for (const std::string& word : words) {
        const bool to_option = !joined.empty() && joined.back().starts_with("--");
        if (to_option && (word == "=" || joined.back().ends_with('=')))
            joined.back() += word;
        else
            joined.push_back(word);
    }
    return joined;
}

Completions all_of(const Words& words)
{
    const std::string& typed = words.back();
    const Verb& verb = verb_of(words.size() > 1 ? words : Words{""});
    if (const std::size_t equals = typed.find('='); typed.starts_with("--") && equals != typed.npos) {
        const OptionHelp* option = find_option(verb, std::string_view(typed).substr(0, equals));
        if (!option) return {};
        Completions result = values_of(*option, std::string_view(typed).substr(equals + 1));
        for (Completion& one : result.words) one.word = typed.substr(0, equals + 1) + one.word;
        return result;
    }
    const OptionHelp* before = words.size() > 1 ? find_option(verb, words[words.size() - 2]) : nullptr;
    if (before && before->takes_value() && !before->value_is_optional) return values_of(*before, typed);
    if (typed.starts_with('-')) return options_of(verb, words);
    Completions result = subjects_of(verb);
    if (words.size() == 1)
        for (const Verb* one : all_verbs())
            if (!one->name.empty())
                result.words.push_back({std::string(one->name), std::string(one->summary)});
    return result;
}

} // namespace

std::vector<std::string> words_of_option(std::string_view long_name)
{
    for (const OptionWords& row : option_words)
        if (row.option == long_name) return row.words();
    return {};
}

Completions complete(std::vector<std::string> words)
{
    words = joined_at_equals(words);
    if (words.empty()) words.emplace_back();
    Completions result = all_of(words);
    std::erase_if(result.words, [&](const Completion& one) { return !one.word.starts_with(words.back()); });
    return result;
}

} // namespace plumb
