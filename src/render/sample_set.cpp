// SPDX-License-Identifier: MIT

#include "plumb/sample_set.h"

#include "plumb/sampler.h"
#include "render/tiles.h"

#include <charconv>
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

// The coordinates at which some block begins or ends, ascending.
std::vector<int> cuts(std::initializer_list<std::span<const SampleBlock>> sets, int PixelRect::*start,
                      int PixelRect::*size)
{
    std::vector<int> result;
    for (const std::span<const SampleBlock> blocks : sets) {
        for (const SampleBlock& block : blocks) {
            result.push_back(block.pixels.*start);
            result.push_back(block.pixels.*start + block.pixels.*size);
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

// The picture, cut so that a cell's pixels all have the same samples.
struct Grid {
    std::vector<int> x;
    std::vector<int> y;

    std::size_t columns() const { return x.empty() ? 0 : x.size() - 1; }
    std::size_t rows() const { return y.empty() ? 0 : y.size() - 1; }
};

std::size_t position(const std::vector<int>& cuts, int at)
{
    return static_cast<std::size_t>(std::lower_bound(cuts.begin(), cuts.end(), at) - cuts.begin());
}

// The samples of each cell, row by row.
std::vector<Intervals> fill(const Grid& grid, std::span<const SampleBlock> blocks)
{
    constexpr Choose either = [](bool in_a, bool in_b) { return in_a || in_b; };
    std::vector<Intervals> cells(grid.columns() * grid.rows());
    for (const SampleBlock& block : blocks) {
        const Intervals samples = {{block.first, block.last}};
        const std::size_t right = position(grid.x, block.pixels.x + block.pixels.width);
        const std::size_t below = position(grid.y, block.pixels.y + block.pixels.height);
        for (std::size_t row = position(grid.y, block.pixels.y); row < below; ++row) {
            for (std::size_t column = position(grid.x, block.pixels.x); column < right; ++column) {
                Intervals& cell = cells[row * grid.columns() + column];
                cell = cell.empty() ? samples : combine(cell, samples, either);
            }
        }
    }
    return cells;
}

// A run of cells with the same samples.
struct Run {
    int left;
    int right;
    Intervals samples;
    friend bool operator==(const Run&, const Run&) = default;
};

std::vector<Run> runs_of_row(const Grid& grid, std::span<const Intervals> row)
{
    std::vector<Run> runs;
    for (std::size_t column = 0; column < row.size(); ++column) {
        if (row[column].empty()) continue;
        if (!runs.empty() && runs.back().right == grid.x[column] && runs.back().samples == row[column])
            runs.back().right = grid.x[column + 1];
        else
            runs.push_back({grid.x[column], grid.x[column + 1], row[column]});
    }
    return runs;
}

// The one form: rows of equal runs as high as they go.
std::vector<SampleBlock> blocks_of(const Grid& grid, const std::vector<Intervals>& cells)
{
    std::vector<SampleBlock> blocks;
    std::vector<Run> runs;
    int top = 0;
    const auto emit = [&](int bottom) {
        for (const Run& run : runs)
            for (const Interval& samples : run.samples)
                blocks.push_back(
                    {{run.left, top, run.right - run.left, bottom - top}, samples.first, samples.last});
    };
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        std::vector<Run> below =
            runs_of_row(grid, std::span(cells).subspan(row * grid.columns(), grid.columns()));
        if (below == runs) continue;
        emit(grid.y[row]);
        runs = std::move(below);
        top = grid.y[row];
    }
    if (grid.rows() > 0) emit(grid.y.back());
    return blocks;
}

std::vector<SampleBlock> combine(std::span<const SampleBlock> a, std::span<const SampleBlock> b,
                                 Choose choose)
{
    const Grid grid{cuts({a, b}, &PixelRect::x, &PixelRect::width),
                    cuts({a, b}, &PixelRect::y, &PixelRect::height)};
    std::vector<Intervals> cells = fill(grid, a);
    const std::vector<Intervals> others = fill(grid, b);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = combine(cells[i], others[i], choose);
    return blocks_of(grid, cells);
}

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
    constexpr int largest = 65536; // of a picture's coordinates
    const auto fits = [](const std::optional<int>& n) { return n && *n >= 0 && *n <= largest; };
    if (!fits(x) || !fits(y) || !fits(width) || !fits(height) || !first || !last || !text.empty())
        return std::nullopt;
    const SampleBlock block{{*x, *y, *width, *height}, *first, *last};
    if (block.empty() || *last > max_samples_per_pixel) return std::nullopt;
    return block;
}

// Whether the grid of these blocks would take more time and memory than any that parts and checkpoints make: those have
// some 256 x 256 cells, and a few blocks for each.
bool is_too_scattered(std::span<const SampleBlock> blocks)
{
    constexpr std::size_t most_cells = std::size_t{1} << 22;
    const Grid grid{cuts({blocks}, &PixelRect::x, &PixelRect::width),
                    cuts({blocks}, &PixelRect::y, &PixelRect::height)};
    const std::size_t cells = grid.columns() * grid.rows();
    std::size_t covered = 0;
    for (const SampleBlock& block : blocks)
        covered +=
            (position(grid.x, block.pixels.x + block.pixels.width) - position(grid.x, block.pixels.x)) *
            (position(grid.y, block.pixels.y + block.pixels.height) - position(grid.y, block.pixels.y));
    return cells > most_cells || covered > most_cells || blocks.size() > 1000 + 64 * cells;
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
{
    std::vector<SampleBlock> some;
    for (const SampleBlock& block : blocks)
        if (!block.empty()) some.push_back(block);
    blocks_ = combine(some, {}, [](bool in_a, bool) { return in_a; });
}

std::uint64_t SampleSet::count() const
{
    std::uint64_t sum = 0;
    for (const SampleBlock& block : blocks_) sum += block.count();
    return sum;
}

SampleSet operator|(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ = combine(a.blocks_, b.blocks_, [](bool in_a, bool in_b) { return in_a || in_b; });
    return result;
}

SampleSet operator&(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ = combine(a.blocks_, b.blocks_, [](bool in_a, bool in_b) { return in_a && in_b; });
    return result;
}

SampleSet operator-(const SampleSet& a, const SampleSet& b)
{
    SampleSet result;
    result.blocks_ = combine(a.blocks_, b.blocks_, [](bool in_a, bool in_b) { return in_a && !in_b; });
    return result;
}

SampleSet::Range SampleSet::samples_per_pixel(const PixelRect& window) const
{
    const SampleBlock whole{window, 0, max_samples_per_pixel};
    const Grid grid{cuts({blocks_, std::span(&whole, 1)}, &PixelRect::x, &PixelRect::width),
                    cuts({blocks_, std::span(&whole, 1)}, &PixelRect::y, &PixelRect::height)};
    const std::vector<Intervals> cells = fill(grid, blocks_);
    Range range{UINT64_MAX, 0};
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            if (grid.x[column] < window.x || grid.x[column] >= window.x + window.width ||
                grid.y[row] < window.y || grid.y[row] >= window.y + window.height)
                continue;
            std::uint64_t count = 0;
            for (const Interval& samples : cells[row * grid.columns() + column])
                count += samples.last - samples.first;
            range = {std::min(range.least, count), std::max(range.most, count)};
        }
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
    if (is_too_scattered(blocks)) return std::nullopt;
    return SampleSet(blocks);
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
