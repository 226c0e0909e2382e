// SPDX-License-Identifier: MIT
#pragma once

// What verbs print that render no whole image, as JSON: docs/json.md.

#include "plumb/check/check.h"
#include "plumb/image/image.h"
#include "plumb/rendering/task.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

std::string info_json(const std::string& file, const Image& image);

// only: the types and the element of this name; empty: all.
std::string types_json(std::string_view only = {});

// What rendering takes, in bytes.
struct MemoryNeeds {
    double scene = 0.0; // and the program
    double image = 0.0; // film and image
};
std::string check_json(const RenderTask& task, const std::vector<Doubt>& doubts, const MemoryNeeds& memory);

struct ReplayedPlace {
    Vec2i pixel;
    std::uint64_t sample = 0;
};
std::string replay_json(const RenderTask& task, const ReplayedPlace& place, const ReplayedSample& sample);
std::string_view event_word(PathEvent::Kind kind);

} // namespace plumb
