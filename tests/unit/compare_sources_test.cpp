// SPDX-License-Identifier: MIT

// Where a comparison finds colours and their noise in the files of other renderers, replicas, and changes that make an
// image agree.

#include "plumb/base/error.h"
#include "plumb/compare/compare.h"
#include "support/catch.h"
#include "support/noisy_image.h"

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr int side = 32;
constexpr int samples = 64;

CompareSettings plain()
{
    CompareSettings options;
    options.flip = FlipMode::none;
    return options;
}

NoisyImage colors(double bias = 1.0)
{
    NoisyImage how;
    how.size = side;
    how.samples = samples;
    how.bias = bias;
    how.channels = {"R", "G", "B"};
    return how;
}

// The first channels of an image under other names, each times its factor.
Image renamed(const Image& image, const std::vector<std::string>& names, const std::vector<float>& factors,
              bool keeps_samples = false)
{
    Image result({0, 0, image.full_width(), image.full_height()}, image.full_width(), image.full_height(),
                 names);
    if (keeps_samples) result.metadata.emplace_back("samplesPerPixel", samples);
    for (int y = 0; y < image.full_height(); ++y)
        for (int x = 0; x < image.full_width(); ++x)
            for (std::size_t i = 0; i < names.size(); ++i)
                result.pixel(x, y)[i] = factors[i] * image.pixel(x, y)[i];
    return result;
}

std::string problem(const Image& a, const Image& b, const CompareSettings& options)
{
    try {
        (void)compare(a, b, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

// Light that is brighter to the right and has a bright corner above: no turned image is like it.
Image scene(std::uint64_t seed, double noise = 0.05)
{
    Image image(64, 64);
    TestRandom random(seed);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double bright = x > 50 && y < 9 ? 2.0 : 1.0;
            const double light = bright * (0.2 + x / 64.0 + (((x / 8) + (y / 8)) % 2 ? 0.3 : 0.0));
            const double shade[] = {1.0, 0.7, 0.3 + y / 128.0};
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    static_cast<float>(light * shade[c] * (1.0 + noise * draw_normal(random)));
        }
    }
    return image;
}

template <class Value>
Image changed(const Image& image, const Value& value)
{
    Image result(image.full_width(), image.full_height());
    for (int y = 0; y < image.full_height(); ++y)
        for (int x = 0; x < image.full_width(); ++x)
            for (int c = 0; c < 3; ++c) result.pixel(x, y)[c] = value(x, y, c);
    return result;
}

std::string hint(const Image& a, const Image& b)
{
    const Comparison found = compare(a, b, plain());
    CHECK(found.verdict != Verdict::passes);
    return found.alignment ? found.alignment->change : "none";
}

} // namespace

TEST_CASE("variance channels of other renderers count as what they are", "[unit][compare]")
{
    const Image ours = noisy_image(colors(), exponential_samples(), 1);
    const Image reference = noisy_image(colors(), exponential_samples(), 2);
    const CompareSettings options = plain();
    const Comparison expected = compare(ours, reference, options);
    CHECK(expected.noise_a == "variance channels");
    REQUIRE(expected.corrected);

    // pbrt-v4's: of a sample.
    const std::vector<std::string> pbrt = {"R", "G", "B", "Variance.R", "Variance.G", "Variance.B"};
    const std::vector<float> of_sample = {1, 1, 1, samples, samples, samples};
    const Comparison theirs = compare(renamed(ours, pbrt, of_sample, true), reference, options);
    CHECK(theirs.noise_a == "Variance.* of 64 samples");
    CHECK(theirs.corrected->squared_error == Approx(expected.corrected->squared_error).epsilon(1e-4));
    CHECK_FALSE(theirs.significance.difference_noise);

    // The header does not say how many.
    const Image unknown = renamed(ours, pbrt, of_sample);
    const Comparison single = compare(unknown, reference, options);
    CHECK(single.noise_a == "none (Variance.* without a number of samples: pass --spp N)");
    CHECK(single.significance.difference_noise);
    CompareSettings told = options;
    told.samples = samples;
    CHECK(compare(unknown, reference, told).noise_a == "Variance.* of 64 samples");
    CHECK_FALSE(compare(unknown, reference, told).significance.difference_noise);

    // What the user says counts more than the name, but not for Plumb's own.
    told.variance_of = VarianceOf::mean;
    CHECK(compare(renamed(ours, pbrt, {1, 1, 1, 1, 1, 1}), reference, told).noise_a == "variance channels");
    told.variance_of = VarianceOf::sample;
    CHECK(compare(ours, reference, told).noise_a == "variance channels");
}

TEST_CASE("moments give error bars of the luminance", "[unit][compare]")
{
    const Image ours = noisy_image(colors(), exponential_samples(), 1);
    const Image reference = noisy_image(colors(), exponential_samples(), 2);
    const std::vector<std::string> names = {
        "R", "G", "B", "nested.X", "nested.Y", "nested.Z", "m2_nested.X", "m2_nested.Y", "m2_nested.Z"};
    Image moments({0, 0, side, side}, side, side, names);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float* pixel = ours.pixel(x, y);
            for (int i = 0; i < 6; ++i) moments.pixel(x, y)[i] = pixel[0]; // grey
            for (int i = 6; i < 9; ++i)
                moments.pixel(x, y)[i] = pixel[0] * pixel[0] + pixel[3] * (samples - 1);
        }
    }
    CompareSettings options = plain();
    CHECK(compare(moments, reference, options).channels == std::vector<std::string>{"R", "G", "B"});
    options.samples = samples;
    const Comparison found = compare(moments, reference, options);
    CHECK(found.channels == std::vector<std::string>{"Y"});
    CHECK(found.noise_a == "m2_nested.Y of 64 samples");
    CHECK(found.verdict == Verdict::passes);
    CHECK(found.corrected->squared_error ==
          Approx(compare(ours, reference, plain()).corrected->squared_error).margin(2e-4));
}

