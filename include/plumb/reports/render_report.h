// SPDX-License-Identifier: MIT
#pragma once

// The report of a run that --json writes: what the header of an image does not say, times and machine included.

#include "plumb/rendering/session.h"
#include "plumb/scene/scene.h"

#include <string>
#include <vector>

namespace plumb {

struct Report {
    std::string scene; // as given
    std::string input_hash;
    Dialect dialect;
    std::string integrator;
    std::string sampler;
    bool noise_is_bound = false;    // for the sampler's samples are not independent
    std::optional<double> adaptive; // RenderOptions::adaptive
    std::uint64_t seed = 0;
    Vec2i resolution;
    std::optional<PixelRect> crop;
    std::uint64_t triangles = 0;
    double parse_seconds = 0.0;
    double build_seconds = 0.0;
    double render_seconds = 0.0;
    double write_seconds = 0.0;
    double total_seconds = 0.0;
    RayCounts rays;
    Evidence evidence;
    bool is_black = false;  // no sample of any pixel saw light
    std::size_t lights = 0; // of the scene
    int threads = 0;
    std::string instruction_set;
    std::string embree_version;
    std::vector<std::string> outputs;
    SceneMemory memory;
    std::uint64_t texture_bytes = 0;
    std::uint64_t film_bytes = 0;
    std::uint64_t peak_memory = 0; // bytes, of the whole process
    std::string host;
    std::string finished; // UTC, ISO 8601
};

// All but outputs, times of writing and in total, and what note_machine() fills in.
Report make_report(const RenderSession& session, Evidence evidence);
void note_machine(Report& report); // peak memory, host and time, now

std::string report_json(const Report& report);

// For people, a line each: what was read, and how the rendering went.
std::vector<std::string> facts_of(const RenderTask& task);
std::vector<std::string> summary_of(const Report& report, const RenderTask& task);

} // namespace plumb
