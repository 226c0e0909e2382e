// SPDX-License-Identifier: MIT

#include "plumb/render/evidence.h"

#include "plumb/statistics/statistics.h"

#include <fmt/format.h>

namespace plumb {

namespace {

SampleSet::Range counts_of_pixels(const Film& film)
{
    const PixelRect& window = film.window();
    SampleSet::Range counts{UINT64_MAX, 0};
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const std::uint64_t count = film.sample_count({x, y});
            counts = {std::min(counts.least, count), std::max(counts.most, count)};
        }
    }
    return counts;
}

} // namespace

std::optional<NoiseEstimate> estimate_noise(const Film& film)
{
    const PixelRect& window = film.window();
    const double pixels = static_cast<double>(window.width) * static_cast<double>(window.height);
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Color variance = film.variance_of_mean({x, y});
            if (std::isnan(variance.r)) return std::nullopt;
            const double mean = (static_cast<double>(variance.r) + static_cast<double>(variance.g) +
                                 static_cast<double>(variance.b)) /
                                3.0;
            sum += mean;
            sum_of_squares += sqr(mean);
        }
    }
    const double squared_error = sum / pixels;
    const double spread = std::max(sum_of_squares / pixels - sqr(squared_error), 0.0);
    const double margin = normal_quantile_95 * std::sqrt(spread / pixels);
    return NoiseEstimate{std::sqrt(squared_error), std::sqrt(std::max(squared_error - margin, 0.0)),
                         std::sqrt(squared_error + margin)};
}

std::optional<NoiseEstimate> estimate_relative_noise(const Film& film)
{
    std::optional<NoiseEstimate> noise = estimate_noise(film);
    if (!noise) return std::nullopt;
    const Image image = film.develop();
    const PixelRect& window = film.window();
    double sum = 0.0;
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Color color = image.color(x, y);
            sum += static_cast<double>(color.r) + static_cast<double>(color.g) + static_cast<double>(color.b);
        }
    }
    const double mean = sum / (3.0 * static_cast<double>(window.width) * static_cast<double>(window.height));
    if (!(mean > 0.0)) return std::nullopt;
    return NoiseEstimate{noise->rmse / mean, noise->low / mean, noise->high / mean};
}

BiasReport make_ledger(const RenderJob& job, const Dialect& dialect)
{
    BiasReport ledger;
    if (std::string bias = job.integrator->bias(); !bias.empty()) ledger.biases.push_back(std::move(bias));
    if (dialect.emitters_absorb) ledger.model.emplace_back("emitters absorb incident light");
    if (dialect.mirrored_view) ledger.model.emplace_back("the view is mirrored");
    if (dialect.point_takes_power) ledger.model.emplace_back("the power of point lights is in watts");
    if (dialect.environment_flipped) ledger.model.emplace_back("environment images are flipped");
    if (dialect.environment_scale != 1.f)
        ledger.model.push_back(
            fmt::format("environment images are multiplied by {}", dialect.environment_scale));
    return ledger;
}

Evidence make_evidence(BiasReport before, const RenderState& state, const std::string& stop)
{
    const PixelRect& window = state.film.window();
    Evidence evidence{std::move(before),
                      estimate_noise(state.film),
                      state.left_out,
                      state.taken.samples_per_pixel(window).least,
                      state.taken,
                      true,
                      state.samples(),
                      {},
                      stop};
    if (state.film.plans() == Plans::kept) {
        const SampleSet::Range counts = counts_of_pixels(state.film);
        evidence.samples_per_pixel = counts.least;
        evidence.most_samples_per_pixel = counts.most;
    }
    evidence.even = state.film.plans() == Plans::none &&
                    state.taken == SampleSet(SampleBlock{window, 0, evidence.samples_per_pixel});
    std::vector<std::string>& biases = evidence.ledger.biases;
    if (state.left_out.count > 0)
        biases.push_back(fmt::format("{} samples were discarded", state.left_out.count));
    if (!stop.empty() && stop != interruption) biases.push_back(stop);
    if (evidence.samples_per_pixel == 0) biases.emplace_back("some pixels have no samples and are black");
    return evidence;
}

} // namespace plumb
