// SPDX-License-Identifier: MIT

#include "plumb/scene/tracer.h"

#include <fmt/format.h>

namespace plumb {
namespace {

std::string text(const Vec3f& v)
{
    return fmt::format("({:.6g} {:.6g} {:.6g})", v.x, v.y, v.z);
}

const char* name_of(RayKind kind)
{
    switch (kind) {
    case RayKind::camera: return "camera";
    case RayKind::bounce: return "bounce";
    case RayKind::shadow: return "shadow";
    }
    return "";
}

} // namespace

RayCounts& RayCounts::operator+=(const RayCounts& other)
{
    camera += other.camera;
    bounce += other.bounce;
    shadow += other.shadow;
    return *this;
}

void FirstSurfaces::meet(const Ray& ray, RayKind kind, const SurfacePoint& hit)
{
    if (kind == RayKind::shadow || not_delta || (kind == RayKind::camera) == surface.has_value()) return;
    distance_ += length(hit.position - ray.origin);
    const SeenSurface seen{hit, normalize(ray.direction), distance_, through_};
    if (!surface) surface = seen;
    const bool is_delta = (hit.bsdf->lobes().bits & ~delta_lobes.bits) == 0;
    if (!is_delta || hit.emitter) not_delta = seen;
}

void FirstSurfaces::scatter(const Color& weight)
{
    through_ *= weight;
}

std::optional<SurfacePoint> Tracer::intersect_watched(const Ray& ray, RayKind kind)
{
    if (!is_traceable(ray)) {
        failed_ = true;
        log(PathEvent::Kind::end, "a ray that is not finite: the sample does not count");
        return std::nullopt;
    }
    std::optional<SurfacePoint> hit = scene_.intersect(ray);
    note(ray, kind, hit);
    return hit;
}

std::optional<SurfacePoint> Tracer::intersect_behind_emitters(const Ray& ray, RayKind kind)
{
    if (!is_traceable(ray)) return intersect(ray, kind); // which counts it as failed
    Ray rest = ray;
    std::optional<SurfacePoint> hit;
    for (;;) {
        ++counts_.of(kind);
        hit = scene_.intersect(rest);
        if (!hit || !hit->emitter) break;
        rest = hit->spawn_ray(ray.direction);
        // A ray that does not come further would not end.
        const double done = dot(Vec3d(rest.origin) - Vec3d(ray.origin), Vec3d(ray.direction)) /
                            length_squared(Vec3d(ray.direction));
        rest.t_max = static_cast<float>(static_cast<double>(ray.t_max) - done);
        if (!(rest.t_max > 0.f) || !is_traceable(rest)) {
            hit.reset();
            break;
        }
    }
    if (watched()) note(ray, kind, hit);
    return hit;
}

void Tracer::note(const Ray& ray, RayKind kind, const std::optional<SurfacePoint>& hit)
{
    if (hit && first_) first_->meet(ray, kind, *hit);
    if (logging()) {
        log(PathEvent::Kind::ray,
            fmt::format("{} ray from {} along {}", name_of(kind), text(ray.origin), text(ray.direction)));
        if (hit) {
            std::string object = "surface";
            for (const SceneObject& candidate : scene_.objects())
                if (candidate.shape.get() == hit->shape) object = candidate.name;
            log(PathEvent::Kind::hit,
                fmt::format("meets {} (primitive {}) at {}, distance {:.6g}, normal {}, shading normal {}, "
                            "uv ({:.6g} {:.6g})",
                            object, hit->primitive, text(hit->position), length(hit->position - ray.origin),
                            text(hit->geometric_normal), text(hit->shading.n), hit->uv.x, hit->uv.y));
        } else {
            log(PathEvent::Kind::escape, "leaves the scene");
        }
    }
}

void Tracer::log(PathEvent::Kind kind, std::string text)
{
    if (log_ != nullptr) log_->push_back({kind, std::move(text)});
}

void Tracer::log_contribution(PathEvent::Kind kind, const char* what, const Color& contribution)
{
    if (log_ != nullptr)
        log_->push_back({kind, fmt::format("{} adds ({:.6g} {:.6g} {:.6g})", what, contribution.r,
                                           contribution.g, contribution.b)});
}

} // namespace plumb
