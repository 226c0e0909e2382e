// SPDX-License-Identifier: MIT
#pragma once

// Eight groups of lights side by side, and how much of their light may reach a receiver: what trees of lights are made of.
//
// [1] Pharr, Jakob and Humphreys 2023, Physically Based Rendering, 4th edition, section 12.6.3.

#include "plumb/model/emitter.h"

#include <array>

namespace plumb {

// A receiver in the coordinates of the lanes.
struct LaneReceiver {
    LaneReceiver(const Vec3f& at, const Vec3f& n)
        : position(at), normal(n), any_side(n == Vec3f(0.f) ? 1.f : 0.f)
    {}

    Vec3f position;
    Vec3f normal;
    float any_side; // 1 where light from all around counts, else 0
};

// Number by number, so that one instruction serves all lanes. Lanes that are not set have no intensity.
struct LightLanes {
    static constexpr std::size_t width = 8;
    using Lanes = std::array<float, width>;
    // The sums of a lane and all before it, after a 0.
    using Sums = std::array<double, width + 1>;

    Lanes x{}, y{}, z{}, radius{};                        // the sphere around the lights
    Lanes axis_x{}, axis_y{}, axis_z{}, cosine{}, sine{}; // the cone of normals, and of its angle
    Lanes intensity{};                                    // towards the axis

    // Coordinates of the lanes are (world - origin) * scale.
    struct Space {
        Vec3d origin{0.0};
        double scale = 1.0;
    };
    void set_box(std::size_t lane, const Box3f& box, const Space& space);
    void set_normal(std::size_t lane, const Vec3f& normal); // a cone of one direction
    // unit: the power of intensity 1.
    void set(std::size_t lane, const LightBounds& bounds, const Space& space, double unit);

    // Of each lane a bound of the cosines over the squared distance, times its intensity. Zero only where none of its light
    // can reach the receiver.
    Sums importance(const LaneReceiver& receiver) const;

    // Whether all lights of a lane have about the same cosines and distances there.
    bool looks_alike(std::size_t lane, const LaneReceiver& receiver) const;
};

// What holds both.
LightBounds merged(const LightBounds& a, const LightBounds& b);

} // namespace plumb
