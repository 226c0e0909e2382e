// SPDX-License-Identifier: MIT
#include "plumb/rendering/session.h"

#include "base/text.h"
#include "render/sample_text.h"
#include "rendering/checkpoint.h"
#include "rendering/origin.h"
#include "rendering/provenance.h"

#include "plumb/image/image.h"
#include "plumb/render/stop_rules.h"

#include <chrono>
#include <fmt/format.h>

namespace plumb {

namespace {

using Clock = std::chrono::steady_clock;

// Whether it is time for another checkpoint. due() is asked from all threads.
class Timer {
public:
    explicit Timer(double seconds)
        : period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)))
    {
        restart();
    }
    bool due() const { return Clock::now().time_since_epoch().count() >= next_; }
    void restart() { next_ = (Clock::now() + period_).time_since_epoch().count(); }

private:
    Clock::duration period_;
    std::atomic<Clock::rep> next_;
};

StopRules stop_rules(const RenderTask& task)
{
    StopRules rules{task.options.samples_per_pixel, task.settings.stop.seconds,
                    task.settings.stop.relative_error};
    const bool other_rule = rules.seconds || rules.relative_error;
    if (other_rule && task.settings.samples.adaptive)
        throw Error(
            "--adaptive decides the number of samples of each pixel: give the maximum with --spp, not "
            "with --time or --target-error");
    if (!other_rule || task.settings.samples.per_pixel) return rules;
    if (task.scene.job.sampler->depends_on_total())
        throw Error(
            fmt::format("the sampler '{}' depends on the total number of samples per pixel: with --time or "
                        "--target-error, give the maximum with --spp, or use --sampler sobol",
                        task.scene.sampler));
    rules.samples_per_pixel = film_max_samples;
    return rules;
}

} // namespace

struct RenderSession::Impl {
    Impl(RenderTask of, SessionOptions how, SessionCallbacks say)
        : task(std::move(of)),
          options(std::move(how)),
          callbacks(std::move(say)),
          header(work_header(task, options.part)),
          rules(stop_rules(task)),
          window(render_window(task.scene.job, task.options)),
          timer(options.checkpoint.every_seconds)
    {
        task.options.threads = options.threads;
        if (options.part && options.part->by == PartBy::samples && task.options.adaptive)
            throw Error(
                "an adaptive rendering has no parts by samples: each would take the pilot of every pixel "
                "again; use parts by tiles");
        if (const RenderJob& job = task.scene.job; task.options.adaptive && job.sampler->depends_on_total())
            throw Error(fmt::format("the sampler '{}' depends on the total number of samples per pixel: with "
                                    "--adaptive, use --sampler sobol",
                                    task.scene.sampler));
    }

    bool has_checkpoint() const { return !options.checkpoint.file.empty(); }

    void say(Severity severity, std::string text) const
    {
        if (callbacks.message) callbacks.message({severity, {}, std::move(text)});
    }

    Rendering& begin()
    {
        if (!rendering) rendering.emplace(task.scene.job, task.options);
        return *rendering;
    }

    bool resume()
    {
        const std::filesystem::path& file = options.checkpoint.file;
        const std::string name = file.string();
        const ChannelSet layers = render_layers(task.scene.job, task.options);
        const Metadata of_program = with_program(header);
        std::optional<LoadedCheckpoint> loaded = load_checkpoint(file);
        if (loaded && !loaded->problem.empty())
            say(Severity::warning,
                fmt::format("{}; resuming from '{}'", loaded->problem, loaded->generation.string()));
        if (loaded)
            if (const auto changes = sample_changes(loaded->file.header, of_program); !changes.empty())
                throw Error(fmt::format("cannot resume from '{}': {}", loaded->generation.string(),
                                        list_text(changes)));
        keep_previous(file, of_program);
        if (!loaded) {
            say(Severity::note, fmt::format("'{}' does not exist yet; starting with the first sample", name));
            return false;
        }
        RenderState& state = loaded->file.state;
        if (state.film.layers() != layers)
            throw Error(
                fmt::format("cannot resume from '{}': it has the layers {}, and --aov and --split ask for {}",
                            name, layer_names(state.film.layers()), layer_names(layers)));
        if (state.film.window() != window)
            throw Error(fmt::format("cannot resume from '{}': it has the pixels {}, not {}", name,
                                    rectangle_text(state.film.window()), rectangle_text(window)));
        if (const SampleSet more = state.taken - most_wanted(); !more.empty())
            throw Error(fmt::format("cannot resume from '{}': it has samples that were not requested: {}",
                                    name, more.text()));
        say(Severity::note,
            fmt::format("resuming from '{}', which has {} samples", name, count_text(state.samples())));
        rendering.emplace(task.scene.job, task.options, std::move(state));
        return true;
    }

    // What is to be taken if no other rule stops it.
    SampleSet most_wanted() const
    {
        if (options.again) return options.again->samples;
        if (const auto& part = options.part)
            return part_of(window, rules.samples_per_pixel, part->by, part->index, part->count);
        return SampleSet(SampleBlock{window, 0, rules.samples_per_pixel});
    }

