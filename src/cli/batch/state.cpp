// SPDX-License-Identifier: MIT
#include "cli/batch/state.h"

#include "cli/text_file.h"

#include "plumb/hash.h"
#include "plumb/image.h"

#include <fmt/format.h>
#include <fstream>

namespace plumb {

namespace {

constexpr std::string_view first_line = "Plumb batch state 1";

// Of the bytes of the files, one after the other; empty if one cannot be read.
std::string hash_of_files(const std::vector<std::string>& files)
{
    Hash128 hash;
    std::vector<char> block(1 << 20);
    for (const std::string& name : files) {
        std::ifstream file(name, std::ios::binary);
        if (!file) return {};
        while (file) {
            file.read(block.data(), static_cast<std::streamsize>(block.size()));
            hash.update({block.data(), static_cast<std::size_t>(file.gcount())});
        }
        if (!file.eof()) return {};
    }
    return hash.hex();
}

const std::string& hash_of_program()
{
    static const std::string hash = hash_of_files({"/proc/self/exe", ImageLibrary::file()});
    return hash;
}

} // namespace

std::string picture_key(const Options& options, const LoadedScene& scene)
{
    Hash128 hash;
    for (const std::string& part :
         {std::string(PLUMB_VERSION), hash_of_program(), options.subject, scene.input_hash,
          options.picture_words, std::to_string(scene.job.sampler->samples_per_pixel()),
          std::to_string(options.render.seed), scene.job.scene.options().instruction_set,
          scene.job.scene.embree_version()})
        hash.update(fmt::format("{}:{}", part.size(), part));
    return hash.hex();
}

BatchState::BatchState(const std::filesystem::path& folder) : file_(folder / "state.txt")
{
    std::ifstream stream(file_);
    std::string line;
    if (!std::getline(stream, line) || line != first_line) return;
    constexpr std::size_t hashes = 32 + 1 + 32;
    while (std::getline(stream, line))
        if (line.size() > hashes + 1) lines_[line.substr(hashes + 1)] = line.substr(0, hashes);
}

bool BatchState::is_up_to_date(const std::string& title, const std::string& key,
                               const std::vector<std::string>& files) const
{
    const auto found = lines_.find(title);
    return found != lines_.end() && found->second == key + " " + hash_of_files(files);
}

void BatchState::note(const std::string& title, const std::string& key, const std::vector<std::string>& files)
{
    lines_[title] = key + " " + hash_of_files(files);
    std::string text = std::string(first_line) + "\n";
    for (const auto& [name, hashes] : lines_) text += hashes + " " + name + "\n";
    write_text_file(file_, text);
}

} // namespace plumb
