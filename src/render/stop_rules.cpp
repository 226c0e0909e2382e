// SPDX-License-Identifier: MIT

#include "plumb/render/stop_rules.h"

#include <algorithm>
#include <bit>

namespace plumb {

namespace {

constexpr std::uint64_t finest_step = 16;

std::uint64_t step_at(std::uint64_t samples)
{
    return std::max(finest_step, std::bit_floor(samples) / 4);
}

} // namespace

std::uint64_t next_convergence_check(std::uint64_t samples)
{
    const std::uint64_t step = step_at(samples);
    return (samples / step + 1) * step;
}

bool is_convergence_check(std::uint64_t samples)
{
    return samples > 0 && samples % step_at(samples) == 0;
}

std::uint64_t next_stop(const StopRules& rules, std::uint64_t samples, double seconds)
{
    const std::uint64_t next = std::min(next_convergence_check(samples), rules.samples_per_pixel);
    if (!rules.seconds || samples >= next) return next;
    if (samples == 0) return 1;
    const double seconds_each = seconds / static_cast<double>(samples);
    const double more = std::clamp((*rules.seconds - seconds) / seconds_each, 0.0, 1e15);
    return std::min(next, samples + static_cast<std::uint64_t>(more));
}

} // namespace plumb
