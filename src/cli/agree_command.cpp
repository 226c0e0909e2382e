// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/text.h"

#include "plumb/compare.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// A picture of the scene by one estimator.
struct Estimate {
    std::string name;
    std::uint64_t samples_per_pixel;
    Image image;
};

struct Pair {
    const Estimate& a;
    const Estimate& b;
    Comparison comparison;
};

// As many samples as take that long, by the speed of a few.
std::uint64_t samples_in(double seconds, const RenderJob& job, RenderOptions options)
{
    constexpr std::uint64_t few = 4;
    options.samples_per_pixel = few;
    const double per_sample = std::max(render(job, options).seconds, 1e-3) / static_cast<double>(few);
    return static_cast<std::uint64_t>(
        std::clamp(seconds / per_sample, static_cast<double>(few), static_cast<double>(film_max_samples)));
}

Estimate estimate(const Options& options, const std::string& integrator, const std::string& sampler,
                  std::uint64_t number, double seconds)
{
    Options one = options;
    one.load.integrator = integrator;
    if (!sampler.empty()) one.load.sampler = sampler;
    one.quiet = options.quiet || number > 0; // what loading says, once
    const LoadedScene scene = load_and_log(one);

    RenderOptions how = options.render;
    how.seed += number; // independent pictures: independent seeds
    how.samples_per_pixel =
        seconds > 0.0 ? samples_in(seconds, scene.job, how) : scene.job.sampler->samples_per_pixel();
    ProgressDisplay display(options.quiet);
    const RenderState result =
        render(scene.job, how, [&](const Progress& progress) { display.show(progress); });

    Estimate made{sampler.empty() ? integrator : integrator + " with " + sampler, how.samples_per_pixel,
                  result.film.develop(Channels::color_and_evidence)};
    made.image.metadata.emplace_back("plumb:samplesPerPixel", static_cast<int>(how.samples_per_pixel));
    return made;
}

std::string pair_text(const Pair& pair)
{
    const Significance& found = pair.comparison.significance;
    std::string text = fmt::format(
        "  {} and {}: {}, p {:.3g}", pair.a.name, pair.b.name,
        pair.comparison.outcome == CompareOutcome::passes ? "agree" : outcome_word(pair.comparison.outcome),
        found.p);
    if (pair.comparison.outcome == CompareOutcome::undecided && !found.reason.empty())
        text += fmt::format(" ({})", found.reason);
    if (pair.comparison.outcome == CompareOutcome::passes && found.differing + found.untested > 0)
        text += fmt::format(" ({} of {} pixels differ, {} are undecided)", found.differing, found.pixels,
                            found.untested);
    if (found.detectable_bias)
        text += fmt::format("; a bias of {:.3g} % would have been found with 90 % probability",
                            *found.detectable_bias * 100.0);
    return text + "\n";
}

CompareOutcome outcome_of(const std::vector<Pair>& pairs)
{
    CompareOutcome worst = CompareOutcome::passes;
    for (const Pair& pair : pairs) {
        if (pair.comparison.outcome == CompareOutcome::differs) return CompareOutcome::differs;
        if (pair.comparison.outcome == CompareOutcome::undecided) worst = CompareOutcome::undecided;
    }
    return worst;
}

const char* verdict_of(CompareOutcome outcome)
{
    switch (outcome) {
    case CompareOutcome::passes: return "agree";
    case CompareOutcome::differs: return "differ";
    case CompareOutcome::undecided: return "undecided";
    }
    return "";
}

// What may decide it. An estimator that all undecided pairs share, and others do not, is the one that rarely finds some
// of the light.
std::string advice(const std::vector<Estimate>& estimates, const std::vector<Pair>& pairs)
{
    const auto is_shared = [&](const Estimate& estimate) {
        return std::all_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
            return pair.comparison.outcome != CompareOutcome::undecided || &pair.a == &estimate ||
                   &pair.b == &estimate;
        });
    };
    std::string names;
    for (const Estimate& estimate : estimates)
        if (estimates.size() > 2 && is_shared(estimate))
            names += (names.empty() ? "" : " or ") + estimate.name;
    std::string text = "more samples may decide it";
    if (!names.empty()) text += "; or leave out " + names + ", which finds some of the light too rarely";
    return text + "\n";
}

