// SPDX-License-Identifier: MIT

// Numbers of papers: see plumb/image/development.h.

#include "plumb/image/development.h"

#include "plumb/math/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view display_name = "plumb:display";
constexpr std::string_view comment_name = "ImageDescription"; // what becomes of a JPEG file's comment

constexpr double ln_2 = 0x1.62e42fefa39efp-1;
constexpr double brightest = 1e9; // beyond any curve's white; keeps fractions finite

double power(double base, double exponent)
{
    return base > 0.0 ? exp(exponent * log(base)) : 0.0;
}

// From 0; what is not a number is 0.
double positive(double x)
{
    return x > 0.0 ? std::min(x, brightest) : 0.0;
}

// [1]
double hable(double x)
{
    constexpr double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

// A branch of the sigmoid of [3], from its pivot at (0, 0) to its end at (width, height): slope is that at the pivot,
// sharpness that of the knee.
class SigmoidBranch {
public:
    SigmoidBranch(double width, double height, double slope, double sharpness)
        : slope_(slope),
          sharpness_(sharpness),
          scale_(power(power(slope * width, -sharpness) * (power(slope * width / height, sharpness) - 1.0),
                       -1.0 / sharpness)) // equation_scale
    {}
    double operator()(double x) const
    {
        const double term = slope_ * x / scale_;
        return scale_ * term / power(1.0 + power(term, sharpness_), 1.0 / sharpness_); // equation_hyperbolic
    }

private:
    double slope_;
    double sharpness_;
    double scale_;
};

// [3], AgX_compressed_matrix: primaries moved away from white by 1 / (1 - 0.2). In these, a colour is a mix of itself and of
// the grey of the same sum X + Y + Z of tristimulus values.
constexpr double inset = 0.2;

struct Rgb {
    double r, g, b;
    template <class F>
    Rgb map(const F& f) const
    {
        return {f(r), f(g), f(b)};
    }
    // X + Y + Z, 1 of white: the columns' sums of the matrix from sRGB to XYZ (IEC 61966-2-1).
    double tristimulus_sum() const
    {
        constexpr double of_r = 0.4124 + 0.2126 + 0.0193, of_g = 0.3576 + 0.7152 + 0.1192,
                         of_b = 0.1805 + 0.0722 + 0.9505;
        return (of_r * r + of_g * g + of_b * b) / (of_r + of_g + of_b);
    }
};

Rgb agx(const Rgb& light)
{
    const double grey = inset * light.tristimulus_sum();
    const Rgb curved = light.map([&](double x) { return agx_curve((1.0 - inset) * x + grey); });
    const double grey_back = inset * curved.tristimulus_sum();
    return curved.map([&](double x) { return (x - grey_back) / (1.0 - inset); });
}

double encoded(double light)
{
    return static_cast<double>(srgb_from_linear(static_cast<float>(std::clamp(light, 0.0, 1.0))));
}

} // namespace

double filmic_curve(double x)
{
    constexpr double white = 11.2, exposure_bias = 2.0;
    return std::clamp(hable(exposure_bias * positive(x)) / hable(white), 0.0, 1.0);
}

double aces_curve(double x)
{
    using F = AcesFraction;
    x = positive(x);
    return std::clamp((F::a0 * x * x + F::a1 * x) / (F::b0 * x * x + F::b1 * x + F::b2), 0.0, 1.0);
}

double agx_curve(double x)
{
    constexpr double middle_grey = 0.18, least_stops = -10.0, most_stops = 6.5;
    constexpr double pivot_x = -least_stops / (most_stops - least_stops), pivot_y = 0.5;
    constexpr double slope = 2.0;
    static const SigmoidBranch toe(pivot_x, pivot_y, slope, 3.0);
    static const SigmoidBranch shoulder(1.0 - pivot_x, 1.0 - pivot_y, slope, 3.25);
    x = positive(x);
    if (x <= 0.0) return 0.0;
    const double stops = std::clamp(log(x / middle_grey) / ln_2, least_stops, most_stops);
    const double place = (stops - least_stops) / (most_stops - least_stops);
    const double from_pivot = place - pivot_x;
    return from_pivot < 0.0 ? pivot_y - toe(-from_pivot) : pivot_y + shoulder(from_pivot);
}

std::span<const std::string_view> tone_curve_names()
{
    static constexpr std::array<std::string_view, 4> names = {"none", "filmic", "aces", "agx"};
    return names;
}

std::string_view to_string(ToneCurve curve)
{
    return tone_curve_names()[static_cast<std::size_t>(curve)];
}

Developer::Developer(const Development& development)
    : scale_(development.exposure < 0.f ? 1.f / pow(2.f, -development.exposure)
                                        : pow(2.f, development.exposure)),
      curve_(development.curve)
{}

Color Developer::operator()(const Color& light) const
{
    const auto scale = [this](float x) {
        x *= scale_;
        return x > 0.f ? x : 0.f;
    };
    const Color scaled(scale(light.r), scale(light.g), scale(light.b));
    const auto each = [&](const auto& f) { return Color(f(scaled.r), f(scaled.g), f(scaled.b)); };
    const auto by_curve = [&](double (*curve)(double)) {
        return each([&](float x) { return static_cast<float>(encoded(curve(static_cast<double>(x)))); });
    };
    switch (curve_) {
    case ToneCurve::none: return each([](float x) { return srgb_from_linear(std::min(x, 1.f)); });
    case ToneCurve::filmic: return by_curve(filmic_curve);
    case ToneCurve::aces: return by_curve(aces_curve);
    case ToneCurve::agx: break;
    }
    const Rgb shown = agx({positive(static_cast<double>(scaled.r)), positive(static_cast<double>(scaled.g)),
                           positive(static_cast<double>(scaled.b))});
    const auto clipped = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
    return {clipped(shown.r), clipped(shown.g), clipped(shown.b)};
}

std::string development_text(const Development& development)
{
    std::string text;
    if (development.exposure != 0.f) text = fmt::format("exposure {}", development.exposure);
    if (development.curve != ToneCurve::none)
        text += fmt::format("{}tonemap {}", text.empty() ? "" : ", ", to_string(development.curve));
    return text;
}

std::string display_text(const Metadata& header)
{
    for (const auto& [name, value] : header) {
        const auto* const text = std::get_if<std::string>(&value);
        if (!text) continue;
        if (name == display_name) return *text;
        const std::string start = std::string(display_name) + " ";
        if (name == comment_name && text->starts_with(start)) return text->substr(start.size());
    }
    return {};
}

Metadata display_header(std::string_view extension, const std::string& text)
{
    if (text.empty()) return {};
    if (extension.starts_with(".jp"))
        return {{std::string(comment_name), fmt::format("{} {}", display_name, text)}};
    return {{std::string(display_name), text}};
}

} // namespace plumb
