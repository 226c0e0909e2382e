// SPDX-License-Identifier: MIT
#pragma once

// Reading a test file: a <test type="ttest"> or <test type="chi2test"> of the courses.

#include "plumb/model/bsdf.h"
#include "plumb/model/emitter.h"
#include "plumb/scene_file/scene_file.h"

#include <vector>

namespace plumb {

enum class TestType { ttest, chi2test };

struct TestedBsdf {
    std::shared_ptr<const Bsdf> bsdf;
    std::string name; // "bsdf 'diffuse' (line 4)"
};

struct TestedEmitter {
    std::unique_ptr<Emitter> emitter;
    std::string name; // "emitter 'point' (line 4)"
};

struct TestedScene {
    RenderJob job;
    Dialect dialect;
    std::string name; // "scene (line 4), path_mis"
};

// A ttest holds BSDFs, emitters or scenes, a chi2test holds BSDFs.
struct TestFile {
    TestType type = TestType::ttest;
    double significance_level = 0.01; // of the whole file
    std::uint64_t sample_count = 0;   // of each test
    std::vector<TestedBsdf> bsdfs;
    std::vector<TestedEmitter> emitters;
    std::vector<TestedScene> scenes;

    // A ttest's: a reference for each scene, or for each angle of each BSDF, BSDF by BSDF, or for each distance of each
    // emitter, emitter by emitter.
    std::vector<double> references;
    std::vector<double> angles;    // of wi from the normal, in degrees
    std::vector<double> distances; // of the receiver from the origin, along z

    // A chi2test's: a grid of resolution x 2 resolution cells in cos theta and phi.
    std::size_t resolution = 0;
    double min_expected = 0.0;        // samples in a cell; cells that expect fewer are pooled
    std::size_t directions = 0;       // random ones, for each BSDF
    std::unique_ptr<Sampler> sampler; // independent random numbers, whatever the scenes' samplers

    std::vector<Diagnostic> warnings;

    std::size_t test_count() const
    {
        return type == TestType::chi2test ? bsdfs.size() * directions : references.size();
    }
};

// The tests of one file are told apart by 16 bits of the random numbers' key.
inline constexpr std::size_t max_tests = 65536;

// settings: those of the scene, and the instruction set. Throws SceneError with
// everything that is wrong with the file, or Error if it cannot be read.
TestFile load_test(const std::filesystem::path& path, const RenderSettings& settings = {});

} // namespace plumb
