// SPDX-License-Identifier: MIT

#include "plumb/render/render.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "plumb/base/error.h"
#include "plumb/model/guide.h"
#include "plumb/scene/tracer.h"
#include "render/film_edge.h"
#include "render/sample_layers.h"
#include "render/tiles.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <tuple>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>

namespace plumb {
namespace {

using Clock = std::chrono::steady_clock;

// Samples a pixel gets before the next tile's turn: few enough for a lively progress report, many enough for a tile
// to stay in the cache.
constexpr std::uint64_t samples_per_pass = 16;

struct SampleTaken {
    Color radiance;
    Color scale; // of what the integrator found
    Vec2f raster;
    float weight;
};

// One sample: a pure function of job, seed, pixel and index.
SampleTaken take_sample(const RenderJob& job, const FilmEdge& edge, Tracer& tracer, Sampler& sampler,
                        std::uint64_t seed, Vec2i pixel, std::uint64_t index)
{
    sampler.start(seed, pixel, index);
    const Vec2f u_filter = sampler.next_2d();
    const Vec2f u_lens = sampler.next_2d();
    const FilterSample place = edge.sample(pixel, u_filter);
    const Vec2f raster(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                       static_cast<float>(pixel.y) + 0.5f + place.offset.y);
    const CameraRay camera_ray = job.camera->sample_ray(raster, u_lens);
    Color radiance = job.integrator->radiance(tracer, sampler, camera_ray.ray) * camera_ray.weight;
    if (tracer.take_failure()) radiance = Color(std::numeric_limits<float>::quiet_NaN());
    return {radiance, camera_ray.weight, raster, place.weight};
}

// What one thread needs and gathers.
struct Worker {
    Worker(const RenderJob& job, std::uint64_t total, const SampleLayers& wanted)
        : layers(wanted), tracer(*job.scene, layers.notes()), sampler(job.sampler->clone(total))
    {}
    Worker(const Worker&) = delete; // the tracer points to it
    Worker& operator=(const Worker&) = delete;

    SampleLayers::Meter layers; // of the sample being taken
    Tracer tracer;
    std::unique_ptr<Sampler> sampler;
    LeftOut left_out;
};

// One line of the image's progress at a time, whichever thread is free to report it.
class Reporter {
public:
    Reporter(const ProgressReport& report, std::uint64_t before, std::uint64_t total)
        : report_(report), before_(before), total_(total), done_(before)
    {}

    void add(std::uint64_t samples, std::uint64_t rays)
    {
        done_ += samples;
        rays_ += rays;
        if (!report_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock) report_({done_, total_, before_, rays_, seconds()});
    }

    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    const ProgressReport& report_;
    const std::uint64_t before_;
    const std::uint64_t total_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> done_;
    std::atomic<std::uint64_t> rays_ = 0;
    std::mutex mutex_;
};

// The samples from `first` to before `last` of a set, as blocks of one tile each.
std::vector<SampleBlock> cut_into_work(const SampleSet& set, std::uint64_t first, std::uint64_t last,
                                       int tile_size)
{
    std::vector<SampleBlock> work;
    for (const SampleBlock& block : set.blocks()) {
        const SampleBlock slice{block.pixels, std::max(block.first, first), std::min(block.last, last)};
        if (slice.empty()) continue;
        for (const PixelRect& tile : cut_into_tiles(slice.pixels, tile_size))
            work.push_back({tile, slice.first, slice.last});
    }
    return work;
}

// Throws Error if the sampler cannot take the samples before `end`.
void check_total(const RenderJob& job, std::uint64_t end, std::uint64_t total)
{
    if (job.sampler->depends_on_total() && end > total)
        throw Error(fmt::format("sample {} was requested, but the sampler has a total of {} samples per "
                                "pixel; give the total with --spp",
                                end - 1, total));
}

RenderState nothing_taken(const RenderJob& job, const RenderOptions& options)
{
    const Vec2i size = job.camera->resolution();
    return {Film(render_window(job, options), size.x, size.y, render_layers(job, options)), {}, {}, {}};
}

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

RenderState& RenderState::operator+=(const RenderState& other)
{
    film += other.film;
    taken = taken | other.taken;
    rays += other.rays;
    left_out += other.left_out;
    seconds += other.seconds;
    return *this;
}

PixelRect render_window(const RenderJob& job, const RenderOptions& options)
{
    const Vec2i size = job.camera->resolution();
    const PixelRect whole{0, 0, size.x, size.y};
    if (!options.crop) return whole;
    const PixelRect& c = *options.crop;
    if (c.width < 1 || c.height < 1 || c.x < 0 || c.y < 0 || c.x > size.x - c.width ||
        c.y > size.y - c.height)
        throw Error(fmt::format("the crop {},{},{},{} is not inside the image of {}x{} pixels", c.x, c.y,
                                c.width, c.height, size.x, size.y));
    return c;
}

std::uint64_t render_samples(const RenderJob& job, const RenderOptions& options)
{
    const std::uint64_t samples =
        options.samples_per_pixel != 0 ? options.samples_per_pixel : job.sampler->samples_per_pixel();
    if (samples < 1 || samples > film_max_samples)
        throw Error(fmt::format("samples per pixel must be from 1 to {}, not {}", film_max_samples, samples));
    return samples;
}

int render_threads(const RenderOptions& options)
{
    return options.threads > 0 ? options.threads : oneapi::tbb::info::default_concurrency();
}

Rendering::Rendering(const RenderJob& job, const RenderOptions& options)
    : Rendering(job, options, nothing_taken(job, options))
{}

Rendering::Rendering(const RenderJob& job, const RenderOptions& options, RenderState state)
    : job_(job), options_(options), state_(std::move(state))
{
    if (const ChannelSet wanted = render_layers(job, options); state_.film.layers() != wanted)
        throw Error(fmt::format("the samples so far have the layers {}, not {}",
                                layer_names(state_.film.layers()), layer_names(wanted)));
    // Every rendering pays for what its integrator has learnt, whoever was the first to ask for it: the time of an image does not
    // depend on which others were made before.
    if (const auto guide = train(*job_.integrator, *job_.scene, options_.threads))
        state_.seconds += guide->seconds;
}

bool Rendering::take(const SampleSet& wanted, const ProgressReport& progress, const Pause& pause,
                     const TileReport& tile_report)
{
    const SampleSet missing = wanted - state_.taken;
    std::uint64_t first = max_samples_per_pixel;
    std::uint64_t end = 0;
    for (const SampleBlock& block : missing.blocks()) {
        first = std::min(first, block.first);
        end = std::max(end, block.last);
    }
    const std::uint64_t total = render_samples(job_, options_);
    check_total(job_, end, total);
    Reporter reporter(progress, (wanted & state_.taken).count(), wanted.count());
    const SampleLayers layers(job_, options_);
    oneapi::tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(job_, total, layers); });
    const FilmEdge edge(*job_.filter, *job_.camera);
    std::atomic<bool> paused = false;

