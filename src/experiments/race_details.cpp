// SPDX-License-Identifier: MIT
#include "experiments/race_details.h"

#include "compare/channel_names.h"
#include "experiments/racer.h"

#include "plumb/statistics/mean_and_variance.h"

#include <fmt/format.h>

namespace plumb {

namespace {

template <class Action>
void for_each_pixel(const Image& image, const Action& action)
{
    const PixelRect& window = image.data_window();
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) action(x, y);
}

double mean_squared_difference(const Image& a, const Image& b)
{
    MeanAndVariance squares;
    for_each_pixel(a, [&](int x, int y) {
        for (int channel = 0; channel < 3; ++channel)
            squares.add(sqr(static_cast<double>(a.pixel(x, y)[channel]) - b.pixel(x, y)[channel]));
    });
    return squares.mean();
}

} // namespace

Image mean_image(std::span<const Image> images)
{
    const Image& first = images.front();
    Image mean(first.data_window(), first.full_width(), first.full_height(),
               {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    for_each_pixel(mean, [&](int x, int y) {
        for (int channel = 0; channel < 3; ++channel) {
            MeanAndVariance values;
            for (const Image& image : images) values.add(image.pixel(x, y)[channel]);
            mean.pixel(x, y)[channel] = static_cast<float>(values.mean());
            mean.pixel(x, y)[channel + 3] = static_cast<float>(sqr(values.standard_error()));
        }
    });
    return mean;
}

std::vector<double> squared_distances(std::span<const Image> images, const Image& other)
{
    std::vector<double> distances;
    for (const Image& image : images) distances.push_back(mean_squared_difference(image, other));
    return distances;
}

Truth::Truth(const Image& reference) : colors_(colors_of(reference, Side::b))
{
    const ChosenChannels chosen = choose_channels(reference, Side::b, {}, false);
    if (chosen.kind != VarianceKind::of_mean) return;
    MeanAndVariance variances;
    for_each_pixel(reference, [&](int x, int y) {
        for (const std::size_t place : chosen.variances)
            if (const double v = reference.pixel(x, y)[place]; std::isfinite(v)) variances.add(v);
    });
    noise_ = variances.mean();
}

void Truth::check(const PixelRect& window) const
{
    const PixelRect& own = colors_.data_window();
    if (own != window)
        throw Error(fmt::format(
            "the reference has {}x{} pixels at {},{}, and the scene {}x{} at {},{}; choose the "
            "scene's with --size",
            own.width, own.height, own.x, own.y, window.width, window.height, window.x, window.y));
}

std::vector<double> Truth::squared_errors(std::span<const Image> images) const
{
    std::vector<double> errors = squared_distances(images, colors_);
    for (double& error : errors) error -= noise_;
    return errors;
}

std::optional<Bounded> error_of(std::span<const Image> images, const std::optional<Truth>& truth)
{
    if (truth) return rmse_of_errors(truth->squared_errors(images));
    return rmse_of_spread(
        {std::vector<double>(images.size(), 1.0), squared_distances(images, mean_image(images))});
}

Image efficiency_map(const Image& mean, std::size_t images, double seconds, const std::optional<Image>& rays)
{
    Image map(mean.data_window(), mean.full_width(), mean.full_height(), {"Y"});
    const auto rays_at = [&](int x, int y) { return rays ? static_cast<double>(rays->pixel(x, y)[0]) : 1.0; };
    double all_rays = 0.0;
    for_each_pixel(map, [&](int x, int y) { all_rays += rays_at(x, y); });
    for_each_pixel(map, [&](int x, int y) {
        const float* const pixel = mean.pixel(x, y);
        MeanAndVariance variance; // of the mean, over the channels
        for (int channel = 3; channel < 6; ++channel) variance.add(pixel[channel]);
        const double cost =
            variance.mean() * static_cast<double>(images) * seconds * rays_at(x, y) / all_rays;
        map.pixel(x, y)[0] = cost > 0.0 ? static_cast<float>(1.0 / cost) : 0.f;
    });
    return map;
}

} // namespace plumb
