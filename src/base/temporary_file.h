// SPDX-License-Identifier: MIT
#pragma once

// Files that appear whole or not at all.

#include <filesystem>
#include <span>
#include <string_view>

namespace plumb {

// Where a file of that name is written: a symbolic link stays one, whether the file that it points to is there or not.
std::filesystem::path end_of_links(const std::filesystem::path& path);

// Beside `path`: ".a.exr.plumb-5f0c41d09b3a77e2.SUFFIX", a name that nobody else has a reason to give.
std::filesystem::path unfinished_name(const std::filesystem::path& path, std::string_view suffix);

// A new, empty file beside `target` (at the end of its links), to take its place when it is complete; gone again when this
// goes before that. What a process that was killed left behind is used again: it is told by its
// unfinished_name(), and is a plain file of this user's with no other name. What else has such a name stays as it is.
// All functions throw Error, "cannot write 'TARGET': " and the reason; a name that is too long is one.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& target);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    void write(std::span<const unsigned char> bytes);
    void write(std::string_view text);
    void flush(); // waits until the disk has what was written
    void take_place();

private:
    [[noreturn]] void fail(int problem) const;
    bool open_free_file(); // false if it is another process's

    std::filesystem::path target_; // as given
    std::filesystem::path final_;  // where the links end
    std::filesystem::path path_;
    int descriptor_ = -1;
};

// Waits until the disk knows the names of the files in the directory of `path`. Throws Error.
void flush_directory_of(const std::filesystem::path& path);

} // namespace plumb
