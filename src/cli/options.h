// SPDX-License-Identifier: MIT
#pragma once

// What the command line asks for. A pure function of the words: nothing is printed, read or exited here.

#include "plumb/compare/compare.h"
#include "plumb/render/sample_set.h"
#include "plumb/scene_file/scene_file.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace plumb {

enum class Verb {
    render,
    types,
    info,
    replay,
    rerun,
    merge,
    test,
    compare,
    agree,
    race,
    check,
    batch,
    new_scene,
    help
};

// The command line makes no sense: main() prints the message and exits with 2.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// What `renderer compare` is asked for.
struct CompareRequest {
    std::string difference; // the picture of it to write; empty: none
    bool difference_is_flip = false;
    bool choose_flip = true; // LDR for pictures made for screens, else HDR
    CompareOptions how;
};

// What `renderer agree` and `renderer race` render a scene with.
struct EstimatorRequest {
    std::vector<std::string> integrators = {"path", "path_nee", "path_mis"};
    std::vector<std::string> samplers; // none: the scene's
};

struct RaceRequest {
    std::uint64_t rounds = 16; // pictures by each estimator
};

// When a rendering ends, besides the number of samples: stop_rules.h.
struct StopRequest {
    std::optional<double> seconds; // for all pictures of a run together
    std::optional<double> relative_error;
};

struct CheckpointRequest {
    std::string file; // empty: none
    double every_seconds = 60.0;
    bool resume = false;
};

// One of the parts of a picture, from 0.
struct PartRequest {
    std::uint64_t index = 0;
    std::uint64_t count = 1;
    PartBy by = PartBy::tiles;
};

// A picture that is there, to be rendered again.
struct RepeatRequest {
    std::string scene; // what its header calls the scene
    SampleSet samples;
    std::string stop; // Evidence::stop
};

// What `renderer batch` does with a suite.
struct BatchRequest {
    std::string directory; // for pictures and reports; empty: batch/<suite>
    std::string filter;    // empty: all entries
    bool fail_fast = false;
    bool update = false; // make the references instead
    bool force = false;  // also what is up to date
};

struct Options {
    Verb verb = Verb::render;
    bool help = false;
    bool version = false;
    std::vector<std::string>
        subjects;        // the words that are no options: scenes, images or the name of a plugin
    std::string subject; // the first of them; empty: none
    std::string scene;   // where the scene of an image to be rendered again lies now; empty: not said
    std::vector<std::string> outputs; // none: <scene>_<spp>.exr and .png
    std::string json;                 // empty: no report; "-": standard output
    float exposure = 0.f;
    bool keep_interrupted = true; // write the picture although a signal ended the rendering
    bool variance = true;         // .exr files also hold the error bars
    bool quiet = false;
    bool verbose = false;
    LoadOptions load;     // with samples_per_pixel, if given
    RenderOptions render; // with seed, threads and crop
    Vec2i pixel;          // to replay
    std::uint64_t sample = 0;
    CompareRequest compare;
    EstimatorRequest estimators;
    RaceRequest race;
    BatchRequest batch;
    StopRequest stop;
    CheckpointRequest checkpoint;
    std::optional<PartRequest> part;
    std::optional<PartBy> part_by; // as given; settled in part
    bool allow_missing = false;    // merge parts although some are not there
    std::optional<RepeatRequest> repeat;

    // The words that change the scene or the seed, quoted for a shell: " --seed 7 --define 'a=b c'"; and those that
    // change a picture's file.
    std::string scene_words;
    std::string picture_words;
    std::string all_words; // as given, quoted
};

// words: without the program's name. Throws UsageError.
Options parse_options(std::vector<std::string> words);

// What a picture's header says of how the scene was rendered: `words` may come from anybody, and only options that change a
// picture are taken. Throws UsageError.
Options options_of_header(const std::string& scene, const std::vector<std::string>& words);

// What --help prints.
std::string help_text(Verb verb);

} // namespace plumb
