// SPDX-License-Identifier: MIT
#pragma once

// Where a ray of the camera begins that stands for a pixel.

#include "plumb/model/sampler.h"
#include "plumb/render/render.h"
#include "render/film_edge.h"

namespace plumb {

struct CameraPlace {
    CameraRay camera;
    Vec2f raster;
    float weight; // of the filter
};

// Draws four dimensions.
inline CameraPlace draw_place(const RenderJob& job, const FilmEdge& edge, Vec2i pixel, Sampler& sampler)
{
    const Vec2f u_filter = sampler.next_2d();
    const Vec2f u_lens = sampler.next_2d();
    const FilterSample place = edge.sample(pixel, u_filter);
    const Vec2f raster(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                       static_cast<float>(pixel.y) + 0.5f + place.offset.y);
    return {job.camera->sample_ray(raster, u_lens), raster, place.weight};
}

} // namespace plumb
