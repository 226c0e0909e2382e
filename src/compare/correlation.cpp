// SPDX-License-Identifier: MIT
#include "compare/correlation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace plumb {

namespace {

constexpr int block_side = 32;
constexpr int farthest = 10;              // pixels
constexpr std::size_t most_blocks = 1024; // they overlap by half, and a large image has enough of them
constexpr double significant = 2.5;       // standard errors
constexpr double negligible = 0.02;       // of the inflation

// The deviations from the mean of a block, and the sum of their squares.
struct Block {
    std::vector<double> deviations;
    double square = 0.0;
};

std::vector<Block> take_blocks(const std::vector<double>& values, int width, int height, int side)
{
    std::vector<std::pair<int, int>> corners;
    const int step = std::max(1, side / 2);
    for (int y = 0; y + side <= height; y += step)
        for (int x = 0; x + side <= width; x += step) corners.emplace_back(x, y);
    const std::size_t stride = (corners.size() + most_blocks - 1) / most_blocks;
    std::vector<Block> blocks;
    for (std::size_t k = 0; k < corners.size(); k += stride) {
        const auto [left, top] = corners[k];
        Block block;
        double mean = 0.0;
        for (int y = 0; y < side; ++y) {
            const auto row = values.begin() + (static_cast<std::ptrdiff_t>(top + y) * width + left);
            block.deviations.insert(block.deviations.end(), row, row + side);
        }
        for (const double value : block.deviations) mean += value;
        mean /= static_cast<double>(block.deviations.size());
        for (double& value : block.deviations) {
            value -= mean;
            block.square += value * value;
        }
        if (block.square > 0.0 && std::isfinite(block.square)) blocks.push_back(std::move(block));
    }
    return blocks;
}

// The sum of rho over the 8 `distance` shifts whose larger coordinate is `distance`.
double ring_sum(const Block& block, int side, int distance)
{
    double sum = 0.0;
    const double values = static_cast<double>(side) * side;
    for (int dy = 0; dy <= distance; ++dy) {
        for (int dx = -distance; dx <= distance; ++dx) {
            if (std::max(std::abs(dx), dy) != distance || (dy == 0 && dx < 0)) continue;
            double products = 0.0;
            for (int y = 0; y + dy < side; ++y) {
                const double* row = block.deviations.data() + static_cast<std::ptrdiff_t>(y) * side;
                const double* other = row + static_cast<std::ptrdiff_t>(dy) * side + dx;
                const int end = side - std::max(dx, 0);
                for (int x = std::max(-dx, 0); x < end; ++x) products += row[x] * other[x];
            }
            const double pairs = static_cast<double>(side - dy) * (side - std::abs(dx));
            sum += 2.0 * products / block.square * values / pairs; // and the opposite shift
        }
    }
    return sum;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

} // namespace

Correlation measure_correlation(const std::vector<double>& values, int width, int height)
{
    Correlation result;
    const int side = std::min({block_side, width, height});
    const std::vector<Block> blocks = take_blocks(values, width, height, side);
    if (blocks.empty()) return result;

    const double pixels = static_cast<double>(width) * height;
    const double in_block = static_cast<double>(side) * side;
    const int last = std::clamp(side / 3, 1, farthest);
    std::vector<double> sums(blocks.size(), 1.0); // of rho up to this ring, as seen in each block
    double shifts = 1.0;
    double squared_error = 0.0;
    for (int distance = 1; distance <= last; ++distance) {
        std::vector<double> ring;
        ring.reserve(blocks.size());
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            ring.push_back(ring_sum(blocks[i], side, distance));
            sums[i] += ring.back();
        }
        const double in_ring = 8.0 * distance;
        shifts += in_ring;
        // Of a sum of pairs of opposite shifts, each with the variance 1 / pixels where the values are independent;
        // 1.3: a median's is larger than a mean's.
        const double error = 1.3 * std::sqrt(2.0 * in_ring / pixels * std::max(1.0, 0.5 * result.inflation));
        const double found = median(ring) + in_ring * result.inflation / in_block;
        squared_error += error * error;
        const double inflation =
            shifts < in_block ? median(sums) / (1.0 - shifts / in_block) : result.inflation;
        if (found < std::max(significant * error, negligible * result.inflation)) {
            if (distance == 1) result.inflation = std::max(result.inflation, inflation);
            result.reach = distance - 1;
            result.inflation += std::sqrt(squared_error);
            return result;
        }
        result.inflation = std::max(result.inflation, inflation);
    }
    result.reach.reset();
    result.inflation += std::sqrt(squared_error);
    return result;
}

} // namespace plumb
