// SPDX-License-Identifier: MIT

// Numbers of papers and equations: see compare/flip.h.

#include "compare/flip_ldr.h"

#include "compare/flip_color.h"

namespace plumb {

namespace {

using flip::Size;

constexpr double pixels_per_degree = 0.7 * (3840.0 / 0.7) * (pi_d / 180.0);

// One number for each pixel.
using Plane = std::vector<double>;
using Kernel = std::vector<double>; // of odd length, about its middle

// Sums of `kernel` times the pixels beside each pixel; beyond its border the image goes on as it ends.
Plane filter_rows(const Plane& plane, const Kernel& kernel, const Size& size)
{
    const std::size_t radius = kernel.size() / 2;
    Plane result(plane.size(), 0.0);
    std::vector<double> row(size.columns() + 2 * radius);
    for (std::size_t y = 0; y < size.rows(); ++y) {
        const double* const from = plane.data() + y * size.columns();
        double* const to = result.data() + y * size.columns();
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = from[std::min(std::max(i, radius) - radius, size.columns() - 1)];
        for (std::size_t i = 0; i < kernel.size(); ++i)
            for (std::size_t x = 0; x < size.columns(); ++x) to[x] += kernel[i] * row[x + i];
    }
    return result;
}

// The same with the pixels above and below.
Plane filter_columns(const Plane& plane, const Kernel& kernel, const Size& size)
{
    const std::size_t radius = kernel.size() / 2;
    Plane result(plane.size(), 0.0);
    for (std::size_t y = 0; y < size.rows(); ++y) {
        double* const to = result.data() + y * size.columns();
        for (std::size_t i = 0; i < kernel.size(); ++i) {
            const std::size_t row = std::min(std::max(y + i, radius) - radius, size.rows() - 1);
            const double* const from = plane.data() + row * size.columns();
            for (std::size_t x = 0; x < size.columns(); ++x) to[x] += kernel[i] * from[x];
        }
    }
    return result;
}

Plane filter(const Plane& plane, const Kernel& across, const Kernel& down, const Size& size)
{
    return filter_columns(filter_rows(plane, across, size), down, size);
}

// The eye's contrast sensitivity, as blurs of the three channels: Gaussians whose Fourier transforms [1], table 1,
// lists; that of Cz is the sum of two ([1], section 4.1.1 and equation 3).
struct SpatialFilters {
    Kernel y;
    Kernel cx;
    Kernel cz_narrow; // sum in the plane of both: 1
    Kernel cz_wide;
};

double sum_of(const Kernel& kernel)
{
    double sum = 0.0;
    for (const double weight : kernel) sum += weight;
    return sum;
}

Kernel scaled(Kernel kernel, double factor)
{
    for (double& weight : kernel) weight *= factor;
    return kernel;
}

Kernel gaussian(double b)
{
    // Three standard deviations of the widest of the Gaussians, whose b is 0.04.
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi_d * pi_d)) * pixels_per_degree));
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(exp(-sqr(pi_d * i / pixels_per_degree) / b));
    return kernel;
}

const SpatialFilters& spatial_filters()
{
    static const SpatialFilters filters = [] {
        constexpr double a1 = 34.1;
        constexpr double b1 = 0.04;
        constexpr double a2 = 13.5;
        constexpr double b2 = 0.025;
        const Kernel y = gaussian(0.0047);
        const Kernel cx = gaussian(0.0053);
        const Kernel cz1 = gaussian(b1);
        const Kernel cz2 = gaussian(b2);
        const double weight1 = a1 * std::sqrt(pi_d / b1);
        const double weight2 = a2 * std::sqrt(pi_d / b2);
        const double total = weight1 * sqr(sum_of(cz1)) + weight2 * sqr(sum_of(cz2));
        return SpatialFilters{scaled(y, 1.0 / sum_of(y)), scaled(cx, 1.0 / sum_of(cx)),
                              scaled(cz1, std::sqrt(weight1 / total)),
                              scaled(cz2, std::sqrt(weight2 / total))};
    }();
    return filters;
}

Plane component(const std::vector<Vec3d>& image, int index)
{
    Plane plane;
    plane.reserve(image.size());
    for (const Vec3d& pixel : image) plane.push_back(pixel[index]);
    return plane;
}

