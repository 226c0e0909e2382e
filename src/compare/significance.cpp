// SPDX-License-Identifier: MIT

// The chance of a false alarm is shared out beforehand (Bonferroni): one half to the test of the whole image, the
// rest in equal parts to the sizes of squares, and within a size to its squares and channels. Sizes go from fine to
// coarse; pixels of a square that was rejected do not count in the larger ones, so that a single wrong pixel does not
// make the whole image wrong.

#include "compare/significance.h"

#include "compare/region_test.h"
#include "compare/squares.h"
#include "plumb/statistics/statistics.h"

#include <array>

namespace plumb {

namespace {

constexpr double share_of_whole = 0.5;
// Squares below such a size take their variance to be at least that of the square of this size around them, as rare bright
// samples may all have been missed in the small one. Where both are images of one estimator, what one has missed the
// other tells of, and the first will do; else neither may, and more of the surroundings must.
constexpr std::array surroundings = {16, 64};

enum class State : std::uint8_t { usable, unusable, differs };

class Tester {
public:
    Tester(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options)
        : a_(a),
          b_(b),
          options_(options),
          states_(a.pixels(), State::usable),
          covered_(a.pixels(), false),
          rejected_by_(a.pixels(), 0)
    {
        sampling_ = {a.samples_per_pixel, b.samples_per_pixel, a.is_exact, b.is_exact,
                     options.rounding,    a.inflation,         b.inflation};
        for (std::size_t i = 0; i < states_.size(); ++i)
            if (!a.is_finite(i) || !b.is_finite(i) || !a.variance_is_known(i) || !b.variance_is_known(i))
                states_[i] = State::unusable;
        const bool is_told = sampling_.noise_is_shared() && are_of_one_estimator(a, b);
        for (std::size_t level = 0; level < (is_told ? 1 : surroundings.size()); ++level) {
            around_.emplace_back();
            for (std::size_t channel = 0; channel < a.channels.size(); ++channel)
                around_[level].push_back(sums(Squares(surroundings[level], a.window), channel));
        }
    }

    Significance run()
    {
        Significance result;
        std::vector<int> sizes;
        for (int size = 1; size < std::max(a_.window.width, a_.window.height); size *= 2)
            sizes.push_back(size);
        const double whole_share = sizes.empty() ? 1.0 : share_of_whole;
        const double share =
            (1.0 - share_of_whole) / static_cast<double>(std::max<std::size_t>(sizes.size(), 1));
        // Of the whole as it is, before rejected squares are left out.
        find_detectable_bias(result, whole_share);
        const std::optional<UnitTest> whole = largest_of_whole(whole_share);
        for (const int size : sizes) result.scales.push_back(test_scale(size, share));
        result.scales.push_back(test_scale(0, whole_share));
        result.scales.back().largest = whole;

        result.pixels = states_.size();
        for (const ScaleTest& scale : result.scales)
            if (scale.largest) result.p = std::min(result.p, scale.largest->p);
        result.rejected_by = rejected_by_;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            if (!a_.is_finite(i) && !b_.is_finite(i)) continue;
            if (states_[i] == State::differs || a_.is_finite(i) != b_.is_finite(i))
                ++result.differing;
            else if (!covered_[i])
                ++result.untested;
        }
        return result;
    }

private:
    std::vector<UnitSums> sums(const Squares& squares, std::size_t channel) const
    {
        std::vector<UnitSums> result(squares.count());
        const auto contributing = [](const ComparedImage& image, std::size_t pixel) {
            return static_cast<double>(image.contributing.empty() ? infinity : image.contributing[pixel]);
        };
        std::size_t i = 0;
        for (int y = 0; y < a_.window.height; ++y) {
            for (int x = 0; x < a_.window.width; ++x, ++i) {
                if (states_[i] != State::usable) continue;
                UnitSums& unit = result[squares.index(x, y)];
                unit.a.add(static_cast<double>(a_.value(i, channel)), a_.variance(i, channel),
                           a_.samples_per_pixel, contributing(a_, i), a_.freedom);
                unit.b.add(static_cast<double>(b_.value(i, channel)), b_.variance(i, channel),
                           b_.samples_per_pixel, contributing(b_, i), b_.freedom);
                ++unit.pixels;
            }
        }
        return result;
    }

    Deviation deviation_of(const UnitSums& unit, const PixelRect& place, int size, std::size_t channel) const
    {
        std::optional<LeastNoise> least;
        for (std::size_t level = 0; level < around_.size(); ++level) {
            if (size == 0 || size >= surroundings[level]) continue;
            const Squares squares(surroundings[level], a_.window);
            const UnitSums& around =
                around_[level][channel][squares.index(place.x - a_.window.x, place.y - a_.window.y)];
            const double pixels = static_cast<double>(std::max<std::uint64_t>(around.pixels, 1));
            if (!least) least.emplace();
            least->a = std::max(least->a, around.a.variance / pixels);
            least->b = std::max(least->b, around.b.variance / pixels);
        }
        return deviation(unit, sampling_, least);
    }

