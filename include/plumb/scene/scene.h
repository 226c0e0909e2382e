// SPDX-License-Identifier: MIT
#pragma once

// The scene: owns shapes, BSDFs and emitters, and answers what a ray meets.

#include "plumb/model/bsdf.h"
#include "plumb/model/emitter.h"
#include "plumb/model/instance_map.h"
#include "plumb/scene/instruction_set.h"
#include "plumb/scene/light_tree.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

class Shape;

// A shape, what it is made of, and the light it gives. bsdf is never null, and other objects may have the same one; emitter
// may be null.
struct SceneObject {
    std::shared_ptr<Shape> shape;
    std::shared_ptr<const Bsdf> bsdf;
    std::unique_ptr<Emitter> emitter;
    std::string name; // "mesh 'obj' (cbox.xml:12)", for people
    std::string material =
        {}; // "floor", "bsdf 'diffuse' (cbox.xml:14)" likewise; objects with one BSDF have one name
};

// Objects that instances put into the scene, any number of times. Built once; they are in the scene nowhere else. No emitters.
class Group {
public:
    Group(std::vector<SceneObject> objects, std::string name);
    const std::vector<SceneObject>& objects() const { return objects_; }
    const Box3f& bounds() const { return bounds_; }   // in its own space
    const std::string& name() const { return name_; } // "group 'tree' (garden.xml:5)", for people

private:
    std::vector<SceneObject> objects_;
    std::string name_;
    Box3f bounds_;
};

struct Instance : InstanceMap {
    Box3f bounds() const { return to_world(group->bounds()); }

    std::shared_ptr<const Group> group; // never null
    std::string name;                   // "instance of 'tree' (garden.xml:12)", for people
};

struct SceneOptions {
    bool emitters_absorb = false;                                // paths end at emitters
    std::string instruction_set{default_instruction_set().name}; // Embree traces with this and no other
};

// Bytes that a scene takes as long as it is there; and what Embree took at most while it built.
struct SceneMemory {
    std::uint64_t meshes = 0;
    std::uint64_t acceleration = 0;
    std::uint64_t acceleration_peak = 0;
    std::uint64_t images = 0; // of environments
};

// Conventions. World space. Emitters are chosen by what they are expected to send to the receiver (light_tree.h).
class Scene {
public:
    // lights: the emitters that no shape carries. Builds the acceleration structure; throws Error if Embree cannot.
    // light_names: for people; those that are missing have numbers.
    Scene(std::vector<SceneObject> objects, std::vector<std::unique_ptr<Emitter>> lights,
          const SceneOptions& options = {}, std::vector<Instance> instances = {},
          std::vector<std::string> light_names = {});
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    std::optional<SurfacePoint> intersect(const Ray& ray) const;
    bool occluded(const Ray& ray) const;
    // The ray between a surface point and a light's chosen point, clear of both surfaces.
    static Ray shadow_ray(const SurfacePoint& from, const EmitterSample& light)
    {
        if (light.distance == infinity) return from.spawn_ray(light.wi);
        // Both ends are moved off their surfaces towards each other; what lies strictly between them is in the way.
        const Vec3f origin = offset_origin(from.position, from.clearance, from.geometric_normal, light.wi);
        const float end = end_clearance(light.clearance, light.normal, light.wi * light.distance);
        const Vec3f target = light.position + light.normal * end;
        return {origin, target - origin, 0.f, one_minus_epsilon};
    }

    // A point of one emitter, chosen by u_choice (which is used up: what is left of it selects a part of the
    // emitter), among all or among point and directional lights alone. pdf includes the choice.
    std::optional<EmitterSample> sample_emitter(const LightReceiver& receiver, double u_choice,
                                                const Vec2f& u, Measure measure = Measure::best) const;
    std::optional<EmitterSample> sample_delta_emitter(const LightReceiver& receiver, double u_choice,
                                                      const Vec2f& u) const;
    // What a ray from the receiver along unit wi sees: the emitter of the surface it hit or, with hit == nullptr,
    // all infinite emitters. pdf: as sample_emitter would have chosen it for the same receiver (of which cameras and
    // delta bounces, whose directions no other technique finds, need no more than the position). Black where
    // nothing is emitted.
    EmitterValue emission(const LightReceiver& receiver, const Vec3f& wi, const SurfacePoint* hit,
                          Measure measure = Measure::best) const;

    bool has_null_surfaces() const { return has_null_surfaces_; } // light passes straight through them
    bool has_delta_emitters() const { return delta_choice_.can_sample(); }
    bool emitters_absorb() const { return options_.emitters_absorb; }
    const std::vector<const Emitter*>& emitters() const { return emitters_; }        // all, in document order
    const std::vector<std::string>& emitter_names() const { return emitter_names_; } // of those, for people
    const std::vector<SceneObject>& objects() const { return objects_; }
    const std::vector<Instance>& instances() const { return instances_; }
    std::vector<const Group*> groups() const; // those of the instances, each once, in their order
    // Those of the scene, then those of its groups, whose space is their own.
    template <class Action>
    void for_each_object(const Action& action) const
    {
        for (const SceneObject& object : objects_) action(object);
        for (const Group* group : groups())
            for (const SceneObject& object : group->objects()) action(object);
    }
    // What SurfacePoint::instance is: an index into instances(). Nothing outside of instances.
    std::optional<std::uint32_t> instance_of(const SurfacePoint& at) const;
    std::string name_of(const SurfacePoint& at) const; // the object, and its instance, for people
    Box3f bounds() const;
    std::uint64_t triangle_count() const; // as stored: those of a group count once
    SceneMemory memory() const;
    const SceneOptions& options() const { return options_; }
    std::string embree_version() const; // "3.13.5"

private:
    class Accel;
    // What a hit needs to know of its object.
    struct ObjectFacts {
        std::uint32_t emitter_index = 0; // into emitters_
        bool is_oriented = false;        // Bsdf::is_oriented
    };
    SurfacePoint point_in_instance(const Ray& ray, std::uint32_t index, std::uint32_t object,
                                   std::uint32_t primitive) const;
    std::optional<EmitterSample> sample_chosen(const LightTree::Choice& choice, const LightReceiver& receiver,
                                               const Vec2f& u, Measure measure) const;

    SceneOptions options_;
    std::vector<SceneObject> objects_;
    std::vector<Instance> instances_; // whose addresses points have
    std::vector<std::unique_ptr<Emitter>> lights_;
    std::vector<const Emitter*> emitters_; // those of objects_, then lights_
    std::vector<std::string> emitter_names_;
    std::vector<ObjectFacts> facts_;      // of objects_
    std::vector<std::uint32_t> infinite_; // indices of infinite, not delta emitters
    LightTree choice_;
    LightTree delta_choice_; // among delta emitters alone
    bool has_null_surfaces_ = false;
    std::unique_ptr<Accel> accel_;
};

} // namespace plumb
