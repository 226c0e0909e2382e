// SPDX-License-Identifier: MIT
#include "plumb/experiments/race.h"

#include "experiments/pairs.h"
#include "experiments/race_details.h"
#include "experiments/racer.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace plumb {

namespace {

double mean_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// What a racer has rendered: for each number of samples, round by round.
struct Runs {
    std::vector<std::vector<double>> seconds;
    std::vector<std::vector<Image>> images;
};

// Of each image. By a time limit, the power of two that makes all rounds of all racers take about that long: powers of two
// suit sequences of low discrepancy.
std::uint64_t samples_of_a_image(const std::vector<RenderTask>& tasks, const RaceSettings& settings)
{
    if (!settings.base.stop.seconds) return tasks.front().options.samples_per_pixel;
    double seconds = 0.0;
    for (const RenderTask& task : tasks) seconds += seconds_per_sample(task);
    const double samples = *settings.base.stop.seconds / (seconds * static_cast<double>(settings.rounds));
    return std::bit_floor(
        static_cast<std::uint64_t>(std::clamp(samples, 2.0, static_cast<double>(film_max_samples))));
}

// Powers of two, and the number itself.
std::vector<std::uint64_t> steps_to(std::uint64_t samples)
{
    std::vector<std::uint64_t> steps;
    for (std::uint64_t step = 1; step < samples; step *= 2) steps.push_back(step);
    steps.push_back(samples);
    return steps;
}

ForeignRequest request_of(const RaceCommand& command, const std::filesystem::path& scene)
{
    ForeignRequest request{command.name, scene, {}, 0, 1, {}};
    request.foreign.command = command.command;
    request.foreign.timeout = command.timeout;
    return request;
}

std::vector<std::unique_ptr<Racer>> racers_of(const std::filesystem::path& scene,
                                              const std::vector<RenderTask>& tasks,
                                              const RaceSettings& settings, int threads)
{
    std::vector<std::unique_ptr<Racer>> racers;
    for (const RenderTask& task : tasks) racers.push_back(make_racer(task));
    const Vec2i size = tasks.front().scene.job.camera->resolution();
    for (const RaceCommand& command : settings.commands) {
        check_race_command(command, scene);
        ForeignJob job{request_of(command, scene), (settings.directory / command.name).string(), threads};
        job.request.size = size;
        racers.push_back(make_racer(std::move(job), size));
    }
    return racers;
}

// In turn, so that a machine whose speed drifts favours none. Every image has a seed of its own.
std::vector<Runs> run(const std::vector<std::unique_ptr<Racer>>& racers,
                      const std::vector<std::uint64_t>& samples, const RaceSettings& settings,
                      const SessionCallbacks& callbacks)
{
    std::uint64_t seed = settings.base.samples.seed;
    std::vector<Runs> all(racers.size());
    for (Runs& runs : all) {
        runs.seconds.resize(samples.size());
        runs.images.resize(samples.size());
    }
    for (std::uint64_t round = 0; round < settings.rounds; ++round) {
        for (std::size_t i = 0; i < racers.size(); ++i) {
            std::vector<RacerImage> images = racers[i]->render(seed++, samples, callbacks);
            for (std::size_t step = 0; step < samples.size(); ++step) {
                all[i].seconds[step].push_back(images[step].seconds);
                all[i].images[step].push_back(std::move(images[step].image));
            }
        }
    }
    return all;
}

// No noise is most likely no light, and no merit.
double cost(const RaceRow& row)
{
    const double variance = row.rounds.variance();
    return variance > 0.0 ? row.rounds.mean_seconds() * variance : static_cast<double>(infinity);
}

} // namespace

void check_race_command(const RaceCommand& command, const std::filesystem::path& scene)
{
    ForeignRequest request = request_of(command, scene);
    request.size = Vec2i(1, 1);
    std::string problem = foreign_problem(request);
    if (problem.empty()) {
        const std::vector<std::string> names = placeholders_in(command.command);
        for (const char* name : {"seed", "spp"})
            if (problem.empty() && std::find(names.begin(), names.end(), name) == names.end())
                problem = fmt::format(
                    "the images of a race differ in seeds and numbers of samples; put {{{}}} into "
                    "the command",
                    name);
    }
    if (!problem.empty()) throw Error(fmt::format("command '{}': {}", command.name, problem));
}

RaceResult race(SceneFile& file, const RaceSettings& settings, int threads, const SessionCallbacks& callbacks)
{
    if (settings.methods.empty() || settings.methods.size() + settings.commands.size() < 2)
        throw Error("two estimators or more are needed, one of them Plumb's");
    const std::vector<RenderTask> tasks = tasks_of(file, settings, threads);
    const std::vector<std::unique_ptr<Racer>> racers = racers_of(file.path(), tasks, settings, threads);
    std::optional<Truth> truth;
    if (settings.reference) {
        truth.emplace(*settings.reference);
        truth->check(render_window(tasks.front().scene.job, tasks.front().options));
    }
    RaceResult result;
    result.samples_per_pixel = samples_of_a_image(tasks, settings);
    result.rounds = settings.rounds;
    result.has_reference = truth.has_value();
    const std::vector<std::uint64_t> samples = settings.details
                                                   ? steps_to(result.samples_per_pixel)
                                                   : std::vector<std::uint64_t>{result.samples_per_pixel};
    const std::vector<Runs> all = run(racers, samples, settings, callbacks);

    std::vector<Estimate> means;
    for (std::size_t i = 0; i < racers.size(); ++i) {
        const std::vector<Image>& images = all[i].images.back();
        Image mean = mean_image(images);
        RaceRow row{racers[i]->name(),
                    racers[i]->bias(),
                    Rounds{all[i].seconds.back(), squared_distances(images, mean)},
                    {},
                    {},
                    {}};
        if (settings.details) {
            for (std::size_t step = 0; step < samples.size(); ++step)
                row.curve.push_back(
                    {samples[step], mean_of(all[i].seconds[step]), error_of(all[i].images[step], truth)});
            row.efficiency_map =
                efficiency_map(mean, images.size(), row.rounds.mean_seconds(), racers[i]->rays(callbacks));
        }
        // What is independent is an image.
        means.push_back({row.name, std::move(mean), static_cast<double>(settings.rounds), {}, {}});
        result.ranking.push_back(std::move(row));
    }
    // Those that are alike stay in their order.
    std::ranges::stable_sort(result.ranking, {}, cost);
    for (RaceRow& row : result.ranking)
        row.efficiency = efficiency_ratio(row.rounds, result.ranking.front().rounds);
    result.means = compare_pairs(
        std::move(means),
        std::vector<std::uint64_t>(racers.size(), result.samples_per_pixel * settings.rounds), settings.how);
    return result;
}

} // namespace plumb
