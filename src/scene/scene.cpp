// SPDX-License-Identifier: MIT

#include "plumb/scene/scene.h"
#include "plumb/model/shape.h"

#include "scene/accel.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

namespace plumb {
namespace {

SceneSphere bounding_sphere(const Box3f& bounds)
{
    if (bounds.isEmpty()) return {};
    return {bounds.center(), length(bounds.size()) * 0.5f};
}

} // namespace

Group::Group(std::vector<SceneObject> objects, std::string name)
    : objects_(std::move(objects)), name_(std::move(name))
{
    for (const SceneObject& object : objects_) bounds_.extendBy(object.shape->bounds());
}

Scene::Scene(std::vector<SceneObject> objects, std::vector<std::unique_ptr<Emitter>> lights,
             const SceneOptions& options, std::vector<Instance> instances,
             std::vector<std::string> light_names)
    : options_(options),
      objects_(std::move(objects)),
      instances_(std::move(instances)),
      lights_(std::move(lights))
{
    const SceneSphere sphere = bounding_sphere(bounds());
    const auto add_emitter = [&](Emitter& emitter) {
        emitter.prepare(sphere);
        const auto index = static_cast<std::uint32_t>(emitters_.size());
        emitters_.push_back(&emitter);
        if (emitter.is_infinite() && !emitter.is_delta()) infinite_.push_back(index);
        return index;
    };
    for (const SceneObject& object : objects_) {
        if (object.emitter) object.shape->prepare_sampling();
        if (object.emitter) emitter_names_.push_back(object.name);
        facts_.push_back(
            {object.emitter ? add_emitter(*object.emitter) : 0, object.bsdf && object.bsdf->is_oriented()});
    }
    light_names.resize(lights_.size());
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        add_emitter(*lights_[i]);
        emitter_names_.push_back(light_names[i].empty() ? fmt::format("light {}", i + 1) : light_names[i]);
    }
    for_each_object([this](const SceneObject& object) {
        has_null_surfaces_ = has_null_surfaces_ || object.bsdf->lobes().has_any(Lobe::null);
    });

    choice_ = LightTree(emitters_, LightTree::Among::all, sphere);
    delta_choice_ = LightTree(emitters_, LightTree::Among::delta, sphere);

    accel_ = std::make_unique<Accel>(objects_, instances_, options_.instruction_set);
}

Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

std::optional<EmitterSample> Scene::sample_emitter(const LightReceiver& receiver, double u_choice,
                                                   const Vec2f& u, Measure measure) const
{
    if (!choice_.can_sample()) return std::nullopt;
    const std::optional<LightTree::Choice> choice = choice_.choose(receiver, u_choice);
    if (!choice) return std::nullopt;
    return sample_chosen(*choice, receiver, u, measure);
}

std::optional<EmitterSample> Scene::sample_delta_emitter(const LightReceiver& receiver, double u_choice,
                                                         const Vec2f& u) const
{
    if (!delta_choice_.can_sample()) return std::nullopt;
    const std::optional<LightTree::Choice> choice = delta_choice_.choose(receiver, u_choice);
    if (!choice) return std::nullopt;
    return sample_chosen(*choice, receiver, u, Measure::best);
}

std::optional<EmitterSample> Scene::sample_chosen(const LightTree::Choice& choice,
                                                  const LightReceiver& receiver, const Vec2f& u,
                                                  Measure measure) const
{
    const Emitter& emitter = *emitters_[choice.index];
    std::optional<EmitterSample> light = emitter.sample(receiver, choice.u, u, measure);
    if (!light) return light;
    light->emitter = &emitter;
    light->emitter_index = choice.index;
    light->pdf *= choice.probability;
    // Infinite emitters overlap: the direction brings light from all of them, and any could have chosen it.
    if (infinite_.size() > 1 && emitter.is_infinite() && !emitter.is_delta()) {
        const EmitterValue all = emission(receiver, light->wi, nullptr, measure);
        light->radiance = all.radiance;
        light->pdf = all.pdf;
    }
    return light;
}

EmitterValue Scene::emission(const LightReceiver& receiver, const Vec3f& wi, const SurfacePoint* hit,
                             Measure measure) const
{
    if (hit != nullptr) {
        if (hit->emitter == nullptr) return {};
        const EmitterValue value = hit->emitter->evaluate(receiver, wi, hit, measure);
        return {value.radiance, value.pdf * choice_.probability(receiver, hit->emitter_index)};
    }
    EmitterValue sum;
    for (const std::uint32_t index : infinite_) {
        const EmitterValue value = emitters_[index]->evaluate(receiver, wi, nullptr, measure);
        sum.radiance += value.radiance;
        sum.pdf += value.pdf * choice_.probability(receiver, index);
    }
    return sum;
}

Box3f Scene::bounds() const
{
    Box3f bounds;
    for (const SceneObject& object : objects_) bounds.extendBy(object.shape->bounds());
    for (const Instance& instance : instances_) bounds.extendBy(instance.bounds());
    return bounds;
}

std::vector<const Group*> Scene::groups() const
{
    std::vector<const Group*> groups;
    std::unordered_set<const Group*> seen;
    for (const Instance& instance : instances_)
        if (seen.insert(instance.group.get()).second) groups.push_back(instance.group.get());
    return groups;
}

std::optional<std::uint32_t> Scene::instance_of(const SurfacePoint& at) const
{
    if (at.instance == nullptr) return std::nullopt;
    return static_cast<std::uint32_t>(static_cast<const Instance*>(at.instance) - instances_.data());
}

std::string Scene::name_of(const SurfacePoint& at) const
{
    const auto instance = instance_of(at);
    for (const SceneObject& object : instance ? instances_[*instance].group->objects() : objects_)
        if (object.shape.get() == at.shape)
            return instance ? fmt::format("{} in {}", object.name, instances_[*instance].name) : object.name;
    return "surface";
}

// Apart from intersect(), so that scenes without instances pay for one test.
SurfacePoint Scene::point_in_instance(const Ray& ray, std::uint32_t index, std::uint32_t object_index,
                                      std::uint32_t primitive) const
{
    const Instance& instance = instances_[index];
    const SceneObject& object = instance.group->objects()[object_index];
    SurfacePoint point = object.shape->surface_at(instance.to_object(RayD(ray)), primitive);
    point.primitive = primitive;
    point.shape = object.shape.get();
    point.bsdf = object.bsdf.get();
    const bool is_oriented = object.bsdf->is_oriented();
    Tangents tangents;
    if (is_oriented) tangents = instance.to_world(point.shape->tangents(point));
    instance.move_to_world(point, object.shape->primitive_bounds(primitive));
    if (is_oriented) point.shading = Frame(point.shading.n, tangents.dp_du);
    return point;
}

std::uint64_t Scene::triangle_count() const
{
    std::uint64_t count = 0;
    for_each_object([&](const SceneObject& object) { count += object.shape->triangle_count(); });
    return count;
}

SceneMemory Scene::memory() const
{
    SceneMemory memory = accel_->memory();
    for_each_object([&](const SceneObject& object) { memory.meshes += object.shape->memory_bytes(); });
    memory.meshes += instances_.capacity() * sizeof(Instance);
    for (const auto& light : lights_) memory.images += light->memory_bytes();
    return memory;
}

std::string Scene::embree_version() const
{
    return accel_->version();
}

} // namespace plumb
