// SPDX-License-Identifier: MIT
#include "experiments/pairs.h"

#include <algorithm>

namespace plumb {

Agreement agree(SceneFile& file, const AgreeSettings& settings, int threads,
                const SessionCallbacks& callbacks)
{
    if (settings.methods.size() < 2) throw Error("two methods or more are needed");
    std::vector<RenderTask> tasks = tasks_of(file, settings, threads);
    std::vector<Estimate> estimates;
    std::vector<std::uint64_t> samples_of;
    for (RenderTask& task : tasks) {
        task.options.seed += estimates.size(); // independent images: independent seeds
        if (const auto seconds = settings.base.stop.seconds) {
            const double samples = *seconds / static_cast<double>(tasks.size()) / seconds_per_sample(task);
            task.options.samples_per_pixel =
                static_cast<std::uint64_t>(std::clamp(samples, 4.0, static_cast<double>(film_max_samples)));
        }
        const RenderState result = render_all(task, callbacks);
        const std::uint64_t samples = task.options.samples_per_pixel;
        estimates.push_back({method_name(task.settings.method),
                             result.film.develop(Channels::color_and_evidence),
                             static_cast<double>(samples),
                             {},
                             {}});
        samples_of.push_back(samples);
    }
    return compare_pairs(std::move(estimates), std::move(samples_of), settings.how);
}

} // namespace plumb
