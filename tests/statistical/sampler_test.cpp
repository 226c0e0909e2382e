// SPDX-License-Identifier: MIT

#include "plumb/sampler.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/statistics.h"

#include <bit>
#include <vector>

namespace plumb {
class IndependentSampler;
}

using namespace plumb;
using test::ParamsBuilder;

namespace {

std::unique_ptr<Sampler> independent()
{
    return ParamsBuilder("sampler", "independent").build<IndependentSampler, Sampler>();
}

std::vector<double> draw(Sampler& sampler, std::uint64_t seed, Vec2i pixel, std::uint64_t index,
                         int count = 12)
{
    sampler.start(seed, pixel, index);
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(i % 3 == 0 ? sampler.next_choice() : sampler.next_1d());
    return numbers;
}

} // namespace

TEST_CASE("a sample's numbers depend on seed, pixel and index alone", "[statistical][sampler]")
{
    const auto sampler = independent();
    const std::uint64_t large = (std::uint64_t{1} << 40) + 3;
    const std::vector<double> first = draw(*sampler, 1, {10, 20}, large);

    draw(*sampler, 5, {1, 2}, 3, 7); // whatever was drawn before
    CHECK(draw(*sampler, 1, {10, 20}, large) == first);
    CHECK(draw(*sampler->clone(), 1, {10, 20}, large) == first);

    CHECK(draw(*sampler, 2, {10, 20}, large) != first);
    CHECK(draw(*sampler, 1 + (std::uint64_t{1} << 32), {10, 20}, large) != first);
    CHECK(draw(*sampler, 1, {20, 10}, large) != first);
    CHECK(draw(*sampler, 1, {10, 20}, 3) != first); // all 64 bits of the index count
    CHECK(draw(*sampler, 1, {10, 20}, large + 1) != first);
}

TEST_CASE("the independent sampler is Philox4x32-10", "[statistical][sampler]")
{
    // The all-zero vector of the authors' known-answer tests (Random123): 6627e8d5 e169c58d bc57ac4c 9b00dbd8. A block
    // holds the first words of eight counters, then their second words, and so on.
    const auto sampler = independent();
    sampler->start(0, {0, 0}, 0);
    for (const std::uint32_t word : {0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}) {
        CHECK(sampler->next_1d() == static_cast<float>(word >> 8) * 0x1p-24f);
        for (int other = 1; other < 8; ++other) sampler->next_1d();
    }
}

TEST_CASE("neighbouring samples are independent and uniform", "[statistical][sampler]")
{
    // Pairs (a dimension of one sample, the same of its neighbour) on a 16 x 16 grid: chi-square against uniform.
    const int neighbour = GENERATE(0, 1, 2, 3); // next dimension, next index, next pixel across, next seed
    const bool passed = test::check_statistic(
        "pairs of neighbour " + std::to_string(neighbour),
        [neighbour](std::uint64_t samples, std::uint64_t seed) {
            const auto sampler = independent();
            std::vector<double> cells(256, 0.0);
            for (std::uint64_t i = 0; i < samples; ++i) {
                const Vec2i pixel(static_cast<int>(i % 200), static_cast<int>(i / 200 % 100));
                const std::uint64_t index = 2 * (i / 20000);
                sampler->start(seed, neighbour == 2 ? Vec2i(2 * pixel.x, pixel.y) : pixel, index);
                const float x = sampler->next_1d();
                if (neighbour == 1)
                    sampler->start(seed, pixel, index + 1);
                else if (neighbour == 2)
                    sampler->start(seed, {2 * pixel.x + 1, pixel.y}, index);
                else if (neighbour == 3)
                    sampler->start(seed + 1, pixel, index);
                const float y = sampler->next_1d();
                ++cells[static_cast<std::size_t>(x * 16.f) * 16 + static_cast<std::size_t>(y * 16.f)];
            }
            const double expected = static_cast<double>(samples) / 256.0;
            double statistic = 0.0;
            for (const double count : cells) statistic += sqr(count - expected) / expected;
            return test::Outcome{test::chi2_survival(statistic, 255), "chi2 " + std::to_string(statistic)};
        },
        100000, test::sidak_level(test::significance, 4), 11);
    CHECK(passed);
}
