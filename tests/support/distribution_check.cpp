// SPDX-License-Identifier: MIT

// check_distribution() and the quadrature under it.

#include "support/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb::test {

namespace {

// Gauss-Legendre quadrature with five points on [-1, 1].
constexpr int points = 5;
constexpr double abscissas[points] = {-0.906179845938663992797626878299, -0.538469310105683091036314420700,
                                      0.0, 0.538469310105683091036314420700,
                                      0.906179845938663992797626878299};
constexpr double weights[points] = {0.236926885056189087514264040720, 0.478628670499366468041291514836,
                                    0.568888888888888888888888888889, 0.478628670499366468041291514836,
                                    0.236926885056189087514264040720};

// What a cell, and the sum of all cells, may be off by.
constexpr double cell_error = 1e-6;
constexpr double quadrature_error = 2e-5;

double gauss(const PlaneDensity& density, double x0, double x1, double y0, double y1)
{
    const double cx = 0.5 * (x0 + x1), hx = 0.5 * (x1 - x0);
    const double cy = 0.5 * (y0 + y1), hy = 0.5 * (y1 - y0);
    double sum = 0.0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j)
            sum += weights[i] * weights[j] * density(cx + hx * abscissas[i], cy + hy * abscissas[j]);
    return sum * hx * hy;
}

// Splits a rectangle in four until the parts agree with the whole. The tolerance only halves when the area
// quarters: along a discontinuity the number of rectangles that do not agree doubles with every level.
double refine(const PlaneDensity& density, double x0, double x1, double y0, double y1, double whole,
              double tolerance, int depth)
{
    const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
    const double a = gauss(density, x0, xm, y0, ym);
    const double b = gauss(density, xm, x1, y0, ym);
    const double c = gauss(density, x0, xm, ym, y1);
    const double d = gauss(density, xm, x1, ym, y1);
    const double sum = a + b + c + d;
    if (depth == 0 || std::abs(sum - whole) <= tolerance) return sum;
    return refine(density, x0, xm, y0, ym, a, tolerance / 2, depth - 1) +
           refine(density, xm, x1, y0, ym, b, tolerance / 2, depth - 1) +
           refine(density, x0, xm, ym, y1, c, tolerance / 2, depth - 1) +
           refine(density, xm, x1, ym, y1, d, tolerance / 2, depth - 1);
}

std::size_t cells(const Grid& grid)
{
    return static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
}

// The chance of each cell; the last entry is the chance of no sample.
std::vector<double> expected_chances(const Grid& grid, const PlaneDensity& density)
{
    const double dx = (grid.x_max - grid.x_min) / grid.columns;
    const double dy = (grid.y_max - grid.y_min) / grid.rows;
    std::vector<double> chances;
    double sum = 0.0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const double x = grid.x_min + column * dx;
            const double y = grid.y_min + row * dy;
            chances.push_back(integrate(density, x, x + dx, y, y + dy, 1e-7));
            sum += chances.back();
        }
    }
    chances.push_back(std::max(0.0, 1.0 - sum));
    return chances;
}

struct Observed {
    std::vector<std::uint64_t> counts; // as the chances
    std::uint64_t off_grid = 0;
};

Observed observe(const Grid& grid, const PlaneSampler& sample, std::uint64_t samples, std::uint64_t seed)
{
    Observed observed{std::vector<std::uint64_t>(cells(grid) + 1), 0};
    TestRandom random(seed);
    for (std::uint64_t i = 0; i < samples; ++i) {
        const auto place = sample(random);
        if (!place) {
            ++observed.counts.back();
            continue;
        }
        const double x = (place->x - grid.x_min) / (grid.x_max - grid.x_min);
        const double y = (place->y - grid.y_min) / (grid.y_max - grid.y_min);
        const double slack = 1e-6; // rounding may leave the grid by a hair
        if (!(x >= -slack && x <= 1.0 + slack && y >= -slack && y <= 1.0 + slack)) {
            ++observed.off_grid;
            continue;
        }
        const auto column = std::clamp(static_cast<int>(x * grid.columns), 0, grid.columns - 1);
        const auto row = std::clamp(static_cast<int>(y * grid.rows), 0, grid.rows - 1);
        ++observed.counts[static_cast<std::size_t>(row * grid.columns + column)];
    }
    return observed;
}

// Whether a Poisson variable of this mean is hardly ever so large.
bool too_many(double count, double mean)
{
    return count > 0.0 && regularised_gamma_p(count, mean) < 1e-9;
}

Outcome chi2_outcome(const std::vector<double>& chances, const Observed& observed, std::uint64_t samples)
{
    if (observed.off_grid > 0) return {0.0, fmt::format("{} samples off the grid", observed.off_grid)};
    const auto n = static_cast<double>(samples);

    // Largest expectation first, so that what is pooled comes last.
    std::vector<std::size_t> order(chances.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return chances[a] > chances[b]; });

    double statistic = 0.0, pooled_expected = 0.0, pooled_count = 0.0;
    int terms = 0;
    const auto add = [&](double count, double expected) {
        statistic += (count - expected) * (count - expected) / expected;
        ++terms;
    };
    for (const auto i : order) {
        const bool refused = i + 1 == chances.size();
        const double expected = chances[i] * n;
        const auto count = static_cast<double>(observed.counts[i]);
        if (refused && std::max(chances[i], count / n) < quadrature_error) continue;
        if (chances[i] < cell_error) { // the quadrature may not have seen a sliver of density in this cell
            if (too_many(count, expected + cell_error * n))
                return {0.0, fmt::format("{} samples {}", count,
                                         refused ? "refused where the density integrates to 1"
                                                 : "where the density is 0")};
            continue;
        }
        if (expected >= 5.0) {
            add(count, expected);
        } else {
            pooled_expected += expected;
            pooled_count += count;
        }
    }
    if (pooled_expected >= 5.0) {
        add(pooled_count, pooled_expected);
    } else if (too_many(pooled_count, pooled_expected)) {
        return {0.0, fmt::format("{} samples where {} are expected", pooled_count, pooled_expected)};
    }

    const double p = terms > 1 ? chi2_survival(statistic, terms - 1) : 1.0;
    return {p, fmt::format("chi2 = {} with {} cells, {} samples", statistic, terms, samples)};
}

