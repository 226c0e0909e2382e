// SPDX-License-Identifier: MIT
#pragma once

// Files that are wrong, each beside a file .expected with the exact text of what is wrong with it.

#include "plumb/base/error.h"
#include "support/catch.h"
#include "support/temp_directory.h"

namespace plumb {

// What load(path) complains of, with paths relative to the file's directory.
template <class Load>
std::string complaints(const std::filesystem::path& path, const Load& load)
{
    std::string text;
    try {
        load(path);
        return "no error\n";
    } catch (const SceneError& error) {
        text = error.what();
    } catch (const Error& error) {
        text = std::string("not a scene error: ") + error.what();
    }
    const std::string prefix = path.parent_path().string() + "/";
    for (std::size_t i = text.find(prefix); i != text.npos; i = text.find(prefix, i))
        text.erase(i, prefix.size());
    return text + "\n";
}

// Loading it complains of what its .expected says.
template <class Load>
void check_complaints(const std::filesystem::path& path, const Load& load)
{
    CAPTURE(path.filename());
    CHECK(complaints(path, load) == read_bytes(std::filesystem::path(path).replace_extension(".expected")));
}

} // namespace plumb
