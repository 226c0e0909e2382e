// SPDX-License-Identifier: MIT
#include "plumb/base/error.h"
#include "plumb/compare/compare.h"
#include "plumb/reports/comparison_report.h"
#include "support/catch.h"
#include "support/noisy_image.h"

using namespace plumb;
using namespace plumb::test;

namespace {

Image grey(int width, int height, float value, std::vector<std::string> channels = {"Y"})
{
    Image image({0, 0, width, height}, width, height, std::move(channels));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < image.channel_count(); ++c) image.pixel(x, y)[c] = value;
    return image;
}

std::string problem(const Image& a, const Image& b, const CompareSettings& options = {})
{
    try {
        compare(a, b, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

CompareSettings without_flip()
{
    CompareSettings options;
    options.flip = FlipMode::none;
    return options;
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Every pixel has this mean, and the variance that so many samples have.
Image sampled(int size, float mean, float variance_of_sample, int samples)
{
    Image image = grey(size, size, mean, {"Y", "variance.Y"});
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            image.pixel(x, y)[1] = variance_of_sample / static_cast<float>(samples);
    image.metadata.emplace_back("plumb:samplesPerPixel", samples);
    return image;
}

void describe(Image& image, const std::string& integrator, const std::string& seed)
{
    image.metadata.emplace_back("plumb:inputHash", "0123");
    image.metadata.emplace_back("plumb:integrator", integrator);
    image.metadata.emplace_back("plumb:seed", seed);
}

} // namespace

TEST_CASE("metrics are what they are defined to be", "[unit][compare]")
{
    Image a = grey(2, 1, 1.f);
    Image b = grey(2, 1, 1.f);
    a.pixel(1, 0)[0] = 1.5f;
    b.pixel(1, 0)[0] = 2.f;
    const Metrics m = compare(a, b, without_flip()).metrics;
    CHECK(m.mse == 0.125);
    CHECK(m.rmse == Approx(std::sqrt(0.125)).epsilon(1e-14));
    CHECK(m.relative_mse == Approx(0.25 / 4.01 / 2.0).epsilon(1e-14));
    CHECK(m.mae == 0.25);
    CHECK(m.psnr == Approx(10.0 * std::log10(8.0)).epsilon(1e-12));
    CHECK(m.max == 0.5);
    CHECK(m.max_pixel == Vec2i(1, 0));
    CHECK_FALSE(m.flip);
    CHECK(metric_value(m, "relmse") == m.relative_mse);
    CHECK_THROWS_AS(metric_value(m, "flip"), Error);
    CHECK_THROWS_AS(metric_value(m, "ssim"), Error);
    CHECK(compare(a, a, without_flip()).metrics.psnr == double(infinity));
}

TEST_CASE("channels are found by name", "[unit][compare]")
{
    Image a = grey(1, 1, 0.f, {"contributing", "B", "variance.G", "R", "variance.B", "G", "variance.R"});
    const float values[] = {64.f, 3.f, 0.02f, 1.f, 0.03f, 2.f, 0.01f};
    std::copy(std::begin(values), std::end(values), a.pixel(0, 0));
    Image b = grey(1, 1, 0.f, {"R", "G", "B"});
    CompareSettings options = without_flip();
    options.exact = Side::b;
    const Comparison c = compare(a, b, options);
    CHECK(c.metrics.mse == Approx((1.0 + 4.0 + 9.0) / 3.0));
    CHECK(c.metrics.max == 3.0);
    CHECK(c.channels == std::vector<std::string>{"R", "G", "B"});
}

TEST_CASE("images that cannot be compared say why", "[unit][compare]")
{
    CHECK(problem(grey(2, 1, 0.f), grey(1, 2, 0.f)) ==
          "the images have different sizes: A is 2x1 pixels, B is 1x2 pixels");
    CHECK(problem(Image({1, 0, 1, 1}, 2, 1, {"Y"}), grey(2, 1, 0.f)) ==
          "the images have different sizes: A is 2x1 pixels of which 1,0,1,1 exist, B is 2x1 pixels");
    CHECK(problem(grey(1, 1, 0.f, {"R", "G", "B"}), grey(1, 1, 0.f)) ==
          "the images have different channels: A has R, G, B, B has Y");
    CHECK(problem(grey(1, 1, 0.f), grey(1, 1, 0.f, {"Z", "A"})) ==
          "B has neither the channels R, G and B nor Y, but Z, A; only these can be compared");
    CompareSettings options;
    options.thresholds = {{"ssim", 1.0}};
    CHECK(problem(grey(1, 1, 0.f), grey(1, 1, 0.f), options) ==
          "unknown metric 'ssim'; known are mse, rmse, relmse, mae, max, psnr and flip");
}

TEST_CASE("pixels that are not finite differ unless both have them", "[unit][compare]")
{
    Image a = grey(3, 3, 1.f);
    Image b = grey(3, 3, 1.f);
    a.pixel(2, 1)[0] = not_a_number;
    CompareSettings options;
    options.thresholds = {{"rmse", 0.1}};
    const Comparison one = compare(a, b, options);
    CHECK(one.verdict == Verdict::differs);
    CHECK(one.exceeded.empty());
    CHECK(one.non_finite.only_a == 1);
    CHECK(one.non_finite.first == Vec2i(2, 1));
    CHECK(one.metrics.mse == 0.0);
    CHECK(one.metrics.flip == 0.0);
    CHECK(compare(b, a, options).non_finite.only_b == 1);

    options.fail_percent = 12.0; // one of nine is 11.1 %
    CHECK(compare(a, b, options).verdict == Verdict::passes);
    options.fail_percent = 11.0;
    CHECK(compare(a, b, options).verdict == Verdict::differs);

    b.pixel(2, 1)[0] = infinity;
    const Comparison both = compare(a, b);
    CHECK(both.non_finite.both == 1);
    CHECK(both.verdict == Verdict::passes); // it is left out, and the others are equal
    b.pixel(2, 1)[0] = not_a_number;
    CHECK(compare(a, b).identical);
    CHECK(compare(a, b).verdict == Verdict::passes);
}

TEST_CASE("limits decide where nobody knows the noise", "[unit][compare]")
{
    const Image a = grey(4, 4, 1.f);
    const Image b = grey(4, 4, 1.25f);
    CompareSettings options;
    const Comparison neither = compare(a, b, options);
    CHECK(neither.significance.verdict == Verdict::differs); // and nothing looks like noise
    CHECK(neither.verdict == Verdict::differs);
    CHECK_FALSE(neither.corrected);
    options.thresholds = {{"rmse", 0.25}, {"mae", 0.3}};
    const Comparison limited = compare(a, b, options);
    CHECK(limited.verdict == Verdict::passes);
    CHECK(limited.significance.verdict == std::nullopt);
    CHECK(limited.significance.reason == "neither image has variance channels, and limits are given");
    options.thresholds.push_back({"mse", 0.06});
    const Comparison above = compare(a, b, options);
    CHECK(above.verdict == Verdict::differs);
    REQUIRE(above.exceeded.size() == 1);
    CHECK(above.exceeded[0].metric == "mse");
    options.thresholds = {{"psnr", 12.0}}; // it is 12.04
    CHECK(compare(a, b, options).verdict == Verdict::passes);
    options.thresholds = {{"psnr", 12.1}};
    CHECK(compare(a, b, options).verdict == Verdict::differs);
}

TEST_CASE("an exact image has no noise", "[unit][compare]")
{
    const NoisyImage how;
    const Image a = noisy_image(how, exponential_samples(), 1);
    const Image truth = true_image(how);
    CompareSettings options = without_flip();
    const Comparison single = compare(a, truth, options);
    CHECK(single.verdict == Verdict::undecided);
    CHECK(single.significance.reason ==
          "B shows no noise of its own beside that of A, as after a denoiser; if it has "
          "none, pass --exact B");
    options.exact = Side::b;
    const Comparison exact = compare(a, truth, options);
    CHECK(exact.verdict == Verdict::passes);
    REQUIRE(exact.corrected);
    CHECK(exact.corrected->low < 0.0);
    CHECK(exact.corrected->high > 0.0);
    // The noise is nearly all of the error: 1/64.
    CHECK(exact.metrics.mse == Approx(1.0 / 64.0).epsilon(0.3));
    CHECK(std::abs(exact.corrected->squared_error) < 0.3 / 64.0);
    options.exact = Side::a;
    CHECK(compare(truth, a, options).verdict == Verdict::passes);
    options.exact = Side::b;
    options.verdict = false;
    CHECK(compare(a, truth, options).significance.verdict == std::nullopt);
}

TEST_CASE("a bias is found, and where it is", "[unit][compare]")
{
    NoisyImage how;
    how.size = 32;
    how.channels = {"R", "G", "B"};
    const Image a = noisy_image(how, exponential_samples(), 1);
    Image b = noisy_image(how, exponential_samples(), 2);
    CHECK(compare(a, b, without_flip()).verdict == Verdict::passes);

    SECTION("everywhere")
    {
        how.bias = 1.1;
        const Comparison c = compare(noisy_image(how, exponential_samples(), 3), b, without_flip());
        CHECK(c.verdict == Verdict::differs);
        CHECK(c.significance.scales.back().rejected == 1);
        CHECK(c.significance.scales.back().largest->mean_a > 1.05);
        CHECK(c.significance.scales.front().rejected == 0);
    }
    SECTION("in one block and one channel")
    {
        for (int y = 8; y < 16; ++y)
            for (int x = 16; x < 24; ++x) b.pixel(x, y)[1] *= 1.5f;
        const Significance s = compare(a, b, without_flip()).significance;
        CHECK(s.verdict == Verdict::differs);
        UnitTest most;
        for (const ScaleTest& scale : s.scales)
            if (scale.size != 0 && scale.largest && scale.largest->p < most.p) most = *scale.largest;
        INFO(most.place.x << "," << most.place.y << " " << most.place.width << " p " << most.p);
        CHECK(most.p <= 0.01);
        CHECK(most.channel == 1);
        CHECK(most.place.width <= 8);
        CHECK((most.place.x >= 16 && most.place.x < 24 && most.place.y >= 8 && most.place.y < 16));
        CHECK(s.differing >= 4);
        CHECK(s.differing <= 64);
    }
    SECTION("in one pixel, which may be tolerated")
    {
        for (int c = 0; c < 3; ++c) b.pixel(5, 6)[c] += 100.f;
        CompareSettings options = without_flip();
        const Significance s = compare(a, b, options).significance;
        CHECK(s.verdict == Verdict::differs);
        CHECK(s.differing >= 1);
        CHECK(s.differing <= 16);
        CHECK(s.scales.back().rejected == 0); // without that pixel
        CHECK(s.p < 0.01);
        options.fail_percent = 2.0;
        CHECK(compare(a, b, options).verdict == Verdict::passes);
    }
}

TEST_CASE("what the data do not support is not tested", "[unit][compare]")
{
    NoisyImage how;
    how.size = 32;
    // 65536 samples, of which 6 or 7 hit: too few to say anything.
    const Comparison few =
        compare(noisy_image(how, hits(1e-4), 1), noisy_image(how, hits(1e-4), 2), without_flip());
    CHECK(few.significance.verdict == Verdict::undecided);
    CHECK(few.verdict == Verdict::undecided);
    CHECK(few.significance.untested == 32 * 32);
    CHECK_FALSE(few.significance.detectable_bias);
    // 650 hits: the whole can be tested, no pixel can.
    const Comparison some =
        compare(noisy_image(how, hits(1e-2), 1), noisy_image(how, hits(1e-2), 2), without_flip());
    CHECK(some.verdict == Verdict::passes);
    CHECK(some.significance.scales.front().tested == 0);
    CHECK(some.significance.scales.back().tested == 1);
    CHECK(*some.significance.detectable_bias > 0.05);
    // One pixel has nearly all of the noise.
    Image spiky = noisy_image(how, exponential_samples(), 3);
    spiky.pixel(3, 3)[0] = 1000.f;
    spiky.pixel(3, 3)[1] = 1e6f;
    const Comparison spike = compare(spiky, noisy_image(how, exponential_samples(), 4), without_flip());
    CHECK(spike.verdict == Verdict::undecided);
    CHECK(spike.significance.untested >= 1);
    CHECK(spike.significance.untested <= 16);

    SECTION("nor a variance that nobody knows")
    {
        Image unknown = noisy_image(how, exponential_samples(), 5);
        const Image other = noisy_image(how, exponential_samples(), 6);
        unknown.pixel(0, 0)[1] = not_a_number;
        CHECK(compare(unknown, other, without_flip()).significance.untested == 1);
        CHECK(compare(unknown, other, without_flip()).verdict == Verdict::undecided);
    }
    SECTION("but the same image is the same")
    {
        const Image a = noisy_image(how, hits(1e-4), 1);
        CHECK(compare(a, a, without_flip()).verdict == Verdict::passes);
    }
    SECTION("nor black against an image")
    {
        const SampleKind nothing = one_by_one("0", [](TestRandom&) { return 0.0; });
        CHECK(
            compare(noisy_image(how, nothing, 1), noisy_image(how, exponential_samples(), 2), without_flip())
                .verdict == Verdict::undecided);
    }
}

TEST_CASE("rare light that one image has missed is no difference", "[unit][compare]")
{
    SECTION("where the other image tells of it")
    {
        // 4096 samples, none of which is bright, and 262144: the mean of so few deviates by 0.11.
        const Image few = sampled(16, 1.f, 0.01f, 16);
        CHECK(compare(few, sampled(16, 1.3f, 50.f, 1024), without_flip()).verdict == Verdict::passes);
        CHECK(compare(few, sampled(16, 1.8f, 50.f, 1024), without_flip()).verdict == Verdict::differs);
        CHECK(compare(few, sampled(16, 1.3f, 5.f, 1024), without_flip()).verdict == Verdict::differs);
    }
    SECTION("where the surroundings tell of it")
    {
        // The noise of all pixels but those of a square of 16x16.
        const auto outcome = [](float variance_around, const std::string& other_integrator) {
            Image image = sampled(64, 1.f, variance_around, 64);
            for (int y = 16; y < 32; ++y)
                for (int x = 16; x < 32; ++x) {
                    image.pixel(x, y)[0] = 0.8f;
                    image.pixel(x, y)[1] = 0.01f / 64.f;
                }
            describe(image, "path", "1");
            Image reference = sampled(64, 1.f, 0.01f, 1024);
            describe(reference, other_integrator, "2");
            return compare(image, reference, without_flip()).verdict;
        };
        CHECK(outcome(100.f, "smooth") == Verdict::passes);
        CHECK(outcome(1.f, "smooth") == Verdict::differs);
        // The same estimator, but the image of more samples knows of no rare light.
        CHECK(outcome(100.f, "path") == Verdict::differs);
    }
}

TEST_CASE("images too alike are said to be of one seed only if they are", "[unit][compare]")
{
    const auto text = [](const std::string& seed, const std::string& integrator) {
        Image a = sampled(16, 1.f, 1.f, 16);
        Image b = sampled(16, 1.001f, 1.f, 16);
        describe(a, "path", "7");
        describe(b, integrator, seed);
        const Comparison comparison = compare(a, b, without_flip());
        REQUIRE(comparison.corrected->high < 0.0);
        return comparison_text(comparison, without_flip());
    };
    CHECK_THAT(text("7", "path"), ContainsSubstring("because they have the same seed"));
    CHECK_THAT(text("8", "path"), !ContainsSubstring("seed"));
    CHECK_THAT(text("7", "path_mis"), !ContainsSubstring("seed"));
}

TEST_CASE("rounding is no difference", "[unit][compare]")
{
    NoisyImage how;
    const SampleKind one = one_by_one("1", [](TestRandom&) { return 1.0; });
    const Image a = noisy_image(how, one, 1);
    how.bias = 1.0 + 5e-6;
    CHECK(compare(noisy_image(how, one, 1), a, without_flip()).verdict == Verdict::passes);
    how.bias = 1.0 + 5e-5;
    CHECK(compare(noisy_image(how, one, 1), a, without_flip()).verdict == Verdict::differs);
}

TEST_CASE("difference images have a bar below them", "[unit][compare]")
{
    Image a = grey(128, 20, 1.f, {"R", "G", "B"});
    const Image b = grey(128, 20, 1.f, {"R", "G", "B"});
    a.pixel(5, 5)[1] = 3.f;
    a.pixel(6, 5)[2] = not_a_number;
    const Image difference = difference_image(a, b);
    CHECK(difference.full_width() == 128);
    CHECK(difference.full_height() > 20);
    CHECK(difference.color(6, 5) == Color(0.f, 1.f, 0.f));
    CHECK(luminance(difference.color(5, 5)) > 0.8f); // the largest error
    CHECK(luminance(difference.color(0, 0)) < 0.01f);
    CHECK(difference.color(127, 25) == difference.color(5, 5)); // the end of the bar
    const Comparison c = compare(a, b);
    CHECK(flip_image(c).full_width() == 128);
    CHECK_THROWS_AS(flip_image(compare(a, b, without_flip())), Error);
}
