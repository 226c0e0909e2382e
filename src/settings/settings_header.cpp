// SPDX-License-Identifier: MIT
#include "plumb/settings/settings_header.h"

#include "base/shell_words.h"
#include "base/visible_text.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

using Row = SettingRow<RenderSettings>;

constexpr std::string_view schema_name = "plumb:settings";
constexpr std::string_view arguments_name = "plumb:arguments";
constexpr std::string_view prefix = "plumb:set.";

std::string escaped(std::string_view text)
{
    std::string line;
    for (const char c : text) {
        if (c == '\n')
            line += "\\n";
        else if (c == '\r')
            line += "\\r";
        else if (c == '\\')
            line += "\\\\";
        else
            line += c;
    }
    return line;
}

std::string unescaped(std::string_view name, std::string_view line)
{
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] != '\\') {
            text += line[i];
            continue;
        }
        const char c = ++i < line.size() ? line[i] : ' ';
        if (c != 'n' && c != 'r' && c != '\\')
            throw Error(fmt::format("{} has a backslash that is not in \\n, \\r or \\\\", name));
        text += c == 'n' ? '\n' : c == 'r' ? '\r' : '\\';
    }
    return text;
}

const MetadataValue* find(const Metadata& header, std::string_view name)
{
    for (const auto& entry : header)
        if (entry.first == name) return &entry.second;
    return nullptr;
}

const std::string& text_of(const std::string& name, const MetadataValue& value)
{
    const auto* const text = std::get_if<std::string>(&value);
    if (!text) throw Error(fmt::format("{} must be a text", name));
    return *text;
}

// "--seed 7 --define 'a=b c'".
RenderSettings settings_of_arguments(const std::string& arguments)
{
    RenderSettings settings;
    std::vector<const Row*> given;
    const std::vector<std::string> words = shell_split(arguments);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const Row* const row =
            word.starts_with("--") ? find_setting<RenderSettings>(std::string_view(word).substr(2)) : nullptr;
        if (!row)
            throw Error(
                fmt::format("{}: '{}' is not an option that changes the image", arguments_name, word));
        if (!row->repeatable && std::ranges::find(given, row) != given.end())
            throw Error(fmt::format("{}: option '{}' is given twice", arguments_name, word));
        given.push_back(row);
        if (!row->is_switch() && i + 1 == words.size())
            throw Error(fmt::format("{}: option '{}' needs a value", arguments_name, word));
        row->set(settings, fmt::format("{}: {}", arguments_name, word),
                 row->is_switch() ? "true" : words[++i]);
    }
    return settings;
}

void check_schema(const MetadataValue& value)
{
    const int* const schema = std::get_if<int>(&value);
    if (!schema || *schema < 2) throw Error(fmt::format("{} must be an integer from 2", schema_name));
    if (*schema > settings_schema)
        throw Error(fmt::format("{} is {}, and this program reads versions up to {}", schema_name, *schema,
                                settings_schema));
}

} // namespace

bool is_settings_entry(std::string_view name)
{
    return name == schema_name || name == arguments_name || name.starts_with(prefix);
}

Metadata settings_header(const RenderSettings& settings)
{
    Metadata header = {{std::string(schema_name), settings_schema}};
    for (const Row& row : setting_rows<RenderSettings>()) {
        const std::vector<std::string> values = row.get(settings);
        if (values.empty()) continue;
        std::string text;
        for (const std::string& value : values)
            text += (&value == values.data() ? "" : "\n") + escaped(valid_utf8(value));
        header.emplace_back(fmt::format("{}{}", prefix, row.name), text);
    }
    return header;
}

RenderSettings settings_of_header(const Metadata& header)
{
    const MetadataValue* const schema = find(header, schema_name);
    const MetadataValue* const arguments = find(header, arguments_name);
    if (schema && arguments)
        throw Error(fmt::format("{} and {} cannot be used together", schema_name, arguments_name));
    RenderSettings settings;
    if (arguments) settings = settings_of_arguments(text_of(std::string(arguments_name), *arguments));
    if (schema) check_schema(*schema);
    for (const auto& [name, value] : header) {
        if (!name.starts_with(prefix)) continue;
        if (!schema) throw Error(fmt::format("{} needs {}", name, schema_name));
        const Row* const row = find_setting<RenderSettings>(std::string_view(name).substr(prefix.size()));
        if (!row) throw Error(fmt::format("{} is not a setting of an image", name));
        const std::string_view text = text_of(name, value);
        for (std::size_t start = 0; start <= text.size();) {
            const std::size_t end =
                row->repeatable ? std::min(text.find('\n', start), text.size()) : text.size();
            row->set(settings, name, unescaped(name, text.substr(start, end - start)));
            start = end + 1;
        }
    }
    return settings;
}

} // namespace plumb
