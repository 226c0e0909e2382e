// SPDX-License-Identifier: MIT
#pragma once

// Random numbers for tests: the same sequence on every machine, for a given seed.

#include "plumb/math/math.h"

#include <cstdint>

namespace plumb::test {

// SplitMix64: Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators", figure 18.
class TestRandom {
public:
    explicit TestRandom(std::uint64_t seed = 1) : state_(seed * 0xd1342543de82ef95u) {}

    std::uint64_t next_bits()
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // Uniform in [0, 1): 24 bits, the grid on which samplers draw, and 53 bits.
    float next_1d() { return static_cast<float>(next_bits() >> 40) * 0x1p-24f; }
    double next_double() { return static_cast<double>(next_bits() >> 11) * 0x1p-53; }

    Vec2f next_2d()
    {
        const float x = next_1d();
        const float y = next_1d();
        return {x, y};
    }

    // A uniform number in [a, b).
    double between(double a, double b) { return a + (b - a) * next_double(); }

    // A direction uniform on the sphere.
    Vec3f direction()
    {
        for (;;) {
            const double x = between(-1, 1);
            const double y = between(-1, 1);
            const double z = between(-1, 1);
            const double r = std::sqrt(x * x + y * y + z * z);
            if (r > 1e-3 && r <= 1.0)
                return {static_cast<float>(x / r), static_cast<float>(y / r), static_cast<float>(z / r)};
        }
    }

private:
    std::uint64_t state_;
};

} // namespace plumb::test
