// SPDX-License-Identifier: MIT

#include "plumb/render/render.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "plumb/base/error.h"
#include "plumb/model/guide.h"
#include "plumb/render/adaptive.h"
#include "render/sample_layers.h"
#include "render/sample_taker.h"
#include "render/tiles.h"

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
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
// Of an adaptive rendering, whose later passes have few pixels.
constexpr std::uint64_t most_samples_per_pass = 1024;

// What one thread needs and gathers.
struct Worker {
    Worker(const RenderJob& job, const FilmEdge& edge, Outlines& outlines, std::uint64_t total,
           const SampleLayers& wanted)
        : layers(wanted), taker(job, edge, outlines, total, layers.notes())
    {}

    SampleLayers::Meter layers; // of the sample being taken
    SampleTaker taker;          // which points to them
    LeftOut left_out;
    std::vector<double> pilot; // of the pixel that decides
};

// One line of the image's progress at a time, whichever thread is free to report it.
class Reporter {
public:
    Reporter(const ProgressReport& report, std::uint64_t before, std::uint64_t total)
        : report_(report), before_(before), total_(total), done_(before)
    {}

    // The total is what the plans of some pixels let expect of all of them.
    void add_plan(std::uint64_t samples)
    {
        planned_ += samples;
        ++pixels_planned_;
    }
    void expect_plans_of(std::uint64_t pixels) { pixels_ = pixels; }

    void add(std::uint64_t samples, std::uint64_t rays)
    {
        done_ += samples;
        rays_ += rays;
        if (!report_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock) report_({done_, total(), before_, rays_, seconds()});
    }

    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    std::uint64_t total() const
    {
        if (pixels_planned_ == 0) return total_;
        const double each = static_cast<double>(planned_) / static_cast<double>(pixels_planned_);
        return std::max<std::uint64_t>(done_, std::llround(each * static_cast<double>(pixels_)));
    }

    const ProgressReport& report_;
    const std::uint64_t before_;
    const std::uint64_t total_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> done_;
    std::atomic<std::uint64_t> rays_ = 0;
    std::uint64_t pixels_ = 0; // which are to have plans
    std::atomic<std::uint64_t> pixels_planned_ = 0;
    std::atomic<std::uint64_t> planned_ = 0;
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

Plans plans_of(const RenderOptions& options)
{
    return options.adaptive ? Plans::kept : Plans::none;
}

// Of a pilot's sample; of one that the film would leave out: 0.
double pilot_value(const SampleTaken& sample)
{
    const Color value = sample.radiance * sample.weight;
    return is_finite(value) ? std::max(static_cast<double>(luminance(value)), 0.0) : 0.0;
}

// Tells the reporter of the plans that there are, and of how many there are to be.
void expect_plans(const Film& film, const SampleSet& wanted, std::uint64_t total, Reporter& reporter)
{
    const PixelRect& window = film.window();
    reporter.expect_plans_of(wanted.count() /
                             std::max<std::uint64_t>(wanted.samples_per_pixel(window).most, 1));
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (const std::uint64_t plan = film.plan({x, y}); plan > 0)
                reporter.add_plan(std::min(plan, total));
}

RenderState nothing_taken(const RenderJob& job, const RenderOptions& options)
{
    const Vec2i size = job.camera->resolution();
    return {Film(render_window(job, options), size.x, size.y, render_layers(job, options), plans_of(options)),
            {},
            {},
            {}};
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

std::uint64_t RenderState::samples() const
{
    if (film.plans() == Plans::none) return taken.count();
    const PixelRect& window = film.window();
    std::uint64_t samples = left_out.count;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) samples += film.sample_count({x, y});
    return samples;
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
    if (state_.film.plans() != plans_of(options))
        throw Error("the samples so far are those of an adaptive rendering, or these are to be: not both");
    if (options.adaptive && job.sampler->depends_on_total())
        throw Error(
            "the sampler depends on the total number of samples per pixel, and an adaptive rendering has "
            "another number in each pixel");
    // Every rendering pays for what its integrator has learnt, whoever was the first to ask for it: the time of an image does not
    // depend on which others were made before.
    if (const auto guide = train(*job_.integrator, *job_.scene, *job_.camera, options_.threads))
        state_.seconds += guide->seconds;
}

Rendering::~Rendering() = default;

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
    std::optional<AdaptiveRule> rule;
    if (options_.adaptive) rule.emplace(*options_.adaptive);
    Reporter reporter(progress, rule ? state_.samples() : (wanted & state_.taken).count(), wanted.count());
    if (rule) expect_plans(state_.film, wanted, total, reporter);
    const SampleLayers layers(job_, options_);
    const FilmEdge edge(*job_.filter, *job_.camera);
    if (!outlines_) outlines_ = std::make_unique<Outlines>(job_, state_.film.window(), options_.threads);
    oneapi::tbb::enumerable_thread_specific<Worker> workers(
        [&] { return Worker(job_, edge, *outlines_, total, layers); });
    std::atomic<bool> paused = false;

