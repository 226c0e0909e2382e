// SPDX-License-Identifier: MIT

#include "model/plugin.h"

#include "plumb/model/filter.h"

namespace plumb {

/// A tent: f(x) = max(0, 1 - |x| / radius) along each axis.
///
///     radius   float   where the filter ends, in pixels, greater than 0   (default 1)
///
///         <rfilter type="tent"/>
class TentFilter final : public Filter {
public:
    explicit TentFilter(const Params& params)
        : radius_(params.number("radius", 1.f, Range{0.0, 16.0, true, false}))
    {}

    float radius() const override { return radius_; }

    float evaluate(const Vec2f& offset) const override
    {
        return std::max(0.f, 1.f - std::abs(offset.x) / radius_) *
               std::max(0.f, 1.f - std::abs(offset.y) / radius_);
    }

    FilterSample sample(const Vec2f& u) const override { return {{sample_axis(u.x), sample_axis(u.y)}, 1.f}; }

private:
    // The inverse of the tent's cumulative distribution, half by half.
    float sample_axis(float u) const
    {
        return radius_ * (u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f - 2.f * u));
    }

    float radius_;
};

template std::unique_ptr<Filter> build<TentFilter>(const Params&);

} // namespace plumb
