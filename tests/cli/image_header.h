// SPDX-License-Identifier: MIT
#pragma once

// What an image's file says of it.

#include "plumb/image/image.h"

#include <map>

namespace plumb {

using ImageHeader = std::map<std::string, MetadataValue>;

inline ImageHeader header(const std::filesystem::path& image)
{
    const Image read = read_image(image, false);
    return {read.metadata.begin(), read.metadata.end()};
}

inline int integer(const ImageHeader& header, const std::string& name)
{
    return std::get<int>(header.at(name));
}

inline std::string text(const ImageHeader& header, const std::string& name)
{
    const auto found = header.find(name);
    if (found == header.end()) return "no " + name;
    const auto* value = std::get_if<std::string>(&found->second);
    return value ? *value : name + " is no text";
}

} // namespace plumb
