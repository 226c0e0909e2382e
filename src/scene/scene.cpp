// SPDX-License-Identifier: MIT

#include "plumb/scene/scene.h"
#include "plumb/model/shape.h"

#include "scene/accel.h"

namespace plumb {
namespace {

SceneSphere bounding_sphere(const Box3f& bounds)
{
    if (bounds.isEmpty()) return {};
    return {bounds.center(), length(bounds.size()) * 0.5f};
}

} // namespace

Scene::Scene(std::vector<SceneObject> objects, std::vector<std::unique_ptr<Emitter>> lights,
             const SceneOptions& options)
    : options_(options), objects_(std::move(objects)), lights_(std::move(lights))
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
        facts_.push_back(
            {object.emitter ? add_emitter(*object.emitter) : 0, object.bsdf && object.bsdf->is_oriented()});
    }
    for (const auto& light : lights_) add_emitter(*light);

    choice_ = LightTree(emitters_, LightTree::Among::all, sphere);
    delta_choice_ = LightTree(emitters_, LightTree::Among::delta, sphere);

    accel_ = std::make_unique<Accel>(objects_, options_.instruction_set);
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
        const EmitterValue value = hit->emitter->evaluate(receiver.position, wi, hit, measure);
        return {value.radiance, value.pdf * choice_.probability(receiver, hit->emitter_index)};
    }
    EmitterValue sum;
    for (const std::uint32_t index : infinite_) {
        const EmitterValue value = emitters_[index]->evaluate(receiver.position, wi, nullptr, measure);
        sum.radiance += value.radiance;
        sum.pdf += value.pdf * choice_.probability(receiver, index);
    }
    return sum;
}

Box3f Scene::bounds() const
{
    Box3f bounds;
    for (const SceneObject& object : objects_) bounds.extendBy(object.shape->bounds());
    return bounds;
}

std::uint64_t Scene::triangle_count() const
{
    std::uint64_t count = 0;
    for (const SceneObject& object : objects_) count += object.shape->triangle_count();
    return count;
}

SceneMemory Scene::memory() const
{
    SceneMemory memory = accel_->memory();
    for (const SceneObject& object : objects_) memory.meshes += object.shape->memory_bytes();
    for (const auto& light : lights_) memory.pictures += light->memory_bytes();
    return memory;
}

std::string Scene::embree_version() const
{
    return accel_->version();
}

} // namespace plumb
