// SPDX-License-Identifier: MIT
#pragma once

// What every JSON of Plumb begins with. docs/json.md describes them all: whoever removes or renames a member, or changes what
// it means, makes a new version; a new member does not.

#include "base/json.h"
#include "plumb/base/error.h"

#include <string_view>
#include <vector>

namespace plumb {

inline constexpr int json_schema = 1;

void begin_document(JsonWriter& json, std::string_view kind);
void write_text_or_null(JsonWriter& json, std::string_view key, std::string_view text);
// An array of {file, line, column, severity, message, suggestion}.
void write_diagnostics(JsonWriter& json, std::string_view key, const std::vector<Diagnostic>& diagnostics);

// Of a command that failed.
std::string error_json(const std::vector<Diagnostic>& diagnostics, int exit_code);

} // namespace plumb
