// SPDX-License-Identifier: MIT
#include "cli/estimators.h"

#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/usage_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

std::string Estimator::name() const
{
    return sampler.empty() ? integrator : integrator + " with " + sampler;
}

std::vector<Estimator> estimators_of(const EstimatorRequest& request, std::string_view verb)
{
    std::vector<Estimator> estimators;
    for (const std::string& integrator : request.integrators) {
        if (request.samplers.empty()) estimators.push_back({integrator, ""});
        for (const std::string& sampler : request.samplers) estimators.push_back({integrator, sampler});
    }
    if (estimators.size() < 2)
        throw UsageError(fmt::format("{} needs two estimators or more; name them with --integrators", verb));
    if (request.settings.stop.seconds && request.settings.samples.per_pixel)
        throw UsageError("--time and --spp cannot be used together");
    return estimators;
}

LoadedScene load_for(const Estimator& estimator, const EstimatorRequest& request, bool says)
{
    SceneRequest one = request;
    one.settings.method.integrator = estimator.integrator;
    if (!estimator.sampler.empty()) one.settings.method.sampler = estimator.sampler;
    one.quiet = request.quiet || !says;
    return load_and_log(one);
}

double seconds_per_sample(const RenderJob& job, RenderOptions options)
{
    constexpr std::uint64_t few = 4;
    options.samples_per_pixel = few;
    return std::max(render(job, options).seconds, 1e-3) / static_cast<double>(few);
}

namespace {

// Two pictures of the same bits are the same. Two estimators whose pictures are the same without a pixel that tells anything
// of either, as black ones do not, need not agree.
void doubt_if_untested(Comparison& comparison)
{
    Significance& found = comparison.significance;
    if (!comparison.identical || found.untested < found.pixels) return;
    found.finding = Finding::undecided;
    found.reason = comparison.metrics.mean_a == 0.0 ? "both images are black: no sample has found any light"
                                                    : "no sample of either image shows any noise";
    comparison.outcome = CompareOutcome::undecided;
}

} // namespace

std::vector<Pair> compare_pairs(const std::vector<Estimate>& estimates, const CompareSettings& options)
{
    CompareSettings how = options;
    how.flip = FlipMode::none;
    how.alignment = false;
    how.significance /= static_cast<double>(estimates.size() * (estimates.size() - 1) / 2); // Bonferroni
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < estimates.size(); ++i)
        for (std::size_t j = i + 1; j < estimates.size(); ++j)
            pairs.push_back(
                {estimates[i], estimates[j], compare(estimates[i].image, estimates[j].image, how)});
    for (Pair& pair : pairs) doubt_if_untested(pair.comparison);
    return pairs;
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

std::string_view verdict_of(CompareOutcome outcome)
{
    switch (outcome) {
    case CompareOutcome::passes: return "agree";
    case CompareOutcome::differs: return "differ";
    case CompareOutcome::undecided: return "undecided";
    }
    return "";
}

std::string pair_text(const Pair& pair)
{
    const Significance& found = pair.comparison.significance;
    std::string text = fmt::format(
        "  {} and {}: {}, p {}", pair.a.name, pair.b.name,
        pair.comparison.outcome == CompareOutcome::passes ? "agree" : outcome_word(pair.comparison.outcome),
        p_text(found.p, 3));
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
    if (!names.empty()) text += "; or omit " + names + ", which finds some of the light too rarely";
    return text + "\n";
}

void write_verdict(JsonWriter& json, const EstimatorRequest& request, const std::vector<Pair>& pairs)
{
    json.text("scene", request.scene);
    json.text("verdict", verdict_of(outcome_of(pairs)));
    json.number("significance", request.how.significance);
}

void write_pairs(JsonWriter& json, const std::vector<Pair>& pairs)
{
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
}

} // namespace plumb
