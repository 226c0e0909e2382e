// SPDX-License-Identifier: MIT

// Expected values: the authors' package, flip-evaluator 1.7 from PyPI, called as
// evaluate(reference, test, "LDR" or "HDR", inputsRGB=False, applyMagma=False) on the same float images. It computes
// in float; we differ by less than 3e-5 but where an edge nearly vanishes (1e-4: the square root of a rounding error).

#include "compare/flip.h"
#include "support/catch.h"

using namespace plumb;

namespace {

constexpr int width = 24;
constexpr int height = 16;

// Sixteenths of `scale`, exact in float.
std::vector<Color> pattern(float scale, int shift)
{
    std::vector<Color> image;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto value = [&](int c) {
                return static_cast<float>((x * (3 + c) + y * (5 + 2 * c) + shift * (x * y % 7)) % 16) / 16.f *
                       scale;
            };
            image.emplace_back(value(0), value(1), value(2));
        }
    return image;
}

struct Expected {
    int x;
    int y;
    double error;
};

void check(const FlipError& flip, double mean, const std::vector<Expected>& pixels)
{
    REQUIRE(flip.map.size() == width * height);
    CHECK(flip.mean == Approx(mean).margin(3e-6));
    for (const Expected& pixel : pixels) {
        INFO(pixel.x << "," << pixel.y);
        CHECK(flip.map[static_cast<std::size_t>(pixel.y * width + pixel.x)] ==
              Approx(pixel.error).margin(3e-5));
    }
}

} // namespace

TEST_CASE("FLIP gives what the authors' program gives", "[unit][flip]")
{
    check(
        ldr_flip(pattern(1.f, 0), pattern(1.f, 1), width, height), 0.2731026,
        {{0, 0, 0.1043903}, {5, 3, 0.2150075}, {23, 15, 0.4077963}, {12, 8, 0.2875466}, {0, 15, 0.0880556}});
    check(
        hdr_flip(pattern(8.f, 0), pattern(8.f, 1), width, height), 0.2706845,
        {{0, 0, 0.08939099}, {5, 3, 0.207134}, {23, 15, 0.4546273}, {12, 8, 0.2376615}, {0, 15, 0.07765536}});
}

TEST_CASE("FLIP of one wrong pixel, and of black and white", "[unit][flip]")
{
    const std::vector<Color> grey(12 * 12, Color(0.25f));
    std::vector<Color> dotted = grey;
    dotted[6 * 12 + 6] = Color(0.75f, 0.125f, 0.25f);
    const FlipError dot = ldr_flip(grey, dotted, 12, 12);
    CHECK(dot.mean == Approx(0.015318911).margin(3e-6));
    CHECK(dot.map[6 * 12 + 6] == Approx(0.1847505).margin(3e-5));
    CHECK(dot.map[6 * 12 + 7] == Approx(0.13943714).margin(3e-5));

    const std::vector<Color> black(16, Color(0.f));
    const std::vector<Color> white(16, Color(1.f));
    CHECK(ldr_flip(black, white, 4, 4).mean == Approx(0.96738821).margin(3e-6));
    CHECK(ldr_flip(white, white, 4, 4).mean == 0.0);
}

TEST_CASE("HDR-FLIP of references without a range of exposures", "[unit][flip]")
{
    const std::vector<Color> black(16, Color(0.f));
    std::vector<Color> nearly_black = black;
    nearly_black[5] = Color(3.f);
    for (const auto& reference : {black, nearly_black}) {
        CHECK(hdr_flip(reference, reference, 4, 4).mean == 0.0);
        const FlipError flip = hdr_flip(reference, std::vector<Color>(16, Color(1.f, 2.f, -3.f)), 4, 4);
        CHECK(flip.mean > 0.1);
        for (const float error : flip.map) CHECK((error >= 0.f && error <= 1.f));
    }
}
