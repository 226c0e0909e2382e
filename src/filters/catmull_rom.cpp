// SPDX-License-Identifier: MIT

// [1] Catmull and Rom 1974, "A Class of Local Interpolating Splines", Computer Aided Geometric Design.
// [2] Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", SIGGRAPH, equation 8 with B = 0, C = 1/2.

#include "filters/tabulated.h"
#include "model/plugin.h"

namespace plumb {

/// The cubic of Catmull and Rom [1], which is that of Mitchell and Netravali [2] with B = 0 and C = 1/2, along each axis:
/// sharp, with negative lobes. It ends 2 pixels from the pixel's middle.
///
///         <rfilter type="catmullrom"/>
class CatmullRomFilter final : public Filter {
public:
    explicit CatmullRomFilter(const Params&) : profile_(2.f, evaluate_axis) {}

    float radius() const override { return 2.f; }

    float evaluate(const Vec2f& offset) const override
    {
        return static_cast<float>(evaluate_axis(offset.x) * evaluate_axis(offset.y));
    }

    FilterSample sample(const Vec2f& u) const override { return profile_.sample(u); }

private:
    static double evaluate_axis(double offset)
    {
        const double x = std::abs(offset);
        if (x < 1.0) return 0.5 * ((3.0 * x - 5.0) * x * x + 2.0);
        if (x < 2.0) return 0.5 * (((5.0 - x) * x - 8.0) * x + 4.0);
        return 0.0;
    }

    TabulatedProfile profile_;
};

template std::unique_ptr<Filter> build<CatmullRomFilter>(const Params&);

} // namespace plumb