    // Where the pixel's samples of the block end. Below the least number of samples there is nothing to decide.
    const auto end_of_pixel = [&](Worker& worker, Vec2i pixel, const SampleBlock& block) {
        if (!rule || total <= rule->least()) return block.last;
        std::uint64_t plan = state_.film.plan(pixel);
        if (plan == 0) {
            worker.pilot.resize(rule->pilot_size());
            for (std::uint64_t i = 0; i < worker.pilot.size(); ++i) {
                if (!layers.empty()) worker.layers.start(worker.taker.counts());
                worker.pilot[i] =
                    pilot_value(worker.taker.take(options_.seed, pixel, first_pilot_sample + i));
            }
            plan = rule->samples(worker.pilot);
            state_.film.set_plan(pixel, static_cast<std::uint32_t>(plan));
            reporter.add_plan(std::min(plan, total));
        }
        return std::min(block.last, std::max(block.first, plan));
    };

    // How much of the block was done: its first rows.
    const auto take_block = [&](const SampleBlock& block) {
        const FlushDenormals flush;
        Worker& worker = workers.local();
        const std::uint64_t rays_before = worker.taker.counts().total();
        const PixelRect& tile = block.pixels;
        SampleBlock done = block;
        std::uint64_t samples = 0;
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            done.pixels.height = y - tile.y;
            if (pause && (paused || pause())) {
                paused = true;
                break;
            }
            for (int x = tile.x; x < tile.x + tile.width; ++x) {
                const std::uint64_t last = end_of_pixel(worker, {x, y}, block);
                samples += last - block.first;
                for (std::uint64_t index = block.first; index < last; ++index) {
                    if (!layers.empty()) worker.layers.start(worker.taker.counts());
                    const SampleTaken sample = worker.taker.take(options_.seed, {x, y}, index);
                    const SampleStatus status =
                        layers.empty()
                            ? state_.film.add({x, y}, sample.radiance, sample.weight)
                            : state_.film.add({x, y}, sample.radiance, sample.weight,
                                              worker.layers.measure(sample.radiance, worker.taker.counts()),
                                              index);
                    if (status != SampleStatus::accepted)
                        worker.left_out.add({{x, y}, index, sample.radiance, status});
                }
            }
            done.pixels.height = y - tile.y + 1;
        }
        if (tile_report && done.pixels.height > 0) tile_report(state_.film, done.pixels);
        reporter.add(samples, worker.taker.counts().total() - rays_before);
        return done;
    };

    for (std::uint64_t pass; first < end && !paused; first += pass) {
        pass = rule ? std::clamp(std::bit_floor(first), samples_per_pass, most_samples_per_pass)
                    : samples_per_pass;
        std::vector<SampleBlock> work = cut_into_work(missing, first, first + pass, options_.tile_size);
        parallel_for(work.size(), options_.threads, [&](std::size_t i) { work[i] = take_block(work[i]); });
        state_.taken = state_.taken | SampleSet(work);
    }
    for (const Worker& worker : workers) {
        state_.rays += worker.taker.counts();
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
    train(*job.integrator, *job.scene, *job.camera, options.threads);
    const FlushDenormals flush;
    ReplayedSample replayed;
    const FilmEdge edge(*job.filter, *job.camera);
    Outlines outlines(job, {pixel.x, pixel.y, 1, 1}, options.threads);
    SampleTaker taker(job, edge, outlines, total, {.log = &replayed.log});
    const SampleTaken sample = taker.take(options.seed, pixel, sample_index);
    Film judge({pixel.x, pixel.y, 1, 1}, size.x, size.y);
    replayed.value = sample.radiance;
    replayed.raster = sample.raster;
    replayed.weight = sample.weight;
    replayed.status = judge.add(pixel, sample.radiance, sample.weight);
    return replayed;
}

} // namespace plumb
