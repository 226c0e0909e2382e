// SPDX-License-Identifier: MIT

// Cells of an environment's map: all, and views of some.

#include "emitters/sky_cells.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/statistics.h"

#include <limits>
#include <vector>

using namespace plumb;
using test::TestRandom;

namespace {

struct Map {
    std::size_t columns;
    std::size_t rows;
};
constexpr Map maps[] = {{1, 1}, {1, 9}, {7, 1}, {12, 5}, {64, 32}, {700, 3}};

// Some cells, rows and columns are black: the last row too.
SkyCells cells_of(const Map& map, TestRandom& random)
{
    SkyCells cells;
    const double dark = random.next_double() * 0.9;
    std::vector<bool> is_dark;
    for (std::size_t i = 0; i < map.columns; ++i) is_dark.push_back(random.next_double() < 0.3);
    for (std::size_t j = 0; j < map.rows; ++j) {
        std::vector<double> row;
        const bool is_black = map.rows > 1 && (j + 1 == map.rows || random.next_double() < 0.2);
        for (std::size_t i = 0; i < map.columns; ++i) {
            const double light = std::exp(8.0 * random.next_double());
            const bool is_lit = !is_black && !is_dark[i] && random.next_double() >= dark;
            row.push_back(is_lit ? light : 0.0);
        }
        if (j == 0) row[map.columns / 2] = 1.0; // there is light
        cells.add_row(row, 0.5 + random.next_double());
    }
    cells.complete();
    return cells;
}

SkyRectangle rectangle(TestRandom& random)
{
    const float size = random.next_1d() < 0.3f ? 0.01f : random.next_1d();
    const float top = random.next_1d();
    return {random.next_1d(), std::min(size + 0.001f, 1.f), top,
            std::min(top + size * random.next_1d(), 1.f)};
}

} // namespace

TEST_CASE("a view has the cells around its rectangle, and of the light what these have", "[unit][sky]")
{
    TestRandom random(1);
    int narrow = 0, wraps = 0;
    for (int i = 0; i < 600; ++i) {
        const Map map = maps[i % std::size(maps)];
        const SkyCells cells = cells_of(map, random);
        const SkyRectangle wanted = rectangle(random);
        const SkyView view = cells.view(wanted);
        CAPTURE(map.columns, map.rows, wanted.left, wanted.width, wanted.top, wanted.bottom);
        double sum = 0.0;
        for (std::size_t row = 0; row < map.rows; ++row)
            for (std::size_t column = 0; column < map.columns; ++column)
                if (view.is_whole() || cells.shows(view, column, row))
                    sum += static_cast<double>(cells.probability(column, row));
        CHECK(view.share == Approx(sum).epsilon(1e-5).margin(1e-7));
        if (view.is_whole()) continue;
        narrow += sum < 0.5 ? 1 : 0;
        wraps += wanted.left + wanted.width > 1.f ? 1 : 0;
        for (int k = 0; k < 20; ++k) {
            const float x = wanted.left + wanted.width * random.next_1d();
            const float y = wanted.top + (wanted.bottom - wanted.top) * random.next_1d();
            const auto cell = [](float place, std::size_t count) {
                return std::min(static_cast<std::size_t>(place * static_cast<float>(count)), count - 1);
            };
            CHECK(cells.shows(view, cell(x - std::floor(x), map.columns), cell(y, map.rows)));
        }
    }
    CHECK(narrow > 100);
    CHECK(wraps > 100);
}

TEST_CASE("samples of a view are in it, by their light", "[unit][sky]")
{
    TestRandom random(2);
    for (int i = 0; i < 60; ++i) {
        const Map map = maps[i % std::size(maps)];
        const SkyCells cells = cells_of(map, random);
        const SkyView view = cells.view(rectangle(random));
        if (view.is_whole()) continue;
        CAPTURE(i, map.columns, map.rows, view.left, view.right, view.top, view.bottom);
        // Strata, so that few samples tell much; and the corners.
        constexpr int side = 100;
        std::vector<double> counts(map.columns * map.rows);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const SkyCells::Choice choice =
                    cells.sample(view, (x + random.next_double()) / side, (y + random.next_double()) / side);
                REQUIRE(cells.shows(view, choice.column, choice.row));
                CHECK((choice.across >= 0.0 && choice.across < 1.0));
                CHECK((choice.down >= 0.0 && choice.down < 1.0));
                counts[choice.row * map.columns + choice.column] += 1.0 / (side * side);
            }
        double worst = 0.0;
        for (std::size_t row = 0; row < map.rows; ++row)
            for (std::size_t column = 0; column < map.columns; ++column) {
                const bool is_shown = cells.shows(view, column, row);
                const double expected =
                    is_shown ? static_cast<double>(cells.probability(column, row)) / view.share : 0.0;
                worst = std::max(worst, std::abs(counts[row * map.columns + column] - expected));
            }
        CHECK(worst < 0.03); // a stratum on each side of a cell's border, along a column of strata
        constexpr double largest = 0x1.fffffffffffffp-1;
        for (const double across : {0.0, largest})
            for (const double down : {0.0, largest}) {
                const SkyCells::Choice choice = cells.sample(view, across, down);
                CHECK(cells.probability(choice.column, choice.row) > 0.f);
                CHECK(cells.shows(view, choice.column, choice.row));
            }
    }
}

TEST_CASE("a view of any rectangle is one, whatever its numbers", "[unit][sky]")
{
    TestRandom random(3);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Map& map : maps) {
        const SkyCells cells = cells_of(map, random);
        for (const float a : {nan, 0.f, 1.f, 0.5f})
            for (const float b : {nan, 0.f, 1.f, 1e-30f}) {
                const SkyView view = cells.view({a, b, b, a});
                if (view.is_whole()) continue;
                const SkyCells::Choice choice =
                    cells.sample(view, random.next_double(), random.next_double());
                CHECK(cells.shows(view, choice.column, choice.row));
                CHECK(view.share > 0.0);
            }
    }
}

TEST_CASE("a view without light is the whole map", "[unit][sky]")
{
    SkyCells cells;
    for (int row = 0; row < 4; ++row) {
        std::vector<double> light(4);
        if (row == 1) light[2] = 1.0;
        cells.add_row(light, 1.0);
    }
    cells.complete();
    CHECK(cells.view({0.f, 0.25f, 0.f, 1.f}).is_whole());
    CHECK(cells.view({0.f, 1.f, 0.6f, 1.f}).is_whole());
    CHECK_FALSE(cells.view({0.6f, 0.1f, 0.3f, 0.4f}).is_whole());
    CHECK(cells.view({0.6f, 0.1f, 0.3f, 0.4f}).share == Approx(1.0));
}
