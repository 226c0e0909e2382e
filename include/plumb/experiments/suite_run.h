// SPDX-License-Identifier: MIT
#pragma once

// Suites: many images, rendered and compared with their references.

#include "plumb/compare/compare.h"
#include "plumb/rendering/session.h"
#include "plumb/settings/compare_settings.h"
#include "plumb/settings/render_settings.h"
#include "plumb/suite_file/suite.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct SuiteJob {
    SuiteEntry entry;
    RenderSettings image;
    CompareSettings compare;
    RenderSettings reference; // to make the reference with
};

// The suite with everything checked that can be without opening a scene. Throws SceneError, or Error.
std::vector<SuiteJob> plan_suite(const std::filesystem::path& suite,
                                 const std::map<std::string, std::string>& definitions = {});

// The attributes of a suite that are settings of `renderer` and `renderer compare`, in the order of --help.
std::vector<std::string_view> suite_settings();

// "renderer scene.xml --spp 64", quoted for a shell, to do it again by hand.
std::string command_text(const std::filesystem::path& scene, const RenderSettings& settings);

// How far an image of a suite has come.
enum class JobState {
    not_run,  // after a failure or a signal
    made,     // a reference
    rendered, // there is nothing to compare it with
    compared,
    failed, // could not be rendered or compared
};

// A run of another program, or all of an image's replicas.
struct ProgramRun {
    int exit_code = 0;
    double seconds = 0.0;
    std::uint64_t peak_memory = 0; // bytes, of the largest process; 0: unknown
    std::string output;            // the end of what it printed; of the last replica
};

struct SuiteResult {
    std::string title; // with the sample count, where it is known
    std::string scene;
    std::string command;               // that renders the image by hand
    std::string compare_command;       // that compares it; empty: there is nothing to compare
    std::string accept_command;        // that makes the image the reference; empty: nothing does
    std::string image;                 // empty: there is none
    std::vector<std::string> replicas; // the images that it is the mean of; empty: it is one
    std::string screen_image;
    std::string reference;             // empty: none
    std::string difference;            // the image of it; empty: none
    std::string significant;           // the image of the squares that the test rejected; empty: none
    std::string replaced;              // of a reference that is made again: where the old one is kept
    std::vector<std::string> stale;    // why the reference is not what Plumb would make today
    std::optional<ProgramRun> program; // that made the image, if it is not Plumb and has just run
    JobState state = JobState::not_run;
    std::optional<Verdict> verdict; // where it was compared
    bool up_to_date = false;        // not rendered again
    double seconds = 0.0;           // for all of it
    bool interrupted = false;       // before all samples were taken
    std::string problem;            // of an error: the text of all that is wrong
    std::vector<Diagnostic> errors; // the same, one by one
    std::vector<std::string> warnings;
    std::optional<double> noise; // the root mean squared error that the image's own noise makes expect
    std::string biases;          // empty: none
    std::uint64_t left_out = 0;
    std::optional<Comparison> comparison;
    CompareSettings how;

    // An error, a difference, or no decision: none of them is agreement.
    bool is_failure() const { return state == JobState::failed || (verdict && *verdict != Verdict::passes); }
};

struct SuiteRun {
    std::string suite;
    std::string directory;
    std::vector<SuiteResult> results;
    double seconds = 0.0;
    bool interrupted = false;
    int signal = 0; // that interrupted it, where the caller knows

    std::size_t count(JobState state) const;
    std::size_t count(Verdict verdict) const;
};

struct SuiteOptions {
    std::filesystem::path directory = {}; // for images
    std::string filter = {};              // of titles: a part of them, or a pattern; empty: all
    bool fail_fast = false;               // ends at the first image that does not pass
    // Makes references instead: those that are missing, those whose files or images have this name or pattern, or all.
    std::optional<std::string> update = {}; // "missing", "all" or a name
    bool check_references = false;          // renders them as their headers say, and compares
    bool force = false;                     // also what is up to date
    bool allow_commands = false;            // other programs may be run
    int threads = 0;
    std::map<std::string, std::string> definitions =
        {}; // that the suite was read with, for the commands of the report

    bool is_about_references() const { return update || check_references; }
};

// Of a job, while it is told of; null: there is none.
struct SuiteImages {
    const Image* image = nullptr;
    const Image* reference = nullptr; // that it was compared with
};
using SuiteTold = std::function<void(const SuiteResult&, const SuiteImages&)>;

// The jobs whose images or references will be made; none if no reference is missing. Throws Error if nothing has the name
// that is asked for, SceneError if it is not clear how a reference is made.
std::vector<SuiteJob> chosen_jobs(const std::filesystem::path& suite, const std::vector<SuiteJob>& jobs,
                                  const SuiteOptions& options);

// Does the chosen ones of all jobs of a suite, one after the other; what goes wrong with one is in its result. Images that
// are up to date by the directory's state are compared, but not rendered. told: of each result, as soon as it is there. Throws
// Error if the directory cannot be used.
SuiteRun run_suite(const std::filesystem::path& suite, const std::vector<SuiteJob>& jobs,
                   const SuiteOptions& options, const SessionCallbacks& callbacks = {},
                   const SuiteTold& told = {});

} // namespace plumb
