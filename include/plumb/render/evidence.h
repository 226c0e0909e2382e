// SPDX-License-Identifier: MIT
#pragma once

// How sure an image is, and what its expectation is that of.

#include "plumb/model/dialect.h"
#include "plumb/render/render.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

// The root of the mean squared error of an image, over its pixels and channels, estimated from the variance of its own
// samples: what is expected of noise, without bias. low to high: a 95 % interval.
//
// The mean of unbiased estimates of each pixel's variance is an unbiased estimate of the mean squared error. The interval
// is that of a mean of as many independent numbers as there are pixels, by the central limit theorem, with the spread of
// the estimates over the image; that spread includes how much the pixels differ, so the interval is too wide rather
// than too narrow. Where most of the noise is in paths that few samples have found yet, both are too small, as any
// estimate from the samples is.
struct NoiseEstimate {
    double rmse = 0.0;
    double low = 0.0;
    double high = 0.0;
};

// Nothing if a pixel has fewer than 2 samples.
std::optional<NoiseEstimate> estimate_noise(const Film& film);

// The same, divided by the mean of the image's values over its pixels and channels: 0.01 is noise of one percent of the
// mean brightness. Nothing for a black image either.
std::optional<NoiseEstimate> estimate_relative_noise(const Film& film);

// What an image's expectation differs in from all the light that the scene's model sends to the camera, and what the
// model itself is where there was a choice. Phrases for people.
struct BiasReport {
    std::vector<std::string> biases; // empty: unbiased
    std::vector<std::string> model;
};

// What is known of it before the first sample.
BiasReport make_ledger(const RenderJob& job, const Dialect& dialect);

// All that an image can tell about itself.
struct Evidence {
    BiasReport ledger;
    std::optional<NoiseEstimate> noise;
    LeftOut left_out;
    std::uint64_t samples_per_pixel = 0; // the smallest number that a pixel has
    SampleSet taken;
    bool even = true;          // every pixel has the samples from 0 to before that number, and no others
    std::uint64_t samples = 0; // of all pixels, those left out included
    // Of an adaptive rendering: the largest number that a pixel has. samples_per_pixel is the smallest, and `taken` are the
    // samples that are settled (RenderState::taken).
    std::optional<std::uint64_t> most_samples_per_pixel;
    std::string stop; // what ended the rendering, if not the number of samples
};
// A stop that knew nothing of the samples, and so biases nothing.
inline constexpr std::string_view interruption = "it was interrupted";

// before: make_ledger(). stop: a phrase for the ledger; empty if all samples that were asked for were taken.
Evidence make_evidence(BiasReport before, const RenderState& state, const std::string& stop = {});

} // namespace plumb
