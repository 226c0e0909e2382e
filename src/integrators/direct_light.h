// SPDX-License-Identifier: MIT
#pragma once

// Estimates of the light that reaches a vertex straight from emitters and leaves it towards the camera.

#include "integrators/vertex.h"
#include "plumb/model/params.h"
#include "plumb/model/sampler.h"
#include "plumb/scene/tracer.h"

namespace plumb {

// How two techniques share what both can find (Veach 1997, section 9.2). none: one of them counts nothing.
enum class Heuristic { none, balance, power };
Heuristic heuristic_of(const Params& params); // the parameter `heuristic`
float mis_weight(Heuristic heuristic, float mine, float other);

// One emitter, chosen by what it is expected to send here (light_tree.h), and one point of it. With a heuristic, emitters that BSDF sampling
// finds too are weighted against it. directions: how many BSDF samples look for lamps for each of these; for environments there is one.
Color light_from_one_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex,
                             Heuristic heuristic = Heuristic::none, float directions = 1.f);

// The same by resampling [1]: of `candidates` such points one is followed, chosen in proportion to what it would add if
// nothing were in the way. To BSDF sampling, which finds emitters too, they count as so many samples: the weights
//     w(x) = h(candidates p(x), p_bsdf(x)),   w_bsdf(x) = h(p_bsdf(x), candidates p(x)),   h: the heuristic,
// depend on the point alone and add up to 1, which is all that Veach 1997, section 9.2, asks of them. With the target
// q(x) = luminance(f L) w the estimate is
//     f L w V (y) / q(y) * 1/M sum_i q(x_i) / p(x_i),   P(y = x_i) ~ q(x_i) / p(x_i)   ([1], equation 6),
// whose mean over the choice of y is 1/M sum_i (f L w V)(x_i) / p(x_i): right if each candidate alone has the density p, and
// they need not be independent. They are one point shifted, spread over the emitters.
//
// [1] Talbot, Cline and Egbert 2005, "Importance Resampling for Global Illumination", EGSR.
Color light_by_resampling(Tracer& tracer, Sampler& sampler, const Vertex& vertex, Heuristic heuristic,
                          int candidates, float directions = 1.f);

// One emitter among those that no BSDF sample can reach: point and directional lights.
Color light_from_one_delta_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex);

// One point of every emitter, or of every delta emitter.
Color light_from_all_emitters(Tracer& tracer, Sampler& sampler, const Vertex& vertex, Measure measure);
Color light_from_all_delta_emitters(Tracer& tracer, Sampler& sampler, const Vertex& vertex);

// What a ray into a sampled direction finds. Nothing for delta samples: the path itself follows those.
Color light_along(Tracer& tracer, const Vertex& vertex, const std::optional<BsdfSample>& sampled);

// Calls seen(hit, light) for each surface along a ray into a direction, and with null at the end of a ray that leaves the
// scene: light is the emission that arrives from there. Ends where no light passes.
template <class Seen>
void look_along(Tracer& tracer, const Vertex& vertex, const Vec3f& direction, const Seen& seen)
{
    float fraction = 1.f;
    Ray ray = vertex.at().spawn_ray(direction);
    while (true) {
        const auto hit = tracer.intersect(ray, RayKind::bounce);
        const SurfacePoint* point = hit ? &*hit : nullptr;
        seen(point, tracer.scene().emission(vertex.receiver(), direction, point).radiance * fraction);
        if (!hit || !tracer.scene().has_null_surfaces()) return;
        fraction *= 1.f - hit->bsdf->opacity(*hit);
        if (!(fraction > 0.f) || (hit->emitter && tracer.scene().emitters_absorb())) return;
        ray = hit->spawn_ray(direction);
    }
}

// What an emitter's chosen point adds, if it is visible. f_cos: the BSDF's value towards it.
Color light_through(Tracer& tracer, const Vertex& vertex, const EmitterSample& light, Color f_cos,
                    float weight = 1.f);

// Throws Error if an emitter of the scene cannot be sampled by solid angle; `parameter` asked for it.
void require_solid_angle(const Scene& scene, const char* parameter);

} // namespace plumb
