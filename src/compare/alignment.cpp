// SPDX-License-Identifier: MIT
#include "compare/alignment.h"

#include "compare/shift_test.h"
#include "compare/shifted.h"
#include "compare/verdict.h"
#include "plumb/math/elementary.h"

#include <functional>

#include <fmt/format.h>

namespace plumb {

namespace {

using Pair = ImagePair;

// Changes of one kind: the one with the smallest difference that agrees is named.
struct Change {
    std::string text; // behind "A "
    std::function<Pair(const ComparedImage&, const ComparedImage&)> apply;
};
using Group = std::vector<Change>;

// A with the pixels in another order.
Pair reorder(const ComparedImage& a, const ComparedImage& b, bool turns_x, bool turns_y)
{
    Pair pair{a, b};
    const std::size_t width = static_cast<std::size_t>(a.window.width);
    const std::size_t height = static_cast<std::size_t>(a.window.height);
    const std::size_t channels = a.channels.size();
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t to = y * width + x;
            const std::size_t from = (turns_y ? height - 1 - y : y) * width + (turns_x ? width - 1 - x : x);
            for (std::size_t c = 0; c < channels; ++c) {
                pair.a.values[to * channels + c] = a.values[from * channels + c];
                if (!a.variances.empty())
                    pair.a.variances[to * channels + c] = a.variances[from * channels + c];
            }
            if (!a.contributing.empty()) pair.a.contributing[to] = a.contributing[from];
        }
    }
    return pair;
}

Pair swap_channels(const ComparedImage& a, const ComparedImage& b, std::size_t first, std::size_t second)
{
    Pair pair{a, b};
    for (std::size_t i = 0; i + 2 < a.values.size(); i += 3) {
        std::swap(pair.a.values[i + first], pair.a.values[i + second]);
        if (!a.variances.empty()) std::swap(pair.a.variances[i + first], pair.a.variances[i + second]);
    }
    return pair;
}

Pair scale(const ComparedImage& a, const ComparedImage& b, double factor)
{
    Pair pair{a, b};
    for (float& value : pair.a.values) value = static_cast<float>(factor * static_cast<double>(value));
    for (float& value : pair.a.variances)
        value = static_cast<float>(sqr(factor) * static_cast<double>(value));
    return pair;
}

double power(double value, double exponent)
{
    return value > 0.0 ? exp(exponent * log(value)) : 0.0;
}

double decode_srgb(double value)
{
    return value <= 0.04045 ? value / 12.92 : power((value + 0.055) / 1.055, 2.4);
}

template <class Decode>
void decode(ComparedImage& image, Decode curve)
{
    for (float& value : image.values)
        value = std::copysign(static_cast<float>(curve(std::abs(static_cast<double>(value)))), value);
    drop_noise(image);
}

template <class Decode>
Change decoded(const std::string& text, bool of_a, Decode curve)
{
    return {text, [of_a, curve](const ComparedImage& a, const ComparedImage& b) {
                Pair pair{a, b};
                decode(of_a ? pair.a : pair.b, curve);
                return pair;
            }};
}

// The factor that makes the sums over all pixels and channels equal.
std::optional<double> exposure(const ComparedImage& a, const ComparedImage& b)
{
    double sum_a = 0.0;
    double sum_b = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (!std::isfinite(a.values[i]) || !std::isfinite(b.values[i])) continue;
        sum_a += static_cast<double>(a.values[i]);
        sum_b += static_cast<double>(b.values[i]);
    }
    const double factor = sum_a > 0.0 && sum_b > 0.0 ? sum_b / sum_a : 0.0;
    if (!(factor > 1e-6 && factor < 1e6)) return {};
    return factor;
}

