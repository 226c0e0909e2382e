// SPDX-License-Identifier: MIT
#include "reports/json_document.h"

namespace plumb {

namespace {

std::string_view severity_word(Severity severity)
{
    switch (severity) {
    case Severity::error: return "error";
    case Severity::warning: return "warning";
    case Severity::note: break;
    }
    return "note";
}

void write_place(JsonWriter& json, const SourceLocation& place)
{
    write_text_or_null(json, "file", place.file);
    if (place.line > 0) {
        json.integer("line", static_cast<std::uint64_t>(place.line));
        json.integer("column", static_cast<std::uint64_t>(place.column));
    } else {
        json.null("line");
        json.null("column");
    }
}

} // namespace

void begin_document(JsonWriter& json, std::string_view kind)
{
    json.begin_object();
    json.integer("schema", json_schema);
    json.text("kind", kind);
    json.text("software", "Plumb " PLUMB_VERSION);
}

void write_text_or_null(JsonWriter& json, std::string_view key, std::string_view text)
{
    if (text.empty())
        json.null(key);
    else
        json.text(key, text);
}

void write_diagnostics(JsonWriter& json, std::string_view key, const std::vector<Diagnostic>& diagnostics)
{
    json.begin_array(key);
    for (const Diagnostic& diagnostic : diagnostics) {
        // The way out stands behind the first semicolon.
        const std::string_view message = diagnostic.message;
        const std::size_t end = std::min(message.find("; "), message.size());
        json.begin_object();
        write_place(json, diagnostic.location);
        json.text("severity", severity_word(diagnostic.severity));
        json.text("message", message.substr(0, end));
        write_text_or_null(json, "suggestion", message.substr(std::min(end + 2, message.size())));
        json.end_object();
    }
    json.end_array();
}

std::string error_json(const std::vector<Diagnostic>& diagnostics, int exit_code)
{
    JsonWriter json;
    begin_document(json, "error");
    json.integer("exit_code", static_cast<std::uint64_t>(exit_code));
    write_diagnostics(json, "errors", diagnostics);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
