// SPDX-License-Identifier: MIT

#include "render/outlines.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "plumb/model/shape.h"
#include "render/sample_taker.h"
#include "samplers/hashed.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

namespace plumb {
namespace {

constexpr float unknown = -1.f; // in shares_
constexpr int places = 2;       // that are looked at, along each side of a pixel
constexpr std::size_t probes = 4;
// Of an outline: what is seen of lamps differs by more than this factor.
constexpr float least_contrast = 2.f;
constexpr float least_share = 0.25f;
constexpr std::uint64_t place_key = 0x6F75746C696E6573; // "outlines"
constexpr std::uint64_t probe_seed = 0x70726F626573;    // "probes"
constexpr std::uint64_t look_key = 0x6C6F6F6B73;        // "looks"

struct Seen {
    Color radiance{0.f}; // of a lamp; times the ray's weight
    std::uint32_t emitter = 0;
};

Seen look_along(const CameraRay& camera, Tracer& tracer)
{
    const auto hit = tracer.glance(camera.ray);
    if (!hit || !hit->emitter) return {};
    return {hit->emitter->evaluate({camera.ray.origin}, camera.ray.direction, &*hit, Measure::best).radiance *
                camera.weight,
            hit->emitter_index};
}

float finite_luminance(const Color& color)
{
    const float value = luminance(color);
    return std::isfinite(value) ? value : 0.f;
}

std::size_t index_in(const PixelRect& window, Vec2i pixel)
{
    return static_cast<std::size_t>(pixel.y - window.y) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(pixel.x - window.x);
}

std::size_t pixels_of(const PixelRect& window)
{
    return static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
}

// The mean of what was added.
struct Mean {
    double sum = 0.0;
    double count = 0.0;

    void add(float value)
    {
        sum += static_cast<double>(value);
        count += 1.0;
    }
    double or_else(double other) const { return count > 0.0 ? sum / count : other; }
};

} // namespace

Outlines::Outlines(const RenderJob& job, const PixelRect& window, int threads)
    : job_(job), window_(window), rays_(static_cast<std::uint64_t>(job.integrator->outline_rays()))
{
    // Filters with negative lobes have samples of both signs, which are no means of each other.
    if (rays_ == 0 || job.filter->sample(Vec2f(0.5f)).weight != 1.f) return;
    reach_ = static_cast<int>(std::ceil(job.filter->radius() + 0.5f));
    around_ = {window.x - reach_, window.y - reach_, window.width + 2 * reach_, window.height + 2 * reach_};
    if (const std::vector<bool> seen = candidates(); !seen.empty()) find(seen, threads);
}

std::vector<bool> Outlines::candidates() const
{
    std::vector<bool> seen;
    const auto clamped = [](float x, int first, int size) {
        return static_cast<int>(std::clamp(x, static_cast<float>(first), static_cast<float>(first + size)));
    };
    for (const SceneObject& object : job_.scene->objects()) {
        if (!object.emitter) continue;
        const RasterBounds bounds = job_.camera->bounds_of(object.shape->bounds())
                                        .value_or(RasterBounds{Vec2f(-infinity), Vec2f(infinity)});
        const int left = clamped(std::floor(bounds.min.x), around_.x, around_.width);
        const int right = clamped(std::ceil(bounds.max.x), around_.x, around_.width);
        const int top = clamped(std::floor(bounds.min.y), around_.y, around_.height);
        const int bottom = clamped(std::ceil(bounds.max.y), around_.y, around_.height);
        if (left >= right || top >= bottom) continue;
        seen.resize(pixels_of(around_));
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) seen[index_in(around_, {x, y})] = true;
    }
    return seen;
}

