// SPDX-License-Identifier: MIT
#pragma once

// When a rendering ends: pure functions of how many samples each pixel has, of the image's noise, and of the time.

#include "plumb/render/evidence.h"

#include <cstdint>
#include <optional>
#include <string>

namespace plumb {

// It ends as soon as one of them says so.
struct StopRules {
    std::uint64_t samples_per_pixel = film_max_samples;
    std::optional<double> seconds; // of rendering
    std::optional<double>
        relative_error; // estimate_relative_noise(): until the upper end of its interval is below
};

// The numbers of samples per pixel at which the noise is looked at, whatever the machine and the interruptions: 16, 32, 48, 64,
// 80, and on in steps of a quarter of the power of two below. The next one after `samples`.
std::uint64_t next_convergence_check(std::uint64_t samples);
bool is_convergence_check(std::uint64_t samples);

// How far to go from `samples` for each pixel, which took `seconds`; `samples` if there is not enough time for one more.
// The first sample is always taken.
std::uint64_t next_stop(const StopRules& rules, std::uint64_t samples, double seconds);

} // namespace plumb
