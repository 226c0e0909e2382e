// SPDX-License-Identifier: MIT
#pragma once

// How efficient an estimator is: 1 / (time x variance), which more samples do not change. From a number of pictures, each
// with a seed of its own: the spread between those is the right one for any sampler, also where a picture's samples are not
// independent of each other.

#include <optional>
#include <vector>

namespace plumb {

// Of each of the pictures, 3 or more: the seconds that it took, and how far it is from the mean of all pictures: the mean
// of the squared differences over pixels and channels.
struct Rounds {
    std::vector<double> seconds;
    std::vector<double> deviations;

    double mean_seconds() const;
    double variance() const; // of one picture, the mean over pixels and channels; unbiased
};

// low to high: a 95 % interval.
struct Ratio {
    double value = 1.0;
    double low = 1.0;
    double high = 1.0;
};

// The efficiency of one over that of another one, whose pictures were rendered in turn with its own. By the jackknife of
// the ratio's logarithm over the rounds, which knows of noise that comes in rounds, such as that of a machine that is
// not calm. Nothing if one of them has no variance.
std::optional<Ratio> efficiency_ratio(const Rounds& one, const Rounds& other);

} // namespace plumb
