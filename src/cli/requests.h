// SPDX-License-Identifier: MIT
#pragma once

// What each verb is asked for. Nothing of a command line is in here; rendering itself has render_request.h.

#include "cli/render_request.h"

#include "plumb/settings/compare_settings.h"

#include <map>

namespace plumb {

// A sample to be taken again.
struct ReplayRequest : SceneRequest {
    Vec2i pixel;
    std::uint64_t sample = 0;
};

// A picture to be rendered again from its header.
struct RerunRequest {
    std::string image;
    std::string scene;                // where its scene file lies now; empty: where it was
    std::vector<std::string> outputs; // at least one
    std::string json;
    int threads = 0;
    bool quiet = false;
    bool verbose = false;
};

struct MergeRequest {
    std::vector<std::string> parts;   // at least one
    std::vector<std::string> outputs; // pictures
    std::string checkpoint;           // the sum as a part; empty: none
    std::string json;
    bool allow_missing = false; // make the picture although samples are missing
    bool quiet = false;
};

struct TestRequest {
    std::vector<std::string> files; // at least one
    RenderSettings settings;        // of the scenes in them, and the seed
    int threads = 0;
    std::string json;
    bool quiet = false;
};

// Two images; b is the reference. Several files of one side are replicas: they differ in their seeds.
struct CompareRequest {
    std::vector<std::string> a, b;
    CompareSettings how;
    std::string difference; // the picture of it to write; empty: none
    bool difference_is_flip = false;
    std::string json;
    bool quiet = false;
};

// What `renderer agree` and `renderer race` render a scene with, and how they compare.
struct EstimatorRequest : SceneRequest {
    std::vector<std::string> integrators = {"path", "path_nee", "path_mis"};
    std::vector<std::string> samplers; // none: the scene's
    CompareSettings how;
    int threads = 0;
    std::string json;
};

struct RaceRequest : EstimatorRequest {
    std::uint64_t rounds = 16; // pictures by each estimator
};

struct BatchRequest {
    std::string suite;
    std::map<std::string, std::string> definitions; // of $name in the suite
    std::string directory;                          // for pictures and reports; empty: batch/<suite>
    std::string filter;                             // empty: all entries
    bool fail_fast = false;
    bool update = false; // make the references instead
    bool force = false;  // also what is up to date
    int threads = 0;
    bool quiet = false;
};

} // namespace plumb
