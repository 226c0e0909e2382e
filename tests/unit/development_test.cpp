// SPDX-License-Identifier: MIT

// Tone curves, and what files for screens say of them.

#include "plumb/image/development.h"

#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <array>

using namespace plumb;

namespace {

double linear(double x)
{
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix inverse(const Matrix& m)
{
    Matrix result{};
    double determinant = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        determinant += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
    }
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            result[c][r] = (m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]) / determinant;
        }
    return result;
}

std::array<double, 3> times(const Matrix& m, const std::array<double, 3>& v)
{
    std::array<double, 3> result{};
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) result[r] += m[r][c] * v[c];
    return result;
}

// From RGB with these primaries to XYZ, where (1, 1, 1) is the white of luminance 1 (SMPTE RP 177).
Matrix to_xyz(const double (&primaries)[3][2], const double (&white)[2])
{
    const auto tristimulus = [](const double(&xy)[2]) {
        return std::array<double, 3>{xy[0] / xy[1], 1.0, (1.0 - xy[0] - xy[1]) / xy[1]};
    };
    Matrix m{};
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t i = 0; i < 3; ++i) m[i][p] = tristimulus(primaries[p])[i];
    const std::array<double, 3> luminances = times(inverse(m), tristimulus(white));
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t i = 0; i < 3; ++i) m[i][p] *= luminances[p];
    return m;
}

} // namespace

TEST_CASE("tone curves begin at black, rise, and end at white", "[unit][image]")
{
    double (*const curve)(double) = GENERATE(&filmic_curve, &aces_curve, &agx_curve);
    CHECK(curve(0.0) == Approx(0.0).margin(1e-12));
    CHECK(curve(-1.0) == curve(0.0));
    CHECK(curve(std::nan("")) == curve(0.0));
    CHECK(curve(1e30) == Approx(1.0).margin(1e-3));
    double last = curve(0.0);
    for (double x = 1e-5; x < 1e5; x *= 1.01) {
        CAPTURE(x);
        REQUIRE(curve(x) >= last);
        REQUIRE(curve(x) <= 1.0);
        last = curve(x);
    }
    CHECK(curve(3.0) < 1.0); // what is brighter than white has detail left
    CHECK(curve(3.0) > curve(1.0));
}

TEST_CASE("tone curves have their authors' values", "[unit][image]")
{
    CHECK(filmic_curve(11.2 / 2.0) == Approx(1.0));
    // Hable's own partial curve at 2 x 0.18, by hand: 0.04144 / 0.25944 - 1 / 15, over 19.38 / 24.476 - 1 / 15.
    CHECK(filmic_curve(0.18) == Approx(0.09306 / 0.72513).epsilon(1e-3));
    // At 0.6 x: 0.6 (2.51 0.6 + 0.03) / (0.6 (2.43 0.6 + 0.59) + 0.14) = 0.9216 / 1.3688
    CHECK(aces_curve(1.0) == Approx(0.9216 / 1.3688));
    CHECK(agx_curve(0.18) == Approx(0.5).margin(1e-12)); // the pivot
    CHECK(agx_curve(0.18 * std::pow(2.0, 6.5)) == Approx(1.0));
    CHECK(agx_curve(0.18 * std::pow(2.0, -10.0)) == Approx(0.0).margin(1e-9));
}

TEST_CASE("the curve of AgX is near the polynomial that others fitted to it", "[unit][image]")
{
    // Wrensch 2023, "Minimal AgX Implementation", https://iolite-engine.com/blog_posts/minimal_agx_implementation
    double square = 0.0;
    constexpr int count = 1000;
    for (int i = 0; i <= count; ++i) {
        const double x = static_cast<double>(i) / count;
        const double fit = 15.5 * std::pow(x, 6.0) - 40.14 * std::pow(x, 5.0) + 31.96 * std::pow(x, 4.0) -
                           6.868 * x * x * x + 0.4298 * x * x + 0.1191 * x - 0.00232;
        const double light = std::pow(2.0, -12.47393 + x * (4.026069 + 12.47393));
        square += (agx_curve(light) - fit) * (agx_curve(light) - fit);
    }
    CHECK(std::sqrt(square / count) < 0.003);
}

TEST_CASE("AgX mixes colours as primaries moved away from white do", "[unit][image]")
{
    const double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    const double white[2] = {0.3127, 0.3290};
    double moved[3][2];
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t i = 0; i < 2; ++i)
            moved[p][i] = white[i] + (primaries[p][i] - white[i]) / (1.0 - 0.2);
    const std::array<double, 3> light =
        GENERATE(std::array<double, 3>{1.0, 0.0, 0.0}, std::array<double, 3>{0.02, 0.3, 4.0},
                 std::array<double, 3>{0.18, 0.18, 0.18});
    const Matrix from_moved = to_xyz(moved, white), from_srgb = to_xyz(primaries, white);
    std::array<double, 3> value = times(inverse(from_moved), times(from_srgb, light));
    for (double& x : value) x = agx_curve(x);
    value = times(inverse(from_srgb), times(from_moved, value));
    const Color shown =
        Developer({0.f, ToneCurve::agx})(Color(float(light[0]), float(light[1]), float(light[2])));
    for (int i = 0; i < 3; ++i)
        CHECK(shown[i] == Approx(std::clamp(value[std::size_t(i)], 0.0, 1.0)).margin(2e-4));
}

