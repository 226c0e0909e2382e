// SPDX-License-Identifier: MIT

// Error bars from images with other seeds: the variance of their mean is their sample variance / n, with n - 1 degrees
// of freedom in each pixel. Whether the noise of neighbours is correlated shows in the differences of two replicas,
// which have no expectation.

#include "compare/channel_names.h"
#include "compare/correlation.h"
#include "plumb/base/error.h"
#include "plumb/compare/compare.h"
#include "plumb/image/development.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t most_pairs = 4; // whose correlation is measured

std::string name_of(Side side, std::size_t index)
{
    return fmt::format("{}{}", side == Side::a ? "A" : "B", index + 1);
}

std::size_t pixel_count(const Image& image)
{
    const PixelRect& window = image.data_window();
    return static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
}

const float* pixel_at(const Image& image, std::size_t index)
{
    const PixelRect& window = image.data_window();
    const auto width = static_cast<std::size_t>(window.width);
    return image.pixel(window.x + static_cast<int>(index % width),
                       window.y + static_cast<int>(index / width));
}

bool are_identical(const Image& x, const Image& y, const std::vector<std::size_t>& places)
{
    for (std::size_t i = 0; i < pixel_count(x); ++i)
        for (const std::size_t place : places) {
            const float p = pixel_at(x, i)[place];
            const float q = pixel_at(y, i)[place];
            if (p != q && !(std::isnan(p) && std::isnan(q))) return false;
        }
    return true;
}

void check_replicas(const std::vector<Image>& replicas, Side side, const std::vector<std::size_t>& places)
{
    const Image& first = replicas.front();
    for (std::size_t k = 1; k < replicas.size(); ++k) {
        const Image& image = replicas[k];
        if (image.data_window() != first.data_window() || image.full_width() != first.full_width() ||
            image.full_height() != first.full_height())
            throw Error(fmt::format("{} and {} have different sizes: {}x{} and {}x{} pixels",
                                    name_of(side, 0), name_of(side, k), first.data_window().width,
                                    first.data_window().height, image.data_window().width,
                                    image.data_window().height));
        if (image.channel_names() != first.channel_names())
            throw Error(fmt::format("{} and {} have different channels: {} and {}", name_of(side, 0),
                                    name_of(side, k), fmt::join(first.channel_names(), ", "),
                                    fmt::join(image.channel_names(), ", ")));
        if (display_text(image.metadata) != display_text(first.metadata))
            throw Error(fmt::format("{} and {} were developed differently, with another curve or exposure",
                                    name_of(side, 0), name_of(side, k)));
    }
    for (std::size_t k = 0; k < replicas.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (are_identical(replicas[j], replicas[k], places))
                throw Error(fmt::format("{} and {} have the same pixels; replicas need different seeds",
                                        name_of(side, j), name_of(side, k)));
}

// The channels that are light, and the name of the variance channel of each.
struct Means {
    std::vector<std::size_t> places;
    std::vector<std::string> names;
    std::vector<std::string> variances;
};

Means find_means(const Image& image)
{
    Means means;
    const std::vector<std::string>& names = image.channel_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& name = names[i];
        if (name == "contributing" || name == "samples" || name.starts_with("variance") ||
            name.starts_with("Variance") || name.starts_with("RelativeVariance") || name.starts_with("m2_"))
            continue;
        means.places.push_back(i);
        means.names.push_back(name);
        means.variances.push_back((name.find('.') == std::string::npos ? "variance." : "variance_of_") +
                                  name);
    }
    return means;
}

// Sums over blocks of side^2 pixels: their squares, over the sum of the pixels' squares.
double block_inflation(const std::vector<double>& values, int width, int height, int side)
{
    double blocks = 0.0;
    double pixels = 0.0;
    for (int top = 0; top + side <= height; top += side) {
        for (int left = 0; left + side <= width; left += side) {
            double sum = 0.0;
            for (int y = top; y < top + side; ++y) {
                for (int x = left; x < left + side; ++x) {
                    const double value =
                        values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)];
                    sum += value;
                    pixels += value * value;
                }
            }
            blocks += sum * sum;
        }
    }
    return pixels > 0.0 ? blocks / pixels : 1.0;
}

double inflation_of(const std::vector<Image>& replicas, const Means& means)
{
    const PixelRect& window = replicas.front().data_window();
    double sum = 0.0;
    std::size_t pairs = 0;
    for (std::size_t k = 0; k + 1 < replicas.size() && pairs < most_pairs; k += 2, ++pairs) {
        std::vector<double> differences(pixel_count(replicas[k]), 0.0);
        for (std::size_t i = 0; i < differences.size(); ++i) {
            for (std::size_t channel = 0; channel < std::min<std::size_t>(3, means.places.size());
                 ++channel) {
                const std::size_t place = means.places[channel];
                const double d = static_cast<double>(pixel_at(replicas[k], i)[place]) -
                                 static_cast<double>(pixel_at(replicas[k + 1], i)[place]);
                if (std::isfinite(d)) differences[i] += d;
            }
        }
        const Correlation found = measure_correlation(differences, window.width, window.height);
        double inflation = found.inflation;
        for (const int side : {16, 32})
            if (!found.reach)
                inflation =
                    std::max(inflation, block_inflation(differences, window.width, window.height, side));
        sum += inflation;
    }
    return pairs > 0 ? sum / static_cast<double>(pairs) : 1.0;
}

} // namespace

Image mean_of_replicas(const std::vector<Image>& replicas, Side side)
{
    const Image& first = replicas.front();
    const Means means = find_means(first);
    check_replicas(replicas, side, means.places);

    std::vector<std::string> names = means.names;
    names.insert(names.end(), means.variances.begin(), means.variances.end());
    Image result(first.data_window(), first.full_width(), first.full_height(), names);
    result.metadata = first.metadata;
    std::erase_if(result.metadata, [](const auto& entry) {
        return entry.first == "plumb:samplesPerPixel" || entry.first == "samplesPerPixel" ||
               entry.first == "plumb:seed" || entry.first == replicas_mark || entry.first == inflation_mark;
    });
    result.metadata.emplace_back(replicas_mark, static_cast<int>(replicas.size()));
    const double inflation = inflation_of(replicas, means);
    if (inflation > 1.0) result.metadata.emplace_back(inflation_mark, static_cast<float>(inflation));

    const double count = static_cast<double>(replicas.size());
    const PixelRect& window = first.data_window();
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            float* out = result.pixel(x, y);
            for (std::size_t channel = 0; channel < means.places.size(); ++channel) {
                double mean = 0.0;
                for (const Image& image : replicas)
                    mean += static_cast<double>(image.pixel(x, y)[means.places[channel]]) / count;
                double squares = 0.0;
                for (const Image& image : replicas) {
                    const double d = static_cast<double>(image.pixel(x, y)[means.places[channel]]) - mean;
                    squares += d * d;
                }
                out[channel] = static_cast<float>(mean);
                out[means.places.size() + channel] = static_cast<float>(squares / (count - 1.0) / count);
            }
        }
    }
    return result;
}

} // namespace plumb
