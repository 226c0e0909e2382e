// SPDX-License-Identifier: MIT

#include "render/outlines.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "plumb/model/shape.h"
#include "render/camera_place.h"
#include "render/pixel_cover.h"
#include "samplers/hashed.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace plumb {
namespace {

// Of a pixel, where a smooth surface may be: at first, and where light has so long a way there that few places show a lamp.
constexpr std::uint8_t places_at_mirrors = 4;
constexpr std::uint32_t places_behind_glass = 8;
constexpr std::uint32_t rays_behind_glass = 3; // of a look, or more
// Where a lamp may be: so many in all the pixels together, within these limits for each.
constexpr float places_of_lamp = 512.f;
constexpr std::uint8_t fewest_places_at_lamps = 4;
constexpr std::uint8_t most_places = 64;
constexpr std::uint64_t probes = 4;
// Of an outline: by which part of its mean V differs at least.
constexpr double least_difference = 0.1;
// Of a look. Those that take more are fewer.
constexpr double usual_rays = 2.0;
constexpr std::uint64_t place_seed = 0x706C61636573; // "places"
constexpr std::uint64_t probe_seed = 0x70726F626573; // "probes"
constexpr std::uint64_t look_key = 0x6C6F6F6B73;     // "looks"

float finite_luminance(const Color& color)
{
    const float value = luminance(color);
    return std::isfinite(value) ? value : 0.f;
}

// The part of it that is in the image may be less.
std::uint8_t places_for(const RasterBounds& lamp)
{
    const Vec2f size = lamp.max - lamp.min + Vec2f(1.f); // and the pixels at both ends
    const float places = places_of_lamp / (size.x * size.y);
    if (!(places > static_cast<float>(fewest_places_at_lamps))) return fewest_places_at_lamps;
    return static_cast<std::uint8_t>(std::min(places, static_cast<float>(most_places)));
}

bool shows_lamps(const SceneObject& object)
{
    return object.bsdf && object.bsdf->lobes().has_any(delta_lobes | glossy_lobes);
}

// Where instances show lamps; of very many of them, the box of all.
std::vector<Box3f> boxes_of_mirrors_in_instances(const Scene& scene)
{
    constexpr std::size_t most = 4096;
    std::unordered_map<const Group*, bool> shows;
    for (const Group* group : scene.groups())
        shows[group] = std::ranges::any_of(group->objects(), shows_lamps);
    std::vector<Box3f> boxes;
    Box3f all;
    for (const Instance& instance : scene.instances()) {
        if (!shows[instance.group.get()]) continue;
        all.extendBy(instance.bounds());
        if (boxes.size() <= most) boxes.push_back(instance.bounds());
    }
    return boxes.size() > most ? std::vector{all} : boxes;
}

// The pixels of a window that bounds touch; of no width where there are none.
PixelRect pixels_in(const RasterBounds& bounds, const PixelRect& window)
{
    const auto clamped = [](float x, int first, int size) {
        return static_cast<int>(std::clamp(x, static_cast<float>(first), static_cast<float>(first + size)));
    };
    const int left = clamped(std::floor(bounds.min.x), window.x, window.width);
    const int right = clamped(std::ceil(bounds.max.x), window.x, window.width);
    const int top = clamped(std::floor(bounds.min.y), window.y, window.height);
    const int bottom = clamped(std::ceil(bounds.max.y), window.y, window.height);
    if (left >= right || top >= bottom) return {window.x, window.y, 0, 0};
    return {left, top, right - left, bottom - top};
}

} // namespace

Outlines::Outlines(const RenderJob& job, const PixelRect& window, int threads)
    : job_(job), window_(window), most_looks_(job.integrator->outline_rays())
{
    // Filters with negative lobes have samples of both signs, which are no means of each other.
    if (most_looks_ < 2 || job.filter->sample(Vec2f(0.5f)).weight != 1.f) return;
    const auto emits = [](const SceneObject& object) { return object.emitter != nullptr; };
    if (std::ranges::none_of(job.scene->objects(), emits)) return;
    reach_ = static_cast<int>(std::ceil(job.filter->radius() + 0.5f));
    around_ = {window.x - reach_, window.y - reach_, window.width + 2 * reach_, window.height + 2 * reach_};
    if (const std::vector<std::uint8_t> looked_at = places(); !looked_at.empty()) find(looked_at, threads);
}

