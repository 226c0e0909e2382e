// SPDX-License-Identifier: MIT
#include "experiments/racer.h"

#include "base/text.h"
#include "compare/channel_names.h"
#include "experiments/pairs.h"

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

class PlumbRacer final : public Racer {
public:
    explicit PlumbRacer(RenderTask task) : task_(std::move(task)) { task_.options.aovs.clear(); }

    std::string name() const override { return method_name(task_.settings.method); }
    std::string bias() const override { return task_.scene.job.integrator->bias(); }

    std::vector<RacerImage> render(std::uint64_t seed, std::span<const std::uint64_t> samples,
                                   const SessionCallbacks& callbacks) override
    {
        task_.options.seed = seed;
        return task_.scene.job.sampler->depends_on_total() ? each(samples, callbacks)
                                                           : growing(samples, callbacks);
    }

    // Of an image of its own: to count them takes time.
    std::optional<Image> rays(const SessionCallbacks& callbacks) override
    {
        RenderTask task = task_;
        task.options.aovs = {"rays"};
        task.options.samples_per_pixel =
            std::min<std::uint64_t>(task.options.samples_per_pixel, samples_of_rays);
        const Image image = render_all(task, callbacks).film.develop();
        Image rays(image.data_window(), image.full_width(), image.full_height(), {"Y"});
        const PixelRect& window = image.data_window();
        for (int y = window.y; y < window.y + window.height; ++y)
            for (int x = window.x; x < window.x + window.width; ++x)
                rays.pixel(x, y)[0] = image.pixel(x, y)[3];
        return rays;
    }

private:
    static constexpr std::uint64_t samples_of_rays = 16;

    // Each from its first sample, where the samples of a larger number are others.
    std::vector<RacerImage> each(std::span<const std::uint64_t> samples, const SessionCallbacks& callbacks)
    {
        std::vector<RacerImage> images;
        for (const std::uint64_t count : samples) {
            task_.options.samples_per_pixel = count;
            const RenderState result = render_all(task_, callbacks);
            images.push_back({result.film.develop(), result.seconds});
        }
        return images;
    }

    std::vector<RacerImage> growing(std::span<const std::uint64_t> samples, const SessionCallbacks& callbacks)
    {
        task_.options.samples_per_pixel = samples.back();
        const PixelRect window = render_window(task_.scene.job, task_.options);
        Rendering rendering(task_.scene.job, task_.options);
        std::vector<RacerImage> images;
        for (const std::uint64_t count : samples) {
            if (!rendering.take(SampleSet(SampleBlock{window, 0, count}), callbacks.progress,
                                [&] { return callbacks.is_stopped(); }))
                throw Error(std::string(interruption));
            images.push_back({rendering.state().film.develop(), rendering.state().seconds});
        }
        return images;
    }

    RenderTask task_;
};

class CommandRacer final : public Racer {
public:
    CommandRacer(ForeignJob job, Vec2i size) : job_(std::move(job)), size_(size) {}

    std::string name() const override { return job_.request.name; }

    std::vector<RacerImage> render(std::uint64_t seed, std::span<const std::uint64_t> samples,
                                   const SessionCallbacks& callbacks) override
    {
        job_.request.seed = seed;
        job_.stop = callbacks.stop;
        std::vector<RacerImage> images;
        for (const std::uint64_t count : samples) {
            job_.request.samples = count;
            images.push_back(run());
        }
        return images;
    }

private:
    RacerImage run() const
    {
        try {
            const ForeignImages made = run_command(job_);
            std::error_code ignored;
            for (const std::string& file : made.files) fs::remove(file, ignored);
            const Image& image = made.images.front();
            if (const PixelRect whole{0, 0, size_.x, size_.y}; image.data_window() != whole)
                throw Error(fmt::format(
                    "'{}' renders {}x{} pixels and the others {}x{}, so they have no common scene", name(),
                    image.data_window().width, image.data_window().height, size_.x, size_.y));
            return {colors_of(image), made.run.seconds};
        } catch (const ProgramError& error) {
            std::vector<Diagnostic> lines = {
                {Severity::error, {}, fmt::format("'{}': {}", name(), error.what())}};
            for (const std::string& line : lines_of(error.run().output))
                lines.push_back({Severity::note, {}, fmt::format("'{}' printed: {}", name(), line)});
            throw SceneError(std::move(lines));
        }
    }

    ForeignJob job_;
    Vec2i size_;
};

} // namespace

std::unique_ptr<Racer> make_racer(RenderTask task)
{
    return std::make_unique<PlumbRacer>(std::move(task));
}

std::unique_ptr<Racer> make_racer(ForeignJob job, Vec2i size)
{
    return std::make_unique<CommandRacer>(std::move(job), size);
}

Image colors_of(const Image& image, Side side)
{
    const std::vector<std::size_t> places = choose_channels(image, side, {}, false).values;
    const PixelRect& window = image.data_window();
    Image colors(window, image.full_width(), image.full_height());
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                colors.pixel(x, y)[c] = image.pixel(x, y)[places[std::min(c, places.size() - 1)]];
    return colors;
}

} // namespace plumb
