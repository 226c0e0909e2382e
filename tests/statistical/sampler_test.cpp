// SPDX-License-Identifier: MIT

#include "plumb/model/sampler.h"
#include "plumb/statistics/mean_and_variance.h"
#include "samplers/stream.h"
#include "scene_file/catalog.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <vector>

using namespace plumb;
using test::ParamsBuilder;

namespace {

constexpr const char* stream = "stream";

std::unique_ptr<Sampler> make_sampler(const std::string& type, std::uint64_t total = max_samples_per_pixel)
{
    if (type == stream) return StreamSampler(1).clone(total);
    return ParamsBuilder("sampler", type).build_type(sampler_types())->clone(total);
}

// Of the catalog, and the one that paths use which branch off.
std::vector<std::string> all_samplers()
{
    std::vector<std::string> names{stream};
    for (const Entry<Sampler>& entry : sampler_types()) names.emplace_back(entry.name);
    return names;
}

// Numbers of the camera and of two vertices.
std::vector<double> draw(Sampler& sampler, std::uint64_t seed, Vec2i pixel, std::uint64_t index,
                         int count = 12)
{
    sampler.start(seed, pixel, index);
    std::vector<double> numbers;
    for (int vertex = -1; vertex < 2; ++vertex) {
        if (vertex >= 0) sampler.start_vertex(vertex);
        for (int i = 0; i < count; ++i)
            numbers.push_back(i % 3 == 0   ? sampler.next_choice()
                              : i % 3 == 1 ? static_cast<double>(sampler.next_1d())
                                           : static_cast<double>(sampler.next_2d().y));
    }
    return numbers;
}

// On a grid of 16 x 16 cells.
class CellCounts {
public:
    void add(double x, double y)
    {
        ++cells_[static_cast<std::size_t>(x * 16.0) * 16 + static_cast<std::size_t>(y * 16.0)];
        ++samples_;
    }
    double chi2() const
    {
        const double expected = samples_ / 256.0;
        double statistic = 0.0;
        for (const double count : cells_) statistic += sqr(count - expected) / expected;
        return statistic;
    }
    test::Outcome outcome() const
    {
        return {test::chi2_survival(chi2(), 255), "chi2 " + std::to_string(chi2())};
    }

private:
    std::vector<double> cells_ = std::vector<double>(256, 0.0);
    double samples_ = 0.0;
};

} // namespace

TEST_CASE("a sample's numbers depend on seed, pixel and index alone", "[statistical][sampler]")
{
    const std::string type = GENERATE(from_range(all_samplers()));
    INFO(type);
    const auto sampler = make_sampler(type);
    // All 64 bits of an index count, unless there can be no such indices.
    const std::uint64_t large = sampler->depends_on_total() ? (1 << 25) + 3 : (std::uint64_t{1} << 40) + 3;
    const std::vector<double> first = draw(*sampler, 1, {10, 20}, large);

    draw(*sampler, 5, {1, 2}, 3, 7); // whatever was drawn before
    CHECK(draw(*sampler, 1, {10, 20}, large) == first);
    CHECK(draw(*sampler->clone(max_samples_per_pixel), 1, {10, 20}, large) == first);

    CHECK(draw(*sampler, 2, {10, 20}, large) != first);
    CHECK(draw(*sampler, 1 + (std::uint64_t{1} << 32), {10, 20}, large) != first);
    CHECK(draw(*sampler, 1, {20, 10}, large) != first);
    CHECK(draw(*sampler, 1, {10, 20}, 3) != first);
    CHECK(draw(*sampler, 1, {10, 20}, large + 1) != first);
    CHECK((draw(*sampler->clone(1 << 26 >> 1), 1, {10, 20}, 3) != draw(*sampler, 1, {10, 20}, 3)) ==
          sampler->depends_on_total());
}

