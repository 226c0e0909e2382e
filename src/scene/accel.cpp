// SPDX-License-Identifier: MIT

// Embree, version 3.13 or 4: the device, the scenes, and how rays get there. Instances: accel_instances.cpp.

#include "scene/accel.h"

#include "base/emplace_with.h"
#include "plumb/base/error.h"
#include "plumb/model/shape.h"
#include "plumb/scene/instruction_set.h"
#include "scene/accel_rays.h"

#include <mutex>

#include <fmt/format.h>

namespace plumb {
namespace {

const InstructionSet& find_instruction_set(const std::string& name)
{
    for (const InstructionSet& set : instruction_sets())
        if (set.name == name) return set;
    throw Error(fmt::format("unknown instruction set '{}'{}", name, way_out(name, instruction_set_names())));
}

// The last message of Embree's error callback, for the exception that follows.
struct DeviceErrors {
    std::mutex mutex;
    RTCError code = RTC_ERROR_NONE;
    std::string message;
};

DeviceErrors& device_errors()
{
    static DeviceErrors errors;
    return errors;
}

void on_device_error(void*, RTCError code, const char* message)
{
    DeviceErrors& errors = device_errors();
    const std::lock_guard lock(errors.mutex);
    errors.code = code;
    errors.message = message ? message : "";
}

// Primitives as Embree's user geometry: tested in our own arithmetic, one ray at a time.
template <class UserGeometry>
void user_bounds(const RTCBoundsFunctionArguments* args)
{
    const auto& geometry = *static_cast<const UserGeometry*>(args->geometryUserPtr);
    store_bounds(*args->bounds_o, geometry.primitives->bounds(args->primID));
}

template <class UserGeometry>
void user_intersect(const RTCIntersectFunctionNArguments* args)
{
    if (args->valid[0] == 0) return;
    const auto& geometry = *static_cast<const UserGeometry*>(args->geometryUserPtr);
    auto& ray_hit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
    const std::optional<double> t = geometry.primitives->intersect(our_ray(ray_hit.ray), args->primID);
    if (!t) return;
    ray_hit.ray.tfar = static_cast<float>(*t);
    ray_hit.hit.geomID = geometry.id;
    ray_hit.hit.primID = args->primID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

template <class UserGeometry>
void user_occluded(const RTCOccludedFunctionNArguments* args)
{
    if (args->valid[0] == 0) return;
    const auto& geometry = *static_cast<const UserGeometry*>(args->geometryUserPtr);
    auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
    if (geometry.primitives->intersect(our_ray(ray), args->primID)) ray.tfar = -infinity;
}

} // namespace

void throw_device_error(const char* doing)
{
    DeviceErrors& errors = device_errors();
    const std::lock_guard lock(errors.mutex);
    if (errors.code == RTC_ERROR_NONE) return;
    const bool memory = errors.code == RTC_ERROR_OUT_OF_MEMORY;
    const std::string message = errors.message;
    errors.code = RTC_ERROR_NONE;
    if (memory) throw Error(fmt::format("out of memory while {}", doing));
    throw Error(fmt::format("Embree failed while {}: {}", doing, message));
}

class Scene::Accel::Builder final : public AccelBuilder {
public:
    Builder(Accel& accel, Part& part) : accel_(accel), part_(part) {}

    void start_object(std::uint32_t object) { object_ = object; }

    void add_triangles(std::span<const Vec3f> positions, std::span<const Triangle> triangles) override
    {
        RTCGeometry geometry = rtcNewGeometry(accel_.device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(),
                                   0, sizeof(Vec3f), positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                                   sizeof(Triangle), triangles.size());
        attach(geometry);
    }

    void add_user(const Primitives& primitives) override
    {
        const auto id = static_cast<std::uint32_t>(part_.object_of_geometry.size());
        accel_.user_geometries_.push_back(std::make_unique<UserGeometry>(UserGeometry{&primitives, id}));
        RTCGeometry geometry = rtcNewGeometry(accel_.device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives.count()));
        rtcSetGeometryUserData(geometry, accel_.user_geometries_.back().get());
        rtcSetGeometryBoundsFunction(geometry, user_bounds<UserGeometry>, nullptr);
        rtcSetGeometryIntersectFunction(geometry, user_intersect<UserGeometry>);
        rtcSetGeometryOccludedFunction(geometry, user_occluded<UserGeometry>);
        attach(geometry);
    }

