// SPDX-License-Identifier: MIT

// In a square the spread of d gives the error of its sum. A bias that varies inside the square only adds to it. With
// the sum T of n differences, z = d - T / n and e = (sum z^2)^2 / sum z^4 (how many of them carry the spread), T divided
// by its error is Student's t of e / 2 degrees of freedom: heavy tails make e small.
//
// The test that can be trusted least is that of a square where one image has missed rare bright samples: then d is small
// everywhere and has an offset. So the variance is at least that of the surroundings, and at least the other image's
// known variance there, times the ratio of both noises in the whole image; and the error of the smaller mean is scaled
// up to the larger one.
//
// A small error everywhere is in no square alone. Where the differences are independent and their expectation is 0,
// T^2 - sum d^2 = sum of d_i d_j over i != j has the expectation 0 for any distribution, and its variance
// 2 sum of d_i^2 d_j^2 can be estimated likewise. The sum of these over all squares of one size is tested, with weights
// that do not depend on the square's own differences.

#include "compare/paired_test.h"

#include "compare/correlation.h"
#include "compare/paired_sums.h"
#include "compare/region_test.h"
#include "plumb/statistics/statistics.h"

#include <array>

namespace plumb {

namespace {

// Of the chance of a false alarm. The squares have the rest, in equal parts for each size, but for 0.05, which
// verdict.cpp has for shifts.
constexpr double share_of_squares = 0.4;
constexpr double share_of_image = 0.4;
constexpr double share_of_spread = 0.15;
// Found by simulation (tests/statistical/paired_test.cpp).
constexpr double least_effective_pixels = 6.0;
constexpr double largest_share = 0.5;        // of the spread of a square, in one unit
constexpr double largest_spread_share = 0.3; // of the variance of the sum over squares, in one of them
constexpr double least_squares = 4.0;        // effective number of those
constexpr std::array square_sizes = {8, 16, 32, 64};
constexpr std::array around_sizes = {16, 64};
// Where the correlation reaches too far, or an image has no noise in its pixels, d may be what a denoiser has left of A's noise, or a smooth error. No denoiser
// makes the error of a sum larger than it was. So only that is a difference which would be one even if the noise of the
// sums were that of independent pixels with so many times the variance that neighbours show, or that the other image is
// known to have: if A had a 31st of its samples.
constexpr int own_noise_square = 32;
constexpr double least_own_noise = 0.05; // of the other image's variance
constexpr double hidden_noise = 32.0;
constexpr double hidden_freedom = 30.0;
constexpr int least_hidden_square = 16;

class PairedTester {
public:
    PairedTester(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options)
        : a_(a),
          b_(b),
          options_(options),
          counted_(a.pixels(), 0),
          differs_(a.pixels(), 0),
          covered_(a.pixels(), 0),
          rejected_by_(a.pixels(), 0)
    {
        for (std::size_t i = 0; i < counted_.size(); ++i) counted_[i] = a.is_finite(i) && b.is_finite(i);
        const Correlation correlation =
            measure_correlation(sums_of_channels(), a.window.width, a.window.height);
        noise_.inflation = correlation.inflation;
        noise_.reach = correlation.reach;
        make_pixels();
        for (std::size_t channel = 0; channel < a.channels.size(); ++channel) {
            whole_.push_back(paired_sums(pixels_[channel], Squares(0, a_.window)).front());
            around_.emplace_back();
            for (const int size : around_sizes)
                around_.back().push_back(paired_sums(pixels_[channel], Squares(size, a_.window)));
        }
        find_ratio();
        noise_.is_hidden = !noise_.reach || has_no_noise_of_its_own();
        if (noise_.is_hidden) find_rough_variances();
        const int longest = std::max(a.window.width, a.window.height);
        for (const int size : square_sizes)
            if (size < longest && (!noise_.is_hidden || size >= least_hidden_square)) sizes_.push_back(size);
    }

