// SPDX-License-Identifier: MIT
#pragma once

// One scene rendered by several estimators, Plumb's and other programs: which is the most efficient, and how their errors
// fall with samples and time.

#include "plumb/experiments/agree.h"
#include "plumb/suite_file/suite.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

// A number and its 95 % interval.
struct Bounded {
    double value = 1.0;
    double low = 1.0;
    double high = 1.0;
};

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

// The efficiency of one over that of another one, whose images were rendered in turn with its own. By the jackknife of
// the ratio's logarithm over the rounds, which knows of noise that comes in rounds, such as that of a machine that is
// not calm. Nothing if one of them has no variance.
std::optional<Bounded> efficiency_ratio(const Rounds& one, const Rounds& other);

// The root mean squared error of one image: of its noise alone, from the rounds' spread; or with its bias, from the mean
// squared difference of each image and a reference, of which the reference's own noise is subtracted. By the jackknife likewise.
// Nothing if it is not above 0.
std::optional<Bounded> rmse_of_spread(const Rounds& rounds);
std::optional<Bounded> rmse_of_errors(const std::vector<double>& squared_errors);

// Another program in a race.
struct RaceCommand {
    std::string name;
    std::string
        command; // with placeholders, as in a suite: {image}, {seed} and {spp}, and perhaps {scene} and others
    double timeout = 600.0; // of each run, in seconds
};

struct RaceSettings : AgreeSettings {
    std::uint64_t rounds = 16;              // images by each estimator
    std::vector<RaceCommand> commands = {}; // more estimators
    std::filesystem::path directory = {};   // where commands work
    bool details = false;                   // curves and maps
    std::optional<Image> reference = {}; // that errors are measured against; with variance channels, perhaps
};

// Throws Error if a command has wrong placeholders.
void check_race_command(const RaceCommand& command, const std::filesystem::path& scene);

// The error of images with so many samples.
struct CurvePoint {
    std::uint64_t samples = 0; // per pixel
    double seconds = 0.0;      // an image, in the mean
    std::optional<Bounded> rmse;
};

struct RaceRow {
    std::string name;
    std::string bias; // as of Integrator
    Rounds rounds;
    std::optional<Bounded> efficiency; // over that of the best
    std::vector<CurvePoint> curve;     // from one sample, each point with twice the samples of the one before
    // Of each pixel 1 / (variance x seconds), of one image; 0: no round has found any noise there. The pixel's seconds are
    // the image's, in proportion to the pixel's rays; of other programs, which do not tell, the same for all pixels.
    std::optional<Image> efficiency_map;
};

struct RaceResult {
    std::vector<RaceRow> ranking;        // the most efficient one first
    Agreement means;                     // of the images of all rounds
    std::uint64_t samples_per_pixel = 0; // of an image
    std::uint64_t rounds = 0;
    bool has_reference = false;
};

// Throws Error if callbacks.stop ends it.
RaceResult race(SceneFile& file, const RaceSettings& settings, int threads = 0,
                const SessionCallbacks& callbacks = {});

} // namespace plumb
