// SPDX-License-Identifier: MIT

// In each square, q0 and q1 are the sums of the squared differences without the shift and with it. If A is in its place,
// noise alone gives both the same distribution, and what there is to see makes q1 larger. So (q0 - q1) / (q0 + q1),
// which no outlier can carry beyond 1, has an expectation of at most 0, and its mean over the squares is tested.

#include "compare/shift_test.h"

#include "compare/shifted.h"
#include "compare/squares.h"
#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"

namespace plumb {

namespace {

constexpr int square_side = 16;
constexpr std::uint64_t least_squares = 12;
// The two averages of half a pixel's shift keep 0.313 and 0.318 of the noise's variance.
constexpr double margin = 0.02;

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

} // namespace

std::optional<Alignment> test_shifts(const ComparedImage& a, const ComparedImage& b)
{
    const Squares squares(square_side, a.window);
    std::optional<Alignment> best;
    int tried = 0;
    for (const int step : {2, 1}) {
        for (int y = -step; y <= step; y += step) {
            for (int x = -step; x <= step; x += step) {
                if (x == 0 && y == 0) continue;
                const std::vector<double> without = squared_differences(unshifted(a, b, x, y), squares);
                const std::vector<double> with = squared_differences(shift(a, b, x, y), squares);
                MeanAndVariance gains;
                for (std::size_t i = 0; i < with.size(); ++i)
                    if (without[i] + with[i] > 0.0)
                        gains.add((without[i] - with[i]) / (without[i] + with[i]) - margin);
                ++tried;
                if (gains.count() < least_squares || !(gains.mean() > 0.0)) continue;
                const double t = gains.mean() / std::max(gains.standard_error(), 1e-9);
                const double p = 0.5 * student_t_two_sided(t, static_cast<double>(gains.count() - 1));
                if (!best || p < best->p) best = Alignment{shift_text(x, y), p, 0};
            }
        }
    }
    if (best) {
        best->tried = tried;
        best->p = std::min(1.0, best->p * tried);
    }
    return best;
}

} // namespace plumb