TEST_CASE("exposure and curves of colours", "[unit][image]")
{
    const Color light(0.05f, 0.4f, 3.f);
    const auto curve = GENERATE(ToneCurve::none, ToneCurve::filmic, ToneCurve::aces, ToneCurve::agx);
    CAPTURE(to_string(curve));
    // A stop more is twice the light.
    CHECK(Developer({1.f, curve})(light) == Developer({0.f, curve})(light * 2.f));
    CHECK(Developer({-1.f, curve})(light) == Developer({0.f, curve})(light * 0.5f));
    // Grey stays grey, and nothing is not finite.
    const Color grey = Developer({0.f, curve})(Color(0.3f));
    CHECK(grey.r == Approx(grey.g).margin(1e-4));
    CHECK(grey.b == Approx(grey.g).margin(1e-4));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float odd : {infinity, -infinity, nan, -1.f, 1e38f})
        for (int i = 0; i < 3; ++i) {
            Color color(0.5f);
            (i == 0 ? color.r : i == 1 ? color.g : color.b) = odd;
            const Color shown = Developer({3.f, curve})(color);
            CHECK(is_finite(shown));
            CHECK(min_component(shown) >= 0.f);
            CHECK(max_component(shown) <= 1.f);
        }
    CHECK(Developer({0.f, curve})(Color(nan)) == Developer({0.f, curve})(Color(0.f)));
}

TEST_CASE("filmic and aces are curves of each channel, encoded for sRGB", "[unit][image]")
{
    const Color light(0.05f, 0.4f, 3.f);
    const Color filmic = Developer({0.f, ToneCurve::filmic})(light);
    const Color aces = Developer({0.f, ToneCurve::aces})(light);
    for (int i = 0; i < 3; ++i) {
        const double x = static_cast<double>(light[i]);
        CHECK(linear(static_cast<double>(filmic[i])) == Approx(filmic_curve(x)).epsilon(1e-5));
        CHECK(linear(static_cast<double>(aces[i])) == Approx(aces_curve(x)).epsilon(1e-5));
    }
}

TEST_CASE("files for screens have the developed values, and say so", "[unit][image]")
{
    const TempDirectory directory;
    Image image(4, 1);
    const Color lights[] = {Color(0.f), Color(0.1f, 0.5f, 0.9f), Color(2.f, 1.f, 0.f), Color(50.f)};
    for (int x = 0; x < 4; ++x)
        for (int i = 0; i < 3; ++i) image.pixel(x, 0)[i] = lights[x][i];
    const auto curve = GENERATE(ToneCurve::none, ToneCurve::filmic, ToneCurve::aces, ToneCurve::agx);
    const Development development{0.5f, curve};
    write_image(directory / "a.png", image, development);
    const Image back = read_image(directory / "a.png", false);
    for (int x = 0; x < 4; ++x)
        for (int i = 0; i < 3; ++i)
            CHECK(back.pixel(x, 0)[i] ==
                  Approx(Developer(development)(lights[x])[i]).margin(0.5 / 255.0 + 1e-6));
    const std::string text = development_text(development);
    CHECK(text == (curve == ToneCurve::none ? "exposure 0.5"
                                            : "exposure 0.5, tonemap " + std::string(to_string(curve))));
    CHECK(display_text(back.metadata) == text);

    write_image(directory / "a.jpg", image, development);
    CHECK(display_text(read_image(directory / "a.jpg", false).metadata) == text);

    // Light stays light.
    write_image(directory / "a.exr", image, development);
    const Image light = read_image(directory / "a.exr", false);
    CHECK(light.pixel(3, 0)[0] == 50.f);
    CHECK(display_text(light.metadata).empty());
}

TEST_CASE("what is only clipped says nothing", "[unit][image]")
{
    const TempDirectory directory;
    CHECK(development_text({}).empty());
    for (const std::string name : {"a.png", "a.jpg"}) {
        write_image(directory / name, Image(2, 2));
        CHECK(display_text(read_image(directory / name, false).metadata).empty());
    }
    CHECK(is_for_screens("a.PNG"));
    CHECK(is_for_screens("a.jpeg"));
    CHECK_FALSE(is_for_screens("a.exr"));
    CHECK_FALSE(is_for_screens("a.tif"));
    CHECK_FALSE(is_for_screens("png"));
}
