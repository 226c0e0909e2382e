// SPDX-License-Identifier: MIT
#pragma once

// The samples of a test, and their random numbers.

#include "plumb/model/sampler.h"

#include <algorithm>
#include <vector>

namespace plumb {

// Samples [first, last) are taken by one thread, in order.
struct Chunk {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
};

// A function of the number of samples alone, so that results do not depend on threads; at most about 65536 chunks.
inline std::vector<Chunk> cut_into_chunks(std::uint64_t samples)
{
    const std::uint64_t size = std::max<std::uint64_t>(4096, samples >> 16);
    std::vector<Chunk> chunks;
    for (std::uint64_t first = 0; first < samples; first += size)
        chunks.push_back({first, std::min(samples, first + size)});
    return chunks;
}

// What random numbers are for. Each purpose of each test has its own, independent of all others.
enum class Purpose { first_run, repetition, direction };

// Random numbers of one purpose of test `index`; sample by sample, as a function of the sample's number.
class Stream {
public:
    Stream(const Sampler& prototype, std::uint64_t seed, std::size_t test_index, Purpose purpose)
        : sampler_(prototype.clone(prototype.samples_per_pixel())),
          seed_(seed),
          key_(static_cast<int>(test_index), static_cast<int>(purpose))
    {}

    Sampler& sample(std::uint64_t number)
    {
        sampler_->start(seed_, key_, number);
        return *sampler_;
    }

private:
    std::unique_ptr<Sampler> sampler_;
    std::uint64_t seed_;
    Vec2i key_; // in place of a pixel
};

} // namespace plumb
