// SPDX-License-Identifier: MIT
#include "compare/shifted.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

// Weighted sums over neighbours along x and y; outside of the image there is nowhere.
std::vector<float> filtered(const ComparedImage& image, const std::vector<float>& weights_x, int first_x,
                            const std::vector<float>& weights_y, int first_y)
{
    const int width = image.window.width;
    const int height = image.window.height;
    const int channels = static_cast<int>(image.channels.size());
    const auto along = [&](const std::vector<float>& values, const std::vector<float>& weights, int first,
                           bool is_x) {
        std::vector<float> result(values.size());
        std::size_t i = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < channels; ++c, ++i) {
                    float sum = 0.f;
                    for (std::size_t k = 0; k < weights.size(); ++k) {
                        const int at_x = is_x ? x + first + static_cast<int>(k) : x;
                        const int at_y = is_x ? y : y + first + static_cast<int>(k);
                        const bool is_inside = at_x >= 0 && at_y >= 0 && at_x < width && at_y < height;
                        sum +=
                            is_inside
                                ? weights[k] *
                                      values[static_cast<std::size_t>((at_y * width + at_x) * channels + c)]
                                : nowhere;
                    }
                    result[i] = sum;
                }
            }
        }
        return result;
    };
    return along(along(image.values, weights_x, first_x, true), weights_y, first_y, false);
}

void leave_out_the_same(ImagePair& pair)
{
    for (std::size_t i = 0; i < pair.a.values.size(); ++i)
        if (std::isnan(pair.a.values[i]) || std::isnan(pair.b.values[i]))
            pair.a.values[i] = pair.b.values[i] = nowhere;
}

} // namespace

void drop_noise(ComparedImage& image)
{
    image.variances.clear();
    image.contributing.clear();
}

ImagePair shift(const ComparedImage& a, const ComparedImage& b, int half_x, int half_y)
{
    ImagePair pair{a, b};
    const bool is_whole = half_x % 2 == 0 && half_y % 2 == 0;
    const auto weights_a = [](int half) {
        return half % 2 == 0 ? std::vector<float>{1.f} : std::vector<float>{.125f, .375f, .375f, .125f};
    };
    const auto weights_b = [](int half) {
        return half % 2 == 0 ? std::vector<float>{1.f}
                             : std::vector<float>{1.f / 32.f, .25f, .4375f, .25f, 1.f / 32.f};
    };
    const auto first_a = [](int half) { return half % 2 == 0 ? half / 2 : half > 0 ? -1 : -2; };
    const auto first_b = [](int half) { return half % 2 == 0 ? 0 : -2; };
    pair.a.values = filtered(a, weights_a(half_x), first_a(half_x), weights_a(half_y), first_a(half_y));
    if (is_whole) {
        ComparedImage noise = a;
        if (!a.variances.empty()) {
            noise.values = a.variances;
            pair.a.variances = filtered(noise, {1.f}, half_x / 2, {1.f}, half_y / 2);
        }
        pair.a.contributing.clear();
    } else {
        pair.b.values = filtered(b, weights_b(half_x), first_b(half_x), weights_b(half_y), first_b(half_y));
        drop_noise(pair.a);
        drop_noise(pair.b);
    }
    leave_out_the_same(pair);
    return pair;
}

ImagePair unshifted(const ComparedImage& a, const ComparedImage& b, int half_x, int half_y)
{
    ImagePair pair = shift(a, b, half_x, half_y);
    const bool is_whole = half_x % 2 == 0 && half_y % 2 == 0;
    std::vector<float> values = is_whole ? a.values : shift(b, a, half_x, half_y).b.values;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isnan(pair.a.values[i])) values[i] = nowhere;
    pair.a.values = std::move(values);
    leave_out_the_same(pair);
    return pair;
}

std::string shift_text(int half_x, int half_y)
{
    const auto way = [](int half, const char* more, const char* less) {
        return fmt::format("{} {}", half % 2 == 0 ? "1 pixel" : "half a pixel", half > 0 ? less : more);
    };
    std::string text = half_x != 0 ? way(half_x, "right", "left") : "";
    if (half_y != 0) text += (text.empty() ? "" : " and ") + way(half_y, "down", "up");
    return "shifted " + text;
}

} // namespace plumb
