// SPDX-License-Identifier: MIT

// A polygon loses ears until nothing is left: [1], [2]. When an ear is cut, what is left of the polygon lies in what
// there was, so that no other corner but its two neighbours can become an ear: each corner is tested when the polygon
// is whole, and again when it has lost a neighbour. What could lie in an ear is found in a tree of the corners that are
// not convex [3].
//
// Boundaries may touch themselves: an ear may have corners on its border if no edge goes from them into it.
//
// [1] Meisters 1975, "Polygons Have Ears", The American Mathematical Monthly 82(6).
// [2] O'Rourke 1998, "Computational Geometry in C", 2nd ed., section 1.4 and 1.6.
// [3] Held 2001, "FIST: Fast Industrial-Strength Triangulation of Polygons", Algorithmica 30(4).
//     https://doi.org/10.1007/s00453-001-0028-4

#include "shapes/obj/polygon_ears.h"

#include "shapes/obj/point_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <optional>

namespace plumb {

namespace {

class EarCutter {
public:
    // tolerance: distances up to which a point counts as on a line; 0: exactly.
    EarCutter(std::span<const PlanePoint> points, double tolerance)
        : points_(points),
          tolerance_(tolerance),
          count_(static_cast<std::uint32_t>(points.size())),
          before_(count_),
          after_(count_),
          is_left_(count_, true),
          is_waiting_(count_, false)
    {
        for (std::uint32_t i = 0; i < count_; ++i) {
            before_[i] = (i + count_ - 1) % count_;
            after_[i] = (i + 1) % count_;
        }
    }

    PolygonCut run()
    {
        std::vector<std::uint32_t> not_convex;
        for (std::uint32_t i = 0; i < count_; ++i)
            if (sign_at(i) <= 0) not_convex.push_back(i);
        PointTree tree(points_, std::move(not_convex));
        std::uint32_t left = count_;
        const auto cut = [&](std::uint32_t i) {
            result_.triangles.push_back({before_[i], i, after_[i]});
            tree.remove(i);
            unlink(i);
            --left;
        };

        wait_for_all();
        while (left > 3) {
            if (tree.steps() > most_steps()) takes_any_ = true;
            if (const auto spike = next_spike()) {
                cut(*spike);
            } else if (const auto corner = next_waiting()) {
                if (can_be_cut(*corner, tree)) cut(*corner);
            } else if (!cuts_touch_) {
                cuts_touch_ = true;
                wait_for_all();
            } else if (const auto flat = next_flat()) {
                cut(*flat);
            } else if (!takes_any_) {
                takes_any_ = true; // the boundary crosses itself
                wait_for_all();
            } else {
                break;
            }
        }
        cut_rest();
        result_.steps = tree.steps();
        return std::move(result_);
    }

private:
    // Times that only polygons made for it take; they are cut in some way.
    std::uint64_t most_steps() const
    {
        return 256 * static_cast<std::uint64_t>(count_) * static_cast<std::uint64_t>(std::bit_width(count_));
    }

    int sign_at(std::uint32_t i) const
    {
        return turn_sign(points_[before_[i]], points_[i], points_[after_[i]]);
    }

    // Whether the boundary comes to corner i and goes back the same way.
    bool is_spike(std::uint32_t i) const
    {
        if (sign_at(i) != 0) return false;
        const PlanePoint& a = points_[before_[i]];
        const PlanePoint& b = points_[i];
        const PlanePoint& c = points_[after_[i]];
        return (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y) >= 0.0; // also where two are equal
    }

    bool can_be_cut(std::uint32_t i, PointTree& tree)
    {
        const int sign = sign_at(i);
        if (sign < 0) return false;
        if (takes_any_) return true;
        if (sign > 0) return is_ear(i, tree);
        flat_.push_back(i); // later, and only if it must be: neighbouring faces may have this corner, too
        return false;
    }

    bool is_ear(std::uint32_t i, PointTree& tree) const
    {
        const PlaneTriangle ear = {points_[before_[i]], points_[i], points_[after_[i]]};
        return !tree.any_in(ear, tolerance_, [&](std::uint32_t other) {
            return other != i && other != before_[i] && other != after_[i] && blocks(other, ear);
        });
    }

    // On which side of a b the point lies.
    int side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) const
    {
        if (tolerance_ == 0.0) return turn_sign(a, b, p);
        const double distance = turn(a, b, p);
        if (std::abs(distance) <= tolerance_ * std::hypot(b.x - a.x, b.y - a.y)) return 0;
        return distance > 0.0 ? 1 : -1;
    }

