// SPDX-License-Identifier: MIT

// Errors in false colours.

#include "compare/estimate.h"
#include "compare/false_color_image.h"
#include "plumb/base/error.h"
#include "plumb/image/false_color.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// errors: NaN where a pixel is not finite. largest: what the lightest colour stands for.
Image draw(std::vector<float> errors, int width, int height, double largest)
{
    for (float& error : errors) error = static_cast<float>(static_cast<double>(error) / largest);
    return false_color_image(errors, width, height,
                             {"0", fmt::format("{:.3g}", largest / 2.0), fmt::format("{:.3g}", largest)});
}

// The error that one pixel in 200 exceeds: single bright pixels do not make all others dark.
double nearly_largest(std::vector<float> errors)
{
    std::erase_if(errors, [](float error) { return std::isnan(error); });
    if (errors.empty()) return 1.0;
    const auto place = errors.begin() + static_cast<std::ptrdiff_t>((errors.size() - 1) * 199 / 200);
    std::nth_element(errors.begin(), place, errors.end());
    if (*place > 0.f) return static_cast<double>(*place);
    const float largest = *std::max_element(errors.begin(), errors.end());
    return largest > 0.f ? static_cast<double>(largest) : 1.0;
}

} // namespace

Image difference_image(const Image& image_a, const Image& image_b, const std::string& layer)
{
    CompareSettings options;
    options.layer = layer;
    const auto [a, b] = make_compared_images(image_a, image_b, options);
    check_comparable(a, b);
    std::vector<float> errors;
    errors.reserve(a.pixels());
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        float error = std::numeric_limits<float>::quiet_NaN();
        if (a.is_finite(i) && b.is_finite(i)) {
            error = 0.f;
            for (std::size_t channel = 0; channel < a.channels.size(); ++channel)
                error = std::max(error, std::abs(a.value(i, channel) - b.value(i, channel)));
        }
        errors.push_back(error);
    }
    return draw(errors, a.window.width, a.window.height, nearly_largest(errors));
}

Image flip_image(const Comparison& comparison)
{
    if (comparison.flip_map.empty()) throw Error("FLIP was not computed, so there is no map of it");
    return draw(comparison.flip_map, comparison.width, comparison.height, 1.0);
}

} // namespace plumb
