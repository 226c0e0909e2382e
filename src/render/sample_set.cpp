// SPDX-License-Identifier: MIT

#include "plumb/render/sample_set.h"

#include "plumb/model/sampler.h"
#include "render/tiles.h"

#include <algorithm>
#include <charconv>
#include <climits>
#include <numeric>

#include <fmt/format.h>

namespace plumb {
namespace {

// Sample indices [first, last), ascending, with gaps between.
struct Interval {
    std::uint64_t first;
    std::uint64_t last;
    friend bool operator==(const Interval&, const Interval&) = default;
};
using Intervals = std::vector<Interval>;

// Which indices are in the result, given whether they are in a and in b.
using Choose = bool (*)(bool in_a, bool in_b);

// Where membership in a list of intervals changes, from the left.
class Sweep {
public:
    explicit Sweep(const Intervals& intervals) : intervals_(intervals) {}

    static constexpr std::uint64_t end = UINT64_MAX;
    std::uint64_t next() const
    {
        if (at_ == intervals_.size()) return end;
        return inside_ ? intervals_[at_].last : intervals_[at_].first;
    }
    bool inside() const { return inside_; }
    void cross()
    {
        if (inside_) ++at_;
        inside_ = !inside_;
    }

private:
    const Intervals& intervals_;
    std::size_t at_ = 0;
    bool inside_ = false;
};

Intervals combine(const Intervals& a, const Intervals& b, Choose choose)
{
    Intervals result;
    Sweep sweep_a(a);
    Sweep sweep_b(b);
    bool inside = false;
    for (std::uint64_t at = std::min(sweep_a.next(), sweep_b.next()); at != Sweep::end;
         at = std::min(sweep_a.next(), sweep_b.next())) {
        if (sweep_a.next() == at) sweep_a.cross();
        if (sweep_b.next() == at) sweep_b.cross();
        const bool now_inside = choose(sweep_a.inside(), sweep_b.inside());
        if (now_inside && !inside) result.push_back({at, at});
        if (!now_inside && inside) result.back().last = at;
        inside = now_inside;
    }
    return result;
}

// Of one set of blocks: a run of pixels of a row, all of which have the same samples.
struct Run {
    int left;
    int right;
    Intervals samples;
    friend bool operator==(const Run&, const Run&) = default;
};

// Text from outside may hold blocks that lie over each other in such a way that the pieces they make of one another are
// too many for any memory; those that we write make one each.
constexpr std::size_t most_pieces_of_text = std::size_t{1} << 20;

// Thrown and caught here.
struct TooManyPieces {};

// The rows of a set of blocks, from the top, by bands: rows between which no block begins or ends. So the time and the
// memory are those of the pieces that there are, not of a grid across the image.
class Bands {
public:
    explicit Bands(std::span<const SampleBlock> blocks, std::size_t most_pieces = SIZE_MAX)
        : blocks_(blocks.begin(), blocks.end()), pieces_left_(most_pieces)
    {
        std::sort(blocks_.begin(), blocks_.end(),
                  [](const SampleBlock& a, const SampleBlock& b) { return a.pixels.y < b.pixels.y; });
    }

    static constexpr int end = INT_MAX;
    // The first row below `y`, which take() was called with last, at which something changes.
    int next(int y) const
    {
        int result = next_ < blocks_.size() ? blocks_[next_].pixels.y : end;
        for (const SampleBlock& block : here_)
            if (const int bottom = bottom_of(block); bottom > y) result = std::min(result, bottom);
        return result;
    }

    // Of the band that begins at row y, which must be next() or above it. Throws TooManyPieces.
    std::vector<Run> take(int y)
    {
        std::erase_if(here_, [y](const SampleBlock& block) { return bottom_of(block) <= y; });
        for (; next_ < blocks_.size() && blocks_[next_].pixels.y <= y; ++next_)
            if (bottom_of(blocks_[next_]) > y) here_.push_back(blocks_[next_]);
        return runs();
    }

private:
    static int bottom_of(const SampleBlock& block) { return block.pixels.y + block.pixels.height; }

    std::vector<Run> runs()
    {
        std::vector<int> cuts;
        for (const SampleBlock& block : here_) {
            cuts.push_back(block.pixels.x);
            cuts.push_back(block.pixels.x + block.pixels.width);
        }
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
        std::vector<Intervals> cells(cuts.size());
        const auto column = [&](int x) {
            return static_cast<std::size_t>(std::lower_bound(cuts.begin(), cuts.end(), x) - cuts.begin());
        };
        for (const SampleBlock& block : here_) {
            const std::size_t right = column(block.pixels.x + block.pixels.width);
            for (std::size_t i = column(block.pixels.x); i < right; ++i) {
                if (pieces_left_-- == 0) throw TooManyPieces{};
                cells[i].push_back({block.first, block.last});
            }
        }
        std::vector<Run> result;
        for (std::size_t i = 0; i + 1 < cells.size(); ++i)
            if (!cells[i].empty()) add_run(result, {cuts[i], cuts[i + 1], united(std::move(cells[i]))});
        return result;
    }