std::vector<Group> all_changes(const ComparedImage& a, const ComparedImage& b)
{
    std::vector<Group> groups;
    const auto turned = [](const char* text, bool x, bool y) {
        return Change{text, [x, y](const ComparedImage& of, const ComparedImage& other) {
                          return reorder(of, other, x, y);
                      }};
    };
    groups.push_back({turned("mirrored left to right", true, false),
                      turned("turned upside down", false, true),
                      turned("rotated by 180 degrees", true, true)});
    if (a.channels.size() == 3) {
        const auto swapped = [](const char* text, std::size_t first, std::size_t second) {
            return Change{text, [first, second](const ComparedImage& of, const ComparedImage& other) {
                              return swap_channels(of, other, first, second);
                          }};
        };
        groups.push_back({swapped("with red and blue swapped", 0, 2),
                          swapped("with red and green swapped", 0, 1),
                          swapped("with green and blue swapped", 1, 2)});
    }
    const auto gamma = [](double value) { return power(value, 2.2); };
    groups.push_back({decoded("decoded from sRGB", true, decode_srgb),
                      decoded("decoded from a gamma of 2.2", true, gamma),
                      decoded("encoded as B, in sRGB,", false, decode_srgb),
                      decoded("encoded as B, with a gamma of 2.2,", false, gamma)});
    if (const auto factor = exposure(a, b))
        groups.push_back({{fmt::format("times {:.4g}", *factor),
                           [factor](const ComparedImage& of, const ComparedImage& other) {
                               return scale(of, other, *factor);
                           }}});
    for (const int step : {2, 1}) {
        Group shifts;
        for (int y = -step; y <= step; y += step) {
            for (int x = -step; x <= step; x += step) {
                if (x == 0 && y == 0) continue;
                shifts.push_back(
                    {shift_text(x, y), [x, y](const ComparedImage& of, const ComparedImage& other) {
                         return shift(of, other, x, y);
                     }});
            }
        }
        groups.push_back(std::move(shifts));
    }
    return groups;
}

// The change of this name.
Group only(const std::vector<Group>& groups, const std::string& text)
{
    Group result;
    for (const Group& group : groups)
        std::copy_if(group.begin(), group.end(), std::back_inserter(result),
                     [&text](const Change& change) { return change.text == text; });
    return result;
}

double mean_difference(const ComparedImage& a, const ComparedImage& b)
{
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double d = std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]));
        if (!std::isfinite(d)) continue;
        sum += d;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : static_cast<double>(infinity);
}

} // namespace

std::optional<Alignment> find_alignment(const ComparedImage& a, const ComparedImage& b,
                                        const CompareSettings& options, bool found_by_shift_alone)
{
    std::vector<Group> groups = all_changes(a, b);
    int tried = 0;
    for (const Group& group : groups) tried += static_cast<int>(group.size());
    CompareSettings how = options;
    how.alignment = false;
    how.significance = std::min(0.5, options.significance * tried);
    const double before = mean_difference(a, b);
    // A shift may hide a wrong albedo behind a gradient, and an exposure a shift.
    const std::optional<Alignment> fits = test_shifts(a, b);
    const bool is_shifted = fits && fits->p <= options.significance;
    const auto shifts = [](const Group& group) { return group.front().text.starts_with("shifted"); };
    if (is_shifted) {
        std::stable_partition(groups.begin(), groups.end(), shifts);
        groups.insert(groups.begin(), only(groups, fits->change));
    }
    for (const Group& group : groups) {
        if (shifts(group) && !is_shifted) continue;
        std::optional<Alignment> best;
        double smallest = before;
        for (const Change& change : group) {
            const Pair pair = change.apply(a, b);
            const double difference = mean_difference(pair.a, pair.b);
            if (!(difference < smallest)) continue;
            const Significance found = find_significance(pair.a, pair.b, how);
            if (found.verdict != Verdict::passes) continue;
            // What another exposure leaves of a wrong albedo looks like noise of a wide filter.
            if (change.text.starts_with("times") && found.difference_noise &&
                found.difference_noise->reach.value_or(10) > 2)
                continue;
            if (found_by_shift_alone && !shifts(group)) { // then this must be mended, too
                const std::optional<Alignment> still = test_shifts(pair.a, pair.b);
                if (still && still->p <= how.significance) continue;
            }
            smallest = difference;
            best = Alignment{change.text, found.p, tried};
        }
        if (best) return best;
    }
    return {};
}

} // namespace plumb
