// SPDX-License-Identifier: MIT
#pragma once

// One scene rendered by several methods: whether they agree, and which is the most efficient.

#include "plumb/compare/compare.h"
#include "plumb/rendering/session.h"
#include "plumb/scene_file/scene_file.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

struct AgreeSettings {
    RenderSettings base;                 // view and samples; its time limit is for all images together
    std::vector<MethodSettings> methods; // two or more
    CompareSettings how = {};            // the significance is that of all pairs together
};

// "path_mis with sobol"; without a sampler, "path_mis".
std::string method_name(const MethodSettings& method);

struct MethodPair {
    std::size_t a = 0, b = 0; // of the estimates
    Comparison comparison;
};

struct Agreement {
    std::vector<Estimate> estimates;       // an image by each method
    std::vector<std::uint64_t> samples_of; // of a pixel, in all, by each method
    std::vector<MethodPair> pairs;         // all
    Verdict verdict = Verdict::undecided;
};

// Each method has random numbers of its own. Throws Error if callbacks.stop ends it.
Agreement agree(SceneFile& file, const AgreeSettings& settings, int threads = 0,
                const SessionCallbacks& callbacks = {});

// How efficient an estimator is: 1 / (time x variance), which more samples do not change. From a number of images, each
// with a seed of its own: the spread between those is the right one for any sampler, also where an image's samples are not
// independent of each other.

// Of each of the images, 3 or more: the seconds that it took, and how far it is from the mean of all images: the mean
// of the squared differences over pixels and channels.
struct Rounds {
    std::vector<double> seconds;
    std::vector<double> deviations;

    double mean_seconds() const;
    double variance() const; // of one image, the mean over pixels and channels; unbiased
};

// low to high: a 95 % interval.
struct Ratio {
    double value = 1.0;
    double low = 1.0;
    double high = 1.0;
};

// The efficiency of one over that of another one, whose images were rendered in turn with its own. By the jackknife of
// the ratio's logarithm over the rounds, which knows of noise that comes in rounds, such as that of a machine that is
// not calm. Nothing if one of them has no variance.
std::optional<Ratio> efficiency_ratio(const Rounds& one, const Rounds& other);

struct RaceSettings : AgreeSettings {
    std::uint64_t rounds = 16; // images by each method
};

struct RaceRow {
    std::string name;
    Rounds rounds;
    std::optional<Ratio> efficiency; // over that of the best
};

struct RaceResult {
    std::vector<RaceRow> ranking;        // the most efficient one first
    Agreement means;                     // of the images of all rounds
    std::uint64_t samples_per_pixel = 0; // of an image
    std::uint64_t rounds = 0;
};

RaceResult race(SceneFile& file, const RaceSettings& settings, int threads = 0,
                const SessionCallbacks& callbacks = {});

} // namespace plumb
