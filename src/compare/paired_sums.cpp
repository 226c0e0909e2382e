// SPDX-License-Identifier: MIT
#include "compare/paired_sums.h"

namespace plumb {

PairedPixels::PairedPixels(const ComparedImage& image_a, const ComparedImage& image_b, std::size_t channel,
                           const std::vector<char>& which)
    : width(image_a.window.width), height(image_a.window.height), counted(which)
{
    const std::size_t pixels = counted.size();
    for (std::vector<double>* numbers : {&differences, &a, &b}) numbers->assign(pixels, 0.0);
    black_a.assign(pixels, 1);
    black_b.assign(pixels, 1);
    const ComparedImage* known = image_a.variances.empty() ? &image_b : &image_a;
    if (known->variances.empty()) known = nullptr;
    if (known) variances.assign(pixels, 0.0);
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!counted[i]) continue;
        a[i] = static_cast<double>(image_a.value(i, channel));
        b[i] = static_cast<double>(image_b.value(i, channel));
        differences[i] = a[i] - b[i];
        if (known) {
            const double variance = known->variance(i, channel);
            if (variance > 0.0 && std::isfinite(variance)) variances[i] = variance;
        }
        black_a[i] = image_a.color(i).is_black();
        black_b[i] = image_b.color(i).is_black();
    }
}

std::vector<double> PairedPixels::rough_variances() const
{
    std::vector<double> result(differences.size(), -1.0);
    constexpr int weights[] = {1, -2, 1};
    for (int y = 1; y + 1 < height; ++y) {
        for (int x = 1; x + 1 < width; ++x) {
            double sum = 0.0;
            bool is_whole = true;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const auto i = static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x + dx);
                    sum += weights[dy + 1] * weights[dx + 1] * differences[i];
                    is_whole = is_whole && counted[i];
                }
            }
            if (is_whole) // 36: the sum of the squared weights
                result[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)] = sum * sum / 36.0;
        }
    }
    return result;
}

std::vector<PairedSums> paired_sums(const PairedPixels& pixels, const Squares& squares)
{
    std::vector<PairedSums> result(squares.count());
    const auto for_each_pixel = [&](const auto& visit) {
        std::size_t i = 0;
        for (int y = 0; y < pixels.height; ++y)
            for (int x = 0; x < pixels.width; ++x, ++i)
                if (pixels.counted[i]) visit(result[squares.index(x, y)], i);
    };
    for_each_pixel([&pixels](PairedSums& sums, std::size_t i) {
        const double d = pixels.differences[i];
        sums.pixels += 1.0;
        sums.difference += d;
        sums.square += d * d;
        sums.fourth += d * d * d * d;
        sums.a += pixels.a[i];
        sums.b += pixels.b[i];
        if (!pixels.variances.empty()) sums.variance += pixels.variances[i];
        sums.black_a = sums.black_a && pixels.black_a[i];
        sums.black_b = sums.black_b && pixels.black_b[i];
    });
    for_each_pixel([&pixels](PairedSums& sums, std::size_t i) {
        const double z = pixels.differences[i] - sums.difference / sums.pixels;
        sums.spread += z * z;
        sums.spread_fourth += z * z * z * z;
        sums.largest = std::max(sums.largest, z * z);
    });
    return result;
}

} // namespace plumb
