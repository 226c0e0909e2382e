// SPDX-License-Identifier: MIT

// Plumb against another renderer: the scenes of tests/scenes/independent/ and what Mitsuba 3, or quadrature in double
// precision, says of them (references/independent/README.md). Nothing of Plumb went into those references, but the
// reading of the scene files.

#include "support/catch.h"
#include "support/statistics.h"

#include "plumb/scene_file.h"

#include <fmt/format.h>

#include <array>

using namespace plumb;

namespace {

const std::filesystem::path scene_folder =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "independent";
const std::filesystem::path reference_folder =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "references" / "independent";

std::vector<std::string> scene_names()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scene_folder))
        if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

// A number and the variance of its error, known from so many degrees of freedom.
struct Uncertain {
    double value = 0.0;
    double variance = 0.0;
    double degrees_of_freedom = 1.0;
};

// Welch's t test with Satterthwaite's degrees of freedom. A difference of `allowed` is free.
double same_value_p(const Uncertain& a, const Uncertain& b, double allowed)
{
    const double excess = std::abs(a.value - b.value) - allowed;
    if (std::isnan(excess)) return 0.0;
    if (excess <= 0.0) return 1.0;
    const double variance = a.variance + b.variance;
    if (!(variance > 0.0)) return 0.0;
    const double weights =
        a.variance * a.variance / a.degrees_of_freedom + b.variance * b.variance / b.degrees_of_freedom;
    return test::student_t_two_sided(excess / std::sqrt(variance), variance * variance / weights);
}

// A reference: channels R, G, B and the variances of those three.
class Reference {
public:
    explicit Reference(const std::string& name)
        : image_(read_image(reference_folder / (name + ".exr"), false))
    {
        const std::vector<std::string>& names = image_.channel_names();
        const char* const wanted[] = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
        for (std::size_t i = 0; i < 6; ++i) {
            const auto found = std::find(names.begin(), names.end(), wanted[i]);
            if (found == names.end()) throw std::runtime_error(name + ".exr has no channel " + wanted[i]);
            channels_[i] = static_cast<std::size_t>(found - names.begin());
        }
        for (const auto& [key, value] : image_.metadata) {
            if (key == "judge:replicates") replicates_ = std::stod(std::get<std::string>(value));
            if (key == "judge:samples") samples_ = std::stod(std::get<std::string>(value));
        }
    }

    PixelRect window() const { return image_.data_window(); }
    double samples() const { return samples_; } // per pixel; 0 of a quadrature

    // The mean over a block.
    Uncertain block(const PixelRect& block, std::size_t channel) const
    {
        double sum = 0.0;
        double variance = 0.0;
        double squares = 0.0;
        double absolute = 0.0;
        for (int y = block.y; y < block.y + block.height; ++y)
            for (int x = block.x; x < block.x + block.width; ++x) {
                const float* const pixel = image_.pixel(x, y);
                const double of_pixel = pixel[channels_[channel + 3]];
                sum += pixel[channels_[channel]];
                variance += of_pixel;
                squares += of_pixel * of_pixel;
                absolute += std::sqrt(of_pixel);
            }
        const double pixels = block.width * block.height;
        // The errors of a quadrature may all have one sign, and it has no degrees of freedom.
        if (replicates_ == 0.0) return {sum / pixels, absolute * absolute / (pixels * pixels), 1e6};
        const double degrees = squares > 0.0 ? (replicates_ - 1.0) * variance * variance / squares : 1.0;
        return {sum / pixels, variance / (pixels * pixels), degrees};
    }

private:
    Image image_;
    std::array<std::size_t, 6> channels_{};
    double samples_ = 0.0;
    double replicates_ = 0.0; // 0: a quadrature, whose variance is the square of an estimate of its error
};

// Plumb's pictures of a scene, each with a seed of its own.
class Replicates {
public:
    Replicates(const RenderJob& job, std::uint64_t count, std::uint64_t samples_per_pixel, std::uint64_t seed)
        : samples_(static_cast<double>(count * samples_per_pixel))
    {
        for (std::uint64_t i = 0; i < count; ++i) {
            RenderOptions options;
            options.samples_per_pixel = samples_per_pixel;
            options.seed = seed * 1000 + i;
            const RenderResult result = render(job, options);
            left_out_ += result.left_out.count;
            pictures_.push_back(result.film.develop());
        }
    }

    PixelRect window() const { return pictures_.front().data_window(); }
    double samples() const { return samples_; } // per pixel, in all
    std::uint64_t left_out() const { return left_out_; }