    Significance run()
    {
        Significance result;
        const double whole_share = sizes_.empty() ? 0.95 : share_of_image;
        const double share = share_of_squares / static_cast<double>(std::max<std::size_t>(sizes_.size(), 1));
        find_detectable_bias(result, whole_share);
        const ScaleTest whole = test_scale(0, whole_share, false);
        if (!noise_.is_hidden)
            for (const int size : sizes_) result.spread.push_back(test_spread(size));
        for (const int size : sizes_) {
            result.scales.push_back(test_scale(size, share, true));
            if (result.scales.back().rejected > 0) make_pixels();
        }
        result.scales.push_back(test_scale(0, whole_share, true));
        result.scales.back().largest = whole.largest;

        for (const ScaleTest& scale : result.scales)
            if (scale.largest) result.p = std::min(result.p, scale.largest->p);
        bool spreads = false;
        for (SpreadTest& test : result.spread) {
            result.p = std::min(result.p, test.p);
            spreads = spreads || test.p <= options_.significance;
        }
        result.pixels = counted_.size();
        count_pixels(result, false);
        if (spreads && result.differing <= tolerated()) {
            // What the squares rejected is out of it, as in the whole.
            make_pixels();
            bool remains = result.differing == 0;
            for (const int size : sizes_) remains = remains || test_spread(size).p <= options_.significance;
            if (remains) count_pixels(result, true);
        }
        result.difference_noise = noise_;
        result.rejected_by = rejected_by_;
        if (result.differing == result.pixels) // the sum over all squares is rejected
            for (std::uint16_t& size : result.rejected_by)
                if (size == 0) size = Significance::whole_image;
        return result;
    }

private:
    std::uint64_t tolerated() const
    {
        return static_cast<std::uint64_t>(static_cast<double>(counted_.size()) * options_.fail_percent /
                                          100.0);
    }

    std::vector<double> sums_of_channels() const
    {
        std::vector<double> sums(counted_.size(), 0.0);
        for (std::size_t i = 0; i < sums.size(); ++i)
            for (std::size_t channel = 0; counted_[i] && channel < a_.channels.size(); ++channel)
                sums[i] +=
                    static_cast<double>(a_.value(i, channel)) - static_cast<double>(b_.value(i, channel));
        return sums;
    }

    // Of the pixels that count and that no square has rejected.
    void make_pixels()
    {
        std::vector<char> usable = counted_;
        for (std::size_t i = 0; i < usable.size(); ++i)
            if (differs_[i]) usable[i] = 0;
        pixels_.clear();
        for (std::size_t channel = 0; channel < a_.channels.size(); ++channel)
            pixels_.emplace_back(a_, b_, channel, usable);
    }

    // Of the noise of d to the noise that one image knows, over squares of 16x16; outliers count no more than the 95 %
    // of them that are below.
    void find_ratio()
    {
        for (std::size_t channel = 0; channel < whole_.size(); ++channel) {
            std::vector<double> ratios;
            double known = 0.0;
            for (const PairedSums& square : around_[channel].front()) {
                if (!(square.variance > 0.0) || square.pixels < 2.0) continue;
                ratios.push_back(square.difference_variance() / square.variance);
                known += square.variance;
            }
            if (ratios.empty()) continue;
            std::vector<double> sorted = ratios;
            const auto high =
                sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sorted.size() - 1));
            std::nth_element(sorted.begin(), high, sorted.end());
            double sum = 0.0;
            std::size_t i = 0;
            for (const PairedSums& square : around_[channel].front())
                if (square.variance > 0.0 && square.pixels >= 2.0)
                    sum += std::min(ratios[i++], *high) * square.variance;
            noise_.ratio = std::max({1.0, sum / known, noise_.ratio.value_or(1.0)});
        }
    }

