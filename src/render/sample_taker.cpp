// SPDX-License-Identifier: MIT

#include "render/sample_taker.h"

#include "render/camera_place.h"

namespace plumb {

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
    const int looks = look_sampler_ ? outlines_.looks_at(pixel, edge_, *look_sampler_) : 0;
    tracer_.expect_looks(looks);
    Color seen(0.f);
    if (looks > 0) {
        look_tracer_.expect_looks(looks);
        seen = outlines_.look(seed, pixel, index, edge_, *look_sampler_, look_tracer_);
        if (tracer_.logging())
            tracer_.log_contribution(PathEvent::Kind::emission, "the mean of several looks for lamps", seen);
    }
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
