// SPDX-License-Identifier: MIT
#pragma once

// What the camera sees of lamps, in the pixels that their outlines cross.
//
// There a sample meets a lamp or does not, and a lamp is far brighter than what is around it: a few pixels have most of an
// image's squared error. In them, the emission E of the surface that the camera's ray meets is a control variate [1]: a
// sample's value L becomes
//     L - c E + c 1/k sum_j E_j,
// where the E_j are what k more rays of the same pixel meet, which are followed no further. Its mean is that of L, whatever
// c is. The variance is least where c = Cov(L, E) / Var(E): one, but for what is seen of other light on the lamp and beside it. Rays
// of fixed places find the outlines, and a few fixed samples choose c; neither is in the image.
//
// [1] Owen 2013, "Monte Carlo theory, methods and examples", section 8.9

#include "plumb/render/render.h"
#include "plumb/scene/tracer.h"
#include "render/film_edge.h"

namespace plumb {

// Of a window of the image. What a pixel has is a pure function of job and pixel.
class Outlines {
public:
    // threads: 0: all.
    Outlines(const RenderJob& job, const PixelRect& window, int threads);

    // For what it draws; total: samples per pixel. Null where there are no outlines.
    std::unique_ptr<Sampler> sampler(std::uint64_t total) const;

    // c, in [0, 1]; 0: no more rays. Chosen when it is first asked for, by any thread. sampler: as above, and left changed.
    float share(Vec2i pixel, const FilmEdge& edge, Sampler& sampler);

    // c times the mean of what the rays of a sample of the pixel meet; noted and counted as what the camera sees.
    Color look(float share, std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge,
               Sampler& sampler, Tracer& tracer) const;

private:
    // Luminances of lamps at the places of a pixel.
    struct Range {
        float least = 0.f;
        float most = 0.f;
    };

    // Where lamps may be seen, for each pixel of around_.
    std::vector<bool> candidates() const;
    void find(const std::vector<bool>& candidates, int threads);
    Range glance(Vec2i pixel, Tracer& tracer) const;
    // Over all pixels that the filter of this one may reach, and the next ones.
    Range range_about(Vec2i pixel) const;
    float choose(const Range& range, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const;

    const RenderJob& job_;
    PixelRect window_;
    std::uint64_t rays_; // of a sample
    int reach_ = 0;      // pixels from the window to the edges of around_
    PixelRect around_;
    std::vector<Range> ranges_; // of around_
    std::vector<float> shares_; // of window_; empty: there are no outlines
};

} // namespace plumb