    // The variance of a block's mean is that among the replicates: nothing about its pixels is assumed.
    Uncertain block(const PixelRect& block, std::size_t channel) const
    {
        MeanAndVariance mean;
        for (const Image& picture : pictures_) {
            double sum = 0.0;
            for (int y = block.y; y < block.y + block.height; ++y)
                for (int x = block.x; x < block.x + block.width; ++x) sum += picture.pixel(x, y)[channel];
            mean.add(sum / (block.width * block.height));
        }
        const auto count = static_cast<double>(mean.count());
        return {mean.mean(), mean.variance() / count, count - 1.0};
    }

private:
    std::vector<Image> pictures_;
    double samples_ = 0.0;
    std::uint64_t left_out_ = 0;
};

// Large blocks have little noise, small ones show what is moved or blurred. Both divide a picture of 24 x 18.
constexpr int block_sizes[] = {6, 2};

// What single precision may cost either renderer, of a value; and, of the picture's mean, light that comes by paths so
// rare that the test's samples need not meet them: the tails of filters, whose samples Mitsuba shares among pixels.
constexpr double relative_rounding = 2e-4;
constexpr double absolute_rounding = 1e-4;

std::vector<PixelRect> blocks_of(const PixelRect& window, int size)
{
    std::vector<PixelRect> blocks;
    for (int y = window.y; y < window.y + window.height; y += size)
        for (int x = window.x; x < window.x + window.width; x += size)
            blocks.push_back({x, y, std::min(size, window.x + window.width - x),
                              std::min(size, window.y + window.height - y)});
    return blocks;
}

// The whole picture and its blocks, each channel by itself. The p-value is that of all these tests together: a third
// of the level goes to the whole picture, a third to the blocks of each size (Bonferroni).
test::Outcome compare(const Replicates& ours, const Reference& theirs)
{
    if (!(ours.window() == theirs.window())) return {0.0, "the pictures differ in size"};
    test::Outcome outcome{1.0, ""};
    const auto test_blocks = [&](const std::vector<PixelRect>& blocks) {
        for (const PixelRect& block : blocks)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const Uncertain b = theirs.block(block, channel);
                Uncertain a = ours.block(block, channel);
                // Light that comes by rare paths may have been missed so far, and then the variance says nothing. No
                // block is taken to be less noisy than the other renderer's with as many samples.
                if (blocks.size() > 1)
                    a.variance = std::max(a.variance, b.variance * theirs.samples() / ours.samples());
                const double allowed = relative_rounding * std::abs(b.value) +
                                       absolute_rounding * theirs.block(theirs.window(), channel).value;
                const double tests = 3.0 * 3.0 * static_cast<double>(blocks.size());
                const double p = std::min(tests * same_value_p(a, b, allowed), 1.0);
                if (outcome.text.empty() || p < outcome.p)
                    outcome = {p, fmt::format("channel {} of the {} x {} pixels at {} {}: {:.6g} +- {:.2g}, "
                                              "reference {:.6g} +- {:.2g}",
                                              channel, block.width, block.height, block.x, block.y, a.value,
                                              std::sqrt(a.variance), b.value, std::sqrt(b.variance))};
            }
    };
    test_blocks({theirs.window()});
    for (const int size : block_sizes) test_blocks(blocks_of(theirs.window(), size));
    return outcome;
}

void check_scene(const std::string& name, std::uint64_t replicates, std::uint64_t samples_per_pixel,
                 double level)
{
    const LoadedScene scene = load_scene(scene_folder / (name + ".xml"));
    const Reference reference(name);
    test::check_statistic(
        name,
        [&](std::uint64_t samples, std::uint64_t seed) {
            const Replicates ours(scene.job, replicates, samples, seed);
            CHECK(ours.left_out() == 0);
            return compare(ours, reference);
        },
        samples_per_pixel, level);
}

void check_scenes(std::uint64_t replicates, std::uint64_t samples_per_pixel)
{
    const std::vector<std::string> names = scene_names();
    REQUIRE(names.size() >= 40);
    const double level = test::sidak_level(test::significance, names.size());
    for (const std::string& name : names) check_scene(name, replicates, samples_per_pixel, level);
}

} // namespace

TEST_CASE("pictures have the expectation that the independent judge says", "[statistical][independent]")
{
    check_scenes(16, 8);
}

TEST_CASE("pictures have the expectation that the independent judge says, within a fraction of a percent",
          "[statistical][independent][slow]")
{
    check_scenes(32, 50);
}
