// SPDX-License-Identifier: MIT

#include "integrators/direct_technique.h"

namespace plumb {
namespace {

constexpr double most_samples = 1e6;

DirectTechnique::Kind kind_of(const Params& params, const char* name, DirectTechnique::Kind fallback)
{
    using Kind = DirectTechnique::Kind;
    const std::string word = params.choice(name, {}, {"area", "solid-angle", "hemisphere", "bsdf"});
    if (word == "area") return Kind::area;
    if (word == "solid-angle") return Kind::solid_angle;
    if (word == "hemisphere") return Kind::hemisphere;
    if (word == "bsdf") return Kind::bsdf;
    return fallback;
}

// A point of a light as a ray would have met it, as far as its density depends on it.
SurfacePoint surface_of(const EmitterSample& light)
{
    SurfacePoint point;
    point.position = light.position;
    point.geometric_normal = light.normal;
    point.clearance = light.clearance;
    point.shading = Frame(light.normal);
    point.emitter = light.emitter;
    point.emitter_index = light.emitter_index;
    return point;
}

} // namespace

DirectTechnique::DirectTechnique(const Params& params, const char* measure, const char* samples,
                                 const char* warp, Kind fallback)
    : parameter_(measure),
      kind_(kind_of(params, measure, fallback)),
      warp_(hemisphere_warp(params, warp)),
      samples_(static_cast<int>(params.integer(samples, 1, Range::closed(1, most_samples))))
{}

void DirectTechnique::prepare(const Scene& scene) const
{
    if (kind_ == Kind::solid_angle) require_solid_angle(scene, parameter_);
}

Measure DirectTechnique::measure() const
{
    return kind_ == Kind::area          ? Measure::area
           : kind_ == Kind::solid_angle ? Measure::solid_angle
                                        : Measure::best;
}

std::optional<BsdfSample> DirectTechnique::direction(Sampler& sampler, const Vertex& vertex) const
{
    if (kind_ == Kind::hemisphere) return scatter_by_warp(warp_, sampler, vertex);
    const float u_lobe = sampler.next_1d();
    const Vec2f u = sampler.next_2d();
    return vertex.sample(u_lobe, u);
}

Color DirectTechnique::estimate(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
{
    if (samples_emitters()) return light_from_all_emitters(tracer, sampler, vertex, measure());
    const Color unreachable = light_from_all_delta_emitters(tracer, sampler, vertex);
    const auto sampled = direction(sampler, vertex);
    const std::size_t noted = tracer.noted_light();
    const Color found = light_along(tracer, vertex, sampled);
    tracer.change_noted_light(noted, [&](const Color& sum) { return unreachable + sum; });
    return unreachable + found;
}

float DirectTechnique::density(const Scene& scene, const Vertex& vertex, const Vec3f& wo_world,
                               const BsdfValue& value, const SurfacePoint* hit) const
{
    if (samples_emitters()) return scene.emission(vertex.receiver(), wo_world, hit, measure()).pdf;
    const bool by_bsdf = kind_ == Kind::bsdf || vertex.has_delta_lobes() || vertex.has_transmission();
    if (by_bsdf) return value.pdf;
    return hemisphere_pdf(warp_, vertex.on_seen_side(vertex.at().shading.to_local(wo_world)));
}

void DirectTechnique::find(Tracer& tracer, Sampler& sampler, const Vertex& vertex,
                           const DirectTechnique& other, const Take& take) const
{
    if (samples_emitters()) return find_by_emitter(tracer, sampler, vertex, other, take);
    const auto sampled = direction(sampler, vertex);
    if (!sampled || sampled->is_delta()) return;
    const Vec3f wo_world = vertex.to_world(*sampled);
    const BsdfValue value = vertex.evaluate_local(sampled->wo);
    if (value.f_cos.is_black()) return;
    look_along(tracer, vertex, wo_world, [&](const SurfacePoint* hit, const Color& radiance) {
        if (radiance.is_black()) return;
        take({value.f_cos * radiance, sampled->pdf,
              other.density(tracer.scene(), vertex, wo_world, value, hit), FoundBy::direction,
              hit ? hit->emitter_index : environment_index});
    });
}

void DirectTechnique::find_by_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex,
                                      const DirectTechnique& other, const Take& take) const
{
    const double u_choice = sampler.next_choice();
    const Vec2f u = sampler.next_2d();
    const auto light = tracer.scene().sample_emitter(vertex.receiver(), u_choice, u, measure());
    if (!light || light->is_delta) return;
    const BsdfValue value = vertex.evaluate(light->wi);
    const Color contribution = value.f_cos * light->radiance;
    if (contribution.is_black()) return;
    const float visible = tracer.visible(vertex.at(), *light);
    if (!(visible > 0.f)) return;
    const SurfacePoint point = surface_of(*light);
    const bool is_surface = light->distance != infinity;
    take({contribution * visible, light->pdf,
          other.density(tracer.scene(), vertex, light->wi, value, is_surface ? &point : nullptr),
          FoundBy::emitter_sample, light->emitter_index});
}

} // namespace plumb
