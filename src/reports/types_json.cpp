// SPDX-License-Identifier: MIT

// The scene language as its manual pages have it: what schemas, completion and tables of the documentation are made from.

#include "reports/facts_json.h"

#include "reports/json_document.h"
#include "reports/type_parameters.h"
#include "reports/type_summary.h"
#include "scene_file/catalog.h"
#include "scene_file/element_manuals.h"

namespace plumb {

namespace {

void write_type(JsonWriter& json, const TypeInfo& type)
{
    json.begin_object();
    json.text("kind", type.kind);
    json.text("name", type.name);
    json.text("summary", summary_of(type.manual));
    json.begin_array("parameters");
    for (const TypeParameter& parameter : parameters_of(type)) {
        json.begin_object();
        json.text("name", parameter.name);
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
