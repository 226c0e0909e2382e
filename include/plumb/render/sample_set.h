// SPDX-License-Identifier: MIT
#pragma once

// Which samples: sets of pairs of a pixel and a sample index. What was rendered, what is to be, and what is missing.

#include "plumb/image/image.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// The samples [first, last) of each of these pixels.
struct SampleBlock {
    PixelRect pixels;
    std::uint64_t first = 0;
    std::uint64_t last = 0;

    bool empty() const { return pixels.width < 1 || pixels.height < 1 || first >= last; }
    std::uint64_t count() const;
    friend bool operator==(const SampleBlock&, const SampleBlock&) = default;
};

class SampleSet {
public:
    SampleSet() = default;
    explicit SampleSet(const SampleBlock& block);
    // The union; the blocks may overlap.
    explicit SampleSet(std::span<const SampleBlock> blocks);

    // Disjoint, none empty, from the top; equal sets have equal blocks.
    const std::vector<SampleBlock>& blocks() const { return blocks_; }
    bool empty() const { return blocks_.empty(); }
    std::uint64_t count() const;

    friend SampleSet operator|(const SampleSet& a, const SampleSet& b);
    friend SampleSet operator&(const SampleSet& a, const SampleSet& b);
    friend SampleSet operator-(const SampleSet& a, const SampleSet& b); // in a and not in b
    friend bool operator==(const SampleSet&, const SampleSet&) = default;

    // The smallest and the largest number of samples that a pixel of `window` has.
    struct Range {
        std::uint64_t least = 0;
        std::uint64_t most = 0;
    };
    Range samples_per_pixel(const PixelRect& window) const;

    // "0,0,64,48:0-16 64,0,32,48:0-8": x, y, width, height and the samples from first to before last, block by block.
    std::string text() const;
    // Nothing where it is not such a text, or has so many scattered blocks that nobody rendered them.
    static std::optional<SampleSet> from_text(std::string_view text);

private:
    std::vector<SampleBlock> blocks_;
};

// How to cut an image into parts that take about equally long.
enum class PartBy { tiles, samples };

// Part `index` (from 0) of `count`: a pure function, the parts are disjoint and together all samples of the window.
// By tiles: every count-th of the small squares that the window is cut into, spread evenly. By samples: a range of them.
SampleSet part_of(const PixelRect& window, std::uint64_t samples_per_pixel, PartBy by, std::uint64_t index,
                  std::uint64_t count);

} // namespace plumb
