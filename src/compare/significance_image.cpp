// SPDX-License-Identifier: MIT

// Where two images differ beyond their noise. The plain difference of noisy images shows mostly noise.

#include "compare/estimate.h"
#include "plumb/base/error.h"
#include "plumb/image/false_color.h"

#include <algorithm>
#include <cmath>

namespace plumb {

namespace {

constexpr Color red(0.9f, 0.02f, 0.01f);
constexpr float brightest = 0.35f; // of the grey image, so that the colours stand out

// How much of the colour covers the image: all of it for a pixel, less for larger squares.
float cover(std::uint16_t size)
{
    if (size == 0) return 0.f;
    if (size == Significance::whole_image) return 0.15f;
    return std::max(0.25f, 1.f - 0.1f * std::log2(static_cast<float>(size)));
}

} // namespace

Image significance_image(const Image& image_a, const Image& image_b, const Comparison& comparison,
                         const CompareSettings& settings)
{
    const auto [a, b] = make_compared_images(image_a, image_b, settings);
    const std::vector<std::uint16_t>& sizes = comparison.significance.rejected_by;
    if (sizes.size() != a.pixels()) throw Error("there was no test, so there is no map of what it rejected");
    Image image(a.window.width, a.window.height);
    std::size_t i = 0;
    for (int y = 0; y < a.window.height; ++y) {
        for (int x = 0; x < a.window.width; ++x, ++i) {
            const bool is_finite = a.is_finite(i);
            const float light = is_finite ? std::max(0.f, luminance(a.color(i))) : 0.f;
            const Color grey(brightest * light / (1.f + light));
            const float part = cover(sizes[i]);
            const Color color =
                is_finite == b.is_finite(i) ? (1.f - part) * grey + part * red : not_finite_color;
            for (int channel = 0; channel < 3; ++channel) image.pixel(x, y)[channel] = color[channel];
        }
    }
    return image;
}

} // namespace plumb