std::vector<std::uint8_t> Outlines::places() const
{
    PixelCover lamps(around_), mirrors(around_);
    std::vector<std::pair<PixelRect, std::uint8_t>> small_lamps;
    const auto bounds_of = [&](const Box3f& box) {
        return job_.camera->bounds_of(box).value_or(RasterBounds{Vec2f(-infinity), Vec2f(infinity)});
    };
    for (const SceneObject& object : job_.scene->objects()) {
        if (!object.emitter && !shows_lamps(object)) continue;
        const RasterBounds bounds = bounds_of(object.shape->bounds());
        const PixelRect pixels = pixels_in(bounds, around_);
        if (pixels.width == 0) continue;
        if (shows_lamps(object)) mirrors.add(pixels);
        if (!object.emitter) continue;
        lamps.add(pixels);
        if (const std::uint8_t places = places_for(bounds); places > fewest_places_at_lamps)
            small_lamps.emplace_back(pixels, places);
    }
    for (const Box3f& box : boxes_of_mirrors_in_instances(*job_.scene))
        mirrors.add(pixels_in(bounds_of(box), around_));
    if (lamps.empty() && mirrors.empty()) return {};

    std::vector<std::uint8_t> places(pixel_count(around_));
    const std::vector<bool> has_lamp = lamps.covered(), has_mirror = mirrors.covered();
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = has_lamp[i]     ? fewest_places_at_lamps
                    : has_mirror[i] ? places_at_mirrors
                                    : std::uint8_t{0};
    for (const auto& [pixels, count] : small_lamps)
        for (int y = pixels.y; y < pixels.y + pixels.height; ++y)
            for (int x = pixels.x; x < pixels.x + pixels.width; ++x) {
                std::uint8_t& here = places[index_in(around_, {x, y})];
                here = std::max(here, count);
            }
    return places;
}

void Outlines::find(const std::vector<std::uint8_t>& places, int threads)
{
    sights_.resize(pixel_count(around_));
    std::atomic<bool> any = false;
    parallel_for(static_cast<std::size_t>(around_.height), threads, [&](std::size_t row) {
        const FlushDenormals flush;
        Tracer tracer(*job_.scene); // of its own: these rays are no sample's
        tracer.expect_looks(most_looks_);
        const std::unique_ptr<Sampler> sampler = job_.sampler->clone(most_places);
        const int y = around_.y + static_cast<int>(row);
        for (int x = around_.x; x < around_.x + around_.width; ++x) {
            const std::size_t at = index_in(around_, {x, y});
            if (places[at] == 0) continue;
            Sight& sight = sights_[at];
            glance(sight, {x, y}, places[at], *sampler, tracer);
            if (sight.rays >= rays_behind_glass * sight.places && sight.places < places_behind_glass)
                glance(sight, {x, y}, places_behind_glass - sight.places, *sampler, tracer);
            if (sight.sum > 0.f) any = true;
        }
    });
    if (any) looks_.assign(pixel_count(window_), unknown);
}

// Pixels beyond the edges of the image, too, which samplers do not know: they draw the numbers of other ones.
void Outlines::glance(Sight& sight, Vec2i pixel, std::uint32_t places, Sampler& sampler, Tracer& tracer) const
{
    constexpr int largest = 0xFFFF;
    const std::uint64_t rays_before = tracer.counts().total();
    for (std::uint32_t i = 0; i < places; ++i, ++sight.places) {
        sampler.start(place_seed, {pixel.x & largest, pixel.y & largest}, sight.places);
        const Vec2f u = sampler.next_2d();
        const Vec2f u_lens = sampler.next_2d();
        const Vec2f raster(static_cast<float>(pixel.x) + u.x, static_cast<float>(pixel.y) + u.y);
        const CameraRay camera = job_.camera->sample_ray(raster, u_lens);
        const float value =
            finite_luminance(job_.integrator->look(tracer, sampler, camera.ray) * camera.weight);
        sight.sum += value;
        sight.squares += sqr(value);
    }
    sight.rays += static_cast<std::uint32_t>(tracer.counts().total() - rays_before);
}