TEST_CASE("the numbers of a vertex do not depend on what was drawn before it", "[statistical][sampler]")
{
    const std::string type = GENERATE(as<std::string>{}, "sobol", "stratified");
    INFO(type);
    const auto sampler = make_sampler(type);
    const auto draw_vertex = [&](int numbers_before, int single_numbers) {
        sampler->start(3, {4, 5}, 6);
        sampler->start_vertex(0);
        for (int i = 0; i < numbers_before; ++i) sampler->next_1d();
        sampler->start_vertex(1);
        for (int i = 0; i < single_numbers; ++i) sampler->next_1d();
        const Vec2f first = sampler->next_2d();
        const Vec2f second = sampler->next_2d();
        return std::vector<float>{first.x, first.y, second.x, second.y};
    };
    const std::vector<float> pairs = draw_vertex(0, 0);
    CHECK(draw_vertex(11, 0) == pairs);
    CHECK(draw_vertex(3, 3) == pairs); // nor a pair on single numbers
    CHECK(std::set<float>(pairs.begin(), pairs.end()).size() == 4);
}

TEST_CASE("the independent sampler is Philox4x32-10", "[statistical][sampler]")
{
    // The all-zero vector of the authors' known-answer tests (Random123): 6627e8d5 e169c58d bc57ac4c 9b00dbd8. A block
    // holds the first words of eight counters, then their second words, and so on.
    const auto sampler = make_sampler("independent");
    sampler->start(0, {0, 0}, 0);
    for (const std::uint32_t word : {0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}) {
        CHECK(sampler->next_1d() == static_cast<float>(word >> 8) * 0x1p-24f);
        for (int other = 1; other < 8; ++other) sampler->next_1d();
    }
}

TEST_CASE("neighbouring samples are independent and uniform", "[statistical][sampler]")
{
    // Pairs (a number of one sample, the same of its neighbour) on a 16 x 16 grid: chi-square against uniform.
    enum Neighbour { dimension, pixel_across, seed, vertex, index };
    struct Case {
        const char* type;
        std::vector<Neighbour> neighbours; // `index` last: for samples of a pixel that are independent
    };
    const Case one = GENERATE(Case{"independent", {dimension, pixel_across, seed, index}},
                              Case{stream, {dimension, pixel_across, seed, index}},
                              Case{"sobol", {dimension, pixel_across, seed, vertex}},
                              Case{"stratified", {dimension, pixel_across, seed, vertex}});
    constexpr std::size_t tests = 16;
    for (const Neighbour neighbour : one.neighbours) {
        const bool passed = test::check_statistic(
            std::string(one.type) + ", pairs of neighbour " + std::to_string(neighbour),
            [&](std::uint64_t samples, std::uint64_t first_seed) {
                const auto sampler = make_sampler(one.type);
                CellCounts cells;
                for (std::uint64_t i = 0; i < samples; ++i) {
                    // A pixel's samples are in different runs of the seed, for they may depend on each other.
                    const Vec2i at(2 * static_cast<int>(i % 200), static_cast<int>(i / 200 % 100));
                    const std::uint64_t run = 2 * (i / 20000);
                    const std::uint64_t number = neighbour == index ? run : i % 37;
                    const std::uint64_t this_seed = neighbour == index ? first_seed : first_seed + run;
                    sampler->start(this_seed, at, number);
                    const auto x = static_cast<double>(sampler->next_1d());
                    if (neighbour == index) sampler->start(this_seed, at, number + 1);
                    if (neighbour == pixel_across) sampler->start(this_seed, at + Vec2i(1, 0), number);
                    if (neighbour == seed) sampler->start(this_seed + 1, at, number);
                    if (neighbour == vertex) sampler->start_vertex(0);
                    cells.add(x, static_cast<double>(sampler->next_1d()));
                }
                return cells.outcome();
            },
            100000, test::sidak_level(test::significance, tests), 11);
        CHECK(passed);
    }
}

