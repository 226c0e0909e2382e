// SPDX-License-Identifier: MIT

// The table of AOVs.
//
// Conventions. World space. Normals are on the side of the surface that is seen. A layer is 0 where nothing is seen.

#include "plumb/render/aovs.h"

#include "plumb/model/camera.h"
#include "plumb/model/shape.h"
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

// IEC 61966-2-1: of linear sRGB.
Vec3f xyz_of(const Color& c)
{
    return {0.412453f * c.r + 0.357580f * c.g + 0.180423f * c.b, luminance(c),
            0.019334f * c.r + 0.119193f * c.g + 0.950227f * c.b};
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

// Over all samples, with the filter's weights: what sees nothing counts as 0, as in the aov integrator of Mitsuba.
AovRow mean_row(const char* name, Names components, std::string_view unit, std::string_view manual,
                void (*measure)(const Seen&, const View&, float*))
{
    return {{name, std::move(components), LayerKind::mean}, unit, manual, false, measure, nullptr, nullptr};
}

AovRow sample_row(Layer layer, std::string_view manual, void (*of_sample)(const SampleFacts&, float*))
{
    return {std::move(layer), "", manual, false, nullptr, nullptr, nullptr, of_sample};
}

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
        mean_row("mean_depth", {"T"}, "scene units", "distance from the camera along the ray",
                 [](const Seen& seen, const View&, float* out) { out[0] = seen.distance; }),
        mean_row("mean_position", xyz, "scene units", "where the surface is, world space",
                 [](const Seen& seen, const View&, float* out) { put(out, seen.at.position); }),
        mean_row("mean_uv", {"U", "V"}, "", "texture coordinates",
                 [](const Seen& seen, const View&, float* out) {
                     out[0] = seen.at.uv.x;
                     out[1] = seen.at.uv.y;
                 }),
        mean_row("mean_normal", xyz, "", "shading normal of the front side, whichever is seen",
                 [](const Seen& seen, const View&, float* out) { put(out, seen.at.shading.n); }),
        mean_row("mean_geometric_normal", xyz, "", "normal of the front side of the surface itself",
                 [](const Seen& seen, const View&, float* out) { put(out, seen.at.geometric_normal); }),
        mean_row("mean_dp_du", xyz, "scene units", "how the point moves with u, world space",
                 [](const Seen& seen, const View&, float* out) { put(out, tangents_at(seen.at).dp_du); }),
        mean_row("mean_dp_dv", xyz, "scene units", "how the point moves with v, world space",
                 [](const Seen& seen, const View&, float* out) { put(out, tangents_at(seen.at).dp_dv); }),
        mean_row("mean_object", {"I"}, "", "number of the object: its line in plumb:ids.object, from 1",
                 [](const Seen& seen, const View& view, float* out) {
                     out[0] = static_cast<float>(view.object_of(seen.at));
                 }),
        mean_row("mean_primitive", {"I"}, "", "number of the triangle in its mesh, from 0",
                 [](const Seen& seen, const View&, float* out) {
                     out[0] = static_cast<float>(seen.at.primitive);
                 }),
        sample_row({"xyz", xyz, LayerKind::mean}, "the light of the sample in CIE XYZ",
                   [](const SampleFacts& sample, float* out) { put(out, xyz_of(sample.radiance)); }),
        sample_row({"xyz_squared", xyz, LayerKind::mean}, "the square of each component of xyz",
                   [](const SampleFacts& sample, float* out) {
                       const Vec3f v = xyz_of(sample.radiance);
                       put(out, v * v);
                   }),
        sample_row({"rays", {"N"}, LayerKind::mean_of_hits},
                   "number of rays that a sample takes: camera, bounce and shadow rays",
                   [](const SampleFacts& sample, float* out) { out[0] = static_cast<float>(sample.rays); }),
    };
    return rows;
}

} // namespace

std::span<const AovRow> aov_rows()
{
    return table();
}

} // namespace plumb
