// SPDX-License-Identifier: MIT
#pragma once

// One scene rendered in several ways, and whether they agree: what `renderer agree` and `renderer race` share.

#include "cli/json.h"
#include "cli/requests.h"

#include "plumb/compare/compare.h"
#include "plumb/scene_file/scene_file.h"

namespace plumb {

// An integrator and a sampler.
struct Estimator {
    std::string integrator;
    std::string sampler; // empty: the scene's

    std::string name() const;
};

// Each integrator with each sampler. Throws UsageError if there are fewer than two, and if --time and --spp are given both.
std::vector<Estimator> estimators_of(const EstimatorRequest& request, std::string_view verb);

// The scene, for the estimator. What loading says is said if that is wanted.
LoadedScene load_for(const Estimator& estimator, const EstimatorRequest& request, bool says);

// Of one sample of every pixel, by a few.
double seconds_per_sample(const RenderJob& job, RenderOptions options);

// A picture of the scene by one estimator.
struct Estimate {
    std::string name;
    std::uint64_t samples_per_pixel; // in all
    Image image;                     // with its error bars
};

struct Pair {
    const Estimate& a;
    const Estimate& b;
    Comparison comparison;
};

// All pairs, with the significance of all of them together.
std::vector<Pair> compare_pairs(const std::vector<Estimate>& estimates, const CompareSettings& options);

CompareOutcome outcome_of(const std::vector<Pair>& pairs);
std::string_view verdict_of(CompareOutcome outcome); // agree, differ, undecided
std::string pair_text(const Pair& pair);             // a line
// What may decide it if they are undecided: a line. An estimator that all undecided pairs share, and others do not, is the
// one that rarely finds some of the light.
std::string advice(const std::vector<Estimate>& estimates, const std::vector<Pair>& pairs);
// The scene and what was found about it.
void write_verdict(JsonWriter& json, const EstimatorRequest& request, const std::vector<Pair>& pairs);
void write_pairs(JsonWriter& json, const std::vector<Pair>& pairs);

} // namespace plumb
