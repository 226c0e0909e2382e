// SPDX-License-Identifier: MIT

// Two tests of each shift; q0 is the sum of the squared differences in a square without it, q1 with it.
//
// If A is in its place, noise alone gives q0 and q1 the same distribution, and what there is to see makes q1 larger. So
// (q0 - q1) / (q0 + q1), which no outlier can carry beyond 1, has an expectation of at most 0, and its mean over the
// squares is tested.
//
// Where few squares have an edge, noise hides that. If A is in its place, an edge makes q1 as large as the sum q2 with
// the opposite shift: what one square lacks, its neighbour has. So (q2 - q1) / (q2 + q1) has an expectation near 0, and
// its mean is tested, too. It is not quite 0 where brightness curves, which the noise hides unless it is much smaller
// than what there is to see; but then q0 is smaller than q1. So a shift counts only if the mean of the first is above 0.

#include "compare/shift_test.h"

#include "compare/shifted.h"
#include "compare/squares.h"
#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"

namespace plumb {

namespace {

constexpr int square_side = 16;
constexpr int opposite_side = 8; // of the squares that are compared with the opposite shift
constexpr std::uint64_t least_gains = 12;
// The two averages of half a pixel's shift keep 0.313 and 0.318 of the noise's variance.
constexpr double margin = 0.02;

// A's shift in half pixels.
struct Step {
    int x;
    int y;
};

std::vector<Step> steps()
{
    std::vector<Step> result;
    for (const int length : {2, 1})
        for (int y = -length; y <= length; y += length)
            for (int x = -length; x <= length; x += length)
                if (x != 0 || y != 0) result.push_back({x, y});
    return result;
}

std::vector<double> squared_differences(const ImagePair& pair, const Squares& squares)
{
    std::vector<double> sums(squares.count(), 0.0);
    const std::size_t channels = pair.a.channels.size();
    std::size_t i = 0;
    for (int y = 0; y < pair.a.window.height; ++y) {
        for (int x = 0; x < pair.a.window.width; ++x) {
            for (std::size_t c = 0; c < channels; ++c, ++i) {
                const double d =
                    static_cast<double>(pair.a.values[i]) - static_cast<double>(pair.b.values[i]);
                if (std::isfinite(d)) sums[squares.index(x, y)] += d * d;
            }
        }
    }
    return sums;
}

// Of (q - r) / (q + r) - less over the squares.
struct Gain {
    double mean = 0.0;
    double p = 1.0; // of such a mean or a larger one, if the expectation is 0
};

// Nothing: too few squares.
std::optional<Gain> gain(const std::vector<double>& q, const std::vector<double>& r, double less)
{
    MeanAndVariance gains;
    for (std::size_t i = 0; i < q.size(); ++i)
        if (q[i] + r[i] > 0.0) gains.add((q[i] - r[i]) / (q[i] + r[i]) - less);
    if (gains.count() < least_gains) return {};
    if (!(gains.mean() > 0.0)) return Gain{gains.mean(), 1.0};
    const double t = gains.mean() / std::max(gains.standard_error(), 1e-9);
    return Gain{gains.mean(), 0.5 * student_t_two_sided(t, static_cast<double>(gains.count() - 1))};
}

struct Candidate {
    Step step;
    double gain = 0.0; // over no shift
    double p = 1.0;
};

// Half of the shift that A has fits better than none, too: of those that are beyond doubt, the one with the largest gain.
std::optional<Alignment> best_of(const std::vector<Candidate>& candidates, int tried)
{
    constexpr double beyond_doubt = 1e-6;
    const Candidate* best = nullptr;
    double p = 1.0;
    for (const Candidate& one : candidates) {
        const bool is_better = !best                    ? true
                               : one.p > beyond_doubt   ? one.p < best->p
                               : best->p > beyond_doubt ? true
                                                        : one.gain > best->gain;
        if (is_better) best = &one;
        p = std::min(p, one.p);
    }
    if (!best) return {};
    return Alignment{shift_text(best->step.x, best->step.y), std::min(1.0, 2.0 * tried * p), tried};
}

} // namespace

std::optional<Alignment> test_shifts(const ComparedImage& a, const ComparedImage& b)
{
    const Squares squares(square_side, a.window);
    const Squares small_squares(opposite_side, a.window);
    std::vector<Candidate> candidates;
    int tried = 0;
    for (const Step step : steps()) {
        const ImagePair shifted = shift(a, b, step.x, step.y);
        const std::optional<Gain> over_none =
            gain(squared_differences(unshifted(a, b, step.x, step.y), squares),
                 squared_differences(shifted, squares), margin);
        ++tried;
        if (!over_none || !(over_none->mean > 0.0)) continue;
        const std::optional<Gain> over_opposite =
            gain(squared_differences(shift(a, b, -step.x, -step.y), small_squares),
                 squared_differences(shifted, small_squares), 0.0);
        candidates.push_back(
            {step, over_none->mean, std::min(over_none->p, over_opposite ? over_opposite->p : 1.0)});
    }
    return best_of(candidates, tried);
}

} // namespace plumb
