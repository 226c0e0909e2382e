// SPDX-License-Identifier: MIT
#pragma once

// What a suite's entries are as words of the command line, so that each can be done again by hand.

#include "cli/options.h"

#include "plumb/suite_file/suite.h"

namespace plumb {

struct BatchJob {
    SuiteEntry entry;
    std::vector<std::string> render_words;    // "scene.xml", "--spp", "64"
    std::vector<std::string> compare_words;   // "--max", "rmse=0.1": without the names of the pictures
    std::vector<std::string> reference_words; // like render_words, of the reference
};

// The suite with everything checked that can be without opening a scene. Throws SceneError, or Error.
std::vector<BatchJob> plan_batch(const std::string& suite,
                                 const std::map<std::string, std::string>& definitions);

// The attributes of a suite that are options of `renderer` and `renderer compare`, in the order of --help.
std::vector<std::string_view> suite_settings();

// "renderer scene.xml --spp 64", quoted for a shell.
std::string command_text(const std::vector<std::string>& words);

} // namespace plumb
