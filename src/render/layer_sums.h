// SPDX-License-Identifier: MIT
#pragma once

// The sums of a film's layers, exact as those of beauty: 16 bytes a component of a mean or a share, 48 of a variance, 4 for the
// number of hits where it matters, 8 an id.
//
// Shares. A sample is rounded to the film's units after all contributions are added up as floats. So a contribution counts as
// what it makes of that rounded number: the differences add up to the sample's number, and the shares' sums to beauty's.
//
// A variance has three sums a component: of the values, of the squares of values below 2^18, and of larger squares in units of
// 2^-20, below 2^74 each.
//
// Range: |value times weight| < 2^37, as for beauty, at most 2^26 times: below 2^127 units. A value outside of it or not finite
// counts as if the sample had none: a layer changes no other layer, and no beauty.

#include "plumb/render/channel_set.h"
#include "render/fixed_sum.h"

namespace plumb {

class LayerSums {
public:
    // Throws std::bad_alloc.
    LayerSums(ChannelSet layers, std::size_t pixels);

    const ChannelSet& layers() const { return layers_; }
    static std::size_t bytes_per_pixel(const ChannelSet& layers);

    // One pixel from one thread at a time. index: the sample's, below 2^26.
    void add(std::size_t pixel, float weight, const LayerSample& sample, std::uint64_t index);
    // Those of another with the same layers and pixels.
    LayerSums& operator+=(const LayerSums& other);

    // A float a component, of a pixel with so many samples.
    void develop(std::size_t pixel, std::uint32_t samples, float* out) const;

    // A pixel's state as 32-bit words, all 0 if it has none; and what they are called.
    std::vector<std::string> word_names() const;
    std::size_t word_count() const { return 4 * sums_per_pixel_ + hits_per_pixel_ + 2 * ids_per_pixel_; }
    void words(std::size_t pixel, std::span<std::uint32_t> words) const;
    void set_words(std::size_t pixel, std::span<const std::uint32_t> words);
    // Whether so many samples can have these words.
    bool is_possible(std::span<const std::uint32_t> words, std::uint64_t samples) const;

private:
    void add_shares(FixedSum* sums, float weight, const LayerSample& sample) const;

    ChannelSet layers_;
    std::vector<std::size_t> first_sums_; // of each layer, in a pixel's
    std::size_t sums_per_pixel_ = 0;
    std::size_t hits_per_pixel_ = 0;
    std::size_t ids_per_pixel_ = 0;
    std::vector<FixedSum> sums_;
    std::vector<std::uint32_t> hits_;
    std::vector<std::uint64_t> first_ids_; // (index of the first sample + 1) << 32 | its id; 0: no sample
};

} // namespace plumb
