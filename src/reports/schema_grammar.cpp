// SPDX-License-Identifier: MIT
#include "reports/schema_grammar.h"

#include "reports/type_summary.h"
#include "scene_file/catalog.h"
#include "scene_file/element_manuals.h"
#include "scene_file/nori_words.h"
#include "scene_file/placement.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

#define PLUMB_NUMBER R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)"
#define PLUMB_BLANKS R"([ \t\r\n]*)"
#define PLUMB_SEPARATOR R"([, \t\r\n]+)"

constexpr ValueSyntax syntaxes[] = {
    {"text", ".*"},
    {"boolean",
     PLUMB_BLANKS "[tT][rR][uU][eE]" PLUMB_BLANKS "|" PLUMB_BLANKS "[fF][aA][lL][sS][eE]" PLUMB_BLANKS},
    {"integer", PLUMB_BLANKS R"([+\-]?[0-9]+)" PLUMB_BLANKS},
    {"number", PLUMB_BLANKS PLUMB_NUMBER PLUMB_BLANKS},
    {"numbers2or3", "[, \\t\\r\\n]*" PLUMB_NUMBER "(" PLUMB_SEPARATOR PLUMB_NUMBER "){1,2}[, \\t\\r\\n]*"},
    {"numbers3", "[, \\t\\r\\n]*" PLUMB_NUMBER "(" PLUMB_SEPARATOR PLUMB_NUMBER "){2}[, \\t\\r\\n]*"},
    {"numbers16", "[, \\t\\r\\n]*" PLUMB_NUMBER "(" PLUMB_SEPARATOR PLUMB_NUMBER "){15}[, \\t\\r\\n]*"},
};

#undef PLUMB_NUMBER
#undef PLUMB_BLANKS
#undef PLUMB_SEPARATOR

// Which elements take a value of the type that a manual page names; `Params` reads them so.
struct TypeWord {
    std::string_view word;
    std::vector<ValueTag> tags;
};
const std::vector<TypeWord>& type_words()
{
    static const std::vector<TypeWord> words = {
        {"float", {{"float", "number"}, {"integer", "integer"}}},
        {"integer", {{"integer", "integer"}}},
        {"boolean", {{"boolean", "boolean"}}},
        {"string", {{"string", "text"}}},
        {"color", {{"color", "numbers3"}}},
        {"point", {{"point", "numbers2or3"}, {"vector", "numbers2or3"}}},
        {"vector", {{"vector", "numbers2or3"}, {"point", "numbers2or3"}}},
        {"transform", {{"transform", {}}}},
    };
    return words;
}

std::vector<std::string_view> children_of(std::span<const std::string_view> tags)
{
    std::vector<std::string_view> children;
    for (const std::string_view child : all_tags()) {
        const std::vector<std::string_view> parents = parents_of(child);
        const bool fits = std::any_of(parents.begin(), parents.end(), [&](std::string_view parent) {
            return std::find(tags.begin(), tags.end(), parent) != tags.end();
        });
        if (fits) children.push_back(child);
    }
    return children;
}

std::vector<std::string> other_types(std::string_view kind)
{
    std::vector<std::string> names;
    for (const Vocabulary* words = &nori_vocabulary(DialectName::plumb); words; words = words->base)
        for (const TypeName& type : words->types)
            if (type.kind == kind) names.emplace_back(type.theirs);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

SchemaKind kind_named(std::string_view kind)
{
    SchemaKind found{kind, {}, {}, {}, other_types(kind)};
    for (const std::string_view tag : all_tags())
        if (kind_of_tag(tag) == kind) found.tags.push_back(tag);
    found.children = children_of(found.tags);
    std::erase(found.children, "texture");
    if (kind == "shape") // a group holds shapes, which placement.h leaves to it
        found.children.insert(found.children.end(), found.tags.begin(), found.tags.end());
    for (const TypeInfo& type : known_types()) {
        if (type.kind != kind) continue;
        found.types.push_back({std::string(type.name), summary_of(type.manual), parameters_of(type),
                               texture_parameters_of(kind, type.name)});
        std::erase(found.other_types, type.name);
    }
    return found;
}

} // namespace

std::span<const ValueSyntax> value_syntaxes()
{
    return syntaxes;
}

std::string with_variables(std::string_view pattern)
{
    return fmt::format(R"({}|.*[$].*)", pattern);
}

std::vector<ValueTag> value_tags(std::string_view type)
{
    std::vector<ValueTag> tags;
    for (const TypeWord& word : type_words()) {
        if (type.find(word.word) == type.npos) continue;
        for (const ValueTag& tag : word.tags) {
            const bool known = std::any_of(tags.begin(), tags.end(),
                                           [&](const ValueTag& one) { return one.tag == tag.tag; });
            if (!known) tags.push_back(tag);
        }
    }
    return tags;
}

std::span<const Operation> transform_operations()
{
    static const std::vector<Operation> operations = {
        {"translate", {{"value", "numbers3"}}},
        {"scale", {{"value", "numbers3"}}},
        {"rotate", {{"axis", "numbers3"}, {"angle", "number"}}},
        {"lookat", {{"origin", "numbers3"}, {"target", "numbers3"}, {"up", "numbers3"}}},
        {"matrix", {{"value", "numbers16"}}},
    };
    return operations;
}

std::vector<SchemaKind> schema_kinds()
{
    std::vector<std::string_view> kinds;
    for (const TypeInfo& type : known_types())
        if (std::find(kinds.begin(), kinds.end(), type.kind) == kinds.end()) kinds.push_back(type.kind);
    std::vector<SchemaKind> all;
    for (const std::string_view kind : kinds) all.push_back(kind_named(kind));
    return all;
}

std::vector<std::string_view> scene_children()
{
    constexpr std::string_view scene[] = {"scene"};
    return children_of(scene);
}

std::vector<std::string_view> scene_parameters()
{
    const ElementManual* manual = find_element_manual("scene");
    return manual ? parameters_in(manual->text) : std::vector<std::string_view>();
}

std::vector<std::string_view> dialect_names()
{
    std::vector<std::string_view> names = {"auto"};
    for (const DialectName name : all_dialects) names.push_back(to_string(name));
    return names;
}

} // namespace plumb
