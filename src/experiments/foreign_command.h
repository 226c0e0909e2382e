// SPDX-License-Identifier: MIT
#pragma once

// What a command of a suite, or of a race, is for one image.

#include "plumb/experiments/suite_run.h"
#include "suite_file/command_line.h"

namespace plumb {

// An image that another program is asked for: what the placeholders of its command, or of its file, stand for.
struct ForeignRequest {
    std::string name;
    std::filesystem::path scene; // empty: none
    ForeignImage foreign;
    std::uint64_t seed = 0;               // of the first replica
    std::optional<std::uint64_t> samples; // per pixel
    std::optional<Vec2i> size;
};
ForeignRequest request_of(const SuiteJob& job);

// What is wrong with the placeholders of the command or of the file; empty: nothing is.
std::string foreign_problem(const ForeignRequest& request);

// What a program is started with. replica: from 0. image: the file to write, absolute. threads: 0: all.
std::vector<std::string> command_of(const ForeignRequest& request, int replica,
                                    const std::filesystem::path& image, int threads);
// The files of images that are there, one a replica.
std::vector<std::filesystem::path> given_images(const ForeignRequest& request);

// Quoted for a shell.
std::string words_text(const std::vector<std::string>& words);
// Of the file that the command or image stands in; absolute. The current one for a command that stands in no file.
std::filesystem::path directory_of(const ForeignImage& foreign);

} // namespace plumb
