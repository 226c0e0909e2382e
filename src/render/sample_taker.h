// SPDX-License-Identifier: MIT
#pragma once

// How a sample of a pixel is taken.

#include "plumb/render/render.h"
#include "plumb/scene/tracer.h"
#include "render/outlines.h"

namespace plumb {

struct SampleTaken {
    Color radiance;
    Vec2f raster;
    float weight; // of the filter
};

// One thread's. Job, edge and outlines must outlive it.
class SampleTaker {
public:
    // total: samples per pixel in all; notes: of the tracer.
    SampleTaker(const RenderJob& job, const FilmEdge& edge, Outlines& outlines, std::uint64_t total,
                const Tracer::Notes& notes);
    SampleTaker(const SampleTaker&) = delete;
    SampleTaker& operator=(const SampleTaker&) = delete;

    // A pure function of job, total, seed, pixel and index.
    SampleTaken take(std::uint64_t seed, Vec2i pixel, std::uint64_t index);

    RayCounts counts() const
    {
        RayCounts all = tracer_.counts();
        return all += look_tracer_.counts();
    }

private:
    const RenderJob& job_;
    const FilmEdge& edge_;
    Outlines& outlines_;
    Tracer tracer_;
    Tracer look_tracer_; // of what looks for lamps: notes light, but no surfaces, and keeps no log
    std::unique_ptr<Sampler> sampler_;
    std::unique_ptr<Sampler> look_sampler_; // null: there are no outlines
};

} // namespace plumb
