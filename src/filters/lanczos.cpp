// SPDX-License-Identifier: MIT

// [1] Duchon 1979, "Lanczos Filtering in One and Two Dimensions", Journal of Applied Meteorology 18(8), equation 11.

#include "filters/tabulated.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"

namespace plumb {

/// A windowed sinc [1]: f(x) = sinc(x) sinc(x / lobes) with sinc(x) = sin(pi x) / (pi x) along each axis, up to `lobes`
/// pixels from the pixel's middle. Very sharp; it rings.
///
///     lobes   integer   from 1 to 16   (default 3)
///
///         <rfilter type="lanczos">
///             <integer name="lobes" value="2"/>
///         </rfilter>
class LanczosFilter final : public Filter {
public:
    explicit LanczosFilter(const Params& params)
        : lobes_(static_cast<float>(params.integer("lobes", 3, Range::closed(1, 16)))),
          profile_(lobes_, [this](double x) { return evaluate_axis(x); })
    {}

    float radius() const override { return lobes_; }

    float evaluate(const Vec2f& offset) const override
    {
        return static_cast<float>(evaluate_axis(offset.x) * evaluate_axis(offset.y));
    }

    FilterSample sample(const Vec2f& u) const override { return profile_.sample(u); }

private:
    static double sinc(double x)
    {
        const double angle = pi_d * x;
        return std::abs(angle) < 1e-6 ? 1.0 : sin_cos(angle).sin / angle;
    }

    double evaluate_axis(double offset) const
    {
        const double x = std::abs(offset), lobes = lobes_;
        return x < lobes ? sinc(x) * sinc(x / lobes) : 0.0;
    }

    float lobes_;
    TabulatedProfile profile_;
};

template std::unique_ptr<Filter> build<LanczosFilter>(const Params&);

} // namespace plumb
