// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/estimators.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/progress.h"

#include "base/visible_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// As many samples as take that long.
std::uint64_t samples_in(double seconds, const RenderJob& job, const RenderOptions& options)
{
    const double samples = seconds / seconds_per_sample(job, options);
    return static_cast<std::uint64_t>(std::clamp(samples, 4.0, static_cast<double>(film_max_samples)));
}

Estimate estimate(const EstimatorRequest& request, const Estimator& estimator, std::uint64_t number,
                  double seconds)
{
    const LoadedScene scene = load_for(estimator, request, number == 0);
    RenderOptions how = render_options(request.settings, request.threads);
    how.seed += number; // independent pictures: independent seeds
    how.samples_per_pixel =
        seconds > 0.0 ? samples_in(seconds, scene.job, how) : render_samples(scene.job, how);
    ProgressDisplay display(request.quiet);
    const RenderState result =
        render(scene.job, how, [&](const Progress& progress) { display.show(progress); });

    Estimate made{estimator.name(), how.samples_per_pixel, result.film.develop(Channels::color_and_evidence)};
    made.image.metadata.emplace_back("plumb:samplesPerPixel", static_cast<int>(how.samples_per_pixel));
    return made;
}

std::string agreement_json(const EstimatorRequest& request, const std::vector<Estimate>& estimates,
                           const std::vector<Pair>& pairs)
{
    JsonWriter json;
    json.begin_object();
    write_verdict(json, request, pairs);
    json.begin_array("estimates");
    for (const Estimate& estimate : estimates) {
        json.begin_object();
        json.text("name", estimate.name);
        json.integer("spp", estimate.samples_per_pixel);
        json.end_object();
    }
    json.end_array();
    write_pairs(json, pairs);
    json.end_object();
    return std::move(json).finish();
}

} // namespace

std::string_view agree_manual()
{
    return R"(Renders the scene with each estimator, and compares all pairs as
`renderer compare` does. Each estimator has random numbers of its own and no
depth limit. The significance is that of all pairs together. An error that all
estimators share (in a BSDF, the camera, a mesh) cannot be detected.
The result is undecided if so few samples of an estimator find some of the
light that their spread says nothing. Take more samples, or omit that
estimator: naive paths rarely meet small emitters, and light samples on large
emitters rarely suit surfaces that are nearly smooth.
Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ,
4 undecided.
)";
}

int agree_command(const EstimatorRequest& request)
{
    const std::vector<Estimator> estimators = estimators_of(request, "agree");
    check_outputs({}, request.json);
    const double seconds_each =
        request.settings.stop.seconds.value_or(0.0) / static_cast<double>(estimators.size());
    std::vector<Estimate> estimates;
    for (const Estimator& estimator : estimators)
        estimates.push_back(estimate(request, estimator, estimates.size(), seconds_each));
    const std::vector<Pair> pairs = compare_pairs(estimates, request.how);
    const CompareOutcome outcome = outcome_of(pairs);
    if (!request.quiet && request.json != "-") {
        print_output(visible_text(request.scene) + "\n");
        for (const Estimate& estimate : estimates)
            print_output(
                fmt::format("  {}: {} samples per pixel\n", estimate.name, estimate.samples_per_pixel));
        for (const Pair& pair : pairs) print_output(pair_text(pair));
        print_output(
            fmt::format("{}; errors shared by all estimators cannot be detected\n", verdict_of(outcome)));
        if (outcome == CompareOutcome::undecided) print_output(advice(estimates, pairs));
    }
    if (!request.json.empty()) write_json(request.json, agreement_json(request, estimates, pairs));
    return exit_code_of(outcome);
}

} // namespace plumb
