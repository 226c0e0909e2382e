// SPDX-License-Identifier: MIT
#pragma once

// Images of other programs. What these write may be anything, or nothing.

#include "experiments/foreign_command.h"

namespace plumb {

// What went wrong with another program, and what it printed last.
class ProgramError : public Error {
public:
    ProgramError(SourceLocation location, const std::string& message, ProgramRun run)
        : Error(message), location_(std::move(location)), run_(std::move(run))
    {}
    const SourceLocation& location() const { return location_; }
    const ProgramRun& run() const { return run_; }

private:
    SourceLocation location_;
    ProgramRun run_;
};

// Lines to be added to a message: what a program printed last.
std::string output_text(const ProgramRun& run);

// How the command of an image is run.
struct ForeignJob {
    ForeignRequest request;
    std::string stem; // of the images: "batch/suite/box_16"
    int threads = 0;
    const std::atomic<bool>* stop = nullptr;
};

// A hash of all that the images depend on, as far as it can be told: the program and the files that its words name, the inputs,
// the scene file and the command. Throws Error if an input cannot be read.
std::string foreign_key(const ForeignJob& job);

struct ForeignImages {
    std::vector<std::string> files; // one a replica: "box_16.exr", or "box_16_r1.exr" and so on
    std::vector<Image> images;      // in them
    ProgramRun run;
};

// Runs it once for each replica, in a directory of its own beside the images. Throws ProgramError for an exit code, a signal, a
// time-out, an image that is not there; Error("interrupted").
ForeignImages run_command(const ForeignJob& job);

// The files of images that run_command() would write, of programs that write .exr files.
std::vector<std::string> expected_images(const ForeignJob& job);

} // namespace plumb
