// SPDX-License-Identifier: MIT
#pragma once

// Are two images the same but for their noise?
//
// [1] Welch 1947, "The generalization of Student's problem when several different population variances are involved",
//     https://doi.org/10.1093/biomet/34.1-2.28
// [2] Satterthwaite 1946, "An approximate distribution of estimates of variance components",
//     https://doi.org/10.2307/3002019
// [3] Kish 1965, Survey Sampling: the effective size of a sample of unequal weights, (sum x)^2 / sum x^2.
//
// Conventions. A is the image under test and B the reference; only relative errors and HDR-FLIP care. An image has
// channels R, G and B, or Y. What an image knows of its noise are channels "variance.R", "variance.G", "variance.B"
// (or "variance.Y"): the estimated variance of each pixel's mean, not a number where nobody knows; of others' names see
// src/compare/channel_names.h. Where an image has none, the spread of A - B tells of its noise. "contributing"
// counts the samples of a pixel that were not black, and the header's plumb:samplesPerPixel all of them. Where
// plumb:inputHash and plumb:integrator are equal, both are images of one estimator.

#include "plumb/image/image.h"
#include "plumb/settings/compare_settings.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// Differences of the pixels that are finite in both images, over pixels and channels, d = a - b.
struct Metrics {
    double mse = 0.0;          // mean of d^2
    double rmse = 0.0;         // its square root
    double relative_mse = 0.0; // mean of d^2 / (b^2 + 0.01)
    double mae = 0.0;          // mean of |d|
    double psnr = 0.0;         // 10 log10(1 / mse) dB: the peak is 1; infinite if nothing differs
    double max = 0.0;          // largest |d|
    Vec2i max_pixel;
    int max_channel = 0;
    double mean_a = 0.0; // mean luminance
    double mean_b = 0.0;
    std::optional<double> flip; // mean of the map
};

// Pixels with a channel that is not finite. They count in nothing else.
struct NonFinite {
    std::uint64_t only_a = 0; // they differ
    std::uint64_t only_b = 0; // they differ
    std::uint64_t both = 0;   // they do not
    std::optional<Vec2i> first;
};

// The squared error without what the noise of both images adds: mean of d^2 - var(a) - var(b).
struct NoiseCorrected {
    double squared_error = 0.0; // may be negative
    double low = 0.0;           // 95 % confidence interval
    double high = 0.0;
    std::optional<double> root; // where positive
    std::uint64_t pixels = 0;   // whose variance both images know
};

// A square of pixels, or the whole image, in one channel.
struct UnitTest {
    PixelRect place;
    int channel = 0;
    double mean_a = 0.0;
    double mean_b = 0.0;
    double t = 0.0;       // the difference in standard errors
    double freedom = 0.0; // degrees of it
    double p =
        1.0; // chance of a larger |t|, times the number of tests: may be compared with the significance
};

// The tests of all squares of one size.
struct ScaleTest {
    int size = 0; // of a side in pixels; 0: the whole image
    std::uint64_t units = 0;
    std::uint64_t tested = 0;          // where the data support it
    std::uint64_t rejected = 0;        // without the pixels that smaller squares rejected
    std::uint64_t smallest_pixels = 0; // pixels whose smallest tested square is of this size
    std::optional<UnitTest> largest;   // the one with the smallest p
};

// The noise of d = a - b, where an image has no error bars.
struct DifferenceNoise {
    double inflation = 1.0; // variance of a sum of d over that of independent pixels
    std::optional<int> reach =
        0; // pixels over which it is correlated; nothing: too many for a verdict of "same"
    std::optional<double> ratio; // variance of d over the known one of one image; nothing: both unknown
    std::optional<double> own;   // likewise of the other image's noise, as in most squares of 32x32 pixels
    // It cannot be told from a smooth error: only what is far above any noise is a difference.
    bool is_hidden = false;
};

// The squares of the sums of d of all squares of one size, together: finds what is small but everywhere.
struct SpreadTest {
    int size = 0; // of a side in pixels
    bool is_tested = false;
    int channel = 0;
    double ratio = 1.0; // to what noise makes expect
    double p = 1.0;     // as in UnitTest
};