    // p: of this test alone.
    UnitTest describe(const UnitSums& unit, const PixelRect& place, std::size_t channel,
                      const Deviation& found) const
    {
        UnitTest result;
        result.place = place;
        result.channel = static_cast<int>(channel);
        const double pixels = static_cast<double>(unit.pixels);
        result.mean_a = unit.a.mean / pixels;
        result.mean_b = unit.b.mean / pixels;
        result.t = found.t;
        result.freedom = found.freedom;
        result.p = student_t_two_sided(found.t, found.freedom);
        return result;
    }

    static bool is_larger(const UnitTest& test, const std::optional<UnitTest>& other)
    {
        if (!other || test.p < other->p) return true;
        return test.p == other->p && std::abs(test.t) > std::abs(other->t);
    }

    // p of one of so many tests.
    static void adjust(std::optional<UnitTest>& test, double tests)
    {
        if (test) test->p = std::min(1.0, tests * test->p);
    }

    ScaleTest test_scale(int size, double share)
    {
        struct Unit {
            bool is_tested = false;      // in one channel at least
            bool is_unsupported = false; // in one channel
            bool is_rejected = false;
        };
        const Squares squares(size, a_.window);
        ScaleTest result;
        result.size = size;
        result.units = squares.count();
        const double tests = static_cast<double>(squares.count() * a_.channels.size()) / share;
        std::vector<Unit> units(squares.count());
        double interesting = 0.0; // a smaller |t| can neither be rejected nor be the largest
        for (std::size_t channel = 0; channel < a_.channels.size(); ++channel) {
            const std::vector<UnitSums> all = sums(squares, channel);
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (all[i].pixels == 0 || is_black(all[i])) continue;
                if (!is_supported(all[i], sampling_)) {
                    units[i].is_unsupported = true;
                    continue;
                }
                units[i].is_tested = true;
                const PixelRect place = squares.place(i, a_.window);
                const Deviation found = deviation_of(all[i], place, size, channel);
                // Student's tails are above the normal ones.
                if (result.largest && std::abs(found.t) < interesting) continue;
                const UnitTest test = describe(all[i], place, channel, found);
                if (tests * test.p <= options_.significance) units[i].is_rejected = true;
                if (!is_larger(test, result.largest)) continue;
                result.largest = test;
                interesting = student_t_quantile(std::max(test.p, options_.significance / tests),
                                                 static_cast<double>(infinity));
            }
        }
        adjust(result.largest, tests);
        for (const Unit& unit : units) {
            result.tested += unit.is_tested ? 1 : 0;
            result.rejected += unit.is_rejected ? 1 : 0;
        }
        std::size_t i = 0;
        for (int y = 0; y < a_.window.height; ++y) {
            for (int x = 0; x < a_.window.width; ++x, ++i) {
                if (states_[i] != State::usable) continue;
                const Unit& unit = units[squares.index(x, y)];
                if (!covered_[i] && unit.is_tested && !unit.is_unsupported) {
                    covered_[i] = true;
                    ++result.smallest_pixels;
                }
                if (!unit.is_rejected) continue;
                states_[i] = State::differs;
                rejected_by_[i] = size == 0 ? Significance::whole_image : static_cast<std::uint16_t>(size);
            }
        }
        return result;
    }

    // Of all pixels that are usable now, with its p among the channels.
    std::optional<UnitTest> largest_of_whole(double share) const
    {
        std::optional<UnitTest> result;
        const Squares whole(0, a_.window);
        for (std::size_t channel = 0; channel < a_.channels.size(); ++channel) {
            const UnitSums unit = sums(whole, channel).front();
            if (is_black(unit) || !is_supported(unit, sampling_)) continue;
            const UnitTest test =
                describe(unit, a_.window, channel, deviation_of(unit, a_.window, 0, channel));
            if (is_larger(test, result)) result = test;
        }
        adjust(result, static_cast<double>(a_.channels.size()) / share);
        return result;
    }

    void find_detectable_bias(Significance& result, double share) const
    {
        constexpr double z = 1.2815515655446004; // the normal distribution has 90 % below it
        const double level = options_.significance * share / static_cast<double>(a_.channels.size());
        const Squares whole(0, a_.window);
        for (std::size_t channel = 0; channel < a_.channels.size(); ++channel) {
            const UnitSums unit = sums(whole, channel).front();
            if (is_black(unit) || !is_supported(unit, sampling_)) continue;
            const Deviation found = deviation_of(unit, a_.window, 0, channel);
            const double bias =
                (student_t_quantile(level, found.freedom) + z) * found.standard_error + options_.rounding;
            result.detectable_bias = std::min(bias, result.detectable_bias.value_or(bias));
        }
    }

    const ComparedImage& a_;
    const ComparedImage& b_;
    const CompareSettings& options_;
    Sampling sampling_;
    std::vector<State> states_;
    std::vector<bool> covered_;                              // in a square that was tested
    std::vector<std::uint16_t> rejected_by_;                 // Significance::rejected_by
    std::vector<std::vector<std::vector<UnitSums>>> around_; // of each size of surroundings, in each channel
};

} // namespace

Significance test_significance(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options)
{
    return Tester(a, b, options).run();
}

} // namespace plumb
