// SPDX-License-Identifier: MIT
#pragma once

// What a command of a suite is for one image.

#include "plumb/experiments/suite_run.h"
#include "suite_file/command_line.h"

namespace plumb {

// Adds what is wrong with the placeholders of a job's command or image.
void check_foreign(const SuiteJob& job, Diagnostics& diagnostics);

// What a program is started with. replica: from 0. image: the file to write, absolute. threads: 0: all.
std::vector<std::string> command_of(const SuiteJob& job, int replica, const std::filesystem::path& image,
                                    int threads);
// The files of images that are there, one a replica.
std::vector<std::filesystem::path> given_images(const SuiteJob& job);

// Quoted for a shell.
std::string words_text(const std::vector<std::string>& words);
// Of the file that the command or image stands in; absolute.
std::filesystem::path directory_of(const ForeignImage& foreign);

} // namespace plumb
