// SPDX-License-Identifier: MIT
#include "compare/estimate.h"
#include "compare/channel_names.h"

#include "plumb/base/error.h"
#include "plumb/denoise/denoise.h"
#include "plumb/image/development.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

namespace plumb {

namespace {

std::vector<float> read_channels(const Image& image, const std::vector<std::size_t>& places)
{
    const PixelRect& window = image.data_window();
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) *
                   places.size());
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (const std::size_t place : places) values.push_back(image.pixel(x, y)[place]);
    return values;
}

// The hash is of the scene's files and of what the command line makes of them.
std::string estimator_of(const Image& image)
{
    const std::string inputs = header_text(image, "plumb:inputHash");
    const std::string integrator = header_text(image, "plumb:integrator");
    return inputs.empty() || integrator.empty() ? "" : inputs + " " + integrator;
}

// 10 bits behind the leading one, and zeros: what a 16-bit float holds without loss (its exponents aside).
bool halves_hold(const std::vector<float>& values)
{
    return std::all_of(values.begin(), values.end(), [](float value) {
        return !std::isfinite(value) || (std::bit_cast<std::uint32_t>(value) & 0x1fffu) == 0;
    });
}

// From the variances of a sample, or from the means of the samples' squares.
void to_variance_of_mean(ComparedImage& image, VarianceKind kind)
{
    const double samples = *image.samples_per_pixel;
    for (std::size_t i = 0; i < image.variances.size(); ++i) {
        double variance = static_cast<double>(image.variances[i]);
        if (kind == VarianceKind::second_moment)
            variance = std::max(0.0, variance - sqr(static_cast<double>(image.values[i]))) * samples /
                       std::max(samples - 1.0, 1.0);
        image.variances[i] = static_cast<float>(variance / samples);
    }
}

// The noise of red, green and blue may be correlated: the variance is at most the square of the weighted deviations' sum.
void to_luminance(ComparedImage& image)
{
    const Color weights = {luminance(Color(1.f, 0.f, 0.f)), luminance(Color(0.f, 1.f, 0.f)),
                           luminance(Color(0.f, 0.f, 1.f))};
    std::vector<float> values;
    std::vector<float> variances;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        values.push_back(luminance(image.color(i)));
        if (image.variances.empty()) continue;
        const auto deviation = [&](std::size_t channel) {
            return std::sqrt(image.variances[3 * i + channel]);
        };
        const float sum = weights.r * deviation(0) + weights.g * deviation(1) + weights.b * deviation(2);
        variances.push_back(sum * sum);
    }
    image.channels = {"Y"};
    image.values = std::move(values);
    image.variances = std::move(variances);
}

std::string size_text(const ComparedImage& image)
{
    const PixelRect& window = image.window;
    std::string text = fmt::format("{}x{} pixels", image.full_width, image.full_height);
    if (window != PixelRect{0, 0, image.full_width, image.full_height})
        text += fmt::format(" of which {},{},{},{} exist", window.x, window.y, window.width, window.height);
    return text;
}

} // namespace

Color ComparedImage::color(std::size_t pixel) const
{
    if (channels.size() == 1) return Color(value(pixel, 0));
    return {value(pixel, 0), value(pixel, 1), channels.size() > 2 ? value(pixel, 2) : 0.f};
}

bool ComparedImage::is_finite(std::size_t pixel) const
{
    return plumb::is_finite(color(pixel));
}

bool ComparedImage::variance_is_known(std::size_t pixel) const
{
    if (!knows_noise()) return false;
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
        const double v = variance(pixel, channel);
        if (!std::isfinite(v) || v < 0.0) return false;
    }
    return true;
}