    // Ascending, with gaps between.
    static Intervals united(Intervals all)
    {
        std::sort(all.begin(), all.end(),
                  [](const Interval& a, const Interval& b) { return a.first < b.first; });
        std::size_t kept = 0;
        for (const Interval& interval : all) {
            if (kept > 0 && interval.first <= all[kept - 1].last)
                all[kept - 1].last = std::max(all[kept - 1].last, interval.last);
            else
                all[kept++] = interval;
        }
        all.resize(kept);
        return all;
    }

public:
    // Runs that touch and have the same samples are one.
    static void add_run(std::vector<Run>& runs, Run run)
    {
        if (run.samples.empty()) return;
        if (!runs.empty() && runs.back().right == run.left && runs.back().samples == run.samples)
            runs.back().right = run.right;
        else
            runs.push_back(std::move(run));
    }

private:
    std::vector<SampleBlock> blocks_; // by their first row
    std::size_t next_ = 0;            // of them
    std::vector<SampleBlock> here_;   // those that the band crosses
    std::size_t pieces_left_;
};

// Two rows as one.
std::vector<Run> combine(const std::vector<Run>& a, const std::vector<Run>& b, Choose choose)
{
    static const Intervals none;
    std::vector<Run> result;
    std::size_t at_a = 0;
    std::size_t at_b = 0;
    for (int x = INT_MIN; at_a < a.size() || at_b < b.size();) {
        // The run that x is in, or the next one.
        const auto first = [&x](const std::vector<Run>& runs, std::size_t at) {
            return at == runs.size() ? INT_MAX : std::max(x, runs[at].left);
        };
        const int left = std::min(first(a, at_a), first(b, at_b));
        int right = INT_MAX;
        const auto samples_at = [&](const std::vector<Run>& runs, std::size_t at) -> const Intervals& {
            if (at == runs.size()) return none;
            const bool inside = runs[at].left <= left;
            right = std::min(right, inside ? runs[at].right : runs[at].left);
            return inside ? runs[at].samples : none;
        };
        const Intervals& in_a = samples_at(a, at_a);
        const Intervals& in_b = samples_at(b, at_b);
        Bands::add_run(result, {left, right, combine(in_a, in_b, choose)});
        if (at_a < a.size() && a[at_a].right == right) ++at_a;
        if (at_b < b.size() && b[at_b].right == right) ++at_b;
        x = right;
    }
    return result;
}

// The one form of a set: rows of equal runs as high as they go.
std::vector<SampleBlock> combine(Bands a, Bands b, Choose choose)
{
    std::vector<SampleBlock> blocks;
    std::vector<Run> runs;
    int top = 0;
    for (int y = std::min(a.next(INT_MIN), b.next(INT_MIN)); y != Bands::end;
         y = std::min(a.next(y), b.next(y))) {
        std::vector<Run> below = combine(a.take(y), b.take(y), choose);
        if (below == runs) continue;
        for (const Run& run : runs)
            for (const Interval& samples : run.samples)
                blocks.push_back(
                    {{run.left, top, run.right - run.left, y - top}, samples.first, samples.last});
        runs = std::move(below);
        top = y;
    }
    return blocks;
}

std::vector<SampleBlock> without_empty(std::span<const SampleBlock> blocks)
{
    std::vector<SampleBlock> some;
    for (const SampleBlock& block : blocks)
        if (!block.empty()) some.push_back(block);
    return some;
}

constexpr Choose either = [](bool in_a, bool in_b) { return in_a || in_b; };

// The number at the front of the text, which it is cut off together with the character that ends it (0: none).
template <class Number>
std::optional<Number> take_number(std::string_view& text, char end)
{
    Number number{};
    const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    if (end != '\0') {
        if (!text.starts_with(end)) return std::nullopt;
        text.remove_prefix(1);
    }
    return number;
}

std::optional<SampleBlock> block_from_text(std::string_view text)
{
    const auto x = take_number<int>(text, ',');
    const auto y = take_number<int>(text, ',');
    const auto width = take_number<int>(text, ',');
    const auto height = take_number<int>(text, ':');
    const auto first = take_number<std::uint64_t>(text, '-');
    const auto last = take_number<std::uint64_t>(text, '\0');
    constexpr int largest = 65536; // of an image's coordinates
    const auto fits = [](const std::optional<int>& n) { return n && *n >= 0 && *n <= largest; };
    if (!fits(x) || !fits(y) || !fits(width) || !fits(height) || !first || !last || !text.empty())
        return std::nullopt;
    const SampleBlock block{{*x, *y, *width, *height}, *first, *last};
    if (block.empty() || *last > max_samples_per_pixel) return std::nullopt;
    return block;
}

} // namespace

std::uint64_t SampleBlock::count() const
{
    if (empty()) return 0;
    return static_cast<std::uint64_t>(pixels.width) * static_cast<std::uint64_t>(pixels.height) *
           (last - first);
}

SampleSet::SampleSet(const SampleBlock& block) : SampleSet(std::span(&block, 1)) {}

SampleSet::SampleSet(std::span<const SampleBlock> blocks)
    : blocks_(combine(Bands(without_empty(blocks)), Bands({}), either))
{}

std::uint64_t SampleSet::count() const
{
    std::uint64_t sum = 0;
    for (const SampleBlock& block : blocks_) sum += block.count();
    return sum;
}

SampleSet operator|(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ = combine(Bands(a.blocks_), Bands(b.blocks_), either);
    return result;
}

SampleSet operator&(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ =
        combine(Bands(a.blocks_), Bands(b.blocks_), [](bool in_a, bool in_b) { return in_a && in_b; });
    return result;
}

SampleSet operator-(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ =
        combine(Bands(a.blocks_), Bands(b.blocks_), [](bool in_a, bool in_b) { return in_a && !in_b; });
    return result;
}

SampleSet::Range SampleSet::samples_per_pixel(const PixelRect& window) const
{
    Range range{UINT64_MAX, 0};
    const auto note = [&](std::uint64_t count) {
        range = {std::min(range.least, count), std::max(range.most, count)};
    };
    Bands bands(blocks_);
    const int bottom = window.y + window.height;
    const int right = window.x + window.width;
    // From the window's first row.
    for (int y = window.y; y < bottom; y = bands.next(y)) {
        int x = window.x; // up to which all pixels are seen
        for (const Run& run : bands.take(y)) {
            if (run.right <= window.x || run.left >= right) continue;
            if (run.left > x) note(0);
            std::uint64_t count = 0;
            for (const Interval& samples : run.samples) count += samples.last - samples.first;
            note(count);
            x = run.right;
        }
        if (x < right) note(0);
    }
    return range;
}

std::string SampleSet::text() const
{
    std::string text;
    for (const SampleBlock& block : blocks_)
        text += fmt::format("{}{},{},{},{}:{}-{}", text.empty() ? "" : " ", block.pixels.x, block.pixels.y,
                            block.pixels.width, block.pixels.height, block.first, block.last);
    return text;
}

std::optional<SampleSet> SampleSet::from_text(std::string_view text)
{
    std::vector<SampleBlock> blocks;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const auto block = block_from_text(text.substr(0, end));
        if (!block) return std::nullopt;
        blocks.push_back(*block);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    SampleSet result;
    try {
        result.blocks_ = combine(Bands(blocks, most_pieces_of_text), Bands({}), either);
    } catch (const TooManyPieces&) {
        return std::nullopt;
    }
    return result;
}

SampleSet part_of(const PixelRect& window, std::uint64_t samples_per_pixel, PartBy by, std::uint64_t index,
                  std::uint64_t count)
{
    if (by == PartBy::samples) {
        __extension__ typedef unsigned __int128 Wide;
        const auto border = [&](std::uint64_t i) {
            return static_cast<std::uint64_t>(Wide{samples_per_pixel} * i / count);
        };
        return SampleSet(SampleBlock{window, border(index), border(index + 1)});
    }
    // Squares of 16 pixels, or larger ones where there would be more than 256 in a row. As cards are dealt: in each round
    // every part gets one, and each round begins about a golden section of the parts further, so that no part gets
    // whole columns.
    const int size = std::max(16, (std::max(window.width, window.height) + 255) / 256);
    constexpr double golden = 0.6180339887498949;
    auto step = static_cast<std::uint64_t>(golden * static_cast<double>(count));
    while (std::gcd(step, count) != 1) ++step;
    std::vector<SampleBlock> blocks;
    std::uint64_t number = 0;
    for (const PixelRect& square : cut_into_tiles(window, size)) {
        const std::uint64_t round = number / count;
        if ((number + round * step) % count == index) blocks.push_back({square, 0, samples_per_pixel});
        ++number;
    }
    return SampleSet(blocks);
}

} // namespace plumb