    // How much of the block was done: its first rows.
    const auto take_block = [&](const SampleBlock& block) {
        const FlushDenormals flush;
        Worker& worker = workers.local();
        const std::uint64_t rays_before = worker.tracer.counts().total();
        const PixelRect& tile = block.pixels;
        SampleBlock done = block;
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            done.pixels.height = y - tile.y;
            if (pause && (paused || pause())) {
                paused = true;
                break;
            }
            for (int x = tile.x; x < tile.x + tile.width; ++x) {
                for (std::uint64_t index = block.first; index < block.last; ++index) {
                    if (!layers.empty()) worker.layers.start(worker.tracer.counts());
                    const SampleTaken sample =
                        take_sample(job_, edge, worker.tracer, *worker.sampler, options_.seed, {x, y}, index);
                    const SampleStatus status =
                        layers.empty() ? state_.film.add({x, y}, sample.radiance, sample.weight)
                                       : state_.film.add({x, y}, sample.radiance, sample.weight,
                                                         worker.layers.measure(sample.radiance, sample.scale,
                                                                               worker.tracer.counts()),
                                                         index);
                    if (status != SampleStatus::accepted)
                        worker.left_out.add({{x, y}, index, sample.radiance, status});
                }
            }
            done.pixels.height = y - tile.y + 1;
        }
        if (tile_report && done.pixels.height > 0) tile_report(state_.film, done.pixels);
        reporter.add(done.count(), worker.tracer.counts().total() - rays_before);
        return done;
    };

    for (; first < end && !paused; first += samples_per_pass) {
        std::vector<SampleBlock> work =
            cut_into_work(missing, first, first + samples_per_pass, options_.tile_size);
        parallel_for(work.size(), options_.threads, [&](std::size_t i) { work[i] = take_block(work[i]); });
        state_.taken = state_.taken | SampleSet(work);
    }
    for (const Worker& worker : workers) {
        state_.rays += worker.tracer.counts();
        state_.left_out += worker.left_out;
    }
    state_.seconds += reporter.seconds();
    return !paused;
}

RenderState render(const RenderJob& job, const RenderOptions& options, const ProgressReport& progress)
{
    Rendering rendering(job, options);
    rendering.take(SampleSet(SampleBlock{render_window(job, options), 0, render_samples(job, options)}),
                   progress);
    return std::move(rendering).finish();
}

ReplayedSample replay(const RenderJob& job, const RenderOptions& options, Vec2i pixel,
                      std::uint64_t sample_index)
{
    const Vec2i size = job.camera->resolution();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
        throw Error(fmt::format("pixel {},{} is not inside the image of {}x{} pixels", pixel.x, pixel.y,
                                size.x, size.y));
    const std::uint64_t total = render_samples(job, options);
    check_total(job, sample_index + 1, total);
    train(*job.integrator, *job.scene, options.threads);
    const FlushDenormals flush;
    ReplayedSample replayed;
    Tracer tracer(*job.scene, {.log = &replayed.log});
    const std::unique_ptr<Sampler> sampler = job.sampler->clone(total);
    const FilmEdge edge(*job.filter, *job.camera);
    const SampleTaken sample = take_sample(job, edge, tracer, *sampler, options.seed, pixel, sample_index);
    Film judge({pixel.x, pixel.y, 1, 1}, size.x, size.y);
    replayed.value = sample.radiance;
    replayed.raster = sample.raster;
    replayed.weight = sample.weight;
    replayed.status = judge.add(pixel, sample.radiance, sample.weight);
    return replayed;
}

} // namespace plumb
