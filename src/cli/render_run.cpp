// SPDX-License-Identifier: MIT
#include "cli/render_run.h"

#include "cli/checkpoint.h"
#include "cli/console.h"
#include "cli/header.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/text.h"

#include "plumb/image/image.h"
#include "plumb/render/aovs.h"
#include "plumb/render/stop_rules.h"

#include <atomic>
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

StopRules stop_rules(const RenderRequest& request, const LoadedScene& scene)
{
    StopRules rules{render_samples(scene.job, render_options(request.settings, request.threads)),
                    request.settings.stop.seconds, request.settings.stop.relative_error};
    const bool other_rule = rules.seconds || rules.relative_error;
    if (!other_rule || request.settings.samples.per_pixel) return rules;
    if (scene.job.sampler->depends_on_total())
        throw Error(
            fmt::format("the sampler '{}' depends on the total number of samples per pixel: with --time or "
                        "--target-error, give the maximum with --spp, or use --sampler sobol",
                        scene.sampler));
    rules.samples_per_pixel = film_max_samples;
    return rules;
}

class Runner {
public:
    Runner(const RenderRequest& request, const LoadedScene& scene, const Metadata& header)
        : request_(request),
          scene_(scene),
          header_(header),
          rules_(stop_rules(request, scene)),
          window_(render_window(scene.job, render_options(request.settings, request.threads))),
          resolution_(scene.job.camera->resolution()),
          timer_(request.checkpoint.every_seconds),
          rendering_(scene.job, render_options(request.settings, request.threads), start())
    {}

    RenderRun run()
    {
        bool all = false;
        {
            ProgressDisplay display(request_.quiet);
            display_ = &display;
            all = take_all();
        }
        const int signal = all ? 0 : InterruptGuard::signal();
        if (signal != 0) stop_ = interruption;
        return {std::move(rendering_).finish(), stop_, signal};
    }

private:
    bool has_checkpoint() const { return !request_.checkpoint.file.empty(); }

    RenderState start() const
    {
        const std::string& name = request_.checkpoint.file;
        const ChannelSet layers = layers_of(request_.settings.view.aovs);
        std::optional<StateFile> file;
        if (request_.checkpoint.resume) {
            const Metadata header = with_program(header_);
            file = load_checkpoint(name, header);
            keep_previous(name, header);
        }
        if (!file) {
            if (request_.checkpoint.resume && !request_.quiet)
                print_log(fmt::format("'{}' does not exist yet; starting with the first sample", name));
            return {Film(window_, resolution_.x, resolution_.y, layers), {}, {}, {}};
        }
        if (file->state.film.layers() != layers)
            throw Error(fmt::format("cannot resume from '{}': it has the layers {}, and --aov asks for {}",
                                    name, layer_names(file->state.film.layers()), layer_names(layers)));
        if (const PixelRect& window = file->state.film.window(); window != window_)
            throw Error(fmt::format("cannot resume from '{}': it has the pixels {}, not {}", name,
                                    rectangle_text(window), rectangle_text(window_)));
        if (const SampleSet more = file->state.taken - most_wanted(); !more.empty())
            throw Error(fmt::format("cannot resume from '{}': it has samples that were not requested: {}",
                                    name, more.text()));
        if (!request_.quiet)
            print_log(fmt::format("resuming from '{}', which has {} samples", name,
                                  count_text(file->state.taken.count())));
        return std::move(file->state);
    }

    // What is to be taken if no other rule stops it.
    SampleSet most_wanted() const
    {
        if (request_.repeat) return request_.repeat->samples;
        if (const auto& part = request_.part)
            return part_of(window_, rules_.samples_per_pixel, part->by, part->index, part->count);
        return SampleSet(SampleBlock{window_, 0, rules_.samples_per_pixel});
    }

    // False: a signal came.
    bool take_all()
    {
        if (request_.repeat) stop_ = request_.repeat->stop;
        if (!request_.repeat && (rules_.seconds || rules_.relative_error)) return take_until_stopped();
        return take(most_wanted());
    }

    bool take_until_stopped()
    {
        for (std::uint64_t samples = fewest_samples();;) {
            if (rules_.relative_error && is_convergence_check(samples) && look(samples)) return true;
            const std::uint64_t next = next_stop(rules_, samples, rendering_.state().seconds);
            if (next == samples) {
                if (samples < rules_.samples_per_pixel)
                    stop_ = fmt::format("it stopped at the time limit of {}", duration_text(*rules_.seconds));
                return true;
            }
            if (!take(SampleSet(SampleBlock{window_, 0, next}))) return false;
            samples = next;
        }
    }

    std::uint64_t fewest_samples() const { return rendering_.state().taken.samples_per_pixel(window_).least; }

    // Whether the noise is low enough.
    bool look(std::uint64_t samples)
    {
        const auto noise = estimate_relative_noise(rendering_.state().film);
        if (!noise) return false;
        samples_expected_ = static_cast<double>(samples) * sqr(noise->high / *rules_.relative_error);
        if (noise->high > *rules_.relative_error) return false;
        stop_ = fmt::format("it stopped when its measured noise was below {}", *rules_.relative_error);
        return true;
    }

    // Takes the wanted samples, with checkpoints; false: a signal came.
    bool take(const SampleSet& wanted)
    {
        const auto pause = [this] {
            return InterruptGuard::signal() != 0 || images_.failed() || (has_checkpoint() && timer_.due());
        };
        while (!rendering_.take(
            wanted, [this](const Progress& progress) { show(progress); }, pause)) {
            if (images_.failed()) images_.wait(); // throws: what is rendered could not be written
            if (InterruptGuard::signal() != 0) return false;
            try {
                save_run(request_, scene_, rendering_.state(), stop_, header_);
            } catch (const Error& error) {
                print_log(fmt::format("warning: {}; rendering continues", error.what()));
            }
            timer_.restart();
        }
        return true;
    }

    // The total is what the rules let expect.
    void show(Progress progress)
    {
        const double pixels = static_cast<double>(window_.width) * static_cast<double>(window_.height);
        const double seconds = rendering_.state().seconds + progress.seconds;
        double total = pixels * static_cast<double>(rules_.samples_per_pixel);
        if (rules_.seconds && seconds > 0.0)
            total = std::min(total, static_cast<double>(progress.samples_done) * *rules_.seconds / seconds);
        if (rules_.relative_error && samples_expected_ > 0.0)
            total = std::min(total, pixels * samples_expected_);
        if (rules_.seconds || rules_.relative_error)
            progress.samples_total = std::max(static_cast<std::uint64_t>(total), progress.samples_done + 1);
        display_->show(progress);
    }

    ImageLibrary images_; // loads while the first samples are taken
    const RenderRequest& request_;
    const LoadedScene& scene_;
    const Metadata& header_;
    const StopRules rules_;
    const PixelRect window_;
    const Vec2i resolution_;
    Timer timer_;
    Rendering rendering_;
    ProgressDisplay* display_ = nullptr; // while run() is running
    std::string stop_;
    double samples_expected_ = 0.0; // for each pixel, by the last look; 0: not known
};

} // namespace

RenderRun run_rendering(const RenderRequest& request, const LoadedScene& scene, const Metadata& header)
{
    return Runner(request, scene, header).run();
}

void save_run(const RenderRequest& request, const LoadedScene& scene, const RenderState& state,
              const std::string& stop, Metadata header)
{
    header = with_program(std::move(header));
    if (!stop.empty()) header.emplace_back("plumb:workStop", stop);
    save_checkpoint(request.checkpoint.file, state, scene.job.camera->resolution(), header);
}

} // namespace plumb
