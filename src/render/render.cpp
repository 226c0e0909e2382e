// SPDX-License-Identifier: MIT

// The only user of oneTBB.

#include "plumb/render.h"

#include "plumb/error.h"
#include "render/tiles.h"
#include "scene/float_mode.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <tuple>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace plumb {
namespace {

using Clock = std::chrono::steady_clock;

// Samples a pixel gets before the next tile's turn: few enough for a lively progress report, many enough for a tile
// to stay in the cache.
constexpr std::uint64_t samples_per_pass = 16;

struct SampleTaken {
    Color radiance;
    Vec2f raster;
    float weight;
};

// One sample: a pure function of job, seed, pixel and index.
SampleTaken take_sample(const RenderJob& job, Tracer& tracer, Sampler& sampler, std::uint64_t seed,
                        Vec2i pixel, std::uint64_t index)
{
    sampler.start(seed, pixel, index);
    const Vec2f u_filter = sampler.next_2d();
    const Vec2f u_lens = sampler.next_2d();
    const FilterSample place = job.filter->sample(u_filter);
    const Vec2f raster(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                       static_cast<float>(pixel.y) + 0.5f + place.offset.y);
    const CameraRay camera_ray = job.camera->sample_ray(raster, u_lens);
    Color radiance = job.integrator->radiance(tracer, sampler, camera_ray.ray) * camera_ray.weight;
    if (tracer.take_failure()) radiance = Color(std::numeric_limits<float>::quiet_NaN());
    return {radiance, raster, place.weight};
}

// What one thread needs and gathers.
struct Worker {
    Worker(const RenderJob& job) : tracer(job.scene), sampler(job.sampler->clone()) {}
    Tracer tracer;
    std::unique_ptr<Sampler> sampler;
    LeftOut left_out;
};

PixelRect checked_window(const RenderJob& job, const RenderOptions& options)
{
    const Vec2i size = job.camera->resolution();
    const PixelRect whole{0, 0, size.x, size.y};
    if (!options.crop) return whole;
    const PixelRect& c = *options.crop;
    if (c.width < 1 || c.height < 1 || c.x < 0 || c.y < 0 || c.x > size.x - c.width ||
        c.y > size.y - c.height)
        throw Error(fmt::format("the crop {},{},{},{} is not inside the picture of {}x{} pixels", c.x, c.y,
                                c.width, c.height, size.x, size.y));
    return c;
}

std::uint64_t checked_samples(const RenderJob& job, const RenderOptions& options)
{
    const std::uint64_t samples =
        options.samples_per_pixel != 0 ? options.samples_per_pixel : job.sampler->samples_per_pixel();
    if (samples < 1 || samples > film_max_samples)
        throw Error(fmt::format("samples per pixel must be from 1 to {}, not {}", film_max_samples, samples));
    return samples;
}

// One line of the picture's progress at a time, whichever thread is free to report it.
class Reporter {
public:
    Reporter(const ProgressReport& report, std::uint64_t total) : report_(report), total_(total) {}

    void add(std::uint64_t samples, std::uint64_t rays)
    {
        done_ += samples;
        rays_ += rays;
        if (!report_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock) report_({done_, total_, rays_, seconds()});
    }

    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    const ProgressReport& report_;
    const std::uint64_t total_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> rays_ = 0;
    std::mutex mutex_;
};

} // namespace

void LeftOut::add(const Sample& sample)
{
    const auto order = [](const Sample& s) { return std::tuple(s.pixel.y, s.pixel.x, s.index); };
    if (count == 0 || order(sample) < order(first)) first = sample;
    ++count;
}

LeftOut& LeftOut::operator+=(const LeftOut& other)
{
    if (other.count == 0) return *this;
    add(other.first);
    count += other.count - 1;
    return *this;
}

RenderResult render(const RenderJob& job, const RenderOptions& options, const ProgressReport& progress)
{
    const PixelRect window = checked_window(job, options);
    const std::uint64_t samples = checked_samples(job, options);
    const int threads = options.threads > 0 ? options.threads : oneapi::tbb::info::default_concurrency();
    const std::vector<PixelRect> tiles = cut_into_tiles(window, options.tile_size);
    const Vec2i size = job.camera->resolution();
    RenderResult result{Film(window, size.x, size.y), {}, {}, 0.0, threads};

    Reporter reporter(progress, samples * static_cast<std::uint64_t>(window.width) *
                                    static_cast<std::uint64_t>(window.height));
    oneapi::tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(job); });

    const auto render_tile = [&](const PixelRect& tile, std::uint64_t first, std::uint64_t last) {
        const FlushDenormals flush;
        Worker& worker = workers.local();
        const std::uint64_t rays_before = worker.tracer.counts().total();
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            for (int x = tile.x; x < tile.x + tile.width; ++x) {
                for (std::uint64_t index = first; index < last; ++index) {
                    const SampleTaken sample =
                        take_sample(job, worker.tracer, *worker.sampler, options.seed, {x, y}, index);
                    const Verdict verdict = result.film.add({x, y}, sample.radiance, sample.weight);
                    if (verdict != Verdict::accepted)
                        worker.left_out.add({{x, y}, index, sample.radiance, verdict});
                }
            }
        }
        const auto pixels = static_cast<std::uint64_t>(tile.width) * static_cast<std::uint64_t>(tile.height);
        reporter.add(pixels * (last - first), worker.tracer.counts().total() - rays_before);
    };

    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    arena.execute([&] {
        for (std::uint64_t first = 0; first < samples; first += samples_per_pass) {
            const std::uint64_t last = std::min(samples, first + samples_per_pass);
            oneapi::tbb::parallel_for(std::size_t{0}, tiles.size(),
                                      [&](std::size_t i) { render_tile(tiles[i], first, last); });
        }
    });

    for (const Worker& worker : workers) {
        result.rays += worker.tracer.counts();
        result.left_out += worker.left_out;
    }
    result.seconds = reporter.seconds();
    return result;
}

ReplayedSample replay(const RenderJob& job, std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index)
{
    const Vec2i size = job.camera->resolution();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
        throw Error(fmt::format("pixel {},{} is not inside the picture of {}x{} pixels", pixel.x, pixel.y,
                                size.x, size.y));
    const FlushDenormals flush;
    ReplayedSample replayed;
    Tracer tracer(job.scene, &replayed.log);
    const std::unique_ptr<Sampler> sampler = job.sampler->clone();
    const SampleTaken sample = take_sample(job, tracer, *sampler, seed, pixel, sample_index);
    Film judge({pixel.x, pixel.y, 1, 1}, size.x, size.y);
    replayed.value = sample.radiance;
    replayed.raster = sample.raster;
    replayed.weight = sample.weight;
    replayed.verdict = judge.add(pixel, sample.radiance, sample.weight);
    return replayed;
}

} // namespace plumb
