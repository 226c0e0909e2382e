// SPDX-License-Identifier: MIT

#include "plumb/film.h"

#include "plumb/error.h"

#include <new>

#include <fmt/format.h>

namespace plumb {
namespace {

__extension__ typedef __int128 Int128;

constexpr double unit = 0x1p-64; // what the last bit of a sum is worth
constexpr double units_per_one = 0x1p64;

// To the nearest unit. |x| < 2^37, so the result lies below 2^101.
Int128 to_fixed(float x)
{
    const double units = static_cast<double>(x) * units_per_one; // exact: a power of two
    if (std::abs(units) < 0x1p62) return std::llrint(units);
    return static_cast<Int128>(units); // a float above 2^-2 is a whole number of units
}

} // namespace

Film::Film(PixelRect window, int full_width, int full_height)
    : window_(window), full_width_(full_width), full_height_(full_height)
{
    try {
        pixels_.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("not enough memory for a film of {}x{} pixels ({} bytes each)", window.width,
                                window.height, film_bytes_per_pixel));
    }
    static_assert(sizeof(Pixel) == film_bytes_per_pixel);
}

Film::Pixel& Film::at(Vec2i pixel)
{
    const auto column = static_cast<std::size_t>(pixel.x - window_.x);
    const auto row = static_cast<std::size_t>(pixel.y - window_.y);
    return pixels_[row * static_cast<std::size_t>(window_.width) + column];
}

const Film::Pixel& Film::at(Vec2i pixel) const
{
    return const_cast<Film&>(*this).at(pixel);
}

Verdict Film::add(Vec2i pixel, const Color& radiance, float weight)
{
    if (!is_finite(radiance)) return Verdict::not_finite;
    if (min_component(radiance) < 0.f) return Verdict::negative;
    const Color value = radiance * weight;
    if (!(max_component(value) < film_max_value && min_component(value) > -film_max_value))
        return Verdict::out_of_range;
    Pixel& p = at(pixel);
    p.sum[0] += to_fixed(value.r);
    p.sum[1] += to_fixed(value.g);
    p.sum[2] += to_fixed(value.b);
    ++p.count;
    return Verdict::accepted;
}

std::uint64_t Film::sample_count(Vec2i pixel) const
{
    return at(pixel).count;
}

Image Film::develop() const
{
    Image image(window_, full_width_, full_height_);
    for (int y = window_.y; y < window_.y + window_.height; ++y) {
        for (int x = window_.x; x < window_.x + window_.width; ++x) {
            const Pixel& p = at({x, y});
            float* out = image.pixel(x, y);
            for (int c = 0; c < 3; ++c)
                out[c] = p.count == 0 ? 0.f
                                      : static_cast<float>(static_cast<double>(p.sum[c]) * unit /
                                                           static_cast<double>(p.count));
        }
    }
    return image;
}

} // namespace plumb