// Directions as points (s, phi) of the grid's plane, and back. Double precision throughout.
class SphereMap {
public:
    explicit SphereMap(const SphereGrid& grid) : n_(Imath::V3d(grid.axis)), concentration_(grid.concentration)
    {
        // Of the cells about the axis, some have the surface's horizon in their middle: along their border it would
        // cut off slivers that quadrature does not see.
        n_ = normalize(n_);
        const Vec3d t = normalize(cross(n_, std::abs(n_.z) < 0.99 ? Vec3d(0, 0, 1) : Vec3d(0, 1, 0)));
        const Vec3d s = cross(t, n_);
        const double half_cell = pi_d / grid.phi_cells;
        s_ = s * std::cos(half_cell) + t * std::sin(half_cell);
        t_ = cross(n_, s_);
    }

    Imath::V2d place(const Vec3f& direction) const
    {
        const Vec3d w(direction);
        const double half = 0.5 * std::atan2(length(cross(w, n_)), dot(w, n_));
        const double s = std::pow(std::sin(half) * std::sin(half), 1.0 / concentration_);
        const double phi = std::atan2(dot(w, t_), dot(w, s_));
        return {s, phi < 0.0 ? phi + 2.0 * pi_d : phi};
    }

    Vec3f direction(double s, double phi) const
    {
        const double one_minus_cos = 2.0 * std::pow(s, concentration_);
        const double sine = std::sqrt(one_minus_cos * (2.0 - one_minus_cos));
        return Vec3f(s_ * (sine * std::cos(phi)) + t_ * (sine * std::sin(phi)) + n_ * (1.0 - one_minus_cos));
    }

    // Solid angle per unit of ds dphi.
    double jacobian(double s) const { return 2.0 * concentration_ * std::pow(s, concentration_ - 1.0); }

private:
    Vec3d s_, t_, n_;
    double concentration_;
};

Grid plane_grid(const SphereGrid& grid)
{
    return {0.0, 1.0, 0.0, 2.0 * pi_d, grid.cos_theta_cells, grid.phi_cells};
}

} // namespace

double integrate(const PlaneDensity& density, double x0, double x1, double y0, double y1, double tolerance)
{
    return refine(density, x0, x1, y0, y1, gauss(density, x0, x1, y0, y1), tolerance, 10);
}

Outcome distribution_outcome(const Grid& grid, const PlaneSampler& sample, const PlaneDensity& density,
                             std::uint64_t samples, std::uint64_t seed)
{
    const auto chances = expected_chances(grid, density);
    double integral = 0.0;
    for (std::size_t i = 0; i < cells(grid); ++i) integral += chances[i];
    if (!(integral <= 1.0 + quadrature_error))
        return {0.0, fmt::format("the density integrates to {}", integral)};
    return chi2_outcome(chances, observe(grid, sample, samples, seed), samples);
}

bool check_distribution(const std::string& name, const Grid& grid, const PlaneSampler& sample,
                        const PlaneDensity& density, std::uint64_t samples, double level, std::uint64_t seed)
{
    const auto run = [&](std::uint64_t n, std::uint64_t s) {
        return distribution_outcome(grid, sample, density, n, s);
    };
    return check_statistic(name, run, samples, level, seed);
}

Outcome distribution_outcome(const SphereGrid& grid, const DirectionSampler& sample,
                             const DirectionDensity& density, std::uint64_t samples, std::uint64_t seed)
{
    const SphereMap map(grid);
    const auto place = [&](TestRandom& random) -> std::optional<Imath::V2d> {
        const auto direction = sample(random);
        if (!direction) return std::nullopt;
        return map.place(*direction);
    };
    const auto plane_density = [&](double s, double phi) {
        return density(map.direction(s, phi)) * map.jacobian(s);
    };
    return distribution_outcome(plane_grid(grid), place, plane_density, samples, seed);
}

bool check_distribution(const std::string& name, const SphereGrid& grid, const DirectionSampler& sample,
                        const DirectionDensity& density, std::uint64_t samples, double level,
                        std::uint64_t seed)
{
    const auto run = [&](std::uint64_t n, std::uint64_t s) {
        return distribution_outcome(grid, sample, density, n, s);
    };
    return check_statistic(name, run, samples, level, seed);
}

double integrate_sphere(const SphereGrid& grid, const std::function<double(const Vec3f&)>& value,
                        double tolerance)
{
    const SphereMap map(grid);
    const auto density = [&](double s, double phi) { return value(map.direction(s, phi)) * map.jacobian(s); };
    const Grid plane = plane_grid(grid);
    const double ds = 1.0 / plane.columns;
    const double dphi = plane.y_max / plane.rows;
    double sum = 0.0;
    for (int i = 0; i < plane.columns; ++i)
        for (int j = 0; j < plane.rows; ++j)
            sum += integrate(density, i * ds, (i + 1) * ds, j * dphi, (j + 1) * dphi, tolerance);
    return sum;
}

} // namespace plumb::test
