// SPDX-License-Identifier: MIT
#include "compare/metrics.h"

#include "plumb/base/error.h"
#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// Of dark references, so that a relative error means something there; usual since Rousselle et al. 2011.
constexpr double relative_epsilon = 0.01;

Vec2i place_of(const ComparedImage& image, std::size_t pixel)
{
    const auto width = static_cast<std::size_t>(image.window.width);
    return {image.window.x + static_cast<int>(pixel % width),
            image.window.y + static_cast<int>(pixel / width)};
}

} // namespace

NonFinite count_non_finite(const ComparedImage& a, const ComparedImage& b)
{
    NonFinite result;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        const bool a_is_finite = a.is_finite(i);
        const bool b_is_finite = b.is_finite(i);
        if (a_is_finite && b_is_finite) continue;
        ++(a_is_finite ? result.only_b : b_is_finite ? result.only_a : result.both);
        if (!result.first) result.first = place_of(a, i);
    }
    return result;
}

Metrics measure(const ComparedImage& a, const ComparedImage& b)
{
    const std::size_t channels = a.channels.size();
    Metrics m;
    double squares = 0.0;
    double relative = 0.0;
    double absolute = 0.0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        if (!a.is_finite(i) || !b.is_finite(i)) continue;
        ++pixels;
        m.mean_a += static_cast<double>(luminance(a.color(i)));
        m.mean_b += static_cast<double>(luminance(b.color(i)));
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const double reference = static_cast<double>(b.value(i, channel));
            const double d = static_cast<double>(a.value(i, channel)) - reference;
            squares += d * d;
            relative += d * d / (reference * reference + relative_epsilon);
            absolute += std::abs(d);
            if (std::abs(d) <= m.max) continue;
            m.max = std::abs(d);
            m.max_pixel = place_of(a, i);
            m.max_channel = static_cast<int>(channel);
        }
    }
    const double count = static_cast<double>(std::max<std::size_t>(pixels, 1));
    const double numbers = count * static_cast<double>(channels);
    m.mse = squares / numbers;
    m.rmse = std::sqrt(m.mse);
    m.relative_mse = relative / numbers;
    m.mae = absolute / numbers;
    constexpr double decibels = -4.34294481903251827651; // -10 / ln 10
    m.psnr = m.mse > 0.0 ? decibels * log(m.mse) : static_cast<double>(infinity);
    m.mean_a /= count;
    m.mean_b /= count;
    return m;
}

std::optional<NoiseCorrected> correct_for_noise(const ComparedImage& a, const ComparedImage& b)
{
    if (!a.knows_noise() || !b.knows_noise()) return {};
    const std::size_t channels = a.channels.size();
    MeanAndVariance errors; // of the pixels: their spread is what the interval follows from
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        if (!a.is_finite(i) || !b.is_finite(i) || !a.variance_is_known(i) || !b.variance_is_known(i))
            continue;
        double error = 0.0;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const double d =
                static_cast<double>(a.value(i, channel)) - static_cast<double>(b.value(i, channel));
            error += d * d - a.variance(i, channel) - b.variance(i, channel);
        }
        errors.add(error / static_cast<double>(channels));
    }
    if (errors.count() < 2) return {};
    const double mean = errors.mean();
    const double half_width = normal_quantile_95 * errors.standard_error();
    NoiseCorrected result;
    result.pixels = errors.count();
    result.squared_error = mean;
    result.low = mean - half_width;
    result.high = mean + half_width;
    if (mean > 0.0) result.root = std::sqrt(mean);
    return result;
}

double metric_value(const Metrics& metrics, std::string_view name)
{
    if (name == "mse") return metrics.mse;
    if (name == "rmse") return metrics.rmse;
    if (name == "relmse") return metrics.relative_mse;
    if (name == "mae") return metrics.mae;
    if (name == "max") return metrics.max;
    if (name == "psnr") return metrics.psnr;
    if (name == "flip") {
        if (metrics.flip) return *metrics.flip;
        throw Error("FLIP was not computed, so it cannot have a limit");
    }
    throw Error(
        fmt::format("unknown metric '{}'; known are mse, rmse, relmse, mae, max, psnr and flip", name));
}

} // namespace plumb