// What A may be instead of a wrong image: a change that makes it agree with B.
struct Alignment {
    std::string change; // "mirrored left to right", "times 0.5"
    double p = 1.0;     // of the same test, smallest of all
    int tried = 0;      // changes
};

enum class Verdict { passes, differs, undecided };

struct Significance {
    std::optional<Verdict> verdict; // of the noise alone; nothing: it was not asked
    std::string reason;             // why it was not asked, or is undecided
    std::vector<ScaleTest> scales;  // pixels first, the whole image last
    double p = 1.0;                 // smallest of all
    std::uint64_t pixels = 0;       // in the image
    std::uint64_t differing = 0;    // in squares that were rejected, or not finite in one image
    std::uint64_t untested = 0;     // in no square that was tested
    // Of each pixel, the side of the smallest square with it that was rejected; 0: none, `whole_image`: only the whole.
    // Empty: nothing was tested.
    std::vector<std::uint16_t> rejected_by;
    static constexpr std::uint16_t whole_image = 65535;
    // Had A been too bright or too dark all over by this factor, the test of the whole image would have found it with
    // 90 % probability. Nothing: the whole image could not be tested.
    std::optional<double> detectable_bias;
    std::optional<DifferenceNoise> difference_noise; // where an image has no error bars
    std::vector<SpreadTest> spread;                  // likewise
    std::optional<Alignment> shift; // likewise: A fits B better than it does as it is, beyond the noise
};

struct Comparison {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels; // R, G and B, or Y
    bool identical = false;            // every pixel and channel of colour has the same value
    bool same_random_numbers = false;  // by the headers: the same inputs, integrator and seed
    Metrics metrics;
    FlipMode flip_mode = FlipMode::none;
    std::vector<float> flip_map; // empty without FLIP
    NonFinite non_finite;
    std::optional<NoiseCorrected> corrected;
    std::string noise_a; // where its error bars come from: "variance channels", "none"
    std::string noise_b;
    Significance significance;
    std::optional<Alignment> alignment; // of images that differ
    std::vector<Threshold> exceeded;
    Verdict verdict = Verdict::undecided;
};

// An image and what is known of it besides.
struct Estimate {
    std::string name;
    Image image;
    std::optional<double> samples_per_pixel; // independent ones, which its variances are of
    std::string estimator; // equal: the samples of both have one distribution; empty: unknown
    std::string seed;      // of its random numbers; empty: unknown
};

// Throws Error if they cannot be compared: different sizes, missing channels, an unknown metric.
Comparison compare(const Estimate& a, const Estimate& b, const CompareSettings& settings = {});
// Of images whose headers say what is known of them.
Comparison compare(const Image& a, const Image& b, const CompareSettings& settings = {});

// Images of one scene that differ in their random numbers only, at least two: their mean, with variance channels from
// their spread, of the colours and of every layer. `side` names them in messages. Throws Error if two have the same
// pixels, or if their sizes or channels differ.
Image mean_of_replicas(const std::vector<Image>& replicas, Side side);

// Whether files of that name are made for screens (PNG, JPEG, BMP and the like): values are rounded to integers and clipped
// at 1. read_to_compare() notes it in the header.
bool is_low_dynamic_range(const std::filesystem::path& path);
// Reads an image to be compared. Throws Error naming the file.
Image read_to_compare(const std::filesystem::path& path);

// The value of a metric by the name that thresholds use. Throws Error if there is none of that name.
double metric_value(const Metrics& metrics, std::string_view name);

// The squares that the test has rejected, in red over A in grey: the smaller the square, the stronger the colour. Green:
// not finite in one image.
Image significance_image(const Image& a, const Image& b, const Comparison& comparison,
                         const CompareSettings& settings = {});

// |a - b| (the largest of the channels), or the FLIP map of a comparison that has one, in false colours above a bar
// with its scale, as linear colours to be written as .png. Pixels that are not finite are green.
Image difference_image(const Image& a, const Image& b, const std::string& layer = {});
Image flip_image(const Comparison& comparison);

} // namespace plumb