Outlines::Sight Outlines::sight_about(Vec2i pixel) const
{
    Sight about;
    for (int y = pixel.y - reach_; y <= pixel.y + reach_; ++y)
        for (int x = pixel.x - reach_; x <= pixel.x + reach_; ++x) {
            const Sight& one = sights_[index_in(around_, {x, y})];
            about.sum += one.sum;
            about.squares += one.squares;
            // Where nobody has looked there is no lamp, and a look would be short.
            about.places += one.places > 0 ? one.places : fewest_places_at_lamps;
            about.rays += one.places > 0 ? one.rays : fewest_places_at_lamps;
        }
    return about;
}

// The product of variance and time is least for a number that goes with the standard deviation of V over that of the rest, and with 1
// over the square root of the rays of a look ([1]). That of the rest is taken to be as large as its mean. One look alone would gain
// nothing.
int Outlines::count_looks(const Sight& sight, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const
{
    const auto places = static_cast<double>(sight.places);
    const double mean = static_cast<double>(sight.sum) / places;
    const double variance = static_cast<double>(sight.squares) / places - sqr(mean);
    if (!(variance > sqr(least_difference * mean))) return 0;
    const double deviation = std::sqrt(variance);
    const double rest = std::max(rest_of_light(pixel, edge, sampler), 1e-6 * deviation);
    const auto most = static_cast<double>(most_looks_);
    const double cost = std::max(static_cast<double>(sight.rays) / places, usual_rays);
    const double wanted = std::min(deviation / rest, most) * std::sqrt(usual_rays / cost);
    int looks = 1;
    while (2.0 * looks <= wanted) looks *= 2;
    return looks > 1 ? looks : 0;
}

std::unique_ptr<Sampler> Outlines::sampler(std::uint64_t total) const
{
    if (looks_.empty()) return nullptr;
    return job_.sampler->clone(std::max(total * static_cast<std::uint64_t>(most_looks_), probes));
}

int Outlines::looks_at(Vec2i pixel, const FilmEdge& edge, Sampler& sampler)
{
    // Two threads that decide at the same time decide the same.
    const std::atomic_ref<std::uint8_t> known(looks_[index_in(window_, pixel)]);
    std::uint8_t looks = known.load(std::memory_order_relaxed);
    if (looks == unknown) {
        looks = static_cast<std::uint8_t>(count_looks(sight_about(pixel), pixel, edge, sampler));
        known.store(looks, std::memory_order_relaxed);
    }
    return looks;
}

// Its luminance, roughly.
double Outlines::rest_of_light(Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const
{
    Tracer tracer(*job_.scene);
    tracer.expect_looks(most_looks_);
    double rest = 0.0;
    for (std::uint64_t i = 0; i < probes; ++i) {
        sampler.start(probe_seed, pixel, i);
        const CameraRay camera = draw_place(job_, edge, pixel, sampler).camera;
        const Color radiance = job_.integrator->radiance(tracer, sampler, camera.ray) * camera.weight;
        rest += static_cast<double>(finite_luminance(radiance)) / static_cast<double>(probes);
    }
    return rest;
}

Color Outlines::look(std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge,
                     Sampler& sampler, Tracer& tracer) const
{
    const std::uint64_t look_seed = random_word(look_key, seed);
    const auto looks = static_cast<std::uint64_t>(tracer.looks());
    Color sum(0.f);
    for (std::uint64_t i = 0; i < looks; ++i) {
        // The looks of a pixel's samples are spread over it together.
        sampler.start(look_seed, pixel, index * looks + i);
        const CameraRay camera = draw_place(job_, edge, pixel, sampler).camera;
        const std::size_t noted = tracer.noted_light();
        const auto with_sum = [&](const Color& seen) {
            return sum + seen * camera.weight * (1.f / static_cast<float>(looks));
        };
        const Color seen = job_.integrator->look(tracer, sampler, camera.ray);
        tracer.change_noted_light(noted, with_sum);
        sum = with_sum(seen);
    }
    return sum;
}

} // namespace plumb
