// SPDX-License-Identifier: MIT
#pragma once

// What the differences d = a - b of one channel tell in the squares of one size.

#include "compare/estimate.h"
#include "compare/squares.h"

#include <optional>
#include <vector>

namespace plumb {

// One channel of both images. What does not count is 0.
struct PairedPixels {
    int width = 0;
    int height = 0;
    std::vector<char> counted;
    std::vector<double> differences;
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> variances; // of one image where the other's are unknown; empty: both unknown
    std::vector<char> black_a;     // no channel has light
    std::vector<char> black_b;

    PairedPixels(const ComparedImage& a, const ComparedImage& b, std::size_t channel,
                 const std::vector<char>& counted);

    // The variance that the second differences of d along x and y show, of independent pixels: what is smooth is not in
    // it. One a pixel; negative where a neighbour is missing.
    std::vector<double> rough_variances() const;
};

// Sums over the pixels of a square; z = d - mean of d.
struct PairedSums {
    double pixels = 0.0;
    double difference = 0.0; // sum of d
    double square = 0.0;     // sum of d^2
    double fourth = 0.0;     // sum of d^4
    double spread = 0.0;     // sum of z^2
    double spread_fourth = 0.0;
    double largest = 0.0; // z^2
    double a = 0.0;
    double b = 0.0;
    double variance = 0.0; // known, of the sum
    bool black_a = true;
    bool black_b = true;

    // Of the sum of d, if the pixels are independent.
    double difference_variance() const { return pixels > 1.0 ? spread * pixels / (pixels - 1.0) : 0.0; }
    // (sum z^2)^2 / sum z^4: how many pixels carry the spread. Of normal noise a third of them.
    double effective_pixels() const { return spread_fourth > 0.0 ? spread * spread / spread_fourth : pixels; }
};

std::vector<PairedSums> paired_sums(const PairedPixels& pixels, const Squares& squares);

} // namespace plumb