TEST_CASE("pairs of numbers and numbers for choices are uniform", "[statistical][sampler]")
{
    const std::string type = GENERATE(as<std::string>{}, "sobol", "stratified");
    const bool of_choices = GENERATE(false, true);
    const bool passed = test::check_statistic(
        type,
        [&](std::uint64_t samples, std::uint64_t seed) {
            const auto sampler =
                make_sampler(type, 5); // fewer samples than cells: some of the grid are empty
            CellCounts cells;
            for (std::uint64_t i = 0; i < samples; ++i) {
                sampler->start(seed + i / 60000, {static_cast<int>(i % 60000), 7}, i % 5);
                sampler->start_vertex(2);
                sampler->next_2d();
                const double choice = sampler->next_choice();
                const Vec2f pair = sampler->next_2d();
                if (of_choices) // the leading bits, and those that a float has not
                    cells.add(choice, std::fmod(choice * 0x1p32, 1.0));
                else
                    cells.add(static_cast<double>(pair.x), static_cast<double>(pair.y));
            }
            return cells.outcome();
        },
        100000, test::sidak_level(test::significance, 4), 5);
    CHECK(passed);
}

TEST_CASE("pairs of sobol are nets", "[statistical][sampler]")
{
    // Of 2^m samples from a multiple of 2^m on, each elementary interval of area 2^-m holds one, whatever its shape.
    const int m = GENERATE(1, 4, 7, 10);
    const std::uint64_t first = GENERATE(0, 5) * (std::uint64_t{1} << m);
    const auto sampler = make_sampler("sobol");
    const std::size_t count = std::size_t{1} << m;
    constexpr int pairs =
        8; // two of the camera and of three vertices; the last vertex's are of its second block
    std::vector<std::vector<Vec2f>> points(pairs);
    for (std::uint64_t i = 0; i < count; ++i) {
        sampler->start(17, {300, 4}, first + i);
        for (std::size_t pair = 0; pair < pairs; ++pair) {
            if (pair > 0 && pair % 2 == 0) sampler->start_vertex(static_cast<int>(pair / 2) - 1);
            if (pair == 6)
                for (int other = 0; other < 2; ++other) sampler->next_2d();
            points[pair].push_back(sampler->next_2d());
        }
    }
    for (const std::vector<Vec2f>& set : points) {
        for (int bits = 0; bits <= m; ++bits) {
            const auto columns = static_cast<float>(1 << bits);
            const auto rows = static_cast<float>(1 << (m - bits));
            std::vector<bool> is_taken(count, false);
            for (const Vec2f& p : set) {
                const auto cell = static_cast<std::size_t>(p.x * columns) * static_cast<std::size_t>(rows) +
                                  static_cast<std::size_t>(p.y * rows);
                REQUIRE_FALSE(is_taken[cell]);
                is_taken[cell] = true;
            }
        }
    }
}

TEST_CASE("single numbers of sobol are nets", "[statistical][sampler]")
{
    const auto sampler = make_sampler("sobol");
    std::vector<std::set<int>> intervals(4);
    for (std::uint64_t i = 0; i < 256; ++i) {
        sampler->start(1, {2, 3}, 256 + i);
        sampler->start_vertex(1);
        intervals[0].insert(static_cast<int>(sampler->next_1d() * 256.f));
        intervals[1].insert(static_cast<int>(sampler->next_choice() * 256.0));
        intervals[2].insert(static_cast<int>(sampler->next_1d() * 256.f));
        intervals[3].insert(static_cast<int>(sampler->next_1d() * 256.f)); // of the next block
    }
    for (const std::set<int>& all : intervals) CHECK(all.size() == 256);
}

