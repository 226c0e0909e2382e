// SPDX-License-Identifier: MIT
#include "rendering/checkpoint.h"

#include "base/temporary_file.h"
#include "base/text.h"
#include "rendering/provenance.h"

#include "plumb/base/error.h"

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path)
{
    std::error_code ignored;
    return fs::exists(path, ignored);
}

// The file gets a second name; it keeps the first. Where the file system has no such links, the name is changed: then
// there is an instant without the last generation, but with this one.
void keep_as(const fs::path& file, const fs::path& name)
{
    const fs::path other = unfinished_name(name, "previous");
    std::error_code failed;
    fs::remove(other, failed);
    fs::create_hard_link(file, other, failed);
    if (failed)
        fs::rename(file, name, failed);
    else
        fs::rename(other, name, failed);
    if (failed) throw Error(fmt::format("cannot write '{}': {}", name.string(), failed.message()));
}

} // namespace

fs::path previous_generation(const fs::path& checkpoint)
{
    fs::path path = checkpoint;
    return path.replace_filename(checkpoint.stem().string() + ".previous" + checkpoint.extension().string());
}

std::optional<fs::path> generation_there(const fs::path& checkpoint)
{
    for (const fs::path& generation : {checkpoint, previous_generation(checkpoint)})
        if (is_there(generation)) return generation;
    return std::nullopt;
}

void keep_previous(const fs::path& checkpoint, const Metadata& header)
{
    const fs::path previous = previous_generation(checkpoint);
    if (!is_there(previous)) return;
    const std::optional<Metadata> there = read_state_header(previous);
    if (!there || !sample_changes(*there, header).empty())
        throw Error(fmt::format("cannot write '{}': the previous state is kept as '{}', which is {}",
                                checkpoint.string(), previous.string(),
                                there ? "the state of another rendering" : "another file"));
}

void save_checkpoint(const fs::path& path, const RenderState& state, Vec2i resolution, const Metadata& header)
{
    TemporaryFile file(path);
    std::vector<unsigned char> bytes;
    try {
        bytes = encode_state(state, resolution, header);
    } catch (const Error& error) {
        throw Error(fmt::format("cannot write '{}': {}", path.string(), error.what()));
    }
    file.write(std::span<const unsigned char>(bytes));
    file.flush();
    if (is_there(path)) keep_as(path, previous_generation(path));
    file.take_place();
    flush_directory_of(path);
}

std::optional<LoadedCheckpoint> load_checkpoint(const fs::path& path)
{
    const fs::path previous = previous_generation(path);
    if (!is_there(path) && !is_there(previous)) return std::nullopt;
    std::string problem;
    for (const fs::path& generation : {path, previous}) {
        try {
            return LoadedCheckpoint{read_state(generation), generation, problem};
        } catch (const Error& error) {
            if (!problem.empty())
                throw Error(fmt::format("{}; and the previous checkpoint: {}", problem, error.what()));
            problem = error.what();
        }
    }
    return std::nullopt;
}

} // namespace plumb