TEST_CASE("colours are found in layers", "[unit][compare]")
{
    const Image ours = noisy_image(colors(), exponential_samples(), 1);
    const Image reference = noisy_image(colors(), exponential_samples(), 2);
    CompareSettings options = plain();
    const std::vector<float> ones(7, 1.f);
    // Blender: the only layer of colours, and one of several.
    const Image blender =
        renamed(ours, {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"}, ones);
    CHECK(compare(blender, reference, options).channels == std::vector<std::string>{"R", "G", "B"});
    const Image several = renamed(ours,
                                  {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
                                   "ViewLayer.DiffCol.R", "ViewLayer.DiffCol.G", "ViewLayer.DiffCol.B"},
                                  ones);
    CHECK(compare(several, reference, options).channels == std::vector<std::string>{"R", "G", "B"});
    const Image unclear = renamed(ours, {"one.R", "one.G", "one.B", "two.R", "two.G", "two.B"}, ones);
    CHECK(problem(unclear, reference, options) == "A has neither the channels R, G and B nor Y, but one.R, "
                                                  "one.G, one.B, two.R, two.G, two.B; choose a layer with "
                                                  "--layer NAME: one, two");
    options.layer = "one";
    CHECK(compare(unclear, reference, options).verdict == Verdict::passes);
    options.layer = "three";
    CHECK(problem(unclear, reference, options) == "A has no layer 'three'; it has one, two");
    // Alpha is no light.
    const Image alpha = renamed(ours, {"beauty.R", "beauty.G", "beauty.B", "beauty.A"}, ones);
    options.layer = "beauty";
    CHECK(compare(alpha, alpha, options).channels ==
          std::vector<std::string>{"beauty.R", "beauty.G", "beauty.B"});
    // A layer of ours with error bars.
    const Image layer = renamed(ours,
                                {"albedo.R", "albedo.G", "albedo.B", "variance_of_albedo.R",
                                 "variance_of_albedo.G", "variance_of_albedo.B"},
                                ones);
    options.layer = "albedo";
    CHECK(compare(layer, layer, options).noise_a == "variance channels");
}

TEST_CASE("replicas have the error bars that their spread gives", "[unit][compare]")
{
    NoisyImage how = colors();
    how.knows_noise = false;
    std::vector<Image> replicas;
    for (std::uint64_t k = 0; k < 4; ++k) replicas.push_back(noisy_image(how, exponential_samples(), 10 + k));
    const Image mean = mean_of_replicas(replicas, Side::a);
    REQUIRE(mean.channel_names() ==
            std::vector<std::string>{"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    double sum = 0.0;
    double squares = 0.0;
    for (const Image& image : replicas) {
        sum += static_cast<double>(image.pixel(3, 5)[0]);
        squares += sqr(static_cast<double>(image.pixel(3, 5)[0]));
    }
    CHECK(static_cast<double>(mean.pixel(3, 5)[0]) == Approx(sum / 4));
    CHECK(static_cast<double>(mean.pixel(3, 5)[3]) == Approx((squares - sum * sum / 4) / 3 / 4));

    const Image reference = noisy_image(colors(), exponential_samples(), 2);
    const Comparison same = compare(mean, reference, plain());
    CHECK(same.noise_a == "4 replicas");
    CHECK(same.verdict == Verdict::passes);

    std::vector<Image> twice;
    for (int k = 0; k < 2; ++k) twice.push_back(noisy_image(how, exponential_samples(), 10));
    CHECK_THROWS_WITH(mean_of_replicas(twice, Side::a),
                      "A1 and A2 have the same pixels; replicas need different seeds");
    how.size = 16;
    twice.pop_back();
    twice.push_back(noisy_image(how, exponential_samples(), 11));
    CHECK_THROWS_WITH(mean_of_replicas(twice, Side::b),
                      "B1 and B2 have different sizes: 32x32 and 16x16 pixels");
}

TEST_CASE("an image that differs is compared after changes", "[unit][compare]")
{
    const Image a = scene(1);
    const Image b = scene(2, 0.025);
    CHECK(compare(a, b, plain()).verdict == Verdict::passes);
    CHECK_FALSE(compare(a, b, plain()).alignment);
    const auto at = [&a](int x, int y, int c) { return a.pixel(x, y)[c]; };
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(63 - x, y, c); }), b) ==
          "mirrored left to right");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(x, 63 - y, c); }), b) == "turned upside down");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(63 - x, 63 - y, c); }), b) ==
          "rotated by 180 degrees");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(x, y, 2 - c); }), b) ==
          "with red and blue swapped");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return 0.5f * at(x, y, c); }), b).starts_with("times "));
    const auto encoded = [&](int x, int y, int c) {
        const float v = at(x, y, c);
        return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.f / 2.4f) - 0.055f;
    };
    CHECK(hint(changed(a, encoded), b) == "decoded from sRGB");
    CHECK(hint(a, changed(b, [&](int x, int y, int c) {
                   const float v = b.pixel(x, y)[c];
                   return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.f / 2.4f) - 0.055f;
               })) == "encoded as B, in sRGB,");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(std::min(x + 1, 63), y, c); }), b) ==
          "shifted 1 pixel right");
    CHECK(hint(changed(a, [&](int x, int y, int c) { return at(x, std::max(y - 1, 0), c); }), b) ==
          "shifted 1 pixel up");
    // An error of light is none of these.
    CHECK(hint(changed(a, [&](int x, int y,
                              int c) { return x < 20 && y < 20 ? 1.3f * at(x, y, c) : at(x, y, c); }),
               b) == "none");
}
