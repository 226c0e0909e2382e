// SPDX-License-Identifier: MIT
#pragma once

// Microfacet distributions: Beckmann's and GGX, isotropic or stretched, sampled by the normals that a direction sees (Heitz
// and d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals").
//
// Conventions. Local frame, z is the macroscopic normal; wh is a unit microfacet normal with wh.z > 0. alpha_u and alpha_v
// are the roughness along x and y: of Beckmann's, the root-mean-square slope times sqrt(2).

#include "plumb/math/math.h"

namespace plumb {

class MicrofacetDistribution {
public:
    enum class Kind { beckmann, ggx };

    // Both alphas > 0.
    MicrofacetDistribution(Kind kind, float alpha_u, float alpha_v)
        : kind_(kind), alpha_(alpha_u), stretch_(alpha_u / alpha_v), area_(alpha_u * alpha_v)
    {}
    static MicrofacetDistribution beckmann(float alpha) { return {Kind::beckmann, alpha, alpha}; }
    static MicrofacetDistribution ggx(float alpha) { return {Kind::ggx, alpha, alpha}; }

    // [Walter 2007], equations 25 and 33, stretched as in [Heitz 2014], section 5.4; 0 for wh.z <= 0.
    float d(const Vec3f& wh) const;
    // Smith's shadowing of one direction, of Beckmann's by the rational fit, [Walter 2007], equations 27 and 34; 0 unless v
    // is on the same side of wh and of the macroscopic normal.
    float g1(const Vec3f& v, const Vec3f& wh) const;
    float g(const Vec3f& wi, const Vec3f& wo, const Vec3f& wh) const { return g1(wi, wh) * g1(wo, wh); }

    // A microfacet normal as v, with v.z > 0, sees them: in proportion to D(wh) max(0, v . wh).
    Vec3f sample_visible(const Vec3f& v, const Vec2f& u) const;
    float visible_pdf(const Vec3f& v, const Vec3f& wh) const; // per unit solid angle of wh
    // The integral of D(wh) max(0, v . wh): what visible_pdf divides by. It is cos(v) / G1(v) with Smith's exact G1,
    // not the fit.
    float visible_area(const Vec3f& v) const;

private:
    // Stretching y makes the slopes isotropic. v then is not of unit length, which none of the formulas needs.
    Vec3f stretched(const Vec3f& v) const { return {v.x, v.y / stretch_, v.z}; }

    Kind kind_;
    float alpha_;   // along x, and along the stretched y
    float stretch_; // alpha along x over alpha along y
    float area_;    // the product of both
};

} // namespace plumb
