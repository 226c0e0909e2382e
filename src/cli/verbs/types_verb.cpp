// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/usage_error.h"
#include "cli/verb_file.h"
#include "plumb/scene_file/scene_file.h"
#include "reports/exit_codes.h"
#include "reports/facts_json.h"
#include "reports/type_summary.h"
#include "scene_file/catalog.h"
#include "scene_file/element_manuals.h"
#include "scene_file/foreign_names.h"
#include "scene_file/nori_words.h"
#include "scene_file/placement.h"
#include "scene_file/vocabulary_manual.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {

namespace {

// The types of a kind, or all of them below their kinds.
void print_list(std::string_view only = {})
{
    std::size_t width = 0;
    for (const TypeInfo& type : known_types()) width = std::max(width, type.name.size());
    std::string_view kind;
    for (const TypeInfo& type : known_types()) {
        if (!only.empty() && type.kind != only) continue;
        if (type.kind != kind) print_output(fmt::format("{}{}\n", kind.empty() ? "" : "\n", type.kind));
        kind = type.kind;
        print_output(fmt::format("  {:<{}}  {}\n", type.name, width, summary_of(type.manual)));
    }
}

// Where the example of a kind stands.
std::string place_text(std::string_view kind)
{
    const std::string_view place = kind == "bsdf"      ? "inside a <shape> or <mesh>, "
                                   : kind == "texture" ? "inside a <bsdf> or <emitter>, "
                                   : kind == "rfilter" ? "inside the <camera>, "
                                                       : "";
    return fmt::format("The example stands {}in a scene that begins with <scene dialect=\"plumb\">;\n"
                       "'renderer new FILE' writes such a scene.\n",
                       place);
}

// The elements that have no types.
void print_elements()
{
    std::string text = "\nelements\n ";
    for (const ElementManual& manual : element_manuals())
        if (kind_of_tag(manual.title()).empty()) text += fmt::format(" {}", manual.title());
    print_output(text + "\n");
}

// The kinds can share a name; then all their manuals are printed.
bool print_type_manuals(const std::string& name)
{
    bool found = false;
    for (const TypeInfo& type : known_types()) {
        if (type.name != name) continue;
        print_output(fmt::format("{}{} '{}'\n\n{}", found ? "\n" : "", type.kind, type.name, type.manual));
        if (!type.manual.ends_with('\n')) print_output("\n");
        print_output("\n" + place_text(type.kind));
        found = true;
    }
    return found;
}

bool print_element_manual(std::string_view name)
{
    const ElementManual* manual = find_element_manual(name);
    if (!manual) return false;
    print_output(fmt::format("{}\n\n{}", manual->names, manual->text));
    if (const std::string_view kind = kind_of_tag(manual->title()); !kind.empty()) {
        print_output("\n");
        print_list(kind);
    }
    return true;
}

// What others call it, or what it could be a slip of.
[[noreturn]] void reject_name(const std::string& name)
{
    for (const TypeInfo& type : known_types())
        if (const auto foreign = foreign_type(type.kind, name)) throw UsageError(*foreign);
    if (const auto foreign = foreign_tag(name)) throw UsageError(*foreign);
    std::vector<std::string_view> names = all_tags();
    for (const TypeInfo& type : known_types()) names.push_back(type.name);
    const std::string_view near = closest_name(name, names);
    throw UsageError(near.empty() ? fmt::format("unknown type '{}'; 'renderer types' lists them", name)
                                  : fmt::format("unknown type '{}'; did you mean '{}'?", name, near));
}

struct Options : VerbOptions {
    std::string json;
    std::string dialect;
};

// What a dialect calls its types and parameters.
void print_vocabulary(const std::string& dialect, const std::string& name)
{
    const Vocabulary* words = vocabulary_named(dialect);
    if (!words) {
        const std::vector<std::string_view> known = vocabulary_names();
        const std::string_view near = closest_name(dialect, known);
        throw UsageError(fmt::format("--dialect: unknown dialect '{}'; {}", dialect,
                                     near.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                                  : fmt::format("did you mean '{}'?", near)));
    }
    if (name.empty()) return print_output(types_of_vocabulary(*words));
    const std::optional<std::string> manual = manual_of_type(*words, name);
    if (!manual)
        throw UsageError(fmt::format(
            "{0} has no type '{1}' of its own; 'renderer types --dialect {0}' lists them", dialect, name));
    print_output(*manual);
}

void settle(Options& options)
{
    if (!options.json.empty() && !options.dialect.empty())
        throw UsageError("--json lists our own words and cannot be used with --dialect");
    check_output_names({}, {{"--json", options.json}});
}

bool is_known(std::string_view name)
{
    const auto& types = known_types();
    return find_element_manual(name) ||
           std::any_of(types.begin(), types.end(), [&](const TypeInfo& type) { return type.name == name; });
}

int run(const Options& options)
{
    const std::string name = options.subjects.empty() ? "" : options.subject();
    if (!options.dialect.empty()) {
        print_vocabulary(options.dialect, name);
        return exit_code::done;
    }
    if (!options.json.empty()) {
        if (!name.empty() && !is_known(name)) reject_name(name);
        check_outputs({}, options.json);
        write_json(options.json, types_json(name));
        return exit_code::done;
    }
    if (name.empty()) {
        print_list();
        print_elements();
    } else if (!print_type_manuals(name) && !print_element_manual(name)) {
        const auto other = manual_of_type(nori_vocabulary(DialectName::plumb), name);
        if (!other) reject_name(name);
        print_output(*other);
    }
    return exit_code::done;
}

} // namespace

struct TypesVerb {
    static Verb make()
    {
        return make_verb<Options>(
            {"types", "[NAME]", "list all types, or print a manual", "name", 0, 1},
            join<Options>(
                {text_option<Options>(
                     Topic::scene, "--dialect", "NAME",
                     "in the words of mitsuba3, mitsuba06 or a\ncourse, with what they are called here",
                     &Options::dialect, "name"),
                 json_option<Options>(), help_option<Options>()}),
            run, settle);
    }
};
template const Verb& verb<TypesVerb>();

} // namespace plumb
