// SPDX-License-Identifier: MIT
#include "check/precision_doubts.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// A scene that lies at the origin is 2^24 steps large, or half of that. With fewer than 2^16 steps a ray starts further
// off a surface than 1/16384 of the scene's size: a share of a pixel, and light gets through walls that meet.
constexpr double fewest_steps_of_scene = 65536.0;
// An object is a part of a scene: with fewer steps than these, its surface is off by some thousandths of its size.
constexpr double fewest_steps_of_object = 1024.0;

double largest_coordinate(const Box3f& box)
{
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(static_cast<double>(box.min[axis])),
                            std::abs(static_cast<double>(box.max[axis]))});
    return largest;
}

// Between a number of that size and the next.
double step_at(double coordinate)
{
    const auto x = static_cast<float>(coordinate);
    return static_cast<double>(std::nextafter(x, infinity)) - static_cast<double>(x);
}

double size_of(const Box3f& box)
{
    return static_cast<double>(max_component(box.size()));
}

std::string offset_text(const Vec3f& offset)
{
    const auto text = [](float x) { return fmt::format("{:.4g}", x == 0.f ? 0.f : x); };
    return fmt::format("({}, {}, {})", text(offset.x), text(offset.y), text(offset.z));
}

// "at coordinates up to 1e+05 floats are 0.0078 apart, 1/256 of".
std::string steps_text(double coordinate, double size)
{
    const double step = step_at(coordinate);
    return fmt::format("at coordinates up to {:.4g} floats are {:.2g} apart, 1/{:.0f} of", coordinate, step,
                       std::max(size / step, 1.0));
}

// The middle one of the distances of what the camera sees; nothing if it sees nothing.
std::optional<double> viewing_distance(const RenderJob& job)
{
    constexpr int rays = 8; // across and down
    const Vec2i resolution = job.camera->resolution();
    std::vector<double> distances;
    for (int i = 0; i < rays * rays; ++i) {
        const Vec2f place((static_cast<float>(i % rays) + 0.5f) / rays,
                          (static_cast<float>(i / rays) + 0.5f) / rays);
        const Vec2f raster(place.x * static_cast<float>(resolution.x),
                           place.y * static_cast<float>(resolution.y));
        const Ray ray = job.camera->sample_ray(raster, Vec2f(0.5f)).ray;
        if (const auto hit = job.scene->intersect(ray))
            distances.push_back(static_cast<double>(length(hit->position - ray.origin)));
    }
    if (distances.empty()) return {};
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

std::optional<Doubt> doubt_of_scene(const Scene& scene)
{
    const Box3f bounds = scene.bounds();
    if (bounds.isEmpty()) return {};
    const double coordinate = largest_coordinate(bounds), size = size_of(bounds);
    if (!(size < fewest_steps_of_scene * step_at(coordinate))) return {};
    return Doubt{"", fmt::format("the scene is too far from the origin for 32-bit floats: {} its size of "
                                 "{:.3g}; move all of it, including the camera, by {}",
                                 steps_text(coordinate, size), size, offset_text(-bounds.center()))};
}

std::optional<Doubt> doubt_of_view(const RenderJob& job)
{
    const Vec2i resolution = job.camera->resolution();
    const Vec2f middle(0.5f * static_cast<float>(resolution.x), 0.5f * static_cast<float>(resolution.y));
    const Vec3f camera = job.camera->sample_ray(middle, Vec2f(0.5f)).ray.origin;
    const double coordinate = largest_coordinate(Box3f(camera));
    const auto distance = viewing_distance(job);
    constexpr double in_a_surface = 1e-5; // of the scene's size: the camera sees nothing else from there
    if (!distance || *distance < in_a_surface * size_of(job.scene->bounds())) return {};
    if (!(*distance < fewest_steps_of_scene * step_at(coordinate))) return {};
    return Doubt{
        "",
        fmt::format("the camera is too far from the origin for 32-bit floats: {} the distance of {:.3g} to "
                    "what it sees; move the whole scene by {}",
                    steps_text(coordinate, *distance), *distance, offset_text(-camera))};
}

std::optional<Doubt> doubt_of_object(const std::string& name, const Box3f& bounds)
{
    if (bounds.isEmpty()) return {};
    const double coordinate = largest_coordinate(bounds), size = size_of(bounds);
    if (!(size < fewest_steps_of_object * step_at(coordinate))) return {};
    return Doubt{name, fmt::format("it is too small for 32-bit floats at its position: {} its size of {:.3g}",
                                   steps_text(coordinate, size), size)};
}

} // namespace

std::vector<Doubt> precision_doubts(const RenderJob& job)
{
    std::vector<Doubt> doubts;
    if (auto scene = doubt_of_scene(*job.scene)) return {*std::move(scene)}; // and so is all that is in it
    if (auto view = doubt_of_view(job)) doubts.push_back(*std::move(view));
    for (const SceneObject& object : job.scene->objects())
        if (auto one = doubt_of_object(object.name, object.shape->bounds()))
            doubts.push_back(*std::move(one));
    for (const Instance& instance : job.scene->instances())
        if (auto one = doubt_of_object(instance.name, instance.bounds())) {
            doubts.push_back(*std::move(one));
            break; // many may stand there
        }
    return doubts;
}

} // namespace plumb