    // Of the image without error bars: an exact one says so, and a denoised one must not be taken for it.
    bool has_no_noise_of_its_own()
    {
        if (!noise_.ratio || a_.is_exact || b_.is_exact) return false;
        const Squares squares(own_noise_square, a_.window);
        double pixels = 0.0;
        for (const PairedPixels& channel : pixels_) {
            std::vector<double> ratios;
            pixels = 0.0;
            for (const PairedSums& square : paired_sums(channel, squares)) {
                if (!(square.variance > 0.0) || square.pixels < 2.0) continue;
                ratios.push_back(square.difference_variance() / square.variance);
                pixels += square.pixels;
            }
            if (ratios.empty()) continue;
            const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
            std::nth_element(ratios.begin(), middle, ratios.end());
            noise_.own = std::max(noise_.own.value_or(0.0), *middle - 1.0);
        }
        // Three standard errors of a median of variances of normal noise.
        return noise_.own && *noise_.own < least_own_noise + 3.75 * std::sqrt(2.0 / std::max(pixels, 1.0));
    }

    // The least variance of d a pixel that the surroundings of a square allow.
    double least_around(const PixelRect& place, int size, std::size_t channel) const
    {
        double least = 0.0;
        if (size == 0) return least;
        const int longest = std::max(a_.window.width, a_.window.height);
        for (std::size_t level = 0; level < around_sizes.size(); ++level) {
            if (size >= around_sizes[level]) continue;
            const PairedSums& around =
                around_sizes[level] >= longest
                    ? whole_[channel]
                    : around_[channel][level][Squares(around_sizes[level], a_.window)
                                                  .index(place.x - a_.window.x, place.y - a_.window.y)];
            if (around.pixels > 0.0) least = std::max(least, around.spread / around.pixels);
        }
        return least;
    }

    // Mean of the rough variances in the 64x64 pixels around every square.
    void find_rough_variances()
    {
        const Squares squares(around_sizes.back(), a_.window);
        for (const PairedPixels& pixels : pixels_) {
            const std::vector<double> all = pixels.rough_variances();
            std::vector<double> sums(squares.count() + 1, 0.0); // the last one: of the whole
            std::vector<double> counts(squares.count() + 1, 0.0);
            std::size_t i = 0;
            for (int y = 0; y < a_.window.height; ++y) {
                for (int x = 0; x < a_.window.width; ++x, ++i) {
                    if (all[i] < 0.0) continue;
                    for (const std::size_t square : {squares.index(x, y), squares.count()}) {
                        sums[square] += all[i];
                        counts[square] += 1.0;
                    }
                }
            }
            for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= std::max(counts[k], 1.0);
            rough_.push_back(std::move(sums));
        }
    }

    Deviation hidden_deviation(const PairedSums& sums, const PixelRect& place, int size,
                               std::size_t channel) const
    {
        if (!noise_.ratio) // neither noise is known, and both may be smooth
            return divide(
                sums,
                std::max(hidden_noise, noise_.inflation) *
                    std::max(sums.difference_variance(), sums.pixels * least_around(place, size, channel)),
                hidden_freedom);
        const Squares squares(around_sizes.back(), a_.window);
        const double rough =
            size == 0 ? rough_[channel].back()
                      : rough_[channel][squares.index(place.x - a_.window.x, place.y - a_.window.y)];
        return divide(sums, hidden_noise * std::max(sums.pixels * rough, sums.variance), hidden_freedom);
    }

    bool is_supported(const PairedSums& sums) const
    {
        if (sums.black_a != sums.black_b) return false;
        if (noise_.is_hidden) return sums.pixels >= sqr(least_hidden_square);
        return sums.effective_pixels() >= least_effective_pixels * noise_.inflation &&
               sums.largest <= std::max(largest_share * sums.spread, 0.0);
    }

    Deviation deviation_of(const PairedSums& sums, const PixelRect& place, int size,
                           std::size_t channel) const
    {
        if (noise_.is_hidden) return hidden_deviation(sums, place, size, channel);
        double variance =
            std::max(sums.difference_variance(), sums.pixels * least_around(place, size, channel));
        if (noise_.ratio) variance = std::max(variance, *noise_.ratio * sums.variance);
        const double independent = 1.0 / noise_.inflation;
        return divide(sums, variance * noise_.inflation,
                      std::max(1.0, std::min(sums.pixels * independent - 1.0,
                                             0.5 * sums.effective_pixels() * independent)));
    }

