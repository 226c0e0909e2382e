// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace plumb {

enum class RayKind { camera, bounce, shadow };

struct RayCounts {
    std::uint64_t camera = 0;
    std::uint64_t bounce = 0;
    std::uint64_t shadow = 0;

    std::uint64_t total() const { return camera + bounce + shadow; }
    std::uint64_t& of(RayKind kind)
    {
        return kind == RayKind::camera ? camera : kind == RayKind::bounce ? bounce : shadow;
    }
    RayCounts& operator+=(const RayCounts& other);
};

} // namespace plumb
