// SPDX-License-Identifier: MIT

#include "integrators/cell_tree.h"
#include "support/catch.h"
#include "support/random.h"

#include <algorithm>
#include <set>

using namespace plumb;

namespace {

// On a line, on a plane, in space, all the same, in two places.
std::vector<Vec3f> points_of(int kind, std::size_t count, test::TestRandom& random)
{
    std::vector<Vec3f> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3f p(random.next_1d(), random.next_1d(), random.next_1d());
        switch (kind) {
        case 0: points.emplace_back(p.x, 2.f, -3.f); break;
        case 1: points.emplace_back(p.x, 0.f, p.z); break;
        case 2: points.push_back(p * std::exp2(20.f * random.next_1d() - 10.f)); break;
        case 3: points.emplace_back(1.f, 2.f, 3.f); break;
        default: points.emplace_back(i % 3 == 0 ? 1.f : 2.f, 0.f, 0.f);
        }
    }
    return points;
}

} // namespace

TEST_CASE("the cells of a tree have all points, each few", "[unit][cell_tree]")
{
    test::TestRandom random(1);
    for (int kind = 0; kind < 5; ++kind) {
        for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 1000u}) {
            CAPTURE(kind, count);
            const std::vector<Vec3f> points = points_of(kind, count, random);
            CellTree::Members members;
            const CellTree tree(points, 8, members);
            std::set<std::uint32_t> seen;
            for (std::size_t node = 0; node < tree.nodes(); ++node) {
                const auto mine = members.of(node);
                if (!tree.is_leaf(node)) {
                    CHECK(tree.first_child(node) > node);
                    CHECK(mine.size() > 8);
                    continue;
                }
                CHECK(mine.size() <= 8);
                CHECK(std::is_sorted(mine.begin(), mine.end()));
                seen.insert(mine.begin(), mine.end());
                // Points in one place may be in several cells, of which any is found.
                if (kind < 3)
                    for (const std::uint32_t i : mine) REQUIRE(tree.leaf_at(points[i]) == node);
            }
            CHECK(seen.size() == count);
            // A place is in the leaf to which it goes at each node.
            for (int i = 0; i < 200; ++i) {
                const Vec3f place = random.direction() * std::exp2(30.f * random.next_1d() - 15.f);
                const std::size_t found = tree.leaf_at(place);
                CHECK(tree.is_leaf(found));
                std::size_t node = 0;
                while (!tree.is_leaf(node))
                    node = tree.first_child(node) + (tree.is_first_of(node, place) ? 0 : 1);
                CHECK(found == node);
            }
        }
    }
}
