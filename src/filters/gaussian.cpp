// SPDX-License-Identifier: MIT

#include "filters/tabulated.h"
#include "model/plugin.h"

#include <fmt/format.h>

namespace plumb {

/// A Gaussian that falls to 0 at the radius: f(x) = max(0, exp(-x^2 / 2s^2) - exp(-r^2 / 2s^2)) along each axis.
/// The default filter of every camera.
///
///     radius   float   where the filter ends, in pixels, greater than 0   (default 2)
///     stddev   float   the standard deviation s, in pixels, greater than 0   (default 0.5)
///
///         <rfilter type="gaussian">
///             <float name="stddev" value="0.4"/>
///         </rfilter>
class GaussianFilter final : public Filter {
public:
    explicit GaussianFilter(const Params& params)
        : radius_(params.number("radius", 2.f, Range{0.0, 16.0, true, false})),
          stddev_(params.number("stddev", 0.5f, Range{1e-3, 1e3, false, false})),
          profile_(radius_, [this](double x) { return evaluate_axis(x); })
    {
        // Else the curve is so flat that nothing is left of it once its value at the end is taken off.
        if (radius_ < 1e-4f * stddev_)
            params.fail("radius", fmt::format("must be at least stddev / 10000, which is {:.4g}, not {}",
                                              1e-4f * stddev_, radius_));
    }

    float radius() const override { return radius_; }

    float evaluate(const Vec2f& offset) const override
    {
        return static_cast<float>(evaluate_axis(offset.x) * evaluate_axis(offset.y));
    }

    FilterSample sample(const Vec2f& u) const override { return profile_.sample(u); }

private:
    double evaluate_axis(double x) const
    {
        const double alpha = -0.5 / (static_cast<double>(stddev_) * stddev_);
        return std::max(0.0, exp(alpha * x * x) - exp(alpha * static_cast<double>(radius_) * radius_));
    }

    float radius_;
    float stddev_;
    TabulatedProfile profile_;
};

template std::unique_ptr<Filter> build<GaussianFilter>(const Params&);

} // namespace plumb
