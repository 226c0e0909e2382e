// SPDX-License-Identifier: MIT

// The table of AOVs.
//
// Conventions. World space. Normals are on the side of the surface that is seen. A layer is 0 where nothing is seen.

#include "plumb/render/aovs.h"

#include "plumb/model/camera.h"
#include "plumb/scene/tracer.h"

namespace plumb {
namespace {

void put(float* out, const Vec3f& v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

void put(float* out, const Color& color)
{
    out[0] = color.r;
    out[1] = color.g;
    out[2] = color.b;
}

// The geometry decides which side is seen: an interpolated normal near a silhouette may lean away.
Vec3f towards_viewer(const SeenSurface& seen, const Vec3f& normal)
{
    return dot(seen.at.geometric_normal, seen.direction) > 0.f ? -normal : normal;
}

Color albedo(const SeenSurface& seen)
{
    return seen.through * seen.at.bsdf->albedo(seen.at, seen.at.shading.to_local(-seen.direction));
}

std::vector<std::string> object_names(const Scene& scene)
{
    std::vector<std::string> names;
    for (const SceneObject& object : scene.objects()) names.push_back(object.name);
    for (const Instance& instance : scene.instances()) names.push_back(instance.name);
    return names;
}

using Seen = SeenSurface;
using View = AovView;
using Names = std::vector<std::string>;
const Names rgb = {"R", "G", "B"};
const Names xyz = {"X", "Y", "Z"};

const std::vector<AovRow>& table()
{
    static const std::vector<AovRow> rows = {
        {{"albedo", rgb, LayerKind::mean},
         "",
         "fraction of light that the surface reflects or transmits towards the viewer, from 0 to 1",
         true,
         [](const Seen& seen, const View&, float* out) { put(out, albedo(seen)); },
         nullptr,
         nullptr},
        {{"normal", xyz, LayerKind::mean_of_hits},
         "",
         "shading normal towards the viewer, world space, each component from -1 to 1",
         true,
         [](const Seen& seen, const View&, float* out) { put(out, towards_viewer(seen, seen.at.shading.n)); },
         nullptr,
         nullptr},
        {{"geometric_normal", xyz, LayerKind::mean_of_hits},
         "",
         "normal of the surface itself towards the viewer, world space, each component from -1 to 1",
         false,
         [](const Seen& seen, const View&, float* out) {
             put(out, towards_viewer(seen, seen.at.geometric_normal));
         },
         nullptr,
         nullptr},
        {{"depth", {"Z"}, LayerKind::mean_of_hits},
         "scene units",
         "distance from the camera along the ray, at least 0",
         true,
         [](const Seen& seen, const View&, float* out) { out[0] = seen.distance; },
         nullptr,
         nullptr},
        {{"depth_z", {"Z"}, LayerKind::mean_of_hits},
         "scene units",
         "distance from the camera along its axis",
         false,
         [](const Seen& seen, const View& view, float* out) {
             out[0] = static_cast<float>(view.depth_along_view(&seen.at.position.x));
         },
         nullptr,
         nullptr},
        {{"position", xyz, LayerKind::mean_of_hits},
         "scene units",
         "where the surface is, world space",
         false,
         [](const Seen& seen, const View&, float* out) { put(out, seen.at.position); },
         nullptr,
         nullptr},
        {{"uv", {"U", "V"}, LayerKind::mean_of_hits},
         "",
         "texture coordinates",
         false,
         [](const Seen& seen, const View&, float* out) {
             out[0] = seen.at.uv.x;
             out[1] = seen.at.uv.y;
         },
         nullptr,
         nullptr},
        {{"coverage", {"A"}, LayerKind::mean},
         "",
         "fraction of samples that see a surface, from 0 to 1",
         false,
         [](const Seen&, const View&, float* out) { out[0] = 1.f; },
         nullptr,
         nullptr},
        {{"object", {"id"}, LayerKind::id},
         "",
         "which object the pixel's first sample sees: its line in plumb:ids.object, from 1",
         true,
         nullptr,
         [](const Seen& seen, const View& view) { return view.object_of(seen.at); },
         object_names},
        {{"material", {"id"}, LayerKind::id},
         "",
         "which BSDF the pixel's first sample sees: its line in plumb:ids.material, from 1",
         true,
         nullptr,
         [](const Seen& seen, const View& view) { return view.material_of(seen.at.bsdf); },
         material_names},
    };
    return rows;
}

} // namespace

std::span<const AovRow> aov_rows()
{
    return table();
}

} // namespace plumb
