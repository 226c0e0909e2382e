// SPDX-License-Identifier: MIT
#include "scene_file/after_load.h"

#include "plumb/model/dialect.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "plumb/scene_file/scene_file.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t most_objects = 1024;
constexpr int points_along = 3; // of an object's box, on each axis

bool is_sun(const Emitter& emitter)
{
    return emitter.is_delta() && emitter.is_infinite();
}

// Whether light towards -wi meets first, on its way through p, a surface that it can light.
bool lights_near(const Scene& scene, const Vec3f& p, const Vec3f& wi, float size)
{
    const auto hit = scene.intersect({p + wi * size, -wi});
    if (!hit) return false;
    return hit->bsdf->has_back() || dot(hit->geometric_normal, wi) > 0.f;
}

// Around the objects and the instances, or around some of very many.
std::vector<Box3f> boxes_in(const Scene& scene)
{
    std::vector<Box3f> boxes;
    const auto add_some = [&](std::size_t count, const auto& box_of) {
        const std::size_t step = std::max<std::size_t>(1, count / most_objects);
        for (std::size_t i = 0; i < count; i += step) boxes.push_back(box_of(i));
    };
    add_some(scene.objects().size(), [&](std::size_t i) { return scene.objects()[i].shape->bounds(); });
    add_some(scene.instances().size(), [&](std::size_t i) { return scene.instances()[i].bounds(); });
    return boxes;
}

// Looks through points in boxes.
bool lights_anything(const Scene& scene, const Vec3f& wi)
{
    const float size = 2.f * length(scene.bounds().size());
    for (const Box3f& box : boxes_in(scene)) {
        for (int k = 0; k < points_along * points_along * points_along; ++k) {
            const Vec3f share((static_cast<float>(k % points_along) + 0.47f) / points_along,
                              (static_cast<float>(k / points_along % points_along) + 0.53f) / points_along,
                              (static_cast<float>(k / points_along / points_along) + 0.51f) / points_along);
            if (lights_near(scene, box.min + share * box.size(), wi, size)) return true;
        }
    }
    return false;
}

template <class Visit>
void visit_all(const Element& element, const Visit& visit)
{
    visit(element);
    for (const Element& child : element.children) visit_all(child, visit);
}

bool has_delta(const Element& element)
{
    return std::any_of(element.children.begin(), element.children.end(), [](const Element& child) {
        return child.value("name") == "delta" &&
               child.value("value").find_first_of("123456789") != std::string::npos;
    });
}

} // namespace

void warn_of_idle_suns(const Element& root, const RenderJob& job, const Dialect& dialect,
                       Diagnostics& diagnostics)
{
    if (!job.integrator->needs_lamps()) return;
    std::vector<const Emitter*> suns;
    for (const Emitter* emitter : job.scene->emitters())
        if (is_sun(*emitter)) suns.push_back(emitter);
    std::size_t index = 0;
    visit_all(root, [&](const Element& element) {
        if (element.tag != "emitter" || element.value("type") != "directional" || index == suns.size())
            return;
        const Emitter& sun = *suns[index++];
        const auto light = sun.sample({}, 0.5, Vec2f(0.5f), Measure::best);
        if (!light || !(sun.power() > 0.f) || lights_anything(*job.scene, light->wi)) return;
        diagnostics.warning(
            element.place(),
            fmt::format("this light reaches the front of no surface, so it lights nothing: it goes along "
                        "({:.3g}, {:.3g}, {:.3g}), for 'direction' {}",
                        -light->wi.x, -light->wi.y, -light->wi.z,
                        dialect.sun_points_to_light ? "points towards the light" : "is where it goes"));
    });
}

std::vector<std::string> readings_changed_since_1(const Element& root, const Dialect& dialect)
{
    static_assert(language_version == 2, "what has changed since version 2, and since when?");
    bool sun = false, delta = false;
    visit_all(root, [&](const Element& element) {
        const std::string type = element.value("type");
        sun = sun || (element.tag == "emitter" && type == "directional" && !dialect.sun_points_to_light);
        delta =
            delta || (element.tag == "texture" && type.starts_with("checkerboard_") && has_delta(element));
    });
    std::vector<std::string> changed;
    if (sun) changed.emplace_back("the direction of a directional light");
    if (delta) changed.emplace_back("the delta of a checkerboard");
    return changed;
}

} // namespace plumb