    StopReason run()
    {
        begin();
        stop = options.again ? options.again->stop : std::string();
        images.emplace(); // loads while the first samples are taken
        const bool has_rules = !options.again && (rules.seconds || rules.relative_error);
        const StopReason reason = has_rules             ? take_until_stopped()
                                  : take(most_wanted()) ? StopReason::all_samples
                                                        : StopReason::interrupted;
        images.reset();
        if (reason == StopReason::interrupted) stop = interruption;
        return reason;
    }

    StopReason take_until_stopped()
    {
        for (std::uint64_t samples = rendering->state().taken.samples_per_pixel(window).least;;) {
            if (rules.relative_error && is_convergence_check(samples) && look(samples))
                return StopReason::target_error;
            const std::uint64_t next = next_stop(rules, samples, rendering->state().seconds);
            if (next == samples) {
                if (samples >= rules.samples_per_pixel) return StopReason::all_samples;
                stop = fmt::format("it stopped at the time limit of {}", duration_text(*rules.seconds));
                return StopReason::time_limit;
            }
            if (!take(SampleSet(SampleBlock{window, 0, next}))) return StopReason::interrupted;
            samples = next;
        }
    }

    // Whether the noise is low enough.
    bool look(std::uint64_t samples)
    {
        const auto noise = estimate_relative_noise(rendering->state().film);
        if (!noise) return false;
        samples_expected = static_cast<double>(samples) * sqr(noise->high / *rules.relative_error);
        if (noise->high > *rules.relative_error) return false;
        stop = fmt::format("it stopped when its measured noise was below {}", *rules.relative_error);
        return true;
    }

    // Takes the wanted samples, with checkpoints; false: somebody stopped it.
    bool take(const SampleSet& wanted)
    {
        const auto pause = [this] {
            return callbacks.is_stopped() || images->failed() || (has_checkpoint() && timer.due());
        };
        while (!rendering->take(
            wanted, [this](const Progress& progress) { show(progress); }, pause, callbacks.tile)) {
            if (images->failed()) images->wait(); // throws: what is rendered could not be written
            if (callbacks.is_stopped()) return false;
            try {
                save();
            } catch (const Error& error) {
                say(Severity::warning, fmt::format("{}; rendering continues", error.what()));
            }
            timer.restart();
        }
        return true;
    }

    // The total is what the rules let expect.
    void show(Progress progress) const
    {
        if (!callbacks.progress) return;
        const double pixels = static_cast<double>(window.width) * static_cast<double>(window.height);
        const double seconds = rendering->state().seconds + progress.seconds;
        double total = pixels * static_cast<double>(rules.samples_per_pixel);
        if (rules.seconds && seconds > 0.0)
            total = std::min(total, static_cast<double>(progress.samples_done) * *rules.seconds / seconds);
        if (rules.relative_error && samples_expected > 0.0)
            total = std::min(total, pixels * samples_expected);
        if (rules.seconds || rules.relative_error)
            progress.samples_total = std::max(static_cast<std::uint64_t>(total), progress.samples_done + 1);
        callbacks.progress(progress);
    }

    void save() const
    {
        Metadata whole = with_program(header);
        if (!stop.empty()) whole.emplace_back("plumb:workStop", stop);
        save_checkpoint(options.checkpoint.file, rendering->state(), task.scene.job.camera->resolution(),
                        whole);
    }

    RenderTask task;
    SessionOptions options;
    SessionCallbacks callbacks;
    Metadata header; // of the work
    StopRules rules;
    PixelRect window;
    Timer timer;
    std::optional<Rendering> rendering; // from the first run() or resume()
    std::optional<ImageLibrary> images; // while run() is running
    std::string stop;                   // Evidence::stop
    double samples_expected = 0.0;      // for each pixel, by the last look; 0: not known
};

RenderSession::RenderSession(RenderTask task, SessionOptions options, SessionCallbacks callbacks)
    : impl_(std::make_unique<Impl>(std::move(task), std::move(options), std::move(callbacks)))
{}

RenderSession::~RenderSession() = default;

bool RenderSession::resume()
{
    return impl_->resume();
}

StopReason RenderSession::run()
{
    return impl_->run();
}

void RenderSession::save() const
{
    impl_->begin();
    impl_->save();
}

const RenderTask& RenderSession::task() const
{
    return impl_->task;
}

const RenderState& RenderSession::state() const
{
    return impl_->begin().state();
}

Evidence RenderSession::evidence() const
{
    const RenderTask& task = impl_->task;
    return make_evidence(make_ledger(task.scene.job, task.scene.dialect), state(), impl_->stop);
}

Image RenderSession::image(const Evidence& evidence) const
{
    return image_of(state().film, scene_header(impl_->task), evidence, impl_->task.settings.output);
}

} // namespace plumb
