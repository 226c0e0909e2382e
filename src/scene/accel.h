// SPDX-License-Identifier: MIT
#pragma once

// The acceleration structure: Embree behind a door. It says which primitive a ray meets first and nothing else;
// where exactly is computed by the shape.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"

#include <atomic>
#include <cstddef>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace plumb {

class Scene::Accel {
public:
    // Not in an optional: its flag, a byte that is read back as a word, would make the processor wait.
    struct Hit {
        static constexpr std::uint32_t nothing = ~0u;
        std::uint32_t object = nothing; // index into the objects given, or into those of the instance's group
        std::uint32_t primitive = 0;    // within that object
        std::uint32_t instance = nothing; // index into the instances given
        explicit operator bool() const { return object != nothing; }
    };

    // Throws Error: an instruction set that this processor lacks, too little memory, or what Embree reports.
    // Objects and instances must outlive it and stay where they are.
    Accel(const std::vector<SceneObject>& objects, const std::vector<Instance>& instances,
          const std::string& instruction_set);
    ~Accel();
    Accel(const Accel&) = delete;
    Accel& operator=(const Accel&) = delete;

    Hit intersect(const Ray& ray) const;
    bool occluded(const Ray& ray) const;
    std::string version() const;
    SceneMemory memory() const; // Embree's part of it

private:
    class Builder;
    struct UserGeometry {
        const Primitives* primitives;
        std::uint32_t id;
    };
    // Of the objects, or of those of a group, in whose space it is then.
    struct Part {
        RTCSceneTy* scene = nullptr;
        std::vector<std::uint32_t> object_of_geometry;
    };
    // All instances are one geometry, whose primitives they are.
    struct Instances {
        const Instance* instances = nullptr;
        std::vector<std::uint32_t> part; // of each instance: into parts_
        const std::vector<Part>* parts = nullptr;
    };
    struct InstanceCallbacks;

    void fill(Part& part, const std::vector<SceneObject>& objects);
    void add_instances(const std::vector<Instance>& instances);
    void release();

    static bool on_memory(void* accel, std::ptrdiff_t bytes, bool post);

    std::atomic<std::ptrdiff_t> memory_ = 0;
    std::atomic<std::ptrdiff_t> memory_peak_ = 0;
    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* scene_ = nullptr; // that of the first part
    std::vector<Part> parts_;     // of the objects, then of each group
    Instances instances_;
    std::vector<std::unique_ptr<UserGeometry>> user_geometries_; // Embree knows their addresses
};

} // namespace plumb
