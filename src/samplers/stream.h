// SPDX-License-Identifier: MIT
#pragma once

// The numbers of a stream (hashed.h), for whoever asks a Sampler: paths that branch off a sample's own.

#include "samplers/hashed.h"

namespace plumb {

// Independent numbers. A stream is of one key, so clone() and start() begin others.
class StreamSampler final : public Sampler {
public:
    explicit StreamSampler(std::uint64_t key) : Sampler(Order::as_drawn), key_(key) {}

    std::unique_ptr<Sampler> clone(std::uint64_t) const override
    {
        return std::make_unique<StreamSampler>(*this);
    }
    std::uint64_t samples_per_pixel() const override { return 1; }
    void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) override
    {
        key_ = random_word(pixel_key(seed, pixel), sample_index);
        begin_sample();
    }

private:
    void fill_block() override
    {
        const std::uint64_t first = std::uint64_t{block_number()} * (block_.size() / 2);
        for (std::size_t i = 0; i < block_.size(); i += 2) {
            const std::uint64_t word = random_word(key_, first + i / 2);
            block_[i] = static_cast<std::uint32_t>(word);
            block_[i + 1] = static_cast<std::uint32_t>(word >> 32);
        }
    }

    std::uint64_t key_;
};

} // namespace plumb