void Outlines::find(const std::vector<bool>& candidates, int threads)
{
    ranges_.resize(pixels_of(around_));
    std::atomic<bool> any = false;
    parallel_for(static_cast<std::size_t>(around_.height), threads, [&](std::size_t row) {
        const FlushDenormals flush;
        Tracer tracer(*job_.scene); // of its own: these rays are no sample's
        const int y = around_.y + static_cast<int>(row);
        for (int x = around_.x; x < around_.x + around_.width; ++x) {
            const std::size_t at = index_in(around_, {x, y});
            if (!candidates[at]) continue;
            ranges_[at] = glance({x, y}, tracer);
            if (ranges_[at].most > 0.f) any = true;
        }
    });
    if (any) shares_.assign(pixels_of(window_), unknown);
}

Outlines::Range Outlines::glance(Vec2i pixel, Tracer& tracer) const
{
    const auto number = static_cast<std::uint64_t>(static_cast<std::uint32_t>(pixel.y)) << 32 |
                        static_cast<std::uint32_t>(pixel.x);
    RandomStream random(random_word(place_key, number));
    Range range{infinity, 0.f};
    for (int i = 0; i < places * places; ++i) {
        const Vec2f u = random.next_2d();
        const Vec2f u_lens = random.next_2d();
        const Vec2f raster(static_cast<float>(pixel.x) + (static_cast<float>(i % places) + u.x) / places,
                           static_cast<float>(pixel.y) + (static_cast<float>(i / places) + u.y) / places);
        const float value =
            finite_luminance(look_along(job_.camera->sample_ray(raster, u_lens), tracer).radiance);
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
    return shares_.empty() ? nullptr : job_.sampler->clone(std::max<std::uint64_t>(total * rays_, probes));
}

float Outlines::share(Vec2i pixel, const FilmEdge& edge, Sampler& sampler)
{
    // Two threads that choose at the same time choose the same.
    const std::atomic_ref<float> known(shares_[index_in(window_, pixel)]);
    float share = known.load(std::memory_order_relaxed);
    if (share == unknown) {
        const Range range = range_about(pixel);
        share = range.most > least_contrast * range.least ? choose(range, pixel, edge, sampler) : 0.f;
        known.store(share, std::memory_order_relaxed);
    }
    return share;
}

// As if the lamp had one luminance, and what is seen of other light another one on it and beside it.
float Outlines::choose(const Range& range, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const
{
    Tracer tracer(*job_.scene);
    tracer.set_share_of_first_emission(0.f);
    Mean lamp, others_on_it, others_beside;
    for (std::size_t i = 0; i < probes; ++i) {
        sampler.start(probe_seed, pixel, i);
        const CameraRay camera = draw_place(job_, edge, pixel, sampler).camera;
        const float seen = finite_luminance(look_along(camera, tracer).radiance);
        const float others =
            finite_luminance(job_.integrator->radiance(tracer, sampler, camera.ray) * camera.weight);
        const bool on_it = seen > 0.5f * range.most;
        if (on_it) lamp.add(seen);
        (on_it ? others_on_it : others_beside)
            .add(std::min(others, range.most)); // a rare bright sample must not choose
    }
    const double on_it = others_on_it.or_else(0.0);
    const double beside = others_beside.or_else(on_it);
    const double share = 1.0 + (on_it - beside) / lamp.or_else(static_cast<double>(range.most));
    return share < least_share ? 0.f : static_cast<float>(std::min(share, 1.0));
}

Color Outlines::look(float share, std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge,
                     Sampler& sampler, Tracer& tracer) const
{
    const std::uint64_t look_seed = random_word(look_key, seed);
    Color sum(0.f);
    for (std::uint64_t i = 0; i < rays_; ++i) {
        // The rays of a pixel's samples are spread over it together.
        sampler.start(look_seed, pixel, index * rays_ + i);
        const Seen seen = look_along(draw_place(job_, edge, pixel, sampler).camera, tracer);
        if (seen.radiance.is_black()) continue;
        sum += seen.radiance * (share / static_cast<float>(rays_));
        tracer.note_light(sum, FoundBy::view, seen.emitter);
    }
    if (tracer.logging())
        tracer.log_contribution(PathEvent::Kind::emission, "what more rays of the pixel see of lamps", sum);
    return sum;
}

} // namespace plumb
