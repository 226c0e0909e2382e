// SPDX-License-Identifier: MIT
#include "base/text_file.h"

#include "base/temporary_file.h"
#include "plumb/base/error.h"

#include <cerrno>
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
        const TemporaryFile created_and_removed(path);
    } else if (access(path.c_str(), W_OK) != 0) {
        fail(path, errno);
    }
}

void write_text_file(const fs::path& path, std::string_view text)
{
    if (is_file_or_absent(path)) {
        TemporaryFile file(path);
        file.write(text);
        file.take_place();
        return;
    }
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path, errno);
    const int problem = write_all(descriptor, text);
    close(descriptor);
    if (problem != 0) fail(path, problem);
}

void make_directory(const fs::path& directory)
{
    std::error_code problem;
    if (!directory.empty()) fs::create_directories(directory, problem);
    if (problem)
        throw Error(
            fmt::format("cannot create the directory '{}': {}", directory.string(), problem.message()));
}

} // namespace plumb
