// SPDX-License-Identifier: MIT
#pragma once

// The attributes of a suite that are about images of other programs. They apply to everything inside an element, as settings do.

#include "plumb/suite_file/suite.h"
#include "scene_file/document.h"

namespace plumb {

inline constexpr std::string_view foreign_names[] = {"command", "image", "replicas", "timeout", "inputs"};

class ForeignAttributes {
public:
    // An empty value removes what was inherited; a command replaces an image, and an image a command.
    void take(const Element& element, Diagnostics& diagnostics);
    // Whether it is another program's image.
    bool is_given() const { return attributes_.contains("command") || attributes_.contains("image"); }
    // Of an image that is. Nothing: the diagnostics say what is wrong.
    std::optional<ForeignImage> read(Diagnostics& diagnostics) const;

private:
    struct Given {
        SuiteSetting setting;
        std::filesystem::path directory; // of the file that it stands in
    };
    std::map<std::string, Given, std::less<>> attributes_;
};

} // namespace plumb
