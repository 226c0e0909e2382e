// SPDX-License-Identifier: MIT
#pragma once

// The interface of samplers: the random numbers of one sample.

#include "plumb/math/math.h"

#include <array>
#include <memory>

namespace plumb {

// More than anybody asked for; what the film can add up without wrapping (film.h).
inline constexpr std::uint64_t max_samples_per_pixel = std::uint64_t{1} << 26;

// A sample is a point in a space of as many dimensions as a path asks for. Its coordinates are a pure function of
// (seed, pixel, sample index, dimension): whatever was drawn before start() has no influence. Each coordinate of each
// sample, taken over all seeds, is uniform and independent of the sample's others, in [0, 1); samples of one pixel may
// depend on each other, those of different pixels do not.
//
// A sampler makes its coordinates as 32-bit fractions, a block of dimensions at a time, so that drawing one costs no
// call: to be written are fill_block(), which sets all of block_, and start(), which ends in begin_sample().
class Sampler {
public:
    virtual ~Sampler() = default;
    // One a thread. total: how many samples each pixel is to get in all; of no influence unless depends_on_total().
    virtual std::unique_ptr<Sampler> clone(std::uint64_t total) const = 0;
    virtual std::uint64_t samples_per_pixel() const = 0;

    // Whether the coordinates depend on the total too: then no sample can have an index beyond it.
    virtual bool depends_on_total() const { return false; }
    // Whether the samples of one pixel are independent. If not, they are spread more evenly, and an error bar made of their
    // variance is an upper bound.
    virtual bool is_independent() const { return true; }

    // pixel: in coordinates of the full image, 0 <= x, y < 65536, so that a crop draws the numbers of the whole. The
    // numbers up to the first start_vertex() are for the camera.
    virtual void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) = 0;

    // What follows is for the path's vertex after so many bounces, and has dimensions of its own, whatever was drawn for
    // earlier vertices. At a vertex pairs come from one place and single numbers from another, so that a pair keeps its
    // dimensions whatever single numbers were drawn.
    void start_vertex(int bounces)
    {
        if (order_ == Order::by_vertex) begin_vertex(static_cast<std::uint32_t>(bounces) + 1);
    }

    float next_1d() { return to_unit(next_words<1>(cursors_[singles_])[0]); }
    Vec2f next_2d()
    {
        const auto [x, y] = next_words<2>(cursors_[pairs]);
        return {to_unit(x), to_unit(y)};
    }
    // One dimension with 53 bits, for choosing among many (emitters, triangles, texels): takes the place of two.
    double next_choice()
    {
        const auto [high, low] = next_words<2>(cursors_[singles_]);
        return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1p-53;
    }

protected:
    // How the numbers of a block are handed out: one after the other, for they are all alike; or for each vertex the
    // pairs from the first four words of a block and the single numbers from the next four.
    enum class Order { as_drawn, by_vertex };

    explicit Sampler(Order order) : order_(order), singles_(order == Order::as_drawn ? pairs : pairs + 1) {}
    Sampler(const Sampler&) = default;

    virtual void fill_block() = 0;
    void begin_sample() { begin_vertex(0); }

    // Of the block to fill: the vertex, 0 for the camera, and the number of the vertex's blocks before.
    std::uint32_t vertex() const { return vertex_; }
    std::uint32_t block_number() const { return block_number_; }

    std::array<std::uint32_t, 32> block_{}; // the coordinates of the next dimensions, times 2^32

private:
    static constexpr std::size_t words_of_a_kind = 4;
    static constexpr std::size_t pairs = 0; // their cursor

    // Of block_.
    struct Cursor {
        std::size_t next = 0;
        std::size_t end = 0;
    };

    static float to_unit(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }

    template <std::size_t count>
    std::array<std::uint32_t, count> next_words(Cursor& from)
    {
        std::array<std::uint32_t, count> words;
        if (from.next + count <= from.end) [[likely]] {
            for (std::size_t i = 0; i < count; ++i) words[i] = block_[from.next + i];
            from.next += count;
        } else {
            for (std::uint32_t& word : words) word = next_word_across_blocks(from);
        }
        return words;
    }

    std::uint32_t next_word_across_blocks(Cursor& from);

    void begin_vertex(std::uint32_t vertex)
    {
        vertex_ = vertex;
        block_number_ = 0;
        cursors_ = {};
    }

    Order order_;
    std::size_t singles_; // their cursor
    std::array<Cursor, 2> cursors_{};
    std::uint32_t vertex_ = 0;
    std::uint32_t block_number_ = 0; // of the next block
};

} // namespace plumb
