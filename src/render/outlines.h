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

    // Whether an outline crosses the pixel. Decided when it is first asked for, by any thread. sampler: as above, and left
    // changed.
    bool at(Vec2i pixel, const FilmEdge& edge, Sampler& sampler);

    // V of a sample. tracer: notes and counts.
    Color look(std::uint64_t seed, Vec2i pixel, std::uint64_t index, const FilmEdge& edge, Sampler& sampler,
               Tracer& tracer) const;

private:
    // Luminances of V.
    struct Range {
        float least = 0.f;
        float most = 0.f;
    };
    enum class Answer : std::uint8_t { unknown, no, yes };

    // At how many places each pixel of around_ is looked at.
    std::vector<std::uint8_t> places() const;
    void find(const std::vector<std::uint8_t>& places, int threads);
    Range glance(Vec2i pixel, int places, Sampler& sampler, Tracer& tracer) const;
    // Over all pixels that the filter of this one may reach, and the next ones.
    Range range_about(Vec2i pixel) const;
    bool is_bright(float lamp, Vec2i pixel, const FilmEdge& edge, Sampler& sampler) const;

    const RenderJob& job_;
    PixelRect window_;
    std::uint64_t looks_; // of a sample
    int reach_ = 0;       // pixels from the window to the edges of around_
    PixelRect around_;
    std::vector<Range> ranges_;   // of around_
    std::vector<Answer> answers_; // of window_; empty: there are no outlines
};

} // namespace plumb
