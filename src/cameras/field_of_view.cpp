// SPDX-License-Identifier: MIT
#include "cameras/field_of_view.h"

#include "plumb/math/elementary.h"

namespace plumb {

namespace {

// Half of 36 mm x 24 mm across, in mm: the film of small-format cameras.
const double half_film_diagonal = 0.5 * std::sqrt(36.0 * 36.0 + 24.0 * 24.0);

} // namespace

FieldOfView read_field_of_view(const Params& params, Vec2i resolution)
{
    const double fov = params.number("fov", 30.f, Range::open(0.0, 180.0));
    const std::string axis = params.choice("fovAxis", "x", {"x", "y", "diagonal", "smaller", "larger"});
    const double focal_length = params.number("focalLengthMm", 50.f, Range::positive());
    const double width = resolution.x, height = resolution.y, diagonal = std::sqrt(sqr(width) + sqr(height));
    if (params.has("focalLengthMm")) {
        if (params.has("fov")) params.fail("focalLengthMm", "and fov were both given; keep one of them");
        const double half_diagonal = half_film_diagonal / focal_length;
        return {half_diagonal * width / diagonal, half_diagonal * height / diagonal};
    }

    const SinCosD half = sin_cos(fov * (pi_d / 360.0));
    const double tangent = half.sin / half.cos;
    const bool is_wide = width > height;
    if (axis == "diagonal") return {tangent * width / diagonal, tangent * height / diagonal};
    if (axis == "y" || (axis == "smaller" && is_wide) || (axis == "larger" && !is_wide))
        return {tangent * width / height, tangent};
    return {tangent, tangent * resolution.y / resolution.x};
}

} // namespace plumb
