// SPDX-License-Identifier: MIT
#include "render/pixel_cover.h"
#include "support/catch.h"
#include "support/random.h"

using namespace plumb;

TEST_CASE("a cover has the pixels of its rectangles", "[unit][outlines]")
{
    test::TestRandom random(1);
    const auto below = [&](int end) { return static_cast<int>(random.next_1d() * static_cast<float>(end)); };
    for (int i = 0; i < 50; ++i) {
        const PixelRect window{-3 + below(6), 2 - below(5), 1 + below(20), 1 + below(20)};
        PixelCover cover(window);
        CHECK(cover.empty());
        std::vector<bool> expected(pixel_count(window));
        for (int k = below(12); k > 0; --k) {
            const int x = below(window.width + 1), y = below(window.height + 1);
            const PixelRect part{window.x + x, window.y + y, below(window.width - x + 1),
                                 below(window.height - y + 1)};
            cover.add(part);
            for (int row = part.y; row < part.y + part.height; ++row)
                for (int column = part.x; column < part.x + part.width; ++column)
                    expected[index_in(window, {column, row})] = true;
        }
        CHECK(cover.covered() == expected);
    }
}
