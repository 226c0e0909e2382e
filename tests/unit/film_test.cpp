// SPDX-License-Identifier: MIT

#include "plumb/render/film.h"
#include "support/catch.h"
#include "support/random.h"

#include <algorithm>
#include <cstring>

using namespace plumb;

namespace {

constexpr PixelRect one_pixel{0, 0, 1, 1};

Color developed(const Film& film)
{
    return film.develop().color(film.window().x, film.window().y);
}

bool same_bits(const Color& a, const Color& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

TEST_CASE("a film's sum does not depend on the order of samples", "[unit][film]")
{
    test::TestRandom random(7);
    std::vector<Color> samples;
    for (int i = 0; i < 2000; ++i) {
        const auto magnitude = static_cast<float>(std::exp(random.between(-25.0, 20.0)));
        samples.push_back(Color(magnitude, 2.f * magnitude, 0.3f * magnitude));
    }
    const auto sum_up = [&] {
        Film film(one_pixel, 1, 1);
        for (const Color& sample : samples) REQUIRE(film.add({0, 0}, sample, 1.f) == SampleStatus::accepted);
        return developed(film);
    };
    const Color forward = sum_up();
    std::reverse(samples.begin(), samples.end());
    REQUIRE(same_bits(forward, sum_up()));
    std::sort(samples.begin(), samples.end(), [](const Color& a, const Color& b) { return a.r < b.r; });
    REQUIRE(same_bits(forward, sum_up()));
}

TEST_CASE("a film's mean is that of its samples to the last bit of a float", "[unit][film]")
{
    const float scale = GENERATE(1e-6f, 1.f, 1e6f);
    test::TestRandom random(3);
    Film film(one_pixel, 1, 1);
    long double sum = 0.0L;
    const int count = 1000;
    for (int i = 0; i < count; ++i) {
        const float value = scale * random.next_1d();
        sum += value;
        film.add({0, 0}, Color(value), 1.f);
    }
    const auto expected = static_cast<float>(sum / count);
    REQUIRE(std::abs(developed(film).r - expected) <= std::abs(expected) * 0x1p-23f);
    REQUIRE(film.sample_count({0, 0}) == count);
}

TEST_CASE("a film leaves out what it cannot hold, and nothing else", "[unit][film]")
{
    Film film(one_pixel, 1, 1);
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    CHECK(film.add({0, 0}, Color(1.f, not_a_number, 1.f), 1.f) == SampleStatus::not_finite);
    CHECK(film.add({0, 0}, Color(infinity), 1.f) == SampleStatus::not_finite);
    CHECK(film.add({0, 0}, Color(1.f, -1e-20f, 1.f), 1.f) == SampleStatus::negative);
    CHECK(film.add({0, 0}, Color(film_max_value), 1.f) == SampleStatus::out_of_range);
    CHECK(film.add({0, 0}, Color(film_max_value * 0.9f), -1.3f) == SampleStatus::out_of_range);
    CHECK(film.sample_count({0, 0}) == 0);
    CHECK(developed(film) == Color());

    CHECK(film.add({0, 0}, Color(std::nextafter(film_max_value, 0.f)), 1.f) == SampleStatus::accepted);
    CHECK(film.add({0, 0}, Color(), 1.f) == SampleStatus::accepted);
    CHECK(film.add({0, 0}, Color(8.f), -0.5f) == SampleStatus::accepted); // a negative lobe of the filter
    CHECK(film.sample_count({0, 0}) == 3);
}

TEST_CASE("a film's largest samples add up to the largest count without wrapping", "[unit][film]")
{
    // 2^26 samples of almost 2^37 fill 127 bits; here the sum of 2^12 is compared with what doubles say.
    Film film(one_pixel, 1, 1);
    const float large = std::nextafter(film_max_value, 0.f);
    for (int i = 0; i < 4096; ++i) film.add({0, 0}, Color(large, 0.f, large), i % 2 == 0 ? 1.f : 0.5f);
    REQUIRE(developed(film).r == Approx(0.75 * large).epsilon(1e-7));
    static_assert(film_max_samples <= (std::uint64_t{1} << 26) && film_max_value <= 0x1p37f);
}

TEST_CASE("a film keeps a window of a larger image", "[unit][film]")
{
    Film film({3, 2, 4, 5}, 10, 9);
    film.add({6, 6}, Color(1.f, 2.f, 3.f), 1.f);
    const Image image = film.develop();
    REQUIRE(image.data_window() == PixelRect{3, 2, 4, 5});
    REQUIRE(image.full_width() == 10);
    REQUIRE(image.full_height() == 9);
    REQUIRE(image.color(6, 6) == Color(1.f, 2.f, 3.f));
    REQUIRE(image.color(3, 2) == Color());
}

TEST_CASE("a film's variance is the sample variance over n, whatever the size of the samples", "[unit][film]")
{
    // Some of the last scale's samples have their squares in the table of large ones.
    const float scale = GENERATE(1e-6f, 1.f, 1e6f);
    test::TestRandom random(5);
    std::vector<float> samples;
    for (int i = 0; i < 1000; ++i) samples.push_back(scale * random.next_1d() * random.next_1d());
    const auto develop = [&samples] {
        Film film(one_pixel, 1, 1);
        for (const float x : samples) film.add({0, 0}, Color(x, 0.5f * x, 0.f), x > 0.f ? 1.f : -1.f);
        return film.variance_of_mean({0, 0});
    };
    long double mean = 0.0L;
    for (const float x : samples) mean += x;
    mean /= static_cast<long double>(samples.size());
    long double variance = 0.0L;
    for (const float x : samples) variance += (x - mean) * (x - mean);
    variance /= 1000.0L * 999.0L;

    const Color found = develop();
    CHECK(found.r == Approx(static_cast<double>(variance)).epsilon(1e-6));
    CHECK(found.g == Approx(0.25 * static_cast<double>(variance)).epsilon(1e-6));
    CHECK(found.b == 0.f);
    std::reverse(samples.begin(), samples.end());
    CHECK(same_bits(develop(), found));
}

TEST_CASE("the variance of one sample is unknown, not 0", "[unit][film]")
{
    Film film(one_pixel, 1, 1);
    CHECK(std::isnan(film.variance_of_mean({0, 0}).r));
    film.add({0, 0}, Color(1.f), 1.f);
    CHECK(std::isnan(film.variance_of_mean({0, 0}).g));
    film.add({0, 0}, Color(3.f), 1.f);
    CHECK(film.variance_of_mean({0, 0}) == Color(1.f)); // s^2 = 2, over 2
}

TEST_CASE("a film counts the samples that are not black", "[unit][film]")
{
    Film film(one_pixel, 1, 1);
    film.add({0, 0}, Color(), 1.f);
    film.add({0, 0}, Color(0.f, 0.f, 1e-30f), 1.f);
    film.add({0, 0}, Color(-1.f), 1.f); // left out
    CHECK(film.sample_count({0, 0}) == 2);
    CHECK(film.contributing_count({0, 0}) == 1);

    const Image image = film.develop(Channels::color_and_evidence);
    CHECK(image.channel_names() ==
          std::vector<std::string>{"R", "G", "B", "variance.R", "variance.G", "variance.B", "contributing"});
    CHECK(image.pixel(0, 0)[6] == 1.f);
    CHECK(film.develop().channel_count() == 3);
}
