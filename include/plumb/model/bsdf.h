// SPDX-License-Identifier: MIT
#pragma once

// The interface of BSDFs.

#include "plumb/math/color.h"
#include "plumb/model/surface.h"

#include <optional>

namespace plumb {

enum class Lobe : unsigned {
    diffuse_reflection = 1,
    glossy_reflection = 2,
    glossy_transmission = 4,
    delta_reflection = 8,
    delta_transmission = 16,
    null = 32, // straight on, as if there were no surface
};

// A set of lobes.
struct Lobes {
    unsigned bits = 0;
    constexpr Lobes() = default;
    constexpr Lobes(Lobe lobe) : bits(static_cast<unsigned>(lobe)) {}
    constexpr explicit Lobes(unsigned b) : bits(b) {}
    constexpr bool has_any(Lobes other) const { return (bits & other.bits) != 0; }
    friend constexpr Lobes operator|(Lobes a, Lobes b) { return Lobes(a.bits | b.bits); }
};
constexpr Lobes operator|(Lobe a, Lobe b)
{
    return Lobes(a) | Lobes(b);
}
inline constexpr Lobes delta_lobes = Lobe::delta_reflection | Lobe::delta_transmission | Lobe::null;
inline constexpr Lobes glossy_lobes = Lobe::glossy_reflection | Lobe::glossy_transmission;
inline constexpr Lobes transmission_lobes = Lobe::glossy_transmission | Lobe::delta_transmission;

// Shiny surfaces are those that scatter by glossy lobes alone: metals and rough glass. They throw light on in bundles, if wide ones, as
// mirrors and glass do.
constexpr bool are_shiny(Lobes lobes)
{
    return lobes.has_any(glossy_lobes) && !lobes.has_any(Lobe::diffuse_reflection);
}
constexpr bool throw_caustics(Lobes lobes)
{
    return lobes.has_any(Lobe::delta_reflection | Lobe::delta_transmission) || are_shiny(lobes);
}

struct BsdfValue {
    Color f_cos;
    float pdf = 0.f;
};

struct BsdfSample {
    Vec3f wo;
    Color
        weight; // f_cos / pdf, or for delta lobes the reflectance divided by the chance of choosing the lobe
    float pdf = 0.f; // per unit solid angle; for delta lobes the chance of choosing the lobe
    Lobe lobe = Lobe::diffuse_reflection;
    float eta = 1.f; // index of wo's side / index of wi's side: 1 unless refracted

    bool is_delta() const { return delta_lobes.has_any(lobe); }
    bool is_transmission() const { return transmission_lobes.has_any(lobe); }
    bool is_pass() const { return lobe == Lobe::null; }
};

// Conventions (after Veach 1997, section 3.7). wi: towards where the path came from (the camera's side), given.
// wo: where the path goes on (the light's side), sampled. Both have unit length, point away from the surface and
// live in the shading frame (z is the shading normal, front side up). Densities are per unit solid angle of wo and
// include the choice of a lobe. Every value includes |cos theta_o|. Delta lobes are invisible to evaluate().
// Radiance is transported: refraction scales it by (eta_i / eta_t)^2 in the value (Veach 1997, section 5.2).
//
// For every wo from sample() that is not delta: weight * pdf equals evaluate(wi, wo).f_cos and the pdfs agree.
// f = 0 for wo below the shading normal, on the other side than wi, unless a lobe transmits: light sampling does not look
// there (integrators/vertex.h). A BSDF that bends the normal therefore is black for directions that lie on different
// sides of the shading normal and of its own; its density is 0 there, too, and is not scaled up elsewhere.
//
// A null lobe is a delta lobe of weight 1 with wo = -wi. It does not end the section between two vertices of a path: light
// sampling and emission see through it (path_loop.h, Tracer::visible).
//
// Nothing, from sample(): the path ends here (absorbed, or wi on a side that does not reflect).
class Bsdf {
public:
    virtual ~Bsdf() = default;
    virtual Lobes lobes() const = 0;
    // Whether s of the shading frame must run along dp/du (shape.h), for normal maps and anisotropy.
    virtual bool is_oriented() const { return false; }
    // Whether light is reflected or transmitted behind the surface as well; else it is black from there.
    virtual bool has_back() const { return lobes().has_any(transmission_lobes); }
    // 1 minus the fraction of light that passes straight through, by null lobes alone.
    virtual float opacity(const SurfacePoint& /*at*/) const { return 1.f; }
    // Whether f(wi, wo) / eta_i^2 = f(wo, wi) / eta_o^2 (Veach 1997, equation 5.14). Not so for bent normals.
    virtual bool is_reciprocal() const { return true; }
    // Whether no more light leaves than arrives.
    virtual bool conserves_energy() const { return true; }
    virtual BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const = 0;
    virtual std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                             const Vec2f& u) const = 0;
    // What fraction of light from wi's direction leaves again, for people and denoisers: the mean weight of samples of a fixed
    // pattern, without the scale of refracted radiance, unless a BSDF knows it. Deterministic.
    virtual Color albedo(const SurfacePoint& at, const Vec3f& wi) const;
};

} // namespace plumb