std::string agreement_json(const Options& options, const std::vector<Estimate>& estimates,
                           const std::vector<Pair>& pairs)
{
    JsonWriter json;
    json.begin_object();
    json.text("scene", options.subject);
    json.text("verdict", verdict_of(outcome_of(pairs)));
    json.number("significance", options.compare.how.significance);
    json.begin_array("estimates");
    for (const Estimate& estimate : estimates) {
        json.begin_object();
        json.text("name", estimate.name);
        json.integer("spp", estimate.samples_per_pixel);
        json.end_object();
    }
    json.end_array();
    json.begin_array("pairs");
    for (const Pair& pair : pairs) {
        json.begin_object();
        json.text("a", pair.a.name);
        json.text("b", pair.b.name);
        json.text("outcome", outcome_word(pair.comparison.outcome));
        if (!pair.comparison.significance.reason.empty())
            json.text("reason", pair.comparison.significance.reason);
        json.number("p", pair.comparison.significance.p);
        if (const auto& bias = pair.comparison.significance.detectable_bias)
            json.number("detectable_bias", *bias);
        else
            json.null("detectable_bias");
        json.end_object();
    }
    json.end_array();
    json.end_object();
    return std::move(json).finish();
}

void check_request(const Options& options)
{
    const AgreeRequest& request = options.agree;
    if (request.integrators.size() * std::max<std::size_t>(request.samplers.size(), 1) < 2)
        throw UsageError("agree needs two estimators or more; name them with --integrators");
    if (options.stop.seconds && options.load.samples_per_pixel)
        throw UsageError("--time and --spp exclude each other");
}

} // namespace

std::string_view agree_manual()
{
    return "Renders the scene with each estimator, each with random numbers of its own and without a depth\n"
           "cut, and compares all pairs as `renderer compare` does; the significance is that of all pairs\n"
           "together. An error that all the estimators share - in a BSDF, the camera, a mesh - makes no\n"
           "difference between them and is not found. Undecided: some of the light is found by so few\n"
           "samples of an estimator that their spread says nothing. Take more, or leave it out: naive paths\n"
           "rarely meet small lamps, samples of large lamps rarely fit surfaces that are nearly smooth.\n"
           "Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ, 4 undecided.\n";
}

int agree_command(const Options& options)
{
    check_request(options);
    check_outputs({}, options.json);
    const AgreeRequest& request = options.agree;
    const std::vector<std::string> samplers =
        request.samplers.empty() ? std::vector<std::string>{""} : request.samplers;
    const double seconds_each = options.stop.seconds.value_or(0.0) /
                                static_cast<double>(request.integrators.size() * samplers.size());

    std::vector<Estimate> estimates;
    for (const std::string& integrator : request.integrators)
        for (const std::string& sampler : samplers)
            estimates.push_back(estimate(options, integrator, sampler, estimates.size(), seconds_each));

    CompareOptions how = options.compare.how;
    how.flip = FlipMode::none;
    how.significance /= static_cast<double>(estimates.size() * (estimates.size() - 1) / 2); // Bonferroni
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < estimates.size(); ++i)
        for (std::size_t j = i + 1; j < estimates.size(); ++j)
            pairs.push_back(
                {estimates[i], estimates[j], compare(estimates[i].image, estimates[j].image, how)});

    const CompareOutcome outcome = outcome_of(pairs);
    if (!options.quiet && options.json != "-") {
        print_output(options.subject + "\n");
        for (const Estimate& estimate : estimates)
            print_output(
                fmt::format("  {}: {} samples per pixel\n", estimate.name, estimate.samples_per_pixel));
        for (const Pair& pair : pairs) print_output(pair_text(pair));
        print_output(
            fmt::format("{}; what is wrong in all of them alike is beyond this test\n", verdict_of(outcome)));
        if (outcome == CompareOutcome::undecided) print_output(advice(estimates, pairs));
    }
    if (!options.json.empty()) write_json(options.json, agreement_json(options, estimates, pairs));
    return exit_code_of(outcome);
}

} // namespace plumb
