// SPDX-License-Identifier: MIT
#pragma once

// What the camera sees of lamps, in the pixels that their outlines cross.
//
// There a sample meets a lamp or does not, and the lamp is far brighter than what is around it: a few pixels have most of an
// image's squared error. In them, the part V of a sample's light that is a lamp seen directly, in mirrors or in highlights
// (Integrator::look()) is left out of the sample and estimated apart, by the mean of several shorter samples of V alone [1].
// In highlights emitter samples find lamps, too: there V has the weight of so many samples (path_estimator.h).
// Where that is, fixed samples decide that are not in the image, so that its mean remains what it was.
//
// [1] Arvo and Kirk 1990, "Particle Transport and Image Synthesis", SIGGRAPH: splitting

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

    // How many looks each sample of the pixel has: 0 where no outline crosses it. Counted when it is first asked for, by any thread.
    // sampler: as above, and left changed.
    int looks_at(Vec2i pixel, const FilmEdge& edge, Sampler& sampler);

    // V of a sample: the mean of as many looks as the tracer expects. tracer: notes and counts.
    Color look(std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge, Sampler& sampler,
               Tracer& tracer) const;

private:
    // What the places of a pixel, or of several, show.
    struct Sight {
        float sum = 0.f; // luminances of V
        float squares = 0.f;
        std::uint32_t places = 0;
        std::uint32_t rays = 0; // that all of them took
    };
    static constexpr std::uint8_t unknown = 255;

    // At how many places each pixel of around_ is looked at first.
    std::vector<std::uint8_t> places() const;
    void find(const std::vector<std::uint8_t>& places, int threads);
    // Adds places to those that the pixel has.
    void glance(Sight& sight, Vec2i pixel, std::uint32_t places, Sampler& sampler, Tracer& tracer) const;
    // Over all pixels that the filter of this one may reach, and the next ones.
    Sight sight_about(Vec2i pixel) const;
    int count_looks(const Sight& sight, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const;
    double rest_of_light(Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const;

    const RenderJob& job_;
    PixelRect window_;
    int most_looks_; // of a sample
    int reach_ = 0;  // pixels from the window to the edges of around_
    PixelRect around_;
    std::vector<Sight> sights_;       // of around_
    std::vector<std::uint8_t> looks_; // of window_, or unknown; empty: there are no outlines
};

} // namespace plumb
