// SPDX-License-Identifier: MIT
#pragma once

// Keeps the codecs below OpenImageIO quiet.

#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>

namespace plumb {

// While one of these lives, nothing that is written to standard error arrives there. libpng and others report to it
// whatever they find, in words of their own, and OpenImageIO offers no way to stop them; what matters of it comes
// back as an error text, and we report that. One picture is read or written at a time.
class QuietStandardError {
public:
    QuietStandardError() : lock_(mutex())
    {
        std::fflush(stderr);
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (nowhere < 0) return;
        saved_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
        if (saved_ >= 0) ::dup2(nowhere, STDERR_FILENO);
        ::close(nowhere);
    }
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;
    ~QuietStandardError()
    {
        if (saved_ < 0) return;
        std::fflush(stderr);
        ::dup2(saved_, STDERR_FILENO);
        ::close(saved_);
    }

private:
    static std::mutex& mutex()
    {
        static std::mutex instance;
        return instance;
    }

    std::lock_guard<std::mutex> lock_;
    int saved_ = -1;
};

} // namespace plumb
