// SPDX-License-Identifier: MIT
#include "experiments/pairs.h"

#include "plumb/statistics/mean_and_variance.h"

#include <algorithm>
#include <bit>

namespace plumb {

namespace {

struct Racer {
    RenderTask task;
    std::vector<double> seconds; // of each round
    std::vector<Image> images;
};

// Of each image. By a time limit, the power of two that makes all rounds of all racers take about that long: powers of two
// suit sequences of low discrepancy.
std::uint64_t samples_of_a_image(const std::vector<Racer>& racers, const RaceSettings& settings)
{
    if (!settings.base.stop.seconds) return racers.front().task.options.samples_per_pixel;
    double seconds = 0.0;
    for (const Racer& racer : racers) seconds += seconds_per_sample(racer.task);
    const double samples = *settings.base.stop.seconds / (seconds * static_cast<double>(settings.rounds));
    return std::bit_floor(
        static_cast<std::uint64_t>(std::clamp(samples, 2.0, static_cast<double>(film_max_samples))));
}

// In turn, so that a machine whose speed drifts favours none. Every image has a seed of its own.
void run(std::vector<Racer>& racers, std::uint64_t samples_per_pixel, const RaceSettings& settings,
         const SessionCallbacks& callbacks)
{
    std::uint64_t seed = settings.base.samples.seed;
    for (Racer& racer : racers) racer.task.options.samples_per_pixel = samples_per_pixel;
    for (std::uint64_t round = 0; round < settings.rounds; ++round) {
        for (Racer& racer : racers) {
            racer.task.options.seed = seed++;
            const RenderState result = render_all(racer.task, callbacks);
            racer.seconds.push_back(result.seconds);
            racer.images.push_back(result.film.develop());
        }
    }
}

// The mean of the images, with the variance that it has by their spread.
Image mean_image(const std::vector<Image>& images)
{
    const Image& first = images.front();
    Image mean(first.data_window(), first.full_width(), first.full_height(),
               {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    const PixelRect& window = mean.data_window();
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                MeanAndVariance values;
                for (const Image& image : images) values.add(image.pixel(x, y)[channel]);
                mean.pixel(x, y)[channel] = static_cast<float>(values.mean());
                mean.pixel(x, y)[channel + 3] = static_cast<float>(sqr(values.standard_error()));
            }
        }
    }
    return mean;
}

double mean_squared_difference(const Image& a, const Image& b)
{
    const PixelRect& window = a.data_window();
    MeanAndVariance squares;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                squares.add(sqr(static_cast<double>(a.pixel(x, y)[channel]) - b.pixel(x, y)[channel]));
    return squares.mean();
}

// No noise is most likely no light, and no merit.
double cost(const RaceRow& row)
{
    const double variance = row.rounds.variance();
    return variance > 0.0 ? row.rounds.mean_seconds() * variance : static_cast<double>(infinity);
}

// The most efficient one first; those that are alike stay in their order.
std::vector<RaceRow> rank(const std::vector<Racer>& racers, const std::vector<Estimate>& means)
{
    std::vector<RaceRow> rows;
    for (std::size_t i = 0; i < racers.size(); ++i) {
        RaceRow row{means[i].name, {racers[i].seconds, {}}, {}};
        for (const Image& image : racers[i].images)
            row.rounds.deviations.push_back(mean_squared_difference(image, means[i].image));
        rows.push_back(std::move(row));
    }
    std::ranges::stable_sort(rows, {}, cost);
    for (RaceRow& row : rows) row.efficiency = efficiency_ratio(row.rounds, rows.front().rounds);
    return rows;
}

} // namespace

RaceResult race(SceneFile& file, const RaceSettings& settings, int threads, const SessionCallbacks& callbacks)
{
    std::vector<Racer> racers;
    for (RenderTask& task : tasks_of(file, settings, threads)) racers.push_back({std::move(task), {}, {}});
    RaceResult result;
    result.samples_per_pixel = samples_of_a_image(racers, settings);
    result.rounds = settings.rounds;
    run(racers, result.samples_per_pixel, settings, callbacks);

    std::vector<Estimate> means;
    for (const Racer& racer : racers)
        means.push_back({method_name(racer.task.settings.method),
                         mean_image(racer.images),
                         static_cast<double>(settings.rounds), // what is independent is an image
                         {},
                         {}});
    result.ranking = rank(racers, means);
    result.means = compare_pairs(
        std::move(means),
        std::vector<std::uint64_t>(racers.size(), result.samples_per_pixel * settings.rounds), settings.how);
    return result;
}

} // namespace plumb
