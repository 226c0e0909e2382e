// SPDX-License-Identifier: MIT

#include "render/sample_taker.h"

namespace plumb {

CameraPlace draw_place(const RenderJob& job, const FilmEdge& edge, Vec2i pixel, Sampler& sampler)
{
    const Vec2f u_filter = sampler.next_2d();
    const Vec2f u_lens = sampler.next_2d();
    const FilterSample place = edge.sample(pixel, u_filter);
    const Vec2f raster(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                       static_cast<float>(pixel.y) + 0.5f + place.offset.y);
    return {job.camera->sample_ray(raster, u_lens), raster, place.weight};
}

SampleTaker::SampleTaker(const RenderJob& job, const FilmEdge& edge, Outlines& outlines, std::uint64_t total,
                         const Tracer::Notes& notes)
    : job_(job),
      edge_(edge),
      outlines_(outlines),
      tracer_(*job.scene, notes),
      look_tracer_(*job.scene, {.light = notes.light}),
      sampler_(job.sampler->clone(total)),
      look_sampler_(outlines.sampler(total))
{}

SampleTaken SampleTaker::take(std::uint64_t seed, Vec2i pixel, std::uint64_t index)
{
    sampler_->start(seed, pixel, index);
    const CameraPlace place = draw_place(job_, edge_, pixel, *sampler_);
    const bool looks = look_sampler_ && outlines_.at(pixel, edge_, *look_sampler_);
    Color seen(0.f);
    if (looks) {
        seen = outlines_.look(seed, pixel, index, edge_, *look_sampler_, look_tracer_);
        if (tracer_.logging())
            tracer_.log_contribution(PathEvent::Kind::emission, "the mean of several looks for lamps", seen);
    }
    tracer_.leave_out_seen_lamps(looks);
    const std::size_t noted = tracer_.noted_light();
    Color radiance = job_.integrator->radiance(tracer_, *sampler_, place.camera.ray);
    const auto in_image = [&](const Color& found) { return found * place.camera.weight + seen; };
    radiance = in_image(radiance);
    tracer_.change_noted_light(noted, in_image);
    const bool failed = tracer_.take_failure();
    if (look_tracer_.take_failure() || failed) radiance = Color(std::numeric_limits<float>::quiet_NaN());
    return {radiance, place.raster, place.weight};
}

} // namespace plumb
