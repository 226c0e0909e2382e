// SPDX-License-Identifier: MIT
#include "cli/outputs.h"

#include "base/text_file.h"
#include "cli/console.h"
#include "cli/usage_error.h"
#include "rendering/output_files.h"

#include "plumb/image/image.h"

#include <filesystem>
#include <fmt/format.h>

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

void write_json(const std::string& json, std::string_view text)
{
    if (json == "-")
        print_output(text);
    else if (is_file(json))
        write_text_file(json, text);
}

} // namespace plumb
