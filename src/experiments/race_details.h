// SPDX-License-Identifier: MIT
#pragma once

// What a race computes of the images of an estimator.

#include "plumb/experiments/race.h"

#include <span>

namespace plumb {

// The mean of the images, with the variance that it has by their spread.
Image mean_image(std::span<const Image> images);

// Of each image: the mean of the squared differences from another image, over pixels and channels.
std::vector<double> squared_distances(std::span<const Image> images, const Image& other);

// What errors are measured against.
class Truth {
public:
    explicit Truth(const Image& reference); // with its error bars, if it has any
    // Throws Error if the reference has other pixels.
    void check(const PixelRect& window) const;
    // Of each image, without the noise of the reference.
    std::vector<double> squared_errors(std::span<const Image> images) const;

private:
    Image colors_;
    double noise_ = 0.0;
};

// Without a truth that of the noise, from the spread.
std::optional<Bounded> error_of(std::span<const Image> images, const std::optional<Truth>& truth);

// RaceRow::efficiency_map. mean: with the variances of the mean of so many images. rays: of a pixel, in any unit.
Image efficiency_map(const Image& mean, std::size_t images, double seconds, const std::optional<Image>& rays);

} // namespace plumb
