// SPDX-License-Identifier: MIT
#pragma once

// The one way to the bytes of files that users and scenes name. A scene may be somebody else's: what it names may be a
// pipe that never ends, a device, or a file under /proc that shows what this process knows.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace plumb {

// A file on a disk, open for reading. What a Git LFS pointer stands for is not there, so it counts as unreadable.
class RegularFile {
public:
    explicit RegularFile(std::filesystem::path path); // throws Error: "cannot read 'PATH': it is a directory"
    ~RegularFile();
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    // When it was opened; what grows later is not read. Files under /proc have 0.
    std::uintmax_t size() const { return size_; }

    // Fills `bytes` with what stands from `offset` on. Several threads may read. Throws Error.
    void read(std::uintmax_t offset, std::span<char> bytes) const;

    [[noreturn]] void fail(const std::string& reason) const;

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uintmax_t size_ = 0;
};

// For files that a library opens by their names: why there is nothing to be read at `path`; empty: there is.
std::string problem_of_file(const std::filesystem::path& path);

} // namespace plumb
