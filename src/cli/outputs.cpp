// SPDX-License-Identifier: MIT
#include "cli/outputs.h"

#include "base/regular_file.h"
#include "base/text_file.h"
#include "cli/console.h"
#include "cli/usage_error.h"
#include "rendering/output_files.h"

#include "plumb/image/image.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace plumb {

namespace {

bool is_file(const std::string& json)
{
    return !json.empty() && json != "-";
}

} // namespace

void check_output_names(const std::vector<std::string>& outputs,
                        const std::vector<std::pair<std::string_view, std::string>>& others)
{
    std::vector<std::pair<std::filesystem::path, std::string>> seen;
    const auto check = [&](const std::string& file, std::string_view option) {
        if (file.empty()) throw UsageError(fmt::format("{} needs a file name", option));
        const auto path = std::filesystem::path(file).lexically_normal();
        for (const auto& [other, name] : seen)
            if (other == path) throw UsageError(fmt::format("'{}' is listed as an output twice", name));
        seen.emplace_back(path, file);
    };
    for (const std::string& file : outputs) check(file, "--output");
    for (const auto& [option, file] : others)
        if (is_file(file)) check(file, option);
}

void check_outputs(const std::vector<std::string>& images, const std::string& json)
{
    for (const std::string& image : images) check_image_path(image);
    if (is_file(json)) check_text_path(json);
    if (const auto twice = listed_twice(with_json(images, json)))
        throw UsageError(fmt::format("'{}' is listed as an output twice", *twice));
}

std::vector<std::string> with_json(std::vector<std::string> images, const std::string& json)
{
    if (is_file(json)) images.push_back(json);
    return images;
}

std::string json_destination_of_errors(const std::vector<std::string>& words)
{
    constexpr std::string_view option = "--json";
    std::string found;
    for (std::size_t i = 0; found.empty() && i < words.size(); ++i) {
        if (words[i].starts_with(std::string(option) + "=")) found = words[i].substr(option.size() + 1);
        if (words[i] == option && i + 1 < words.size() && !words[i + 1].starts_with("--"))
            found = words[i + 1];
    }
    std::error_code ignored;
    if (!is_file(found) || !std::filesystem::exists(found, ignored)) return found;
    if (!problem_of_file(found).empty()) return {};
    constexpr std::string_view ours = "{\n  \"schema\": ";
    std::string start(ours.size(), '\0');
    std::ifstream(found).read(start.data(), static_cast<std::streamsize>(start.size()));
    return start == ours ? found : "";
}

void write_json(const std::string& json, std::string_view text)
{
    if (json == "-")
        print_output(text);
    else if (is_file(json))
        write_text_file(json, text);
}

} // namespace plumb
