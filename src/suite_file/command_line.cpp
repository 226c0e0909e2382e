// SPDX-License-Identifier: MIT
#include "suite_file/command_line.h"

#include "plumb/base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace plumb {

namespace {

// Calls `text` for what stands between the placeholders, and `name` for each of them.
void scan(std::string_view rest, const std::function<void(std::string_view)>& text,
          const std::function<void(std::string_view)>& name)
{
    while (!rest.empty()) {
        const std::size_t at = std::min(rest.find_first_of("{}"), rest.size());
        text(rest.substr(0, at));
        rest.remove_prefix(at);
        if (rest.empty()) return;
        if (rest.size() > 1 && rest[1] == rest[0]) {
            text(rest.substr(0, 1));
            rest.remove_prefix(2);
            continue;
        }
        const std::size_t end = rest.find('}');
        if (rest[0] == '}' || end == rest.npos)
            throw Error(fmt::format("a single '{0}' stands in it; write {0}{0} for the character", rest[0]));
        name(rest.substr(1, end - 1));
        rest.remove_prefix(end + 1);
    }
}

} // namespace

std::vector<std::string> command_words(std::string_view command)
{
    constexpr std::string_view space = " \t\r\n";
    std::vector<std::string> words;
    bool inside = false;
    char quote = 0;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (quote == 0 && space.find(c) != space.npos) {
            inside = false;
            continue;
        }
        if (!inside) words.emplace_back();
        inside = true;
        if (quote == 0 && (c == '\'' || c == '"'))
            quote = c;
        else if (c == quote)
            quote = 0;
        else if (c == '\\' && quote != '\'' && i + 1 < command.size())
            words.back() += command[++i];
        else
            words.back() += c;
    }
    if (quote != 0) throw Error(fmt::format("the quotation mark {} is not closed", quote));
    return words;
}

std::vector<std::string> placeholders_in(std::string_view text)
{
    std::vector<std::string> names;
    scan(
        text, [](std::string_view) {},
        [&](std::string_view name) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
        });
    return names;
}

std::string with_placeholders(std::string_view text, const Placeholders& values)
{
    std::string result;
    scan(
        text, [&](std::string_view part) { result += part; },
        [&](std::string_view name) {
            const auto found = values.find(name);
            if (found != values.end()) {
                result += found->second;
                return;
            }
            std::vector<std::string_view> known;
            for (const auto& [one, value] : values) known.push_back(one);
            throw Error(fmt::format("unknown placeholder '{{{}}}'{}", name, way_out(name, known)));
        });
    return result;
}

} // namespace plumb
