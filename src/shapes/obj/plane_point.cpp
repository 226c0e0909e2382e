// SPDX-License-Identifier: MIT

// [1] Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
//     Discrete & Computational Geometry 18. https://doi.org/10.1007/PL00009321

#include "shapes/obj/plane_point.h"

#include <array>
#include <cmath>

namespace plumb {

int turn_sign(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    const double left = (b.x - a.x) * (c.y - a.y);
    const double right = (b.y - a.y) * (c.x - a.x);
    const double rounded = left - right;
    constexpr double bound = 3.3306690738754716e-16; // [1], section 4.1: (3 + 16 u) u with u = 2^-53
    if (std::abs(rounded) > bound * (std::abs(left) + std::abs(right))) return rounded > 0.0 ? 1 : -1;

    // The same as a sum of products, each of which is exact, summed up without rounding: [1], Grow-Expansion.
    const double products[] = {b.x * c.y, -(b.x * a.y), -(a.x * c.y), -(b.y * c.x), b.y * a.x, a.y * c.x};
    std::array<double, 6> sum{}; // of parts that do not overlap, smallest first
    std::size_t count = 0;
    for (double carry : products) {
        for (std::size_t i = 0; i < count; ++i) {
            const double total = carry + sum[i]; // [1], Two-Sum
            const double part = total - carry;
            const double lost = (carry - (total - part)) + (sum[i] - part);
            sum[i] = lost;
            carry = total;
        }
        sum[count++] = carry;
    }
    for (std::size_t i = count; i-- > 0;)
        if (sum[i] != 0.0) return sum[i] > 0.0 ? 1 : -1;
    return 0;
}

} // namespace plumb
