// SPDX-License-Identifier: MIT

// The scene language as its manual pages have it: what schemas, completion and tables of the documentation are made from.

#include "reports/facts_json.h"

#include "base/text.h"
#include "reports/json_document.h"
#include "scene_file/catalog.h"
#include "scene_file/element_manuals.h"

#include <algorithm>
#include <array>

namespace plumb {

namespace {

// A row of a manual page: "    alpha   float or texture   roughness, in [0, 1]   (default 0.1)".
struct Parameter {
    std::string_view name;
    std::string_view type;
    std::string_view description;
    std::string_view usual; // empty: it must be given, or the text says what happens
};

std::string_view trimmed(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return text.substr(0, text.find_last_not_of(' ') + 1); // npos + 1 is 0
}

// Columns are at least two spaces apart. The last one holds the rest.
std::array<std::string_view, 3> columns_of(std::string_view row)
{
    std::array<std::string_view, 3> columns;
    row = trimmed(row);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::size_t end = i + 1 < columns.size() ? std::min(row.find("  "), row.size()) : row.size();
        columns[i] = row.substr(0, end);
        row = trimmed(row.substr(end));
    }
    return columns;
}

Parameter parameter_of(std::string_view row)
{
    const auto [name, type, rest] = columns_of(row);
    Parameter parameter{name, type, rest, {}};
    const std::size_t usual = rest.rfind("(default");
    if (usual == rest.npos || !rest.ends_with(')')) return parameter;
    parameter.description = trimmed(rest.substr(0, usual));
    std::string_view text = rest.substr(usual, rest.size() - usual - 1);
    text.remove_prefix(std::string_view("(default").size());
    if (text.starts_with(':')) text.remove_prefix(1);
    parameter.usual = trimmed(text);
    return parameter;
}

// The row of the manual that begins with the name of the parameter.
Parameter find_parameter(const std::vector<std::string>& rows, std::string_view name)
{
    for (const std::string& row : rows) {
        if (!row.starts_with("    ")) continue;
        const std::string_view text = trimmed(row);
        if (text.starts_with(name) && text.substr(name.size()).starts_with(' ')) return parameter_of(row);
    }
    return {name, {}, {}, {}};
}

std::string summary_of(std::string_view manual)
{
    std::string text(manual.substr(0, manual.find("\n\n")));
    std::replace(text.begin(), text.end(), '\n', ' ');
    const std::size_t end = text.find(". ");
    return std::string(trimmed(text.substr(0, end))) + (end == std::string::npos ? "" : ".");
}

void write_type(JsonWriter& json, const TypeInfo& type)
{
    json.begin_object();
    json.text("kind", type.kind);
    json.text("name", type.name);
    json.text("summary", summary_of(type.manual));
    json.begin_array("parameters");
    const std::vector<std::string> rows = lines_of(type.manual);
    for (const std::string_view name : parameters_in(type.manual)) {
        const Parameter parameter = find_parameter(rows, name);
        json.begin_object();
        json.text("name", name);
        json.text("type", parameter.type);
        json.text("description", parameter.description);
        write_text_or_null(json, "default", parameter.usual);
        json.end_object();
    }
    json.end_array();
    json.text("manual", type.manual);
    json.end_object();
}

void write_element(JsonWriter& json, const ElementManual& manual)
{
    json.begin_object();
    json.begin_array("names");
    for (std::string_view names = manual.names; !names.empty();) {
        const std::size_t end = std::min(names.find(' '), names.size());
        json.text({}, names.substr(0, end));
        names.remove_prefix(std::min(end + 1, names.size()));
    }
    json.end_array();
    write_text_or_null(json, "kind", kind_of_tag(manual.title()));
    json.text("manual", manual.text);
    json.end_object();
}

} // namespace

std::string types_json(std::string_view only)
{
    JsonWriter json;
    begin_document(json, "types");
    json.begin_array("types");
    for (const TypeInfo& type : known_types())
        if (only.empty() || type.name == only) write_type(json, type);
    json.end_array();
    json.begin_array("elements");
    for (const ElementManual& manual : element_manuals())
        if (only.empty() || manual.is_about(only)) write_element(json, manual);
    json.end_array();
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
