// SPDX-License-Identifier: MIT

#include "render/tiles.h"
#include "support/catch.h"

#include <map>

using namespace plumb;

TEST_CASE("tiles cover a window exactly once", "[unit][tiles]")
{
    const PixelRect window =
        GENERATE(PixelRect{0, 0, 100, 70}, PixelRect{5, 7, 1, 1}, PixelRect{3, 0, 64, 33});
    const int size = GENERATE(1, 16, 32, 1000);
    std::map<std::pair<int, int>, int> covered;
    for (const PixelRect& tile : cut_into_tiles(window, size)) {
        REQUIRE(tile.width <= size);
        REQUIRE(tile.height <= size);
        for (int y = tile.y; y < tile.y + tile.height; ++y)
            for (int x = tile.x; x < tile.x + tile.width; ++x) ++covered[{x, y}];
    }
    REQUIRE(covered.size() ==
            static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    for (const auto& [pixel, times] : covered) {
        REQUIRE(times == 1);
        REQUIRE((pixel.first >= window.x && pixel.first < window.x + window.width));
        REQUIRE((pixel.second >= window.y && pixel.second < window.y + window.height));
    }
}
