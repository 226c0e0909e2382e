// SPDX-License-Identifier: MIT
#include "cli/text_file.h"

#include "plumb/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int problem)
{
    throw Error(fmt::format("cannot write '{}': {}", path.string(), std::strerror(problem)));
}

bool is_file_or_absent(const fs::path& path)
{
    std::error_code ignored; // what cannot be looked at cannot be opened either, and open() says why
    const fs::file_type type = fs::status(path, ignored).type();
    return type == fs::file_type::regular || type == fs::file_type::not_found || type == fs::file_type::none;
}

// An open file that is closed, and removed unless kept.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target)
    {
        // Through a link, so that the link stays one.
        std::error_code missing;
        final_ = fs::is_symlink(target, missing) ? fs::weakly_canonical(target, missing) : target;
        if (final_.empty() || missing) final_ = target;
        // A run that was killed may have left one behind, and a process of the same number may follow it.
        for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
            path_ = final_;
            path_.replace_filename(fmt::format(".plumb-{}-{}.tmp", getpid(), attempt));
            descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
        if (descriptor_ < 0) fail(target, errno);
    }
    ~TemporaryFile()
    {
        if (descriptor_ >= 0) close(descriptor_);
        if (!path_.empty()) unlink(path_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    int descriptor() const { return descriptor_; }

    // 0, or errno.
    int keep()
    {
        const int closed = close(descriptor_);
        descriptor_ = -1;
        if (closed != 0 || std::rename(path_.c_str(), final_.c_str()) != 0) return errno;
        path_.clear();
        return 0;
    }

private:
    fs::path final_;
    fs::path path_;
    int descriptor_ = -1;
};

// 0, or errno.
int write_all(int descriptor, std::string_view text)
{
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return written < 0 ? errno : EIO;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

} // namespace

void check_text_path(const fs::path& path)
{
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) fail(path, EISDIR);
    if (!path.has_filename()) fail(path, ENOENT);
    if (is_file_or_absent(path)) {
        if (fs::exists(path, ignored) && access(path.c_str(), W_OK) != 0) fail(path, errno);
        // Also finds a name that is too long, which the short name of a temporary file does not.
        if (!fs::exists(path, ignored)) {
            const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor < 0 && errno != EEXIST) fail(path, errno);
            if (descriptor >= 0) {
                close(descriptor);
                unlink(path.c_str());
            }
        }
        const TemporaryFile created_and_removed(path);
    } else if (access(path.c_str(), W_OK) != 0) {
        fail(path, errno);
    }
}

void write_text_file(const fs::path& path, std::string_view text)
{
    int problem = 0;
    if (is_file_or_absent(path)) {
        TemporaryFile file(path);
        problem = write_all(file.descriptor(), text);
        if (problem == 0) problem = file.keep();
    } else {
        const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) fail(path, errno);
        problem = write_all(descriptor, text);
        close(descriptor);
    }
    if (problem != 0) fail(path, problem);
}

} // namespace plumb
