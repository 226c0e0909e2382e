// SPDX-License-Identifier: MIT
#include "reports/type_parameters.h"

#include "base/text.h"
#include "scene_file/catalog.h"

#include <algorithm>
#include <array>

namespace plumb {

namespace {

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

TypeParameter parameter_of(std::string_view row)
{
    const auto [name, type, rest] = columns_of(row);
    TypeParameter parameter{std::string(name), std::string(type), std::string(rest), {}};
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
TypeParameter find_parameter(const std::vector<std::string>& rows, std::string_view name)
{
    for (const std::string& row : rows) {
        if (!row.starts_with("    ")) continue;
        const std::string_view text = trimmed(row);
        if (text.starts_with(name) && text.substr(name.size()).starts_with(' ')) return parameter_of(row);
    }
    return {std::string(name), {}, {}, {}};
}

} // namespace

std::vector<TypeParameter> parameters_of(const TypeInfo& type)
{
    const std::vector<std::string> rows = lines_of(type.manual);
    std::vector<TypeParameter> parameters;
    for (const std::string_view name : parameters_in(type.manual))
        parameters.push_back(find_parameter(rows, name));
    return parameters;
}

} // namespace plumb