    void attach(RTCGeometry geometry)
    {
        throw_device_error("building the scene");
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(part_.scene, geometry, static_cast<unsigned>(part_.object_of_geometry.size()));
        rtcReleaseGeometry(geometry);
        part_.object_of_geometry.push_back(object_);
        throw_device_error("building the scene");
    }

private:
    Accel& accel_;
    Part& part_;
    std::uint32_t object_ = 0;
};

Scene::Accel::Accel(const std::vector<SceneObject>& objects, const std::vector<Instance>& instances,
                    const std::string& instruction_set)
{
    const InstructionSet& set = find_instruction_set(instruction_set);
    if (!set.runs_here())
        throw Error(
            fmt::format("this processor cannot run Embree with {}; choose another with --isa", set.name));
    device_ = rtcNewDevice(set.embree_config);
    // The processor can run it, so that only the machine's resources are left as a cause.
    if (device_ == nullptr)
        throw Error(fmt::format(
            "Embree cannot start with instruction set {} (error {}): there may be too little memory",
            set.name, static_cast<int>(rtcGetDeviceError(nullptr))));
    rtcSetDeviceErrorFunction(device_, on_device_error, nullptr);
    rtcSetDeviceMemoryMonitorFunction(device_, on_memory, this);
    try {
        parts_.emplace_back();
        fill(parts_[0], objects);
        scene_ = parts_[0].scene;
        if (!instances.empty()) add_instances(instances);
        rtcCommitScene(scene_);
        throw_device_error("building the scene");
    } catch (...) {
        release();
        throw;
    }
}

void Scene::Accel::fill(Part& part, const std::vector<SceneObject>& objects)
{
    part.scene = rtcNewScene(device_);
    rtcSetSceneFlags(part.scene, RTC_SCENE_FLAG_ROBUST); // no holes along shared edges
    rtcSetSceneBuildQuality(part.scene, RTC_BUILD_QUALITY_MEDIUM);
    Builder builder(*this, part);
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        builder.start_object(i);
        objects[i].shape->add_to(builder);
    }
}

void Scene::Accel::release()
{
    for (const Part& part : parts_)
        if (part.scene != nullptr) rtcReleaseScene(part.scene);
    rtcReleaseDevice(device_);
}

Scene::Accel::~Accel()
{
    release();
}

inline Scene::Accel::Hit Scene::Accel::intersect(const Ray& ray) const
{
    const RTCRayHit found = intersect_scene(scene_, embree_ray(ray));
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const unsigned instance = found.hit.instID[0];
    if (instance != RTC_INVALID_GEOMETRY_ID) [[unlikely]]
        return {parts_[instances_.part[instance]].object_of_geometry[found.hit.geomID], found.hit.primID,
                instance};
    return {parts_[0].object_of_geometry[found.hit.geomID], found.hit.primID};
}

inline bool Scene::Accel::occluded(const Ray& ray) const
{
    return is_occluded(scene_, embree_ray(ray));
}

// Here, so that the way of a ray to Embree is one function.
std::optional<SurfacePoint> Scene::intersect(const Ray& ray) const
{
    const Accel::Hit hit = accel_->intersect(ray);
    if (!hit) return std::nullopt;
    if (hit.instance != Accel::Hit::nothing) [[unlikely]]
        return emplace_with([&] { return point_in_instance(ray, hit.instance, hit.object, hit.primitive); });
    const auto surface_point = [&] {
        const SceneObject& object = objects_[hit.object];
        SurfacePoint point = object.shape->surface_at(ray, hit.primitive);
        point.primitive = hit.primitive;
        point.shape = object.shape.get();
        point.bsdf = object.bsdf.get();
        point.emitter = object.emitter.get();
        const ObjectFacts facts = facts_[hit.object];
        point.emitter_index = facts.emitter_index;
        if (facts.is_oriented) [[unlikely]]
            point.shading = Frame(point.shading.n, point.shape->tangents(point).dp_du);
        return point;
    };
    return emplace_with(surface_point);
}

bool Scene::occluded(const Ray& ray) const
{
    return accel_->occluded(ray);
}

// Called from all threads, before memory is taken and after it is given back.
bool Scene::Accel::on_memory(void* accel, std::ptrdiff_t bytes, bool)
{
    auto& self = *static_cast<Accel*>(accel);
    const std::ptrdiff_t now = self.memory_ += bytes;
    std::ptrdiff_t peak = self.memory_peak_;
    while (now > peak && !self.memory_peak_.compare_exchange_weak(peak, now)) {
    }
    return true; // go on
}

SceneMemory Scene::Accel::memory() const
{
    SceneMemory memory;
    memory.acceleration = static_cast<std::uint64_t>(memory_.load());
    memory.acceleration_peak = static_cast<std::uint64_t>(memory_peak_.load());
    return memory;
}

std::string Scene::Accel::version() const
{
    const auto number = [this](RTCDeviceProperty property) {
        return rtcGetDeviceProperty(device_, property);
    };
    return fmt::format("{}.{}.{}", number(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                       number(RTC_DEVICE_PROPERTY_VERSION_MINOR), number(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

} // namespace plumb
