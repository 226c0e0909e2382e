// SPDX-License-Identifier: MIT
#pragma once

// Keeps the codecs below OpenImageIO quiet.

#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>

namespace plumb {

// While one or more of these live, nothing that is written to standard error arrives there. libpng and others report to it
// whatever they find, in words of their own, and OpenImageIO offers no way to stop them; what matters of it comes
// back as an error text, and we report that.
class QuietStandardError {
public:
    QuietStandardError()
    {
        const std::lock_guard lock(silence().mutex);
        if (silence().wanted++ > 0) return;
        std::fflush(stderr);
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (nowhere < 0) return;
        silence().saved = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
        if (silence().saved >= 0) ::dup2(nowhere, STDERR_FILENO);
        ::close(nowhere);
    }
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;
    ~QuietStandardError()
    {
        const std::lock_guard lock(silence().mutex);
        if (--silence().wanted > 0 || silence().saved < 0) return;
        std::fflush(stderr);
        ::dup2(silence().saved, STDERR_FILENO);
        ::close(silence().saved);
        silence().saved = -1;
    }

private:
    struct Silence {
        std::mutex mutex;
        int wanted = 0;
        int saved = -1; // where standard error went before
    };
    static Silence& silence()
    {
        static Silence instance;
        return instance;
    }
};

} // namespace plumb
