// SPDX-License-Identifier: MIT
#include "base/sanitized.h"

#ifdef PLUMB_SANITIZED

#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

// Read by AddressSanitizer as the program starts; what the environment's ASAN_OPTIONS say goes before it. The sanitizer
// takes thread-local storage of a library that was loaded on demand, as OpenImageIO is, for a block with a header of
// glibc's before it; where glibc 2.36 placed it in the static block there is none, and its search for leaks reads from a
// wild address.
extern "C" const char* __asan_default_options()
{
    return "intercept_tls_get_addr=0";
}

// What libraries that OpenImageIO brings keep in thread-local storage, where the search for leaks does not look then: their
// leaks are not ours.
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:liboflog\nleak:liblog4cplus\nleak:libsrt\n";
}

namespace {

// Where standard error went as the program started.
const int standard_error = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);

bool is_diverted()
{
    struct stat then {};
    struct stat now {};
    return ::fstat(standard_error, &then) == 0 &&
           (::fstat(STDERR_FILENO, &now) != 0 || now.st_dev != then.st_dev || now.st_ino != then.st_ino);
}

} // namespace

// Called by the sanitizers with all that they print. While codecs are kept quiet (io/oiio/quiet.h), what goes to standard
// error is lost, and a finding must not be.
extern "C" void __sanitizer_on_print(const char* text)
{
    if (!is_diverted()) return;
    const ssize_t ignored = ::write(standard_error, text, std::strlen(text));
    static_cast<void>(ignored);
}

#endif