ComparedImage make_compared_image(const Image& image, Side side, const CompareSettings& options)
{
    const NoiseFacts facts = noise_facts(image, options);
    const ChosenChannels chosen = choose_channels(image, side, options.layer, facts.samples.has_value());
    ComparedImage compared;
    compared.window = image.data_window();
    compared.full_width = image.full_width();
    compared.full_height = image.full_height();
    compared.channels = chosen.names;
    compared.values = read_channels(image, chosen.values);
    compared.samples_per_pixel = facts.samples;
    compared.estimator = estimator_of(image);
    compared.seed = header_text(image, "plumb:seed");
    compared.is_for_screens = !header_text(image, screen_mark).empty();
    compared.denoised = denoised_text(image.metadata);
    compared.display = display_text(image.metadata);
    compared.is_luminance = chosen.is_luminance;
    compared.is_half = halves_hold(compared.values);
    if (chosen.variances.empty()) return compared;

    const VarianceKind kind = variance_kind(chosen, facts, options);
    if (kind != VarianceKind::of_mean && !facts.samples) {
        compared.noise =
            fmt::format("none ({} without a number of samples: pass --spp N)", chosen.variance_name);
        return compared;
    }
    compared.variances = read_channels(image, chosen.variances);
    if (kind != VarianceKind::of_mean) to_variance_of_mean(compared, kind);
    if (chosen.contributing) compared.contributing = read_channels(image, {*chosen.contributing});
    compared.noise = "variance channels";
    if (facts.replicas) {
        compared.noise = fmt::format("{} replicas", *facts.replicas);
        compared.freedom = static_cast<double>(*facts.replicas - 1);
        compared.inflation = facts.inflation;
        compared.samples_per_pixel.reset();
    } else if (kind != VarianceKind::of_mean) {
        compared.noise = fmt::format("{} of {} samples", chosen.variance_name, *facts.samples);
    }
    return compared;
}

std::pair<ComparedImage, ComparedImage> make_compared_images(const Image& image_a, const Image& image_b,
                                                             const CompareSettings& options)
{
    CompareSettings of_a = options;
    CompareSettings of_b = options;
    const bool a_has = has_layer(image_a, options.layer);
    const bool b_has = has_layer(image_b, options.layer);
    const bool is_of_colors = is_layer_of_colors(a_has ? image_a : image_b, options.layer);
    if (!options.layer.empty() && a_has != b_has && is_of_colors && has_colors(a_has ? image_b : image_a))
        (a_has ? of_b : of_a).layer.clear();
    ComparedImage a = make_compared_image(image_a, Side::a, of_a);
    ComparedImage b = make_compared_image(image_b, Side::b, of_b);
    if (of_a.layer != of_b.layer) a.channels = b.channels = {"R", "G", "B"};
    if (a.is_luminance && !b.is_luminance && b.channels.size() == 3) to_luminance(b);
    if (b.is_luminance && !a.is_luminance && a.channels.size() == 3) to_luminance(a);
    return {std::move(a), std::move(b)};
}

bool are_of_one_estimator(const ComparedImage& a, const ComparedImage& b)
{
    return !a.estimator.empty() && a.estimator == b.estimator;
}

bool share_random_numbers(const ComparedImage& a, const ComparedImage& b)
{
    return are_of_one_estimator(a, b) && !a.seed.empty() && a.seed == b.seed;
}

void check_comparable(const ComparedImage& a, const ComparedImage& b)
{
    if (!b.denoised.empty())
        throw Error(
            fmt::format("B was denoised ({}), and a reference must not be: its error is unknown; compare "
                        "with the image that was denoised",
                        b.denoised));
    const auto how = [](const ComparedImage& image) {
        return image.display.empty() ? "without a curve or exposure" : "as '" + image.display + "'";
    };
    if (a.display != b.display)
        throw Error(fmt::format("the images were developed differently: A {}, B {}; compare images of light, "
                                "such as .exr files",
                                how(a), how(b)));
    if (size_text(a) != size_text(b))
        throw Error(
            fmt::format("the images have different sizes: A is {}, B is {}", size_text(a), size_text(b)));
    if (a.channels != b.channels)
        throw Error(fmt::format("the images have different channels: A has {}, B has {}",
                                fmt::join(a.channels, ", "), fmt::join(b.channels, ", ")));
}

} // namespace plumb
