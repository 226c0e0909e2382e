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

constexpr std::uint8_t places_at_mirrors = 1; // of a pixel, where a smooth surface may be
// Where a lamp may be: so many in all the pixels together, within these limits for each.
constexpr float places_of_lamp = 512.f;
constexpr std::uint8_t fewest_places_at_lamps = 4;
constexpr std::uint8_t most_places = 64;
constexpr std::uint64_t probes = 4;
// Of an outline: V differs by more than this factor, and is at its brightest so many times the rest of the light.
constexpr float least_contrast = 2.f;
constexpr float least_brightness = 4.f;
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
    : job_(job), window_(window), looks_(static_cast<std::uint64_t>(job.integrator->outline_rays()))
{
    // Filters with negative lobes have samples of both signs, which are no means of each other.
    if (looks_ == 0 || job.filter->sample(Vec2f(0.5f)).weight != 1.f) return;
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
    ranges_.resize(pixel_count(around_));
    std::atomic<bool> any = false;
    parallel_for(static_cast<std::size_t>(around_.height), threads, [&](std::size_t row) {
        const FlushDenormals flush;
        Tracer tracer(*job_.scene); // of its own: these rays are no sample's
        const std::unique_ptr<Sampler> sampler = job_.sampler->clone(most_places);
        const int y = around_.y + static_cast<int>(row);
        for (int x = around_.x; x < around_.x + around_.width; ++x) {
            const std::size_t at = index_in(around_, {x, y});
            if (places[at] == 0) continue;
            ranges_[at] = glance({x, y}, places[at], *sampler, tracer);
            if (ranges_[at].most > 0.f) any = true;
        }
    });
    if (any) answers_.assign(pixel_count(window_), Answer::unknown);
}

// Pixels beyond the edges of the image, too, which samplers do not know: they draw the numbers of other ones.
Outlines::Range Outlines::glance(Vec2i pixel, int places, Sampler& sampler, Tracer& tracer) const
{
    constexpr int largest = 0xFFFF;
    Range range{infinity, 0.f};
    for (int i = 0; i < places; ++i) {
        sampler.start(place_seed, {pixel.x & largest, pixel.y & largest}, static_cast<std::uint64_t>(i));
        const Vec2f u = sampler.next_2d();
        const Vec2f u_lens = sampler.next_2d();
        const Vec2f raster(static_cast<float>(pixel.x) + u.x, static_cast<float>(pixel.y) + u.y);
        const CameraRay camera = job_.camera->sample_ray(raster, u_lens);
        const float value =
            finite_luminance(job_.integrator->look(tracer, sampler, camera.ray) * camera.weight);
        range.least = std::min(range.least, value);
        range.most = std::max(range.most, value);
    }
    return range;
}

Outlines::Range Outlines::range_about(Vec2i pixel) const
{
    Range range{infinity, 0.f};
    for (int y = pixel.y - reach_; y <= pixel.y + reach_; ++y)
        for (int x = pixel.x - reach_; x <= pixel.x + reach_; ++x) {
            const Range& one = ranges_[index_in(around_, {x, y})];
            range.least = std::min(range.least, one.least);
            range.most = std::max(range.most, one.most);
        }
    return range;
}

std::unique_ptr<Sampler> Outlines::sampler(std::uint64_t total) const
{
    return answers_.empty() ? nullptr : job_.sampler->clone(std::max<std::uint64_t>(total * looks_, probes));
}

bool Outlines::at(Vec2i pixel, const FilmEdge& edge, Sampler& sampler)
{
    // Two threads that decide at the same time decide the same.
    const std::atomic_ref<Answer> known(answers_[index_in(window_, pixel)]);
    Answer answer = known.load(std::memory_order_relaxed);
    if (answer == Answer::unknown) {
        const Range range = range_about(pixel);
        const bool differs = range.most > least_contrast * range.least;
        answer = differs && is_bright(range.most, pixel, edge, sampler) ? Answer::yes : Answer::no;
        known.store(answer, std::memory_order_relaxed);
    }
    return answer == Answer::yes;
}

bool Outlines::is_bright(float lamp, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const
{
    Tracer tracer(*job_.scene);
    tracer.leave_out_seen_lamps(true);
    float rest = 0.f;
    for (std::uint64_t i = 0; i < probes; ++i) {
        sampler.start(probe_seed, pixel, i);
        const CameraRay camera = draw_place(job_, edge, pixel, sampler).camera;
        const Color radiance = job_.integrator->radiance(tracer, sampler, camera.ray) * camera.weight;
        rest += finite_luminance(radiance) / static_cast<float>(probes);
    }
    return lamp > least_brightness * rest;
}

Color Outlines::look(std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge,
                     Sampler& sampler, Tracer& tracer) const
{
    const std::uint64_t look_seed = random_word(look_key, seed);
    Color sum(0.f);
    for (std::uint64_t i = 0; i < looks_; ++i) {
        // The looks of a pixel's samples are spread over it together.
        sampler.start(look_seed, pixel, index * looks_ + i);
        const CameraRay camera = draw_place(job_, edge, pixel, sampler).camera;
        const std::size_t noted = tracer.noted_light();
        const auto with_sum = [&](const Color& seen) {
            return sum + seen * camera.weight * (1.f / static_cast<float>(looks_));
        };
        const Color seen = job_.integrator->look(tracer, sampler, camera.ray);
        tracer.change_noted_light(noted, with_sum);
        sum = with_sum(seen);
    }
    return sum;
}

} // namespace plumb