// The filtered image in CIELAB with the Hunt effect: what the colours are compared in.
std::vector<Vec3d> perceived_colors(const std::vector<Vec3d>& ycxcz, const Size& size)
{
    const SpatialFilters& filters = spatial_filters();
    const Plane y = filter(component(ycxcz, 0), filters.y, filters.y, size);
    const Plane cx = filter(component(ycxcz, 1), filters.cx, filters.cx, size);
    const Plane cz = component(ycxcz, 2);
    const Plane cz_narrow = filter(cz, filters.cz_narrow, filters.cz_narrow, size);
    const Plane cz_wide = filter(cz, filters.cz_wide, filters.cz_wide, size);
    std::vector<Vec3d> result;
    result.reserve(size.pixels());
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        Vec3d rgb = flip::linear_from_ycxcz({y[i], cx[i], cz_narrow[i] + cz_wide[i]});
        for (int channel = 0; channel < 3; ++channel) rgb[channel] = std::clamp(rgb[channel], 0.0, 1.0);
        result.push_back(flip::hunt_lab_from_linear(rgb));
    }
    return result;
}

// First and second derivative of a Gaussian as wide as an edge that is just seen; the positive and the negative
// weights of each add up to 1 and -1 ([1], section 4.2).
struct FeatureFilters {
    Kernel smooth;
    Kernel edge;
    Kernel point;
};

Kernel balanced(Kernel kernel)
{
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : kernel) (weight > 0.0 ? positive : negative) += std::abs(weight);
    for (double& weight : kernel) weight /= weight > 0.0 ? positive : negative;
    return kernel;
}

const FeatureFilters& feature_filters()
{
    static const FeatureFilters filters = [] {
        constexpr double width = 0.082; // of the features, in degrees
        const double deviation = 0.5 * width * pixels_per_degree;
        const int radius = static_cast<int>(std::ceil(3.0 * deviation));
        FeatureFilters f;
        for (int i = -radius; i <= radius; ++i) {
            const double g = exp(-sqr(i / deviation) / 2.0);
            f.smooth.push_back(g);
            f.edge.push_back(-i * g);
            f.point.push_back((sqr(i / deviation) - 1.0) * g);
        }
        return FeatureFilters{scaled(f.smooth, 1.0 / sum_of(f.smooth)), balanced(f.edge), balanced(f.point)};
    }();
    return filters;
}

struct Features {
    double edge;
    double point;
};

// How strong an edge or a point each pixel lies on.
std::vector<Features> features(const std::vector<Vec3d>& ycxcz, const Size& size)
{
    const FeatureFilters& filters = feature_filters();
    Plane y = component(ycxcz, 0);
    for (double& value : y) value = (value + 16.0) / 116.0;
    const Plane edge_x = filter(y, filters.edge, filters.smooth, size);
    const Plane edge_y = filter(y, filters.smooth, filters.edge, size);
    const Plane point_x = filter(y, filters.point, filters.smooth, size);
    const Plane point_y = filter(y, filters.smooth, filters.point, size);
    std::vector<Features> result;
    result.reserve(size.pixels());
    const auto length = [](double a, double b) { return std::sqrt(a * a + b * b); };
    for (std::size_t i = 0; i < size.pixels(); ++i)
        result.push_back({length(edge_x[i], edge_y[i]), length(point_x[i], point_y[i])});
    return result;
}

// The difference of two colours on a scale from 0 to 1 ([1], section 4.1.3).
double color_error(const Vec3d& reference, const Vec3d& test)
{
    constexpr double exponent = 0.7;
    constexpr double knee = 0.4;
    constexpr double knee_error = 0.95;
    static const double largest = flip::power(
        flip::hyab(flip::hunt_lab_from_linear({0, 1, 0}), flip::hunt_lab_from_linear({0, 0, 1})), exponent);
    const double error = flip::power(flip::hyab(reference, test), exponent) / largest;
    if (error < knee) return error * knee_error / knee;
    return knee_error + (error - knee) / (1.0 - knee) * (1.0 - knee_error);
}

} // namespace

std::vector<float> flip::ldr_errors(const std::vector<Vec3d>& reference, const std::vector<Vec3d>& test,
                                    const Size& size)
{
    struct Seen {
        std::vector<Vec3d> colors;
        std::vector<Features> features;
    };
    const auto look_at = [&size](std::vector<Vec3d> image) {
        for (Vec3d& pixel : image) pixel = flip::ycxcz_from_linear(pixel);
        return Seen{perceived_colors(image, size), features(image, size)};
    };
    const Seen a = look_at(reference);
    const Seen b = look_at(test);
    std::vector<float> errors(size.pixels());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double edge = std::abs(a.features[i].edge - b.features[i].edge);
        const double point = std::abs(a.features[i].point - b.features[i].point);
        const double feature = std::sqrt(std::sqrt(0.5) * std::max(edge, point));
        errors[i] = static_cast<float>(flip::power(color_error(a.colors[i], b.colors[i]), 1.0 - feature));
    }
    return errors;
}

} // namespace plumb
