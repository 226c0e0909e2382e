// SPDX-License-Identifier: MIT
#pragma once

// The Beckmann microfacet distribution as the courses define it (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces").
//
// Conventions. Local frame, z is the macroscopic normal; wh is a unit microfacet normal with wh.z > 0.

#include "plumb/math.h"

namespace plumb {

class Beckmann {
public:
    explicit Beckmann(float alpha) : alpha_(alpha) {} // alpha > 0: root-mean-square slope times sqrt(2)

    float d(const Vec3f& wh) const; // [Walter 2007], equation 25; 0 for wh.z <= 0
    // Smith shadowing of one direction by the rational fit, [Walter 2007], equation 27; 0 unless v is on the same
    // side of wh and of the macroscopic normal.
    float g1(const Vec3f& v, const Vec3f& wh) const;
    float g(const Vec3f& wi, const Vec3f& wo, const Vec3f& wh) const { return g1(wi, wh) * g1(wo, wh); }

    Vec3f sample(const Vec2f& u) const; // [Walter 2007], equations 28 and 29
    float pdf(const Vec3f& wh) const;   // D(wh) cos(wh), per unit solid angle of wh

private:
    float alpha_;
};

} // namespace plumb
