// SPDX-License-Identifier: MIT
#include "suite_file/foreign_attributes.h"

#include "settings/parse_value.h"
#include "suite_file/suite_names.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::uint64_t most_replicas = 1000;
constexpr std::size_t most_inputs = 10'000;

// The files that a list of names and patterns means.
std::vector<std::filesystem::path> find_inputs(const std::filesystem::path& directory,
                                               const SuiteSetting& list, Diagnostics& diagnostics)
{
    std::vector<std::filesystem::path> inputs;
    for (const std::string_view word : words_of(list.value)) {
        const NamedFile named = find_scene(directory, std::string(word));
        std::vector<std::filesystem::path> files = {named.path};
        if (is_pattern(word)) files = matching_files(named.path);
        if (files.empty()) diagnostics.error(list.at, fmt::format("no file matches '{}'", word));
        inputs.insert(inputs.end(), files.begin(), files.end());
        if (inputs.size() <= most_inputs) continue;
        diagnostics.error(list.at, fmt::format("an image has at most {} inputs", most_inputs));
        return inputs;
    }
    return inputs;
}

} // namespace

void ForeignAttributes::take(const Element& element, Diagnostics& diagnostics)
{
    const Attribute* command = element.attribute("command");
    const Attribute* image = element.attribute("image");
    if (command && image && !command->value.empty() && !image->value.empty())
        diagnostics.error(element.name_place(*image),
                          "an image is either there or made by a command; remove 'image' or 'command'");
    if (command) attributes_.erase("image");
    if (image) attributes_.erase("command");
    for (const std::string_view name : foreign_names) {
        const Attribute* attribute = element.attribute(name);
        if (!attribute) continue;
        if (attribute->value.empty())
            attributes_.erase(std::string(name));
        else
            attributes_[std::string(name)] = {{attribute->value, element.value_place(*attribute)},
                                              element.file->directory()};
    }
}

std::optional<ForeignImage> ForeignAttributes::read(Diagnostics& diagnostics) const
{
    ForeignImage foreign;
    bool is_right = true;
    const auto with = [&](std::string_view name, const auto& use) {
        const auto found = attributes_.find(name);
        if (found == attributes_.end()) return;
        try {
            use(found->second);
        } catch (const Error& problem) {
            diagnostics.error(found->second.setting.at, problem.what());
            is_right = false;
        }
    };
    with("command", [&](const Given& given) {
        foreign.command = given.setting.value;
        foreign.at = given.setting.at;
    });
    with("image", [&](const Given& given) {
        foreign.image = given.setting.value;
        foreign.at = given.setting.at;
    });
    with("replicas", [&](const Given& given) {
        foreign.replicas = static_cast<int>(parse_integer("replicas", given.setting.value, 1, most_replicas));
    });
    with("timeout",
         [&](const Given& given) { foreign.timeout = parse_duration("timeout", given.setting.value); });
    with("inputs", [&](const Given& given) {
        foreign.inputs = find_inputs(given.directory, given.setting, diagnostics);
        foreign.inputs_at = given.setting.at;
    });
    if (!is_right) return {};
    return foreign;
}

} // namespace plumb
