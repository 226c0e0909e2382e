// SPDX-License-Identifier: MIT
#include "base/float_mode.h"
#include "base/parallel.h"
#include "estimator_checks/quadrature.h"
#include "estimator_checks/statistic.h"
#include "plumb/math/elementary.h"
#include "plumb/statistics/statistics.h"

#include <mutex>

#include <fmt/format.h>

namespace plumb {

namespace {

// A density of 0 is one of rounding, too: this share of the samples may fall where it is 0.
constexpr double stray_share = 1e-5;

// What quadrature may be off by, in samples expected in a cell: a cell that counts expects some, with noise above 1.
constexpr double count_error = 0.05;

// Cells of equal solid angle: rows of cos theta, columns of phi.
class CellGrid {
public:
    explicit CellGrid(std::size_t resolution) : rows_(resolution), columns_(2 * resolution) {}

    std::size_t cells() const { return rows_ * columns_; }

    std::size_t cell_of(const Vec3f& direction) const
    {
        const double turns =
            atan2(static_cast<double>(direction.y), static_cast<double>(direction.x)) / (2.0 * pi_d);
        const std::size_t row = part_of(0.5 * (static_cast<double>(direction.z) + 1.0), rows_);
        return row * columns_ + part_of(turns < 0.0 ? turns + 1.0 : turns, columns_);
    }

    // In the plane of cos theta and phi.
    Rectangle2d area(std::size_t cell) const
    {
        const auto row = static_cast<double>(cell / columns_), column = static_cast<double>(cell % columns_);
        const double height = 2.0 / static_cast<double>(rows_),
                     width = 2.0 * pi_d / static_cast<double>(columns_);
        return {row * height - 1.0, (row + 1.0) * height - 1.0, column * width, (column + 1.0) * width};
    }

private:
    static std::size_t part_of(double x, std::size_t parts)
    {
        const double scaled = std::floor(x * static_cast<double>(parts));
        return std::min(static_cast<std::size_t>(std::max(scaled, 0.0)), parts - 1);
    }

    std::size_t rows_;
    std::size_t columns_;
};

// The chance that a sample falls into a cell.
double cell_chance(const Bsdf& bsdf, const Vec3f& wi, const Rectangle2d& cell, double tolerance)
{
    const auto density = [&](double cos_theta, double phi) {
        const double sine = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta));
        const SinCosD azimuth = sin_cos(phi);
        const Vec3f wo(static_cast<float>(sine * azimuth.cos), static_cast<float>(sine * azimuth.sin),
                       static_cast<float>(cos_theta));
        return static_cast<double>(bsdf.evaluate(SurfacePoint(), wi, wo).pdf);
    };
    const auto integral = [&](const Rectangle2d& area) {
        return area.x1 > area.x0 ? integrate(density, area, 8, tolerance) : 0.0;
    };
    // Densities jump at the horizon, which may cut a cell in two.
    const double horizon = std::clamp(0.0, cell.x0, cell.x1);
    return integral({cell.x0, horizon, cell.y0, cell.y1}) + integral({horizon, cell.x1, cell.y0, cell.y1});
}

std::vector<double> expected_counts(const Bsdf& bsdf, const Vec3f& wi, const CellGrid& grid,
                                    const RunOptions& options)
{
    const auto samples = static_cast<double>(options.samples);
    std::vector<double> expected(grid.cells());
    parallel_for(expected.size(), options.threads, [&](std::size_t cell) {
        const FlushDenormals flush;
        expected[cell] = samples * cell_chance(bsdf, wi, grid.area(cell), count_error / samples);
    });
    return expected;
}

struct Observed {
    std::vector<std::uint64_t> counts; // of each cell
    std::uint64_t not_finite = 0;
};

// Samples that the BSDF refuses fall into no cell.
Observed observe(const TestFile& file, const Bsdf& bsdf, const Vec3f& wi, const CellGrid& grid,
                 const RunOptions& options)
{
    const std::vector<Chunk> chunks = cut_into_chunks(options.samples);
    Observed all{std::vector<std::uint64_t>(grid.cells()), 0};
    std::mutex mutex;
    parallel_for(chunks.size(), options.threads, [&](std::size_t i) {
        const FlushDenormals flush;
        Stream stream(*file.sampler, options.seed, options.test_index, options.purpose);
        std::vector<std::size_t> cells;
        std::uint64_t not_finite = 0;
        for (std::uint64_t number = chunks[i].first; number < chunks[i].last; ++number) {
            Sampler& sampler = stream.sample(number);
            const float u_lobe = sampler.next_1d();
            const auto sample = bsdf.sample(SurfacePoint(), wi, u_lobe, sampler.next_2d());
            if (!sample) continue;
            if (is_finite(sample->wo) && is_finite(sample->weight))
                cells.push_back(grid.cell_of(sample->wo));
            else
                ++not_finite;
        }
        const std::lock_guard lock(mutex); // counts are the same in any order
        for (const std::size_t cell : cells) ++all.counts[cell];
        all.not_finite += not_finite;
    });
    return all;
}

// Pearson's test. Cells that expect too few samples are pooled, the smallest first, until the pool expects enough.
TestRun judge(const std::vector<double>& expected, const Observed& observed, double min_expected,
              const RunOptions& options)
{
    TestRun run;
    run.samples = options.samples;
    if (observed.not_finite > 0) {
        run.problem = fmt::format("{} samples are not finite", observed.not_finite);
        return run;
    }
    std::vector<std::size_t> order(expected.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });

    double terms = 0.0, pool_expected = 0.0, pool_count = 0.0;
    const auto add = [&](double count, double mean) {
        run.statistic += (count - mean) * (count - mean) / mean;
        terms += 1.0;
    };
    for (const std::size_t cell : order) {
        const auto count = static_cast<double>(observed.counts[cell]);
        if (!(expected[cell] >= 0.0)) {
            run.problem = "the density is negative or not a number";
            return run;
        }
        if (expected[cell] == 0.0) {
            if (count <= stray_share * static_cast<double>(options.samples)) continue;
            run.problem = fmt::format("{} samples fall into a cell where the density is 0", count);
            return run;
        }
        if (expected[cell] < min_expected || (pool_expected > 0.0 && pool_expected < min_expected)) {
            pool_expected += expected[cell];
            pool_count += count;
        } else {
            add(count, expected[cell]);
        }
    }
    if (pool_expected > 0.0) add(pool_count, pool_expected);
    run.degrees_of_freedom = terms - 1.0;
    if (run.degrees_of_freedom < 1.0)
        run.problem = "fewer than two cells expect enough samples; raise resolution or sampleCount";
    else
        run.p = chi2_survival(run.statistic, run.degrees_of_freedom);
    return run;
}

} // namespace

Vec3f random_direction(const TestFile& file, std::size_t test_index, std::uint64_t seed)
{
    Stream stream(*file.sampler, seed, test_index, Purpose::direction);
    const Vec2f u = stream.sample(0).next_2d();
    const float sine = safe_sqrt(1.f - u.x * u.x);
    const SinCos azimuth = sin_cos(two_pi * u.y);
    return {azimuth.cos * sine, azimuth.sin * sine, u.x};
}

TestRun test_bsdf_distribution(const TestFile& file, const Bsdf& bsdf, const Vec3f& wi,
                               const RunOptions& options)
{
    const CellGrid grid(file.resolution);
    const Observed observed = observe(file, bsdf, wi, grid, options);
    return judge(expected_counts(bsdf, wi, grid, options), observed, file.min_expected, options);
}

} // namespace plumb
