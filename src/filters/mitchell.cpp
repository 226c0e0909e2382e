// SPDX-License-Identifier: MIT

// [1] Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", SIGGRAPH.

#include "filters/tabulated.h"
#include "model/plugin.h"

namespace plumb {

/// The cubic of Mitchell and Netravali, [1], equation 8, along each axis: sharper than a Gaussian, with negative
/// lobes; the argument of their function is 2|x| / radius.
///
///     radius   float   where the filter ends, in pixels, greater than 0   (default 2)
///     B        float   blur, in [0, 1]   (default 1/3)
///     C        float   ringing, in [0, 1]   (default 1/3)
///
///         <rfilter type="mitchell"/>
class MitchellFilter final : public Filter {
public:
    explicit MitchellFilter(const Params& params)
        : radius_(params.number("radius", 2.f, Range{0.0, 16.0, true, false})),
          b_(params.number("B", 1.f / 3.f, Range::closed(0.0, 1.0))),
          c_(params.number("C", 1.f / 3.f, Range::closed(0.0, 1.0))),
          profile_(radius_, [this](double x) { return evaluate_axis(x); })
    {}

    float radius() const override { return radius_; }

    float evaluate(const Vec2f& offset) const override
    {
        return static_cast<float>(evaluate_axis(offset.x) * evaluate_axis(offset.y));
    }

    FilterSample sample(const Vec2f& u) const override { return profile_.sample(u); }

private:
    double evaluate_axis(double offset) const
    {
        const double x = 2.0 * std::abs(offset) / radius_;
        const double x2 = x * x;
        const double x3 = x2 * x;
        const double b = b_;
        const double c = c_;
        if (x < 1.0)
            return ((12.0 - 9.0 * b - 6.0 * c) * x3 + (-18.0 + 12.0 * b + 6.0 * c) * x2 + (6.0 - 2.0 * b)) /
                   6.0;
        if (x < 2.0)
            return ((-b - 6.0 * c) * x3 + (6.0 * b + 30.0 * c) * x2 + (-12.0 * b - 48.0 * c) * x +
                    (8.0 * b + 24.0 * c)) /
                   6.0;
        return 0.0;
    }

    float radius_;
    float b_;
    float c_;
    TabulatedProfile profile_;
};

template std::unique_ptr<Filter> build<MitchellFilter>(const Params&);

} // namespace plumb
