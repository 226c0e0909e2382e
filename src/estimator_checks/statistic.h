// SPDX-License-Identifier: MIT
#pragma once

// The two kinds of test, one run of one test at a time.

#include "estimator_checks/chunks.h"
#include "plumb/estimator_checks/estimator_check.h"

namespace plumb {

struct RunOptions {
    std::size_t test_index = 0;
    Purpose purpose = Purpose::first_run;
    std::uint64_t samples = 0;
    std::uint64_t seed = 0;
    int threads = 0;
};

// The mean luminance of the weights of BSDF samples for wi at `angle` degrees, of what an emitter sends to (0, 0, distance)
// over the density of its samples, or of the light at random places of the film, is `reference`.
TestRun test_bsdf_mean(const TestFile& file, const Bsdf& bsdf, double angle, double reference,
                       const RunOptions& options);
TestRun test_emitter_mean(const TestFile& file, const Emitter& emitter, double distance, double reference,
                          const RunOptions& options);
TestRun test_scene_mean(const TestFile& file, const RenderJob& job, double reference,
                        const RunOptions& options);

// The direction that a chi-square test looks from: uniform on the upper hemisphere.
Vec3f random_direction(const TestFile& file, std::size_t test_index, std::uint64_t seed);
// Samples of a BSDF are distributed as its density says.
TestRun test_bsdf_distribution(const TestFile& file, const Bsdf& bsdf, const Vec3f& wi,
                               const RunOptions& options);

} // namespace plumb
