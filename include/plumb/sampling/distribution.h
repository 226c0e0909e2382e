// SPDX-License-Identifier: MIT
#pragma once

// Choosing one of n things in proportion to given weights.
//
// Built serially in the order given, in double precision, so that it has the same bits everywhere. 12 bytes a thing.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plumb {

class DiscreteDistribution {
public:
    struct Choice {
        std::uint32_t index;
        float probability;
        double u; // what is left of the random number, uniform in [0, 1) again
    };

    DiscreteDistribution() = default;
    explicit DiscreteDistribution(std::span<const double> weights); // finite, not negative

    std::size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }
    double sum() const { return sum_; }
    bool can_sample() const { return sum_ > 0.0; }

    // u in [0, 1). Never chooses a thing of weight 0, nor one whose share of the sum is below 2^-53, the step of u:
    // the probability of what is chosen is positive. Needs can_sample().
    Choice sample(double u) const
    {
        return cdf_.size() == 2 ? Choice{0, 1.f, std::clamp(u, 0.0, largest_below_one)} : sample_several(u);
    }
    float probability(std::size_t index) const { return static_cast<float>(cdf_[index + 1] - cdf_[index]); }

    // The share of all things before this one.
    double begin_of(std::size_t index) const { return cdf_[index]; }

    // The same among the things from number `first` to the one before `last`; nothing where they have no weight.
    struct Pick {
        std::uint32_t index;
        double share; // of theirs
    };
    std::optional<Pick> sample_among(std::size_t first, std::size_t last, double u) const;
    double share_among(std::size_t index, std::size_t first,
                       std::size_t last) const // 0 where they have no weight
    {
        const double all = cdf_[last] - cdf_[first];
        return all > 0.0 ? (cdf_[index + 1] - cdf_[index]) / all : 0.0;
    }

    std::uint64_t memory_bytes() const
    {
        return cdf_.capacity() * sizeof(double) + guide_.capacity() * sizeof(std::uint32_t);
    }

private:
    static constexpr double largest_below_one = 0x1.fffffffffffffp-1;
    Choice sample_several(double u) const;

    std::size_t bucket_of(double u) const
    {
        return static_cast<std::size_t>(u * static_cast<double>(size()));
    }

    std::vector<double> cdf_; // size + 1 values from 0 to 1
    // Of several things: for each of as many buckets of u, where the first end is that lies in it or beyond.
    std::vector<std::uint32_t> guide_;
    double sum_ = 0.0;
};

} // namespace plumb
