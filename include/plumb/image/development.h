// SPDX-License-Identifier: MIT
#pragma once

// How linear light becomes the values of an image for screens (.png, .jpg).
//
// [1] Hable 2010, "Filmic Tonemapping Operators", http://filmicworlds.com/blog/filmic-tonemapping-operators/
// [2] Narkowicz 2016, "ACES Filmic Tone Mapping Curve",
//     https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/
// [3] Sobotka 2022, AgX (AgX.py, generate_config.py), https://github.com/sobotka/AgX
//
// Conventions. Values for a screen are from 0 to 1 and are what a file holds, divided by 255: they are encoded already.
// Light is multiplied by 2^exposure first. Negative values, and those that are not numbers, are black.

#include "plumb/image/image.h"

#include <span>
#include <string_view>

namespace plumb {

// One for each value of ToneCurve, in its order.
std::span<const std::string_view> tone_curve_names();
std::string_view to_string(ToneCurve curve);

class Developer {
public:
    explicit Developer(const Development& development);
    Color operator()(const Color& light) const; // the values for a screen

private:
    float scale_;
    ToneCurve curve_;
};

// "exposure 1, tonemap aces", of what is not the default; empty: values are only clipped and encoded.
std::string development_text(const Development& development);

// How the values of an image for screens were made from light, by its header; empty: they were clipped and encoded, or the
// header does not say. Values of images with different texts cannot be compared.
std::string display_text(const Metadata& header);
// The entries that say so, of a file of the format with this extension: JPEG keeps but a comment.
Metadata display_header(std::string_view extension, const std::string& text);

// The entry of a header that says that the image was denoised, and by what: denoise.h.
inline constexpr std::string_view denoised_entry = "plumb:denoised";

// The curves, of light from 0. Values are light from 0 to 1 (filmic, aces), not yet encoded; or encoded (agx).
double filmic_curve(double x); // [1]: white is 11.2, after an exposure of 2
double aces_curve(double x);   // [2], with the exposure of 0.6 that makes it the curve of ACES
double agx_curve(double x);    // [3]: of log2(light / 0.18) from -10 to 6.5, mapped to 0 to 1

// The curve of [2] as a fraction of polynomials: (a0 x^2 + a1 x) / (b0 x^2 + b1 x + b2).
struct AcesFraction {
    static constexpr double a0 = 0.36 * 2.51;
    static constexpr double a1 = 0.6 * 0.03;
    static constexpr double b0 = 0.36 * 2.43;
    static constexpr double b1 = 0.6 * 0.59;
    static constexpr double b2 = 0.14;
};

} // namespace plumb
