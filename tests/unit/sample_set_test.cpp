// SPDX-License-Identifier: MIT

// Sets of samples against sets of single samples, and the parts that images are cut into.

#include "plumb/render/sample_set.h"
#include "support/catch.h"
#include "support/random.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <tuple>

#include <fmt/format.h>

using namespace plumb;
using test::TestRandom;

namespace {

using Single = std::tuple<int, int, std::uint64_t>; // x, y, sample
using Singles = std::set<Single>;

int below(TestRandom& random, int limit)
{
    return static_cast<int>(random.next_double() * limit);
}

std::vector<SampleBlock> random_blocks(TestRandom& random)
{
    std::vector<SampleBlock> blocks;
    for (int count = below(random, 5); count > 0; --count) {
        const int x = below(random, 6);
        const int y = below(random, 6);
        const int first = below(random, 6);
        blocks.push_back({{x, y, below(random, 5), below(random, 5)},
                          static_cast<std::uint64_t>(first),
                          static_cast<std::uint64_t>(first + below(random, 5))});
    }
    return blocks;
}

Singles singles(std::span<const SampleBlock> blocks)
{
    Singles result;
    for (const SampleBlock& block : blocks)
        for (int y = block.pixels.y; y < block.pixels.y + block.pixels.height; ++y)
            for (int x = block.pixels.x; x < block.pixels.x + block.pixels.width; ++x)
                for (std::uint64_t i = block.first; i < block.last; ++i) result.emplace(x, y, i);
    return result;
}

} // namespace

TEST_CASE("sets of samples are sets", "[unit][sample_set]")
{
    TestRandom random(1);
    for (int round = 0; round < 2000; ++round) {
        const std::vector<SampleBlock> blocks_a = random_blocks(random);
        const std::vector<SampleBlock> blocks_b = random_blocks(random);
        const SampleSet a(blocks_a);
        const SampleSet b(blocks_b);
        const Singles in_a = singles(blocks_a);
        const Singles in_b = singles(blocks_b);
        REQUIRE(singles(a.blocks()) == in_a);
        REQUIRE(a.count() == in_a.size()); // so the blocks do not overlap
        REQUIRE(a.empty() == in_a.empty());

        Singles both;
        Singles only_a;
        Singles either = in_a;
        either.insert(in_b.begin(), in_b.end());
        for (const Single& single : in_a) (in_b.count(single) > 0 ? both : only_a).insert(single);
        REQUIRE(singles((a | b).blocks()) == either);
        REQUIRE(singles((a & b).blocks()) == both);
        REQUIRE(singles((a - b).blocks()) == only_a);

        // One form for one set, however it came about.
        REQUIRE(((a - b) | (a & b)) == a);
        REQUIRE(((a | b) == a) == (either == in_a));
        REQUIRE(SampleSet::from_text(a.text()) == a);

        const PixelRect window{below(random, 3), below(random, 3), 1 + below(random, 5),
                               1 + below(random, 5)};
        std::uint64_t least = UINT64_MAX;
        std::uint64_t most = 0;
        for (int y = window.y; y < window.y + window.height; ++y) {
            for (int x = window.x; x < window.x + window.width; ++x) {
                const auto count = static_cast<std::uint64_t>(
                    std::count_if(in_a.begin(), in_a.end(), [&, px = x, py = y](const Single& single) {
                        return std::get<0>(single) == px && std::get<1>(single) == py;
                    }));
                least = std::min(least, count);
                most = std::max(most, count);
            }
        }
        const SampleSet::Range range = a.samples_per_pixel(window);
        REQUIRE(range.least == least);
        REQUIRE(range.most == most);
    }
}

TEST_CASE("the text of a set of samples", "[unit][sample_set]")
{
    const std::vector<SampleBlock> blocks = {{{0, 0, 64, 48}, 0, 16}, {{64, 0, 32, 48}, 0, 8}};
    CHECK(SampleSet(blocks).text() == "0,0,64,48:0-16 64,0,32,48:0-8");
    CHECK(SampleSet().text().empty());
    CHECK(SampleSet::from_text("") == SampleSet());
    for (const char* wrong : {"0,0,64,48", "0,0,64,48:0", "0,0,64,48:16-0", "0,0,64,48:0-16x",
                              "-1,0,64,48:0-16", " 0,0,1,1:0-1", "0,0,0,48:0-16", "0,0,70000,48:0-16",
                              "0,0,64,48:0-99999999999", "0,0,64,48:0-99999999999999999999"})
        CHECK_FALSE(SampleSet::from_text(wrong));
}

TEST_CASE("sets of scattered blocks take the time and the memory of their blocks", "[unit][sample_set]")
{
    // 60,000 single pixels, no two in one row or column: a grid through all of them has 3.6e9 cells.
    std::string scattered;
    for (int i = 0; i < 60000; ++i)
        scattered += fmt::format("{}{},{},1,1:0-4", i == 0 ? "" : " ", i * 7 % 60000, i);
    const auto set = SampleSet::from_text(scattered);
    REQUIRE(set);
    CHECK(set->blocks().size() == 60000);
    CHECK(set->text() == scattered);
    const PixelRect window{0, 0, 60000, 60000};
    CHECK((SampleSet(SampleBlock{window, 0, 4}) - *set).count() == (60000ull * 60000 - 60000) * 4);
    CHECK(set->samples_per_pixel(window).least == 0);
    CHECK(set->samples_per_pixel(window).most == 4);
}

TEST_CASE("blocks that cut each other into too many pieces are no set", "[unit][sample_set]")
{
    // Strips across strips, each with other samples: 16 million pieces of 8,000 blocks.
    std::string crossing;
    for (int i = 0; i < 4000; ++i)
        crossing += fmt::format("{0},0,1,60000:{1}-{2} 0,{0},60000,1:{3}-{4} ", 2 * i, 4 * i, 4 * i + 1,
                                4 * i + 2, 4 * i + 3);
    crossing.pop_back();
    CHECK_FALSE(SampleSet::from_text(crossing));
    // As many blocks on one pixel, each with other samples, are no more than as many.
    std::string one_pixel;
    for (int i = 0; i < 60000; ++i)
        one_pixel += fmt::format("{}0,0,1,1:{}-{}", i == 0 ? "" : " ", 2 * i, 2 * i + 1);
    const auto set = SampleSet::from_text(one_pixel);
    REQUIRE(set);
    CHECK(set->count() == 60000);
    CHECK(set->text() == one_pixel);
}

TEST_CASE("parts are disjoint, complete and of about one size", "[unit][sample_set]")
{
    const PixelRect window =
        GENERATE(PixelRect{0, 0, 768, 576}, PixelRect{5, 7, 100, 300}, PixelRect{0, 0, 9000, 4000});
    const PartBy by = GENERATE(PartBy::tiles, PartBy::samples);
    for (const std::uint64_t count : {1, 2, 3, 7, 8, 12, 40}) {
        SampleSet all;
        std::uint64_t sum = 0;
        std::uint64_t largest = 0;
        for (std::uint64_t index = 0; index < count; ++index) {
            const SampleSet part = part_of(window, 840, by, index, count);
            sum += part.count();
            largest = std::max(largest, part.count());
            all = all | part;
        }
        const SampleBlock whole{window, 0, 840};
        CHECK(all == SampleSet(whole));
        CHECK(sum == whole.count());
        if (window.width > 700) CHECK(double(largest) < 1.15 * double(sum) / double(count));
    }
}
