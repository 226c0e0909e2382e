// SPDX-License-Identifier: MIT
#pragma once

// The interface of emitters.

#include "plumb/math/color.h"
#include "plumb/math/direction_cone.h"
#include "plumb/model/light_receiver.h"
#include "plumb/model/surface.h"

#include <optional>
#include <string_view>

namespace plumb {

// The measure in which a point on an emitter is chosen; the density is per unit solid angle at the receiver either
// way. `best`: by solid angle where the shape can, else by area.
enum class Measure { best, area, solid_angle };

class Emitter;

struct EmitterValue {
    Color radiance;
    float pdf = 0.f; // per unit solid angle, as sample() in the same measure would have chosen this direction
};

struct alignas(16) EmitterSample {
    Vec3f wi{0.f};         // unit vector from the receiver towards the light, world space
    float distance = 0.f;  // infinity for directional and environment light
    Vec3f position{0.f};   // the chosen point (finite emitters)
    float clearance = 0.f; // as in SurfacePoint; zero for lights without a surface
    Vec3f normal{0.f}; // geometric normal at position, on the side of the receiver; zero without a surface
    float pdf = 0.f;   // per unit solid angle; 1 where is_delta
    Color radiance;    // arriving if nothing is in between; for point lights intensity / distance^2
    bool is_delta = false;            // no other technique can find this light
    const Emitter* emitter = nullptr; // this and the next: set by Scene, which chose it
    std::uint32_t emitter_index = 0;  // as in SurfacePoint
};

// Where a light is, what it emits, and whither. Where it emits light in a direction there is a normal in the cone at
// most 90 degrees away, and what is emitted falls off with the cosine between them.
struct LightBounds {
    Box3f box;
    double power = 0.0; // as Emitter::power()
    DirectionCone normals;
};

// The sphere around everything that is not infinitely far away.
struct SceneSphere {
    Vec3f center;
    float radius = 0.f;
};

// Conventions. World space. Densities do not include the choice among emitters. u_select and u as in shape.h;
// u = (1/2, 1/2) gives the middle of a light.
class Emitter {
public:
    virtual ~Emitter() = default;

    // Called once, before power() and before any sample.
    virtual void prepare(const SceneSphere&) {}

    // Nothing where no light arrives at the receiver (behind a one-sided lamp, say), or none that counts.
    virtual std::optional<EmitterSample> sample(const LightReceiver& receiver, double u_select,
                                                const Vec2f& u, Measure measure) const = 0;

    // What a ray from the receiver along unit wi sees of this emitter: at the surface point `at` for area lights, or with
    // at == nullptr when the ray has left the scene. Zero for point and directional lights. The density is that of
    // samples for the same receiver.
    virtual EmitterValue evaluate(const LightReceiver& receiver, const Vec3f& wi, const SurfacePoint* at,
                                  Measure measure) const = 0;

    // Emitted power in watts, luminance-weighted; of an infinite emitter what enters the scene's sphere. Positive unless
    // the emitter is black everywhere.
    virtual float power() const = 0;

    // Nothing for infinite emitters.
    virtual std::optional<LightBounds> bounds() const { return std::nullopt; }

    // Of an infinite emitter that has one.
    virtual const SkyMap* sky_map() const { return nullptr; }

    virtual bool is_delta() const { return false; } // BSDF sampling cannot reach it
    virtual bool is_infinite() const
    {
        return false;
    } // seen by rays that leave the scene, or delta at infinity
    virtual bool has_solid_angle() const { return true; }    // Measure::solid_angle is possible
    virtual std::uint64_t memory_bytes() const { return 0; } // of its image, if it has one
};

} // namespace plumb
