// SPDX-License-Identifier: MIT
#include "experiments/foreign_command.h"

#include "base/shell_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace plumb {

namespace {

namespace fs = std::filesystem;

// A placeholder, and what an entry lacks that has no value for it.
struct Known {
    std::string_view name;
    std::string_view needs;
    bool is_of_images = false; // may stand in the name of an image that is there
};
constexpr Known known[] = {{"image", "", false},
                           {"name", "", true},
                           {"scene", R"(scene="...")", false},
                           {"input", R"(inputs="...")", false},
                           {"seed", "", true},
                           {"replica", "", true},
                           {"spp", R"(spp="...")", true},
                           {"width", R"(size="WxH")", true},
                           {"height", R"(size="WxH")", true},
                           {"threads", "", false},
                           {"directory", "", true}};

Placeholders values_of(const ForeignRequest& request, int replica)
{
    Placeholders values;
    values["name"] = request.name;
    values["replica"] = std::to_string(replica + 1);
    values["seed"] = std::to_string(request.seed + static_cast<std::uint64_t>(replica));
    values["directory"] = directory_of(request.foreign).string();
    if (!request.scene.empty()) values["scene"] = fs::absolute(request.scene).lexically_normal().string();
    if (!request.foreign.inputs.empty())
        values["input"] = fs::absolute(request.foreign.inputs.front()).lexically_normal().string();
    if (request.samples) values["spp"] = std::to_string(*request.samples);
    if (request.size) {
        values["width"] = std::to_string(request.size->x);
        values["height"] = std::to_string(request.size->y);
    }
    return values;
}

// What keeps the placeholders of the text from having values; empty: nothing does.
std::string problem_of(const ForeignRequest& request, std::string_view text, bool is_command)
{
    Placeholders values = values_of(request, 0);
    if (is_command) values["image"] = values["threads"] = "1";
    for (const std::string& name : placeholders_in(text)) {
        if (values.contains(name)) continue;
        std::vector<std::string_view> names;
        for (const Known& one : known)
            if (is_command || one.is_of_images) names.push_back(one.name);
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            return fmt::format("unknown placeholder '{{{}}}'{}", name, way_out(name, names));
        const auto* const row = std::find_if(std::begin(known), std::end(known),
                                             [&](const Known& one) { return one.name == name; });
        return fmt::format("'{{{}}}' has no value here; add {}", name, row->needs);
    }
    return {};
}

bool has_placeholder(std::string_view text, std::initializer_list<std::string_view> any)
{
    const std::vector<std::string> names = placeholders_in(text);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return std::find(any.begin(), any.end(), name) != any.end();
    });
}

std::string problem_of(const ForeignRequest& request)
{
    const ForeignImage& foreign = request.foreign;
    const bool is_command = !foreign.command.empty();
    const std::string& text = is_command ? foreign.command : foreign.image;
    if (is_command && command_words(text).empty()) return "the command is empty";
    if (std::string problem = problem_of(request, text, is_command); !problem.empty()) return problem;
    if (is_command && !has_placeholder(text, {"image"}))
        return "the command does not say where to write; put {image} into it";
    if (foreign.replicas > 1 && !has_placeholder(text, {"seed", "replica"}))
        return fmt::format("{} replicas would be the same; put {{seed}} or {{replica}} into the {}",
                           foreign.replicas, is_command ? "command" : "name of the image");
    return {};
}

} // namespace

ForeignRequest request_of(const SuiteJob& job)
{
    return {job.entry.name,
            job.entry.scene,
            *job.entry.foreign,
            job.image.samples.seed,
            job.image.samples.per_pixel,
            job.image.view.size};
}

fs::path directory_of(const ForeignImage& foreign)
{
    const fs::path directory = fs::path(foreign.at.file).parent_path();
    return directory.empty() ? fs::current_path() : fs::absolute(directory).lexically_normal();
}

std::string foreign_problem(const ForeignRequest& request)
{
    try {
        return problem_of(request);
    } catch (const Error& error) {
        return error.what();
    }
}

std::vector<std::string> command_of(const ForeignRequest& request, int replica, const fs::path& image,
                                    int threads)
{
    Placeholders values = values_of(request, replica);
    values["image"] = image.string();
    values["threads"] = std::to_string(threads > 0 ? static_cast<unsigned>(threads)
                                                   : std::max(1U, std::thread::hardware_concurrency()));
    std::vector<std::string> words;
    for (const std::string& word : command_words(request.foreign.command))
        words.push_back(with_placeholders(word, values));
    return words;
}

std::vector<fs::path> given_images(const ForeignRequest& request)
{
    std::vector<fs::path> images;
    for (int replica = 0; replica < request.foreign.replicas; ++replica)
        images.emplace_back((fs::path(request.foreign.at.file).parent_path() /
                             with_placeholders(request.foreign.image, values_of(request, replica)))
                                .lexically_normal());
    return images;
}

std::string words_text(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_quote(word);
    return text;
}

} // namespace plumb
