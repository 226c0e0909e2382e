// SPDX-License-Identifier: MIT

// [1] Git LFS specification, https://github.com/git-lfs/git-lfs/blob/main/docs/spec.md: a pointer is a text of less
//     than 1024 bytes whose first line is "version" and an address.

#include "io/regular_file.h"

#include "plumb/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace plumb {

namespace {

std::string_view kind_problem(const std::filesystem::file_status& status)
{
    if (!std::filesystem::exists(status)) return "no such file";
    if (std::filesystem::is_directory(status)) return "it is a directory";
    if (!std::filesystem::is_regular_file(status)) return "it is a device or a pipe, not a regular file";
    return {};
}

// A descriptor, or the reason why there is none.
struct Opened {
    int descriptor = -1;
    std::uintmax_t size = 0;
    std::string problem = {};
};

bool is_lfs_pointer(int descriptor, std::uintmax_t size)
{
    constexpr std::uintmax_t largest = 1024; // [1]
    constexpr std::string_view start = "version https://git-lfs.github.com/spec/";
    char bytes[start.size()];
    if (size < sizeof bytes || size >= largest) return false;
    const ssize_t read = pread(descriptor, bytes, sizeof bytes, 0);
    return read == static_cast<ssize_t>(sizeof bytes) && std::string_view(bytes, sizeof bytes) == start;
}

// Looks before it opens, because opening a device may do things; and again, because it may have been exchanged.
Opened open_regular(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::none) return {.problem = error.message()};
    if (const std::string_view problem = kind_problem(status); !problem.empty())
        return {.problem = std::string(problem)};
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) return {.problem = std::strerror(errno)};
    Opened opened{.descriptor = descriptor};
    struct stat facts = {};
    if (fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode))
        opened.problem = "it is a device or a pipe, not a regular file";
    opened.size = static_cast<std::uintmax_t>(facts.st_size);
    if (opened.problem.empty() && is_lfs_pointer(descriptor, opened.size))
        opened.problem = "it is a Git LFS pointer, not the file itself; 'git lfs pull' fetches that";
    if (!opened.problem.empty()) close(std::exchange(opened.descriptor, -1));
    return opened;
}

} // namespace

RegularFile::RegularFile(std::filesystem::path path) : path_(std::move(path))
{
    const Opened opened = open_regular(path_);
    if (!opened.problem.empty()) fail(opened.problem);
    descriptor_ = opened.descriptor;
    size_ = opened.size;
}

RegularFile::~RegularFile()
{
    close(descriptor_);
}

void RegularFile::read(std::uintmax_t offset, std::span<char> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t size = pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) fail(std::strerror(errno));
        if (size == 0) fail("the file ends early");
        bytes = bytes.subspan(static_cast<std::size_t>(size));
        offset += static_cast<std::uintmax_t>(size);
    }
}

void RegularFile::fail(const std::string& reason) const
{
    throw Error("cannot read '" + path_.string() + "': " + reason);
}

std::string problem_of_file(const std::filesystem::path& path)
{
    const Opened opened = open_regular(path);
    if (!opened.problem.empty()) return opened.problem;
    close(opened.descriptor);
    return opened.size == 0 ? "the file is empty" : "";
}

} // namespace plumb