    // Whether a corner lies inside the ear, or on its border with an edge that goes inside.
    bool blocks(std::uint32_t corner, const PlaneTriangle& ear) const
    {
        std::array<bool, 3> touches{}; // the edge from ear[k] on
        const auto same =
            static_cast<std::size_t>(std::find(ear.begin(), ear.end(), points_[corner]) - ear.begin());
        if (same < 3) {
            touches[same] = touches[(same + 2) % 3] = true;
        } else {
            for (std::size_t k = 0; k < 3; ++k) {
                const int s = side(ear[k], ear[(k + 1) % 3], points_[corner]);
                if (s < 0) return false;
                touches[k] = s == 0;
            }
        }
        if (!touches[0] && !touches[1] && !touches[2]) return true;
        // On the cut: neighbouring faces that have this corner would not fit the ear exactly.
        if (touches[2] && same == 3 && !cuts_touch_) return true;
        const auto goes_inside = [&](const PlanePoint& to) {
            for (std::size_t k = 0; k < 3; ++k)
                if (touches[k] && side(ear[k], ear[(k + 1) % 3], to) <= 0) return false;
            return true;
        };
        return goes_inside(points_[before_[corner]]) || goes_inside(points_[after_[corner]]);
    }

    void unlink(std::uint32_t i)
    {
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        is_left_[i] = false;
        wait(before_[i]);
        wait(after_[i]);
    }

    // Spikes go first. They have no area, and what runs there and back again would seem to have an ear at every bend.
    void wait(std::uint32_t i)
    {
        if (is_spike(i)) spikes_.push_back(i);
        if (is_waiting_[i]) return;
        is_waiting_[i] = true;
        waiting_.push_back(i);
    }

    void wait_for_all()
    {
        for (std::uint32_t i = 0; i < count_; ++i)
            if (is_left_[i]) wait(i);
    }

    // First come, first served: all round the polygon rather than a fan of slivers.
    std::optional<std::uint32_t> next_waiting()
    {
        while (!waiting_.empty()) {
            const std::uint32_t i = waiting_.front();
            waiting_.pop_front();
            is_waiting_[i] = false;
            if (is_left_[i]) return i;
        }
        return std::nullopt;
    }

    std::optional<std::uint32_t> next_spike()
    {
        while (!spikes_.empty()) {
            const std::uint32_t i = spikes_.back();
            spikes_.pop_back();
            if (is_left_[i] && is_spike(i)) return i;
        }
        return std::nullopt;
    }

    // A corner between two others on a line, when there is nothing else to cut.
    std::optional<std::uint32_t> next_flat()
    {
        while (!flat_.empty()) {
            const std::uint32_t i = flat_.back();
            flat_.pop_back();
            if (is_left_[i] && sign_at(i) == 0) return i;
        }
        return std::nullopt;
    }

    void cut_rest()
    {
        const auto first =
            static_cast<std::uint32_t>(std::find(is_left_.begin(), is_left_.end(), true) - is_left_.begin());
        for (std::uint32_t i = after_[first]; after_[i] != first; i = after_[i])
            result_.triangles.push_back({first, i, after_[i]});
    }

    std::span<const PlanePoint> points_;
    double tolerance_;
    std::uint32_t count_;
    std::vector<std::uint32_t> before_; // the corners of what is left of the polygon, round and round
    std::vector<std::uint32_t> after_;
    std::vector<bool> is_left_;
    std::vector<bool> is_waiting_;
    std::deque<std::uint32_t> waiting_; // to be tested
    std::vector<std::uint32_t> spikes_;
    std::vector<std::uint32_t> flat_;
    bool cuts_touch_ = false; // corners between their ends, since there were no other ears
    bool takes_any_ = false;  // whatever lies in it
    PolygonCut result_;
};

// Up to which distance points that were on a line may be off it, after their coordinates were rounded to floats.
double rounding_distance(std::span<const PlanePoint> points)
{
    double largest = 0.0;
    for (const PlanePoint& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    return largest * 0x1p-21;
}

} // namespace

double folded_area(std::span<const PlanePoint> polygon, std::span<const PolygonTriangle> triangles)
{
    double sum = 0.0;
    for (const PolygonTriangle& t : triangles)
        sum += std::max(-0.5 * turn(polygon[t[0]], polygon[t[1]], polygon[t[2]]), 0.0);
    return sum;
}

PolygonCut cut_polygon(std::span<const PlanePoint> polygon)
{
    PolygonCut exact = EarCutter(polygon, 0.0).run();
    const double folded = folded_area(polygon, exact.triangles);
    if (folded == 0.0) return exact;
    // Where boundaries touch, rounded corners may be on the wrong side.
    PolygonCut tolerant = EarCutter(polygon, rounding_distance(polygon)).run();
    tolerant.steps += exact.steps;
    if (folded_area(polygon, tolerant.triangles) < folded) return tolerant;
    exact.steps = tolerant.steps;
    return exact;
}

} // namespace plumb