TEST_CASE("a pixel's numbers of different vertices have nothing to do with each other",
          "[statistical][sampler]")
{
    // Of each pixel, the samples' numbers of one vertex against those of another on a grid of 16 x 16 cells: chi-square
    // of independent points is 255 in the mean, of points that are evenly spread in both numbers a little less. The same
    // order in both would give thousands.
    const std::string type = GENERATE(as<std::string>{}, "sobol", "stratified");
    const bool of_one_vertex = GENERATE(false, true); // then two sets of it
    const bool passed = test::check_statistic(
        type + (of_one_vertex ? ", in one vertex" : ", in two vertices"),
        [&](std::uint64_t pixels, std::uint64_t seed) {
            constexpr std::uint64_t samples = 1024;
            const auto sampler = make_sampler(type, samples);
            MeanAndVariance chi2;
            for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
                CellCounts cells;
                for (std::uint64_t i = 0; i < samples; ++i) {
                    sampler->start(seed, {static_cast<int>(pixel % 60000), static_cast<int>(pixel / 60000)},
                                   i);
                    sampler->start_vertex(0);
                    const auto x = static_cast<double>(sampler->next_2d().x);
                    if (!of_one_vertex) sampler->start_vertex(1);
                    cells.add(x, static_cast<double>(sampler->next_2d().x));
                }
                chi2.add(cells.chi2());
            }
            const double z = (chi2.mean() - 255.0) / chi2.standard_error();
            return test::Outcome{test::normal_survival(z), "mean chi2 " + std::to_string(chi2.mean())};
        },
        200, test::sidak_level(test::significance, 4), 3);
    CHECK(passed);
}

TEST_CASE("stratified has a sample in each stratum", "[statistical][sampler]")
{
    struct Case {
        int total, columns, rows;
    };
    const Case one = GENERATE(Case{1, 1, 1}, Case{16, 4, 4}, Case{64, 8, 8}, Case{128, 11, 12});
    const auto sampler = make_sampler("stratified", static_cast<std::uint64_t>(one.total));
    std::set<int> cells;
    std::set<int> intervals;
    for (int i = 0; i < one.total; ++i) {
        sampler->start(1, {2, 3}, static_cast<std::uint64_t>(i));
        sampler->start_vertex(4);
        const Vec2f p = sampler->next_2d();
        cells.insert(static_cast<int>(p.y * static_cast<float>(one.rows)) * one.columns +
                     static_cast<int>(p.x * static_cast<float>(one.columns)));
        intervals.insert(static_cast<int>(sampler->next_1d() * static_cast<float>(one.total)));
    }
    CHECK(cells.size() == static_cast<std::size_t>(one.total));
    CHECK(intervals.size() == static_cast<std::size_t>(one.total));
}

TEST_CASE("the sets of camera and first two vertices are spread evenly together by sobol",
          "[statistical][sampler]")
{
    // Of 1024 samples from a multiple of 1024 on, each cell of a grid of 4 x 4 x 4 x 4 over two of the six pairs holds four.
    // Of pairs that have nothing to do with each other, a fifth of the cells would.
    const std::uint64_t first = 1024 * GENERATE(0, 3);
    const auto sampler = make_sampler("sobol");
    const auto cell = [](const Vec2f& p) {
        return 4 * static_cast<int>(p.x * 4.f) + static_cast<int>(p.y * 4.f);
    };
    std::vector<std::array<int, 6>> samples;
    for (std::uint64_t i = first; i < first + 1024; ++i) {
        std::array<int, 6>& cells = samples.emplace_back();
        sampler->start(23, {7, 5}, i);
        for (std::size_t pair = 0; pair < cells.size(); ++pair) {
            if (pair > 0 && pair % 2 == 0) sampler->start_vertex(static_cast<int>(pair / 2) - 1);
            cells[pair] = cell(sampler->next_2d());
        }
    }
    for (std::size_t a = 0; a < 6; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            std::vector<int> counts(256, 0);
            for (const auto& cells : samples) ++counts[static_cast<std::size_t>(16 * cells[a] + cells[b])];
            CHECK(std::count(counts.begin(), counts.end(), 4) == 256);
        }
    }
}
