// SPDX-License-Identifier: MIT

// [1] Abramowitz and Stegun 1964, Handbook of Mathematical Functions.

#include "estimator_checks/quadrature.h"

#include <cmath>

namespace plumb {

namespace {

using Function = std::function<double(double, double)>;

constexpr int max_depth = 8;

// [1], table 25.4: the Gauss-Legendre rule with five points on [-1, 1], in the plane.
double gauss(const Function& f, const Rectangle2d& r)
{
    struct Point {
        double at;
        double weight;
    };
    static constexpr Point points[] = {{-0.906179845938664, 0.236926885056189},
                                       {-0.538469310105683, 0.478628670499366},
                                       {0.0, 0.568888888888889},
                                       {0.538469310105683, 0.478628670499366},
                                       {0.906179845938664, 0.236926885056189}};
    const double half_x = 0.5 * (r.x1 - r.x0), half_y = 0.5 * (r.y1 - r.y0);
    double sum = 0.0;
    for (const Point& x : points)
        for (const Point& y : points)
            sum += x.weight * y.weight * f(r.x0 + half_x * (1.0 + x.at), r.y0 + half_y * (1.0 + y.at));
    return sum * half_x * half_y;
}

// The tolerance only halves when the area quarters: along an edge of f the number of rectangles that do not agree
// doubles with every level.
double refine(const Function& f, const Rectangle2d& r, double whole, double tolerance, int depth)
{
    const double x = 0.5 * (r.x0 + r.x1), y = 0.5 * (r.y0 + r.y1);
    const Rectangle2d quarters[] = {
        {r.x0, x, r.y0, y}, {x, r.x1, r.y0, y}, {r.x0, x, y, r.y1}, {x, r.x1, y, r.y1}};
    double parts[4];
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += parts[i] = gauss(f, quarters[i]);
    if (depth == max_depth || !(std::abs(sum - whole) > tolerance))
        return sum; // also where f is not a number
    sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += refine(f, quarters[i], parts[i], 0.5 * tolerance, depth + 1);
    return sum;
}

} // namespace

double integrate(const Function& f, const Rectangle2d& area, int parts, double tolerance)
{
    const double dx = (area.x1 - area.x0) / parts, dy = (area.y1 - area.y0) / parts;
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) {
        for (int j = 0; j < parts; ++j) {
            const Rectangle2d part{area.x0 + i * dx, area.x0 + (i + 1) * dx, area.y0 + j * dy,
                                   area.y0 + (j + 1) * dy};
            sum += refine(f, part, gauss(f, part), tolerance / parts, 0);
        }
    }
    return sum;
}

} // namespace plumb
