// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/estimators.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/race_statistics.h"

#include "base/visible_text.h"
#include "plumb/statistics/mean_and_variance.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace plumb {

namespace {

struct Racer {
    std::string name;
    LoadedScene scene;
    std::vector<double> seconds; // of each round
    std::vector<Image> pictures;
};

// What came of it.
struct Result {
    std::string name;
    Rounds rounds;
    std::optional<Ratio> efficiency; // over that of the best
};

std::vector<Racer> load_racers(const RaceRequest& request)
{
    std::vector<Racer> racers;
    for (const Estimator& estimator : estimators_of(request, "race"))
        racers.push_back({estimator.name(), load_for(estimator, request, racers.empty()), {}, {}});
    return racers;
}

// Of each picture. By --time, the power of two that makes all rounds of all racers take about that long: powers of two suit
// sequences of low discrepancy.
std::uint64_t samples_of_a_picture(const std::vector<Racer>& racers, const RaceRequest& request)
{
    if (!request.settings.stop.seconds)
        return render_samples(racers.front().scene.job, render_options(request.settings, request.threads));
    double seconds = 0.0;
    for (const Racer& racer : racers)
        seconds += seconds_per_sample(racer.scene.job, render_options(request.settings, request.threads));
    const double samples = *request.settings.stop.seconds / (seconds * static_cast<double>(request.rounds));
    return std::bit_floor(
        static_cast<std::uint64_t>(std::clamp(samples, 2.0, static_cast<double>(film_max_samples))));
}

// In turn, so that a machine whose speed drifts favours none. Every picture has a seed of its own.
void run(std::vector<Racer>& racers, std::uint64_t samples_per_pixel, const RaceRequest& request)
{
    RenderOptions how = render_options(request.settings, request.threads);
    how.samples_per_pixel = samples_per_pixel;
    for (std::uint64_t round = 0; round < request.rounds; ++round) {
        for (Racer& racer : racers) {
            ProgressDisplay display(request.quiet);
            const RenderState result =
                render(racer.scene.job, how, [&](const Progress& progress) { display.show(progress); });
            racer.seconds.push_back(result.seconds);
            racer.pictures.push_back(result.film.develop());
            ++how.seed;
        }
    }
}

// The mean of the pictures, with the variance that it has by their spread.
Image mean_picture(const std::vector<Image>& pictures)
{
    const Image& first = pictures.front();
    Image mean(first.data_window(), first.full_width(), first.full_height(),
               {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    // To the comparison, a sample is what is independent: a picture.
    mean.metadata.emplace_back("plumb:samplesPerPixel", static_cast<int>(pictures.size()));
    const PixelRect& window = mean.data_window();
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                MeanAndVariance values;
                for (const Image& picture : pictures) values.add(picture.pixel(x, y)[channel]);
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
double cost(const Result& result)
{
    const double variance = result.rounds.variance();
    return variance > 0.0 ? result.rounds.mean_seconds() * variance : static_cast<double>(infinity);
}

// The most efficient one first; those that are alike stay in their order.
std::vector<Result> rank(const std::vector<Racer>& racers, const std::vector<Estimate>& means)
{
    std::vector<Result> results;
    for (std::size_t i = 0; i < racers.size(); ++i) {
        Result result{racers[i].name, {racers[i].seconds, {}}, {}};
        for (const Image& picture : racers[i].pictures)
            result.rounds.deviations.push_back(mean_squared_difference(picture, means[i].image));
        results.push_back(std::move(result));
    }
    std::ranges::stable_sort(results, {}, cost);
    for (Result& result : results)
        result.efficiency = efficiency_ratio(result.rounds, results.front().rounds);
    return results;
}

std::string efficiency_text(const Result& result, bool is_best)
{
    if (!result.efficiency) return "unknown: it found no noise";
    if (is_best) return "1";
    const auto& [value, low, high] = *result.efficiency;
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", value, low, high);
}

std::string table_text(const std::vector<Result>& results, std::uint64_t samples_per_pixel)
{
    std::size_t width = 0;
    for (const Result& result : results) width = std::max(width, result.name.size());
    std::string text = fmt::format("  {:<{}}  ms a sample  variance   efficiency\n", "", width);
    for (const Result& result : results)
        text += fmt::format("  {:<{}}  {:<11.3g}  {:<9.3g}  {}\n", result.name, width,
                            result.rounds.mean_seconds() * 1e3 / static_cast<double>(samples_per_pixel),
                            result.rounds.variance(), efficiency_text(result, &result == &results.front()));
    return text;
}

std::string race_json(const RaceRequest& request, const std::vector<Result>& results,
                      const std::vector<Pair>& pairs, std::uint64_t samples_per_pixel)
{
    JsonWriter json;
    json.begin_object();
    write_verdict(json, request, pairs);
    json.integer("rounds", request.rounds);
    json.integer("spp", samples_per_pixel);
    json.begin_array("estimators");
    for (const Result& result : results) {
        json.begin_object();
        json.text("name", result.name);
        json.number("seconds_per_sample",
                    result.rounds.mean_seconds() / static_cast<double>(samples_per_pixel));
        json.number("variance", result.rounds.variance());
        if (const auto& efficiency = result.efficiency) {
            json.number("efficiency", efficiency->value);
            json.number("efficiency_low", efficiency->low);
            json.number("efficiency_high", efficiency->high);
        } else {
            json.null("efficiency");
        }
        json.begin_array("seconds");
        for (const double seconds : result.rounds.seconds) json.number("", seconds);
        json.end_array();
        json.end_object();
    }
    json.end_array();
    write_pairs(json, pairs);
    json.end_object();
    return std::move(json).finish();
}

} // namespace

std::string_view race_manual()
{
    return R"(Renders the scene with each estimator in turn, in rounds of images with equal
numbers of samples, each with a seed of its own. For each estimator it prints
  - the time of one sample of every pixel;
  - the variance of an image with that many samples: the mean over pixels and
    channels of the spread between the rounds, which is right for any sampler;
  - the efficiency 1 / (time x variance), relative to the best, with a 95 %
    interval. Twice the efficiency is the same noise in half the time.
Rare bright paths that no round has found are in no variance. The means of the
rounds are compared as `renderer agree` does: if they differ, the estimators do
not estimate the same, and their efficiencies are not comparable. The scene is
loaded once for each estimator, and all images are kept in memory.
Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ,
4 undecided.
)";
}

int race_command(const RaceRequest& request)
{
    std::vector<Racer> racers = load_racers(request);
    check_outputs({}, request.json);
    const std::uint64_t samples_per_pixel = samples_of_a_picture(racers, request);
    run(racers, samples_per_pixel, request);

    std::vector<Estimate> means;
    for (const Racer& racer : racers)
        means.push_back({racer.name, samples_per_pixel * request.rounds, mean_picture(racer.pictures)});
    const std::vector<Pair> pairs = compare_pairs(means, request.how);
    const std::vector<Result> results = rank(racers, means);
    const CompareOutcome outcome = outcome_of(pairs);
    if (!request.quiet && request.json != "-") {
        print_output(fmt::format("{}: {} rounds of {} samples per pixel\n", visible_text(request.scene),
                                 request.rounds, samples_per_pixel));
        print_output(table_text(results, samples_per_pixel));
        for (const Pair& pair : pairs) print_output(pair_text(pair));
        print_output(fmt::format("{}\n", verdict_of(outcome)));
        if (outcome == CompareOutcome::undecided) print_output(advice(means, pairs));
    }
    if (!request.json.empty())
        write_json(request.json, race_json(request, results, pairs, samples_per_pixel));
    return exit_code_of(outcome);
}

} // namespace plumb