    // The difference by its error; variance: of the sum of d, before the error of the smaller mean is scaled up.
    Deviation divide(const PairedSums& sums, double variance, double freedom) const
    {
        const double smaller = std::min(std::abs(sums.a), std::abs(sums.b));
        const double larger = std::max(std::abs(sums.a), std::abs(sums.b));
        if (smaller > 0.0) variance *= std::min(sqr(larger / smaller), 1e12);
        Deviation result;
        const double beyond = std::max(0.0, std::abs(sums.difference) - options_.rounding * larger);
        if (beyond > 0.0)
            result.t =
                std::copysign(variance > 0.0 ? beyond / std::sqrt(variance) : static_cast<double>(infinity),
                              sums.difference);
        result.freedom = freedom;
        result.standard_error = larger > 0.0 ? std::sqrt(variance) / larger : 0.0;
        return result;
    }

    ScaleTest test_scale(int size, double share, bool marks)
    {
        const Squares squares(size, a_.window);
        ScaleTest result;
        result.size = size;
        result.units = squares.count();
        const double tests = static_cast<double>(squares.count() * a_.channels.size()) / share;
        std::vector<char> tested(squares.count(), 0);
        std::vector<char> unsupported(squares.count(), 0);
        std::vector<char> rejected(squares.count(), 0);
        for (std::size_t channel = 0; channel < a_.channels.size(); ++channel) {
            const std::vector<PairedSums> all = paired_sums(pixels_[channel], squares);
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (all[i].pixels < 1.0) continue;
                if (all[i].square == 0.0) { // equal
                    tested[i] = 1;
                    continue;
                }
                if (!is_supported(all[i])) {
                    unsupported[i] = 1;
                    continue;
                }
                tested[i] = 1;
                const PixelRect place = squares.place(i, a_.window);
                const Deviation found = deviation_of(all[i], place, size, channel);
                UnitTest test;
                test.place = place;
                test.channel = static_cast<int>(channel);
                test.mean_a = all[i].a / all[i].pixels;
                test.mean_b = all[i].b / all[i].pixels;
                test.t = found.t;
                test.freedom = found.freedom;
                test.p = std::min(1.0, tests * student_t_two_sided(found.t, found.freedom));
                if (test.p <= options_.significance) rejected[i] = 1;
                if (!result.largest || test.p < result.largest->p ||
                    (test.p == result.largest->p && std::abs(test.t) > std::abs(result.largest->t)))
                    result.largest = test;
            }
        }
        for (std::size_t i = 0; i < tested.size(); ++i) {
            result.tested += tested[i] ? 1 : 0;
            result.rejected += rejected[i] ? 1 : 0;
        }
        if (marks) mark(squares, tested, unsupported, rejected, result);
        return result;
    }

    void mark(const Squares& squares, const std::vector<char>& tested, const std::vector<char>& unsupported,
              const std::vector<char>& rejected, ScaleTest& result)
    {
        std::size_t i = 0;
        for (int y = 0; y < a_.window.height; ++y) {
            for (int x = 0; x < a_.window.width; ++x, ++i) {
                if (!counted_[i] || differs_[i]) continue;
                const std::size_t square = squares.index(x, y);
                if (!covered_[i] && tested[square] && !unsupported[square]) {
                    covered_[i] = 1;
                    ++result.smallest_pixels;
                }
                if (!rejected[square]) continue;
                differs_[i] = 1;
                rejected_by_[i] =
                    squares.size == 0 ? Significance::whole_image : static_cast<std::uint16_t>(squares.size);
            }
        }
    }

    SpreadTest test_spread(int size) const
    {
        SpreadTest result;
        result.size = size;
        const Squares squares(size, a_.window);
        for (std::size_t channel = 0; channel < pixels_.size(); ++channel) {
            const PairedSums& whole = whole_[channel];
            if (!is_supported(whole) || !(whole.spread > 0.0)) continue;
            double excess = 0.0;
            double expected = 0.0;
            double variance = 0.0;
            double variance_squared = 0.0;
            double largest = 0.0;
            const std::vector<PairedSums> all = paired_sums(pixels_[channel], squares);
            for (std::size_t i = 0; i < all.size(); ++i) {
                const PairedSums& sums = all[i];
                if (sums.pixels < 2.0) continue;
                const double weight = 1.0 / weight_variance(sums, squares.place(i, a_.window), size, channel);
                const double independent = noise_.inflation * sums.square;
                excess += (sqr(sums.difference) - independent) * weight;
                expected += independent * weight;
                const double part =
                    2.0 * sqr(noise_.inflation * weight) * std::max(0.0, sqr(sums.square) - sums.fourth);
                variance += part;
                variance_squared += sqr(part);
                largest = std::max(largest, part);
            }
            if (!(variance > 0.0) || largest > largest_spread_share * variance) continue;
            const double freedom = sqr(variance) / variance_squared;
            if (freedom < least_squares) continue;
            // As skewed as chi^2 of so many degrees of freedom.
            const double statistic = excess / std::sqrt(variance) * std::sqrt(2.0 * freedom) + freedom;
            const double tests = static_cast<double>(pixels_.size() * sizes_.size()) / share_of_spread;
            const double p =
                std::min(1.0, tests * (statistic > 0.0 ? chi2_survival(statistic, freedom) : 1.0));
            if (result.is_tested && p >= result.p) continue;
            result.is_tested = true;
            result.channel = static_cast<int>(channel);
            result.ratio = expected > 0.0 ? 1.0 + excess / expected : 1.0;
            result.p = p;
        }
        return result;
    }

    // Of the sum in a square, from its surroundings.
    double weight_variance(const PairedSums& sums, const PixelRect& place, int size,
                           std::size_t channel) const
    {
        const double of_whole = whole_[channel].spread / whole_[channel].pixels;
        const double around =
            size < around_sizes.back() ? least_around(place, around_sizes.front(), channel) : 0.0;
        double variance = sums.pixels * (around > 0.0 ? std::max(around, 0.1 * of_whole) : of_whole);
        if (noise_.ratio) variance = std::max(variance, *noise_.ratio * sums.variance);
        return variance;
    }

    void count_pixels(Significance& result, bool all_differ) const
    {
        result.differing = 0;
        result.untested = 0;
        for (std::size_t i = 0; i < counted_.size(); ++i) {
            if (!a_.is_finite(i) && !b_.is_finite(i)) continue;
            if (!counted_[i] || differs_[i] || all_differ)
                ++result.differing;
            else if (!covered_[i])
                ++result.untested;
        }
    }

    void find_detectable_bias(Significance& result, double share) const
    {
        constexpr double z = 1.2815515655446004; // the normal distribution has 90 % below it
        const double level = options_.significance * share / static_cast<double>(a_.channels.size());
        for (std::size_t channel = 0; channel < whole_.size(); ++channel) {
            const PairedSums& whole = whole_[channel];
            if (whole.pixels < 1.0 || whole.square == 0.0 || !is_supported(whole)) continue;
            const Deviation found = deviation_of(whole, a_.window, 0, channel);
            const double bias =
                (student_t_quantile(level, found.freedom) + z) * found.standard_error + options_.rounding;
            result.detectable_bias = std::min(bias, result.detectable_bias.value_or(bias));
        }
    }

    const ComparedImage& a_;
    const ComparedImage& b_;
    const CompareSettings& options_;
    std::vector<char> counted_;              // finite in both
    std::vector<char> differs_;              // in a square that was rejected
    std::vector<char> covered_;              // in a square that was tested
    std::vector<std::uint16_t> rejected_by_; // Significance::rejected_by
    DifferenceNoise noise_;
    std::vector<int> sizes_;
    std::vector<std::vector<double>>
        rough_;                        // variances of each channel, of squares of 64x64 and, last, the whole
    std::vector<PairedPixels> pixels_; // of each channel
    std::vector<PairedSums> whole_;    // likewise, before anything was rejected
    std::vector<std::vector<std::vector<PairedSums>>> around_; // likewise, of each size of surroundings
};

} // namespace

Significance test_paired(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options)
{
    return PairedTester(a, b, options).run();
}

} // namespace plumb
