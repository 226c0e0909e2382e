// SPDX-License-Identifier: MIT
#pragma once

// Files that appear whole or not at all.

#include <filesystem>
#include <span>
#include <string_view>

namespace plumb {

// A new, empty file beside `target`, to take its place when it is complete; gone again when this goes before that. A
// symbolic link stays one: the file it points to is replaced. What a process that was killed left behind is used again.
// All functions throw Error, "cannot write 'TARGET': " and the reason.
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
    std::filesystem::path final_;  // where the link points
    std::filesystem::path path_;
    int descriptor_ = -1;
};

// Waits until the disk knows the names of the files in the folder of `path`. Throws Error.
void flush_folder_of(const std::filesystem::path& path);

} // namespace plumb
