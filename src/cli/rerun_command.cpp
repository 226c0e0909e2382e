// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/header.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/text.h"

#include <map>

#include <fmt/format.h>

namespace plumb {

namespace {

// What the header of a picture says of how it was made.
struct Recipe {
    std::string software;
    std::string scene;
    std::string arguments;
    std::string inputs;
    std::string input_hash;
};

Recipe read_recipe(const std::string& image_file)
{
    const Image image = read_image(image_file, false);
    const std::map<std::string, MetadataValue> header(image.metadata.begin(), image.metadata.end());
    const auto text = [&](const char* name) {
        const auto found = header.find(name);
        const auto* value = found == header.end() ? nullptr : std::get_if<std::string>(&found->second);
        return value ? *value : std::string();
    };
    const Recipe recipe{text("Software"), text("plumb:scene"), text("plumb:arguments"), text("plumb:inputs"),
                        text("plumb:inputHash")};
    if (recipe.scene.empty() || recipe.inputs.empty())
        throw Error(fmt::format(
            "the header of '{}' does not say how the picture was made; the .exr files that Plumb renders do",
            image_file));
    if (recipe.software != "Plumb " PLUMB_VERSION)
        throw Error(fmt::format("'{}' was rendered by {}, and this is Plumb {}, whose pictures may differ",
                                image_file, recipe.software, PLUMB_VERSION));
    return recipe;
}

// Where the scene file was: seen from this folder, or from the picture's.
std::string find_scene(const Options& options, const Recipe& recipe)
{
    if (!options.scene.empty()) return options.scene;
    const std::filesystem::path beside = std::filesystem::path(options.subject).parent_path() / recipe.scene;
    std::error_code ignored;
    for (const std::filesystem::path& path : {std::filesystem::path(recipe.scene), beside})
        if (std::filesystem::exists(path, ignored)) return path.string();
    throw Error(
        fmt::format("there is no scene file '{}', neither here nor beside '{}'; say where it is with --scene",
                    recipe.scene, options.subject));
}

// The options that made the picture, with what is said of this run.
Options options_of(const Recipe& recipe, const Options& run)
{
    std::vector<std::string> words = shell_split(recipe.arguments);
    words.insert(words.begin(), find_scene(run, recipe));
    Options options = parse_options(std::move(words));
    options.scene_name = recipe.scene;
    options.outputs = run.outputs;
    options.json = run.json;
    options.quiet = run.quiet;
    options.verbose = run.verbose;
    options.render.threads = run.render.threads;
    return options;
}

std::map<std::string, std::string> hash_of_name(const std::string& inputs)
{
    std::map<std::string, std::string> hashes;
    for (std::size_t begin = 0; begin < inputs.size();) {
        const std::size_t end = std::min(inputs.find('\n', begin), inputs.size());
        const std::size_t space = std::min(inputs.find(' ', begin), end);
        hashes.emplace(inputs.substr(std::min(space + 1, end), end - std::min(space + 1, end)),
                       inputs.substr(begin, space - begin));
        begin = end + 1;
    }
    return hashes;
}

// Throws Error with every file that is not what it was.
void check_inputs(const LoadedScene& scene, const Recipe& recipe, const Options& options)
{
    std::map<std::string, std::string> expected = hash_of_name(recipe.inputs);
    std::vector<std::string> changes;
    for (const InputFile& input : scene.inputs) {
        const std::string name = input_name(input.path, options.subject);
        const auto found = expected.find(name);
        if (found == expected.end())
            changes.push_back(fmt::format("'{}' was not read then", name));
        else if (found->second != input.hash)
            changes.push_back(fmt::format("'{}' has changed", name));
        if (found != expected.end()) expected.erase(found);
    }
    for (const auto& [name, hash] : expected) changes.push_back(fmt::format("'{}' is no longer read", name));
    if (changes.empty() && scene.input_hash != recipe.input_hash)
        changes.emplace_back("the dialect's readings have changed");
    if (!changes.empty()) throw Error(fmt::format("the scene is not what it was: {}", list_text(changes)));
}

} // namespace

std::string_view rerun_manual()
{
    return "Renders a picture of ours again from what its header says, to the same file, byte for byte.\n"
           "The scene file is looked for where it was, seen from this folder or from the picture's; if\n"
           "it, a mesh, an image or this program is not what it was, the error names it.\n";
}

int rerun_command(const Options& run)
{
    const Recipe recipe = read_recipe(run.subject);
    keep_inputs({run.subject}, run.outputs, run.json, "it is the picture to be rendered again");
    check_outputs(run.outputs, run.json);
    const Options options = options_of(recipe, run);
    const LoadedScene scene = load_and_log(options);
    check_inputs(scene, recipe, options);
    log_rendering(options, render_and_write(options, scene));
    return exit_code::done;
}

} // namespace plumb
