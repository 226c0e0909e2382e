// SPDX-License-Identifier: MIT
#pragma once

// The Beckmann microfacet distribution as the courses define it (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces"), sampled by the normals that a direction sees (Heitz and d'Eon 2014, "Importance
// Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals").
//
// Conventions. Local frame, z is the macroscopic normal; wh is a unit microfacet normal with wh.z > 0.

#include "plumb/math/math.h"

namespace plumb {

class Beckmann {
public:
    explicit Beckmann(float alpha) : alpha_(alpha) {} // alpha > 0: root-mean-square slope times sqrt(2)

    float d(const Vec3f& wh) const; // [Walter 2007], equation 25; 0 for wh.z <= 0
    // Smith shadowing of one direction by the rational fit, [Walter 2007], equation 27; 0 unless v is on the same
    // side of wh and of the macroscopic normal.
    float g1(const Vec3f& v, const Vec3f& wh) const;
    float g(const Vec3f& wi, const Vec3f& wo, const Vec3f& wh) const { return g1(wi, wh) * g1(wo, wh); }

    // A microfacet normal as v, with v.z > 0, sees them: in proportion to D(wh) max(0, v . wh).
    Vec3f sample_visible(const Vec3f& v, const Vec2f& u) const;
    float visible_pdf(const Vec3f& v, const Vec3f& wh) const; // per unit solid angle of wh
    // The integral of D(wh) max(0, v . wh): what visible_pdf divides by. It is cos(v) / G1(v) with Smith's exact G1,
    // not the fit.
    float visible_area(const Vec3f& v) const;

private:
    struct View;
    View view(const Vec3f& v) const;

    float alpha_;
};

} // namespace plumb
