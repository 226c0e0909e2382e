// SPDX-License-Identifier: MIT
#pragma once

// Which images of an output directory need not be rendered again: a text file in it, with a line for each image.

#include "plumb/rendering/task.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace plumb {

// A hash of everything that the bytes of an image depend on: the program itself, the scene with all its files, and
// the settings.
std::string image_key(const RenderTask& task);

class SuiteState {
public:
    // Nothing is known where there is no state or it cannot be read.
    explicit SuiteState(const std::filesystem::path& directory);

    // Whether the files were made under this key and have not been touched since.
    bool is_up_to_date(const std::string& title, const std::string& key,
                       const std::vector<std::string>& files) const;
    // They were made just now. Writes the state; throws Error.
    void note(const std::string& title, const std::string& key, const std::vector<std::string>& files);

private:
    std::filesystem::path file_;
    std::map<std::string, std::string> lines_; // by title: the key, a space and the hash of the files
};

} // namespace plumb
