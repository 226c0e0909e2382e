// SPDX-License-Identifier: MIT

// Instances as one user geometry of Embree: a primitive for each.

#include "scene/accel.h"
#include "scene/accel_rays.h"

#include <unordered_map>

namespace plumb {

// An instance sends the ray through its map and on to the group's own scene. Embree asserts that rays are in its range, and
// Debian's aborts where one is not: those meet nothing.
struct Scene::Accel::InstanceCallbacks {
    static const Part& part_of(const Instances& all, unsigned instance)
    {
        return (*all.parts)[all.part[instance]];
    }

    static std::optional<RTCRay> in_group(const Instances& all, unsigned instance, const RTCRay& ray)
    {
        const RayD moved = all.instances[instance].to_object(RayD(our_ray(ray)));
        const Ray rounded(Vec3f(moved.origin), Vec3f(moved.direction), ray.tnear, ray.tfar);
        if (!is_traceable(rounded)) return std::nullopt;
        return embree_ray(rounded);
    }

    static void bounds(const RTCBoundsFunctionArguments* args)
    {
        const auto& all = *static_cast<const Instances*>(args->geometryUserPtr);
        RTCBounds of_group;
        rtcGetSceneBounds(part_of(all, args->primID).scene, &of_group);
        const Box3f box = all.instances[args->primID].to_world(
            Box3f({of_group.lower_x, of_group.lower_y, of_group.lower_z},
                  {of_group.upper_x, of_group.upper_y, of_group.upper_z}));
        store_bounds(*args->bounds_o, box);
    }

    static void intersect(const RTCIntersectFunctionNArguments* args)
    {
        if (args->valid[0] == 0) return;
        const auto& all = *static_cast<const Instances*>(args->geometryUserPtr);
        auto& ray_hit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
        const std::optional<RTCRay> ray = in_group(all, args->primID, ray_hit.ray);
        if (!ray) return;
        const RTCRayHit found = intersect_scene(part_of(all, args->primID).scene, *ray);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
        ray_hit.ray.tfar = found.ray.tfar;
        ray_hit.hit.geomID = found.hit.geomID;
        ray_hit.hit.primID = found.hit.primID;
        ray_hit.hit.instID[0] = args->primID;
    }

    static void occluded(const RTCOccludedFunctionNArguments* args)
    {
        if (args->valid[0] == 0) return;
        const auto& all = *static_cast<const Instances*>(args->geometryUserPtr);
        auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
        const std::optional<RTCRay> moved = in_group(all, args->primID, ray);
        if (moved && is_occluded(part_of(all, args->primID).scene, *moved)) ray.tfar = -infinity;
    }
};

// Groups first: the instances' bounds are theirs.
void Scene::Accel::add_instances(const std::vector<Instance>& instances)
{
    std::unordered_map<const Group*, std::uint32_t> part_of;
    instances_.instances = instances.data();
    instances_.part.reserve(instances.size());
    for (const Instance& instance : instances) {
        const auto [known, is_new] =
            part_of.emplace(instance.group.get(), static_cast<std::uint32_t>(parts_.size()));
        if (is_new) {
            parts_.emplace_back();
            fill(parts_.back(), instance.group->objects());
            rtcCommitScene(parts_.back().scene);
            throw_device_error("building a group");
        }
        instances_.part.push_back(known->second);
    }
    instances_.parts = &parts_;

    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(instances.size()));
    rtcSetGeometryUserData(geometry, &instances_);
    rtcSetGeometryBoundsFunction(geometry, InstanceCallbacks::bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, InstanceCallbacks::intersect);
    rtcSetGeometryOccludedFunction(geometry, InstanceCallbacks::occluded);
    throw_device_error("building the scene");
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(parts_[0].object_of_geometry.size()));
    rtcReleaseGeometry(geometry);
    throw_device_error("building the scene");
}

} // namespace plumb
