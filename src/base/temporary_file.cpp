// SPDX-License-Identifier: MIT

#include "base/temporary_file.h"

#include "plumb/base/error.h"
#include "plumb/base/hash.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace plumb {

namespace fs = std::filesystem;

fs::path end_of_links(const fs::path& path)
{
    constexpr int most_links = 40; // as the system follows
    fs::path end = path;
    std::error_code failed;
    for (int i = 0; i < most_links && fs::is_symlink(end, failed); ++i) {
        const fs::path to = fs::read_symlink(end, failed);
        if (failed) return path;
        end = to.is_absolute() ? to : end.parent_path() / to;
    }
    return end;
}

fs::path unfinished_name(const fs::path& path, std::string_view suffix)
{
    constexpr std::size_t longest = 200; // of at most 255 bytes
    const std::string name = path.filename().string();
    Hash128 hash; // so that the names of long names differ, too
    hash.update("Plumb's unfinished " + name);
    fs::path result = path;
    return result.replace_filename(
        fmt::format(".{}.plumb-{}.{}", name.substr(0, longest), hash.hex().substr(0, 16), suffix));
}

TemporaryFile::TemporaryFile(const fs::path& target) : target_(target), final_(end_of_links(target))
{
    struct stat ignored {};
    if (lstat(final_.c_str(), &ignored) != 0 && errno == ENAMETOOLONG) fail(errno);
    if (S_ISLNK(ignored.st_mode)) fail(ELOOP);
    constexpr int most_at_once = 1000;
    for (int i = 0; i < most_at_once; ++i) {
        path_ = unfinished_name(final_, fmt::format("part{}", i));
        if (open_free_file()) return;
    }
    fail(EBUSY);
}

TemporaryFile::~TemporaryFile()
{
    if (descriptor_ < 0) return;
    unlink(path_.c_str()); // while it is still locked: nobody else has it
    close(descriptor_);
}

// The lock tells whether somebody works on it; the kernel drops it when the process ends, however it ends.
bool TemporaryFile::open_free_file()
{
    // Without waiting: a pipe of that name may have nobody at its other end.
    constexpr int how = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    descriptor_ = open(path_.c_str(), how, 0666);
    if (descriptor_ < 0) {
        struct stat there {};
        const int problem = errno;
        // What cannot be opened is no file of ours.
        if (lstat(path_.c_str(), &there) == 0) return false;
        fail(problem);
    }
    const bool taken = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat opened {};
    struct stat named {};
    // Between our opening and locking it another process may have renamed or removed it.
    const bool is_still_there = fstat(descriptor_, &opened) == 0 && lstat(path_.c_str(), &named) == 0 &&
                                opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
    const bool is_ours = S_ISREG(opened.st_mode) && opened.st_nlink == 1 && opened.st_uid == geteuid();
    if (!taken && is_still_there && is_ours) {
        if (ftruncate(descriptor_, 0) == 0) return true;
        const int problem = errno;
        close(descriptor_);
        fail(problem);
    }
    close(std::exchange(descriptor_, -1));
    return false;
}

void TemporaryFile::write(std::span<const unsigned char> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail(written < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void TemporaryFile::write(std::string_view text)
{
    write(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

void TemporaryFile::flush()
{
    if (fsync(descriptor_) != 0) fail(errno);
}

void TemporaryFile::take_place()
{
    // Some file systems say only on closing that they could not write; closing a copy keeps the lock.
    const int copy = dup(descriptor_);
    if (copy < 0 || close(copy) != 0) fail(errno);
    if (std::rename(path_.c_str(), final_.c_str()) != 0) fail(errno);
    close(std::exchange(descriptor_, -1));
}

void TemporaryFile::fail(int problem) const
{
    throw Error(fmt::format("cannot write '{}': {}", target_.string(), std::strerror(problem)));
}

void flush_directory_of(const fs::path& path)
{
    const fs::path directory = path.has_parent_path() ? path.parent_path() : ".";
    const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool good =
        descriptor >= 0 && (fsync(descriptor) == 0 || errno == EINVAL); // EINVAL: cannot, and need not
    const int problem = errno;
    if (descriptor >= 0) close(descriptor);
    if (!good) throw Error(fmt::format("cannot write '{}': {}", path.string(), std::strerror(problem)));
}

} // namespace plumb
