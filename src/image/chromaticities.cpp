// SPDX-License-Identifier: MIT

// [1] Lindbloom, "RGB/XYZ Matrices" and "Chromatic Adaptation", http://www.brucelindbloom.com.

#include "image/chromaticities.h"

#include "plumb/base/error.h"
#include "plumb/math/math.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumb {

namespace {

using Matrix = std::array<double, 9>;

constexpr Matrix bradford = {0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296};

Matrix product(const Matrix& a, const Matrix& b)
{
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return c;
}

Vec3d product(const Matrix& m, const Vec3d& v)
{
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

// Nothing if the matrix is singular.
std::optional<Matrix> inverse(const Matrix& m)
{
    const Matrix cofactors = {
        m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
        m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
        m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
    const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
    if (!(std::abs(determinant) > 1e-9)) return std::nullopt;
    Matrix result{};
    for (std::size_t i = 0; i < 9; ++i) result[i] = cofactors[i] / determinant;
    return result;
}

// XYZ with Y = 1.
Vec3d xyz_of(double x, double y)
{
    return {x / y, 1.0, (1.0 - x - y) / y};
}

[[noreturn]] void fail(const Chromaticities& c)
{
    throw Error(fmt::format("its chromaticities are no colour space: {} {}, {} {}, {} {}, {} {}", c[0], c[1],
                            c[2], c[3], c[4], c[5], c[6], c[7]));
}

// [1]: the columns are the primaries, scaled so that they make white together.
Matrix xyz_of_rgb(const Chromaticities& c)
{
    // Primaries may lie on the x axis: those of ACES do nearly, and those of XYZ do.
    Matrix primaries{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = static_cast<double>(c[2 * i]), y = static_cast<double>(c[2 * i + 1]);
        primaries[i] = x;
        primaries[3 + i] = y;
        primaries[6 + i] = 1.0 - x - y;
    }
    const auto inverted = inverse(primaries);
    if (!inverted || !(c[7] > 0.f)) fail(c);
    const Vec3d scale = product(*inverted, xyz_of(static_cast<double>(c[6]), static_cast<double>(c[7])));
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < 3; ++i) primaries[3 * row + i] *= scale[static_cast<int>(i)];
    return primaries;
}

// [1]: cones' responses to one white become those to another.
Matrix adaptation(const Vec3d& from, const Vec3d& to)
{
    const Vec3d a = product(bradford, from), b = product(bradford, to);
    const Matrix scaled = {b.x / a.x, 0, 0, 0, b.y / a.y, 0, 0, 0, b.z / a.z};
    return product(*inverse(bradford), product(scaled, bradford));
}

} // namespace

std::optional<Chromaticities> chromaticities_of(const Metadata& metadata)
{
    for (const auto& [name, value] : metadata) {
        const auto* const floats = std::get_if<std::vector<float>>(&value);
        if (name != chromaticities_name || !floats || floats->size() != 8) continue;
        Chromaticities found;
        std::copy(floats->begin(), floats->end(), found.begin());
        return found;
    }
    return std::nullopt;
}

std::optional<std::array<double, 9>> to_srgb(const Chromaticities& from)
{
    constexpr float rounding = 5e-4f; // some write 0.3333 and 0.329 for 1/3 and 0.3290
    bool same = true;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (!std::isfinite(from[i])) fail(from);
        same = same && std::abs(from[i] - srgb_chromaticities[i]) <= rounding;
    }
    if (same) return std::nullopt;
    const Matrix xyz = xyz_of_rgb(from);
    const auto white = [](const Chromaticities& c) {
        return xyz_of(static_cast<double>(c[6]), static_cast<double>(c[7]));
    };
    const auto back = inverse(xyz_of_rgb(srgb_chromaticities));
    return product(*back, product(adaptation(white(from), white(srgb_chromaticities)), xyz));
}

} // namespace plumb
