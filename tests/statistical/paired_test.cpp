// SPDX-License-Identifier: MIT

// The verdict on images without error bars, and on replicas: how often it finds a difference where there is none, how
// often it decides, and what it finds. The tables of docs/comparing.md are from longer runs of these.

#include "plumb/compare/compare.h"
#include "support/catch.h"
#include "support/noisy_image.h"
#include "support/statistics.h"

#include <fmt/format.h>
#include <map>

using namespace plumb;
using namespace plumb::test;

namespace {

// What is known of B, the reference, which has 4 times the samples of A or none of its noise.
enum class Reference { with_error_bars, without, exact };

constexpr Reference all_references[] = {Reference::with_error_bars, Reference::without, Reference::exact};

std::string_view name_of(Reference reference)
{
    switch (reference) {
    case Reference::with_error_bars: return "a reference with error bars";
    case Reference::without: return "a reference without error bars";
    case Reference::exact: return "the truth";
    }
    return "";
}

struct Trial {
    SampleKind kind;
    int size = 64;
    int samples = 16;
    double filter = 0.0; // standard deviation in pixels of a filter that splats A's samples; 0: a box
    Reference reference = Reference::with_error_bars;
    double bias = 1.0; // of A
};

std::string text_of(const Trial& trial)
{
    return fmt::format("{}, {}x{}, {} samples, filter {}, bias {}, against {}", trial.kind.name, trial.size,
                       trial.size, trial.samples, trial.filter, trial.bias, name_of(trial.reference));
}

// Every pixel becomes the weighted mean of those around it, as if each had a sample at its centre.
Image splatted(const Image& image, double deviation)
{
    const int radius = static_cast<int>(std::ceil(4.0 * deviation));
    const int width = image.full_width();
    const int height = image.full_height();
    Image result({0, 0, width, height}, width, height, {"Y"});
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i) weights.push_back(std::exp(-0.5 * sqr(i / deviation)));
    std::vector<double> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto at = [width](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    const auto mean = [&](int middle, int end, const auto& value) {
        double sum = 0.0;
        double weight = 0.0;
        for (int i = std::max(0, middle - radius); i <= std::min(end - 1, middle + radius); ++i) {
            const double w = weights[static_cast<std::size_t>(i - middle + radius)];
            sum += w * value(i);
            weight += w;
        }
        return sum / weight;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            rows[at(x, y)] = mean(x, width, [&](int i) { return static_cast<double>(image.pixel(i, y)[0]); });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            *result.pixel(x, y) = static_cast<float>(mean(y, height, [&](int i) { return rows[at(x, i)]; }));
    return result;
}

Image make_a(const Trial& trial, std::uint64_t seed)
{
    NoisyImage how;
    how.size = trial.size;
    how.samples = trial.samples;
    how.bias = trial.bias;
    how.knows_noise = false;
    Image image = noisy_image(how, trial.kind, seed);
    return trial.filter > 0.0 ? splatted(image, trial.filter) : std::move(image);
}

Image make_b(const Trial& trial, std::uint64_t seed)
{
    NoisyImage how;
    how.size = trial.size;
    how.samples = 4 * trial.samples;
    how.knows_noise = trial.reference == Reference::with_error_bars;
    return trial.reference == Reference::exact ? true_image(how) : noisy_image(how, trial.kind, seed);
}

CompareSettings settings_of(const Trial& trial)
{
    CompareSettings options;
    options.flip = FlipMode::none;
    if (trial.reference == Reference::exact) options.exact = Side::b;
    return options;
}

Comparison compare_single(const Trial& trial, std::uint64_t seed)
{
    return compare(make_a(trial, 2 * seed), make_b(trial, 2 * seed + 1), settings_of(trial));
}

// A is the mean of so many, each with its share of the samples.
Comparison compare_replicas(const Trial& trial, int replicas, std::uint64_t seed)
{
    std::vector<Image> images;
    for (int k = 0; k < replicas; ++k)
        images.push_back(make_a(trial, seed * 100 + static_cast<std::uint64_t>(k)));
    return compare(mean_of_replicas(images, Side::a), make_b(trial, seed * 100 + 99), settings_of(trial));
}

template <class Compare>
void check_false_alarms(const std::string& text, const Compare& compare_once, std::uint64_t trials,
                        double level)
{
    const auto run = [&](std::uint64_t pairs, std::uint64_t seed) {
        std::uint64_t alarms = 0;
        for (std::uint64_t i = 0; i < pairs; ++i)
            if (compare_once(seed * 1000003 + i).significance.verdict == Verdict::differs) ++alarms;
        return test::Outcome{binomial_survival(alarms, pairs, CompareSettings().significance),
                             fmt::format("{} of {} pairs differ", alarms, pairs)};
    };
    check_statistic(text, run, trials, level);
}

void check_false_alarms(const std::vector<Trial>& trials, std::uint64_t pairs)
{
    const double level = sidak_level(significance, trials.size());
    for (const Trial& trial : trials)
        check_false_alarms(
            text_of(trial), [&](std::uint64_t seed) { return compare_single(trial, seed); }, pairs, level);
}

struct Counts {
    int same = 0;
    int different = 0;
    int undecided = 0;
};

template <class Compare>
Counts count_findings(int pairs, const Compare& compare_once)
{
    Counts counts;
    for (int i = 0; i < pairs; ++i) {
        const auto verdict = compare_once(static_cast<std::uint64_t>(1000 + i)).significance.verdict;
        ++(verdict == Verdict::passes    ? counts.same
           : verdict == Verdict::differs ? counts.different
                                         : counts.undecided);
    }
    return counts;
}

// The pixels of the left half are brighter by this factor.
Image with_brighter_half(Image image, float factor)
{
    for (int y = 0; y < image.full_height(); ++y)
        for (int x = 0; x < image.full_width() / 2; ++x) *image.pixel(x, y) *= factor;
    return image;
}

} // namespace

TEST_CASE("the verdict on a single image keeps its error rate, in short", "[statistical][compare]")
{
    std::vector<Trial> trials;
    for (const SampleKind& kind :
         {normal_samples(0.3), exponential_samples(), hits(1e-2), rare_light(0.3, 0.6 / (256.0 * 16))})
        for (const Reference reference : {Reference::with_error_bars, Reference::without})
            trials.push_back({.kind = kind, .reference = reference});
    check_false_alarms(trials, 20);
}

TEST_CASE("the verdict on a single image keeps its error rate where a filter splats",
          "[statistical][compare]")
{
    std::vector<Trial> trials;
    for (const double filter : {0.5, 1.0, 2.0})
        trials.push_back({.kind = exponential_samples(), .filter = filter});
    check_false_alarms(trials, 20);
}

TEST_CASE("the verdict on a single image keeps its error rate", "[statistical][compare][slow]")
{
    std::vector<Trial> trials;
    for (const Reference reference : all_references) {
        for (const SampleKind& kind : {normal_samples(0.3), exponential_samples(), lognormal_samples(1.0),
                                       hits(1e-1), hits(1e-2), hits(1e-3), hits(1e-4)})
            for (const auto& [size, samples] : {std::pair{16, 64}, {64, 1}, {64, 16}, {128, 16}})
                trials.push_back({.kind = kind, .size = size, .samples = samples, .reference = reference});
        trials.push_back({.kind = lognormal_samples(2.0), .reference = reference});
        for (const double share : {0.1, 0.3, 0.6})
            for (const double number : {0.6, 2.0, 10.0})
                trials.push_back({.kind = rare_light(share, number / (256.0 * 16)), .reference = reference});
    }
    for (const double filter : {0.3, 0.5, 1.0, 1.5, 2.0})
        for (const int size : {16, 64, 128})
            for (const SampleKind& kind : {normal_samples(0.3), exponential_samples(), hits(1e-2)})
                trials.push_back({.kind = kind, .size = size, .filter = filter});
    check_false_alarms(trials, 40);
}

TEST_CASE("a single image of independent noise is decided", "[statistical][compare]")
{
    for (const SampleKind& kind : {normal_samples(0.3), exponential_samples(), lognormal_samples(1.0),
                                   hits(1e-1), hits(1e-2), hits(1e-3)}) {
        const Trial trial{.kind = kind};
        const Counts counts =
            count_findings(20, [&](std::uint64_t seed) { return compare_single(trial, seed); });
        INFO(text_of(trial) << ": " << counts.undecided << " undecided");
        CHECK(counts.undecided <= 2);
    }
}

// As a denoiser leaves it: what is left of the noise cannot be told from a smooth error.
TEST_CASE("an image whose noise is smooth is not said to agree", "[statistical][compare]")
{
    for (const double filter : {4.0, 8.0}) {
        const Trial trial{.kind = exponential_samples(), .size = 128, .filter = filter};
        const Counts counts =
            count_findings(10, [&](std::uint64_t seed) { return compare_single(trial, seed); });
        INFO(text_of(trial));
        CHECK(counts.same == 0);
        CHECK(counts.different == 0);
        CHECK(compare_single(trial, 1).significance.difference_noise->is_hidden);
        // But a gross error is found.
        Trial wrong = trial;
        wrong.bias = 1.3;
        CHECK(compare_single(wrong, 1).significance.verdict == Verdict::differs);
    }
    // Against another smooth image, the correlation is seen.
    const Trial trial{.kind = exponential_samples(), .size = 128, .filter = 5.0};
    const Image a = make_a(trial, 1);
    const Image b = make_a(trial, 2);
    const Comparison smooth = compare(a, b, settings_of(trial));
    CHECK(smooth.significance.verdict == Verdict::undecided);
    REQUIRE(smooth.significance.difference_noise);
    CHECK(!smooth.significance.difference_noise->reach);
}

TEST_CASE("the verdict on a single image finds small errors", "[statistical][compare]")
{
    // Normal noise of 7.5 %; half of the image is 3 % too bright.
    const Trial trial{.kind = normal_samples(0.6), .size = 128, .samples = 64};
    for (const Reference reference : all_references) {
        Trial how = trial;
        how.reference = reference;
        const Comparison wrong =
            compare(with_brighter_half(make_a(how, 1), 1.03f), make_b(how, 2), settings_of(how));
        INFO(text_of(how) << ": p " << wrong.significance.p);
        CHECK(wrong.significance.verdict == Verdict::differs);
        CHECK(wrong.significance.p < 1e-4);
        // It is known where.
        CHECK(wrong.significance.differing > 128 * 128 / 4);
        CHECK(wrong.significance.differing <= 128 * 128 * 5 / 8);
    }
    // The power that is promised.
    const Trial plain{.kind = exponential_samples()};
    const double bias = *compare_single(plain, 1).significance.detectable_bias;
    CHECK(bias < 0.05);
    Trial biased = plain;
    biased.bias = 1.0 + bias;
    CHECK(count_findings(40, [&](std::uint64_t seed) { return compare_single(biased, seed); }).different >=
          31);
    biased.bias = 1.0 + 0.25 * bias;
    CHECK(count_findings(40, [&](std::uint64_t seed) { return compare_single(biased, seed); }).different <=
          20);
}

// Errors of either sign in every square of 64x64 pixels, too small for each of them.
TEST_CASE("the verdict on a single image finds what is small but everywhere", "[statistical][compare]")
{
    const Trial trial{.kind = normal_samples(0.4), .size = 256, .samples = 16};
    Image a = make_a(trial, 1);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) *a.pixel(x, y) *= ((x / 64) + (y / 64)) % 2 ? 1.004f : 0.996f;
    const Comparison found = compare(a, make_b(trial, 2), settings_of(trial));
    CHECK(found.significance.verdict == Verdict::differs);
    double smallest = 1.0;
    for (const SpreadTest& test : found.significance.spread) smallest = std::min(smallest, test.p);
    CHECK(smallest < 1e-4);
    CHECK(found.significance.p == smallest);
}

TEST_CASE("replicas keep the error rate of compare, and are sharper than a single image",
          "[statistical][compare]")
{
    const double level = sidak_level(significance, 6);
    std::map<int, double> power;
    for (const int replicas : {2, 8}) {
        for (const Trial& trial :
             {Trial{.kind = exponential_samples(), .size = 32}, Trial{.kind = hits(1e-1), .size = 32},
              Trial{.kind = exponential_samples(), .size = 64, .filter = 0.7}})
            check_false_alarms(
                fmt::format("{} replicas, {}", replicas, text_of(trial)),
                [&](std::uint64_t seed) { return compare_replicas(trial, replicas, seed); }, 20, level);
        const Trial trial{.kind = exponential_samples(), .size = 32};
        power[replicas] = compare_replicas(trial, replicas, 1).significance.detectable_bias.value_or(1.0);
    }
    CHECK(power[8] < power[2]);
    const Trial bright{.kind = exponential_samples(), .size = 32, .bias = 1.0 + power[8]};
    CHECK(count_findings(20, [&](std::uint64_t seed) {
              return compare_replicas(bright, 8, seed);
          }).different >= 15);
}
