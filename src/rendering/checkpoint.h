// SPDX-License-Identifier: MIT
#pragma once

// State files (state_file.h) on disk: two generations of each, so that one survives whatever happens.

#include "plumb/render/state_file.h"

#include <filesystem>
#include <optional>
#include <string>

namespace plumb {

// Where the generation before the last is kept: "a.previous.exr" for "a.exr".
std::filesystem::path previous_generation(const std::filesystem::path& checkpoint);

// The last generation that is there, if there is one: perhaps hours of work.
std::optional<std::filesystem::path> generation_there(const std::filesystem::path& checkpoint);

// Throws Error if the name of the previous generation is taken by what is none: another file, or the state of another
// rendering. header: of the one that is to be written.
void keep_previous(const std::filesystem::path& checkpoint, const Metadata& header);

// Writes the state beside `path`, waits until the disk has it, keeps the last generation as the previous one, and gives
// the new one its name: at no instant is there none. Throws Error; the generations there are stay as they are.
void save_checkpoint(const std::filesystem::path& path, const RenderState& state, Vec2i resolution,
                     const Metadata& header);

struct LoadedCheckpoint {
    StateFile file;
    std::filesystem::path generation; // that it is from
    std::string problem; // of the last generation, where it is damaged and this is the one before; else empty
};

// The state to resume from, or nothing if there is neither generation. Throws Error if there is a generation but none that
// is whole.
std::optional<LoadedCheckpoint> load_checkpoint(const std::filesystem::path& path);

} // namespace plumb
