// SPDX-License-Identifier: MIT
#pragma once

// A separable, even filter whose one-dimensional profile is sampled from a table of its absolute value.
//
// The table has 1024 cells over [0, radius], constant in each. The profile that is sampled so differs from f by its
// curvature over a cell, a relative 1e-6; the weight is the same for all samples but for its sign.

#include "plumb/model/filter.h"
#include "plumb/sampling/distribution.h"

#include <array>
#include <functional>

namespace plumb {

class TabulatedProfile {
public:
    TabulatedProfile(float radius, const std::function<double(double)>& f) : radius_(radius)
    {
        std::array<double, cells> weights{};
        double integral = 0.0;
        for (std::size_t i = 0; i < cells; ++i) {
            const double value = f((static_cast<double>(i) + 0.5) / cells * radius);
            weights[i] = std::abs(value);
            negative_[i] = value < 0.0;
            integral += value;
        }
        distribution_ = DiscreteDistribution(weights);
        weight_ = static_cast<float>(distribution_.sum() / integral);
    }

    float radius() const { return radius_; }

    // One axis: the offset, and its share of the sample's weight.
    struct Draw {
        float offset;
        float weight;
    };
    Draw sample(float u) const
    {
        const bool left = u < 0.5f;
        const double half = left ? 2.0 * u : 2.0 * u - 1.0;
        const DiscreteDistribution::Choice choice = distribution_.sample(half);
        const auto x = static_cast<float>((choice.index + choice.u) / cells * radius_);
        return {left ? -x : x, negative_[choice.index] ? -weight_ : weight_};
    }

    FilterSample sample(const Vec2f& u) const
    {
        const Draw x = sample(u.x);
        const Draw y = sample(u.y);
        return {{x.offset, y.offset}, x.weight * y.weight};
    }

private:
    static constexpr std::size_t cells = 1024;
    float radius_;
    DiscreteDistribution distribution_;
    std::array<bool, cells> negative_{};
    float weight_ = 1.f;
};

} // namespace plumb
