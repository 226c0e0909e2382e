// SPDX-License-Identifier: MIT
#include "experiments/pairs.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

std::string method_name(const MethodSettings& method)
{
    const std::string integrator = method.integrator.value_or("the scene's integrator");
    return method.sampler ? integrator + " with " + *method.sampler : integrator;
}

std::vector<RenderTask> tasks_of(SceneFile& file, const AgreeSettings& settings, int threads)
{
    std::vector<RenderTask> tasks;
    for (const MethodSettings& method : settings.methods) {
        RenderSettings one = settings.base;
        one.method = method;
        try {
            tasks.push_back(make_task(file, one));
        } catch (const SceneError& error) {
            std::vector<Diagnostic> all = error.diagnostics();
            all.push_back({Severity::note, {}, fmt::format("the estimator is '{}'", method_name(method))});
            throw SceneError(std::move(all));
        }
        tasks.back().options.threads = threads;
    }
    return tasks;
}

RenderState render_all(const RenderTask& task, const SessionCallbacks& callbacks)
{
    Rendering rendering(task.scene.job, task.options);
    const SampleBlock all{render_window(task.scene.job, task.options), 0, task.options.samples_per_pixel};
    if (!rendering.take(SampleSet(all), callbacks.progress, [&] { return callbacks.is_stopped(); }))
        throw Error(std::string(interruption));
    return std::move(rendering).finish();
}

double seconds_per_sample(RenderTask task)
{
    constexpr std::uint64_t few = 4;
    task.options.samples_per_pixel = few;
    return std::max(render(task.scene.job, task.options).seconds, 1e-3) / static_cast<double>(few);
}

namespace {

// Two images of the same bits are the same. Two estimators whose images are the same without a pixel that tells anything
// of either, as black ones do not, need not agree.
void doubt_if_untested(Comparison& comparison)
{
    Significance& found = comparison.significance;
    if (!comparison.identical || found.untested < found.pixels) return;
    found.verdict = Verdict::undecided;
    found.reason = comparison.metrics.mean_a == 0.0 ? "both images are black: no sample has found any light"
                                                    : "no sample of either image shows any noise";
    comparison.verdict = Verdict::undecided;
}

Verdict outcome_of(const std::vector<MethodPair>& pairs)
{
    Verdict worst = Verdict::passes;
    for (const MethodPair& pair : pairs) {
        if (pair.comparison.verdict == Verdict::differs) return Verdict::differs;
        if (pair.comparison.verdict == Verdict::undecided) worst = Verdict::undecided;
    }
    return worst;
}

} // namespace

Agreement compare_pairs(std::vector<Estimate> estimates, std::vector<std::uint64_t> samples_of,
                        const CompareSettings& settings)
{
    CompareSettings how = settings;
    how.flip = FlipMode::none;
    how.alignment = false;
    how.significance /= static_cast<double>(estimates.size() * (estimates.size() - 1) / 2); // Bonferroni
    Agreement result{std::move(estimates), std::move(samples_of), {}, Verdict::undecided};
    for (std::size_t a = 0; a < result.estimates.size(); ++a) {
        for (std::size_t b = a + 1; b < result.estimates.size(); ++b) {
            result.pairs.push_back({a, b, compare(result.estimates[a], result.estimates[b], how)});
            doubt_if_untested(result.pairs.back().comparison);
        }
    }
    result.verdict = outcome_of(result.pairs);
    return result;
}

} // namespace plumb
