// SPDX-License-Identifier: MIT

#include "model/plugin.h"

#include "plumb/model/filter.h"

namespace plumb {

/// A box: every sample within the radius counts the same. With the default radius, the mean over the pixel's area.
///
///     radius   float   half the width of the box, in pixels, greater than 0   (default 0.5)
///
///         <rfilter type="box"/>
class BoxFilter final : public Filter {
public:
    explicit BoxFilter(const Params& params)
        : radius_(params.number("radius", 0.5f, Range{0.0, 16.0, true, false}))
    {}

    float radius() const override { return radius_; }

    float evaluate(const Vec2f& offset) const override
    {
        return std::abs(offset.x) <= radius_ && std::abs(offset.y) <= radius_ ? 1.f : 0.f;
    }

    FilterSample sample(const Vec2f& u) const override
    {
        return {{(2.f * u.x - 1.f) * radius_, (2.f * u.y - 1.f) * radius_}, 1.f};
    }

private:
    float radius_;
};

template std::unique_ptr<Filter> build<BoxFilter>(const Params&);

} // namespace plumb
