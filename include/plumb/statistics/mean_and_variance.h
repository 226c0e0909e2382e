// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/math/math.h"

namespace plumb {

// Mean and variance of a stream of numbers (Welford 1962), and of two streams together (Chan, Golub and LeVeque 1983).
class MeanAndVariance {
public:
    void add(double x)
    {
        ++count_;
        const double delta = x - mean_;
        mean_ += delta / static_cast<double>(count_);
        sum_of_squares_ += delta * (x - mean_);
    }

    void add(const MeanAndVariance& other)
    {
        if (other.count_ == 0) return;
        const auto both = static_cast<double>(count_ + other.count_);
        const double share = static_cast<double>(other.count_) / both;
        const double delta = other.mean_ - mean_;
        sum_of_squares_ += other.sum_of_squares_ + delta * delta * share * static_cast<double>(count_);
        mean_ += delta * share;
        count_ += other.count_;
    }

    std::uint64_t count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const { return count_ > 1 ? sum_of_squares_ / static_cast<double>(count_ - 1) : 0.0; }
    double standard_error() const // of the mean
    {
        return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_)) : 0.0;
    }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0.0;
    double sum_of_squares_ = 0.0; // of the distances from the mean
};

} // namespace plumb
