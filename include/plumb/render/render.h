// SPDX-License-Identifier: MIT
#pragma once

// Rendering a loaded scene.

#include "plumb/model/camera.h"
#include "plumb/model/filter.h"
#include "plumb/model/integrator.h"
#include "plumb/model/sampler.h"
#include "plumb/render/film.h"
#include "plumb/render/light_split.h"
#include "plumb/render/sample_set.h"
#include "plumb/scene/path_event.h"
#include "plumb/scene/ray_counts.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

class Outlines;
class Scene;

// Everything that an image depends on, but for the seed and the number of samples. Cheap to copy; several jobs may share
// what they have in common.
struct RenderJob {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Camera> camera;
    std::shared_ptr<const Integrator> integrator; // prepared for the scene
    std::shared_ptr<const Sampler> sampler;
    std::shared_ptr<const Filter> filter;
};

struct RenderOptions {
    std::uint64_t samples_per_pixel = 0; // 0: what the scene file says
    std::uint64_t seed = 0;
    int threads = 0;                // 0: all
    int tile_size = 32;             // pixels; changes no bit of the image
    std::optional<PixelRect> crop;  // inside the image
    std::vector<std::string> aovs;  // names of layers: aovs.h
    std::vector<LightSplit> splits; // more layers: light_split.h
    // Each pixel decides how many of the samples it gets (adaptive.h), by this target; samples_per_pixel is the maximum.
    std::optional<double> adaptive;
};

// Samples that were left out of the film. `first` is the smallest in the order (row, column, sample index).
struct LeftOut {
    struct Sample {
        Vec2i pixel;
        std::uint64_t index = 0;
        Color value;
        SampleStatus status = SampleStatus::accepted;
    };
    std::uint64_t count = 0;
    Sample first; // meaningless when count is 0

    void add(const Sample& sample);
    LeftOut& operator+=(const LeftOut& other);
};

// What has been rendered so far: enough to make the image, and to resume.
struct RenderState {
    Film film;
    // Those left out included. Of a film with plans: the samples that are settled, which those beyond a pixel's plan are
    // without being taken.
    SampleSet taken;
    RayCounts rays;
    LeftOut left_out;
    double seconds = 0.0; // of rendering

    // How many samples were taken for the image, those left out included.
    std::uint64_t samples() const;

    // Adds the work of another; of the same job, seed and window, and with none of its samples.
    RenderState& operator+=(const RenderState& other);
};

struct Progress {
    std::uint64_t samples_done = 0;
    std::uint64_t samples_total = 0;
    std::uint64_t samples_before = 0; // of those done, before `seconds` began
    std::uint64_t rays = 0;           // in `seconds`
    double seconds = 0.0;
};
// Called from one thread at a time, between tiles.
using ProgressReport = std::function<void(const Progress&)>;
// Called from all threads with pixels to which nobody adds meanwhile: Film::develop(part) shows them.
using TileReport = std::function<void(const Film& film, const PixelRect& part)>;
// Asked from all threads, for each row of a tile: whether to stop soon.
using Pause = std::function<bool()>;

// The pixels that the options want of the job's image, which layers, and how many samples of each. They throw Error for a crop
// outside the image, for layers that the job does not have, and for too many samples.
PixelRect render_window(const RenderJob& job, const RenderOptions& options);
ChannelSet render_layers(const RenderJob& job, const RenderOptions& options);
std::uint64_t render_samples(const RenderJob& job, const RenderOptions& options);
int render_threads(const RenderOptions& options);

// An image in the making. What a set of samples gives depends on job, seed, `adaptive` and the set, and on nothing else:
// not on threads, tiles, crop, or the order and the calls in which they are taken. With `adaptive` a pixel has those samples
// of the set that are before the end of its plan, and each of them is what it is without.
class Rendering {
public:
    // Throws what render_window() and render_layers() throw, and Error if memory is short.
    Rendering(const RenderJob& job, const RenderOptions& options);
    // Resumes from a state of the same job, seed, window and `adaptive`. Throws Error if it does not have the layers of the
    // options, or if only one of them is adaptive.
    Rendering(const RenderJob& job, const RenderOptions& options, RenderState state);
    Rendering(const Rendering&) = delete;
    Rendering& operator=(const Rendering&) = delete;
    ~Rendering();

    // Takes what has not been taken of the wanted samples, until pause says so. Whether all of them are taken now.
    bool take(const SampleSet& wanted, const ProgressReport& progress = {}, const Pause& pause = {},
              const TileReport& tile = {});

    const RenderState& state() const { return state_; }
    RenderState finish() && { return std::move(state_); }

private:
    const RenderJob job_;
    const RenderOptions options_;
    RenderState state_;
    std::unique_ptr<Outlines> outlines_; // from the first take() on
};

// All samples that the options ask for.
RenderState render(const RenderJob& job, const RenderOptions& options, const ProgressReport& progress = {});

// One sample of one pixel, exactly as render() takes it with these options: its value, its filter weight and, in `log`, its path.
struct ReplayedSample {
    Color value;
    Vec2f raster;
    float weight = 1.f;
    SampleStatus status = SampleStatus::accepted;
    std::vector<PathEvent> log;
};
ReplayedSample replay(const RenderJob& job, const RenderOptions& options, Vec2i pixel,
                      std::uint64_t sample_index);

} // namespace plumb
