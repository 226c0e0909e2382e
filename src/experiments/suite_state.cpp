// SPDX-License-Identifier: MIT
#include "experiments/suite_state.h"

#include "base/regular_file.h"
#include "base/text_file.h"
#include "rendering/program.h"
#include "settings/options_text.h"

#include "plumb/base/hash.h"
#include "plumb/scene/scene.h"

#include <fmt/format.h>
#include <fstream>

namespace plumb {

namespace {

constexpr std::string_view first_line = "Plumb batch state 1";

} // namespace

std::string image_key(const RenderTask& task)
{
    const LoadedScene& scene = task.scene;
    Hash128 hash;
    for (const std::string& part :
         {std::string(PLUMB_VERSION), hash_of_program(), task.file, scene.input_hash,
          options_text(task.settings), std::to_string(task.options.samples_per_pixel),
          scene.job.scene->options().instruction_set, scene.job.scene->embree_version()})
        hash.update(fmt::format("{}:{}", part.size(), part));
    return hash.hex();
}

SuiteState::SuiteState(const std::filesystem::path& directory) : file_(directory / "state.txt")
{
    if (!problem_of_file(file_).empty()) return;
    std::ifstream stream(file_);
    std::string line;
    if (!std::getline(stream, line) || line != first_line) return;
    constexpr std::size_t hashes = 32 + 1 + 32;
    while (std::getline(stream, line))
        if (line.size() > hashes + 1) lines_[line.substr(hashes + 1)] = line.substr(0, hashes);
}

bool SuiteState::is_up_to_date(const std::string& title, const std::string& key,
                               const std::vector<std::string>& files) const
{
    const auto found = lines_.find(title);
    return found != lines_.end() && found->second == key + " " + hash_of_files({files.begin(), files.end()});
}

void SuiteState::note(const std::string& title, const std::string& key, const std::vector<std::string>& files)
{
    lines_[title] = key + " " + hash_of_files({files.begin(), files.end()});
    std::string text = std::string(first_line) + "\n";
    for (const auto& [name, hashes] : lines_) text += hashes + " " + name + "\n";
    write_text_file(file_, text);
}

} // namespace plumb
