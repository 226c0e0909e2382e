// SPDX-License-Identifier: MIT
#pragma once

// Rendering a loaded scene.

#include "plumb/camera.h"
#include "plumb/film.h"
#include "plumb/filter.h"
#include "plumb/integrator.h"
#include "plumb/sampler.h"
#include "plumb/tracer.h"

#include <functional>
#include <memory>
#include <optional>

namespace plumb {

// Everything that a picture depends on, but for the seed and the number of samples.
struct RenderJob {
    Scene scene;
    std::unique_ptr<Camera> camera;
    std::unique_ptr<Integrator> integrator;
    std::unique_ptr<Sampler> sampler;
    std::unique_ptr<Filter> filter;
};

struct RenderOptions {
    std::uint64_t samples_per_pixel = 0; // 0: what the sampler says
    std::uint64_t seed = 0;
    int threads = 0;               // 0: all
    int tile_size = 32;            // pixels; changes no bit of the picture
    std::optional<PixelRect> crop; // inside the picture
};

// Samples that were left out of the film. `first` is the smallest in the order (row, column, sample index).
struct LeftOut {
    struct Sample {
        Vec2i pixel;
        std::uint64_t index = 0;
        Color value;
        Verdict verdict = Verdict::accepted;
    };
    std::uint64_t count = 0;
    Sample first; // meaningless when count is 0

    void add(const Sample& sample);
    LeftOut& operator+=(const LeftOut& other);
};

struct Progress {
    std::uint64_t samples_done = 0;
    std::uint64_t samples_total = 0;
    std::uint64_t rays = 0;
    double seconds = 0.0;
};
// Called from one thread at a time, between tiles.
using ProgressReport = std::function<void(const Progress&)>;

struct RenderResult {
    Film film;
    RayCounts rays;
    LeftOut left_out;
    double seconds = 0.0;
    int threads = 0;
};

// The picture depends on job, seed, samples_per_pixel and nothing else: not on threads, tiles or crop.
// Throws Error for options that make no sense (a crop outside the picture, too many samples) or too little memory.
RenderResult render(const RenderJob& job, const RenderOptions& options, const ProgressReport& progress = {});

// One sample of one pixel, exactly as render() takes it: its value, its filter weight and, in `log`, its path.
struct ReplayedSample {
    Color value;
    Vec2f raster;
    float weight = 1.f;
    Verdict verdict = Verdict::accepted;
    std::vector<PathEvent> log;
};
ReplayedSample replay(const RenderJob& job, std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index);

} // namespace plumb
