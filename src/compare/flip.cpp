// SPDX-License-Identifier: MIT

// Numbers of papers and equations: see compare/flip.h.

#include "compare/flip.h"

#include "compare/flip_ldr.h"
#include "plumb/image/development.h"

namespace plumb {

namespace {

constexpr double ln_2 = 0x1.62e42fefa39efp-1;

FlipError with_mean(std::vector<float> map)
{
    double sum = 0.0;
    for (const float error : map) sum += static_cast<double>(error);
    const double mean = map.empty() ? 0.0 : sum / static_cast<double>(map.size());
    return {std::move(map), mean};
}

std::vector<Vec3d> tone_mapped(const std::vector<Color>& image, double exposure)
{
    const double scale = exp(exposure * ln_2);
    std::vector<Vec3d> result;
    result.reserve(image.size());
    const auto map = [scale](float x) { return aces_curve(scale * std::max(0.0, static_cast<double>(x))); };
    for (const Color& c : image) result.emplace_back(map(c.r), map(c.g), map(c.b));
    return result;
}

std::vector<Vec3d> clamped(const std::vector<Color>& image)
{
    std::vector<Vec3d> result;
    result.reserve(image.size());
    const auto clamp = [](float x) { return std::clamp(static_cast<double>(x), 0.0, 1.0); };
    for (const Color& c : image) result.emplace_back(clamp(c.r), clamp(c.g), clamp(c.b));
    return result;
}

double upper_median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Exposures in steps of about one stop: in the first, the brightest pixel of the reference is not yet white, in the
// last its median is ([2], section 3).
std::vector<double> exposures(const std::vector<Color>& reference)
{
    std::vector<double> all;
    std::vector<double> lit;
    for (const Color& c : reference) {
        const Vec3d rgb(std::max(0.f, c.r), std::max(0.f, c.g), std::max(0.f, c.b));
        all.push_back(0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z);
        if (all.back() > 0.0) lit.push_back(all.back());
    }
    if (lit.empty()) return {0.0};

    // Where the tone curve reaches 0.85: the larger root of a quadratic equation.
    constexpr double nearly_white = 0.85;
    using F = AcesFraction;
    const double a = F::a0 - nearly_white * F::b0;
    const double b = F::a1 - nearly_white * F::b1;
    const double c = -nearly_white * F::b2;
    const double x_max = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);

    const double middle = upper_median(all);
    const double start = log(x_max / *std::max_element(lit.begin(), lit.end())) / ln_2;
    const double stop = log(x_max / (middle > 0.0 ? middle : upper_median(lit))) / ln_2;
    const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
    std::vector<double> result;
    result.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) result.push_back(start + i * (stop - start) / (count - 1));
    return result;
}

} // namespace

FlipError ldr_flip(const std::vector<Color>& reference, const std::vector<Color>& test, int width, int height)
{
    return with_mean(flip::ldr_errors(clamped(reference), clamped(test), {width, height}));
}

FlipError hdr_flip(const std::vector<Color>& reference, const std::vector<Color>& test, int width, int height)
{
    const flip::Size size{width, height};
    std::vector<float> largest(size.pixels(), 0.f);
    for (const double exposure : exposures(reference)) {
        const std::vector<float> errors =
            flip::ldr_errors(tone_mapped(reference, exposure), tone_mapped(test, exposure), size);
        for (std::size_t i = 0; i < errors.size(); ++i) largest[i] = std::max(largest[i], errors[i]);
    }
    return with_mean(std::move(largest));
}

} // namespace plumb
