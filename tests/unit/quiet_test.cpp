// SPDX-License-Identifier: MIT

// Standard error while codecs are kept quiet: what they print is lost, and what sanitizers report is not.

#include "base/sanitized.h"
#include "image/oiio/quiet.h"
#include "support/catch.h"
#include "support/run.h"

#include <climits>
#include <cstdlib>
#include <optional>

using namespace plumb;

namespace {

constexpr const char* printing = "what codecs print is lost while they are kept quiet";
constexpr const char* reporting = "what sanitizers report arrives while codecs are kept quiet";
constexpr const char* variable = "PLUMB_TEST_FAULT";

// This test once more, in a process that is told what to do. What it writes to standard error.
std::string errors_of(const char* test, const std::string& fault)
{
    const TempDirectory directory;
    return run_program({"/proc/self/exe", test}, directory.path(), "", {},
                       {std::string(variable) + "=" + fault})
        .err;
}

void commit(const std::string& fault)
{
    if (fault == "print") {
        std::fputs("before ", stderr);
        {
            const QuietStandardError quiet;
            const QuietStandardError inner;
            std::fputs("within ", stderr);
        }
        std::fputs("after\n", stderr);
    }
    std::optional<QuietStandardError> quiet(std::in_place);
    if (fault.ends_with(" afterwards")) quiet.reset();
    if (fault.starts_with("memory")) {
        char* volatile bytes = new char[3];
        bytes[3] = 1;
    }
    if (fault.starts_with("number")) {
        volatile int number = INT_MAX;
        number = number + 1;
    }
}

} // namespace

TEST_CASE(printing, "[unit]")
{
    if (std::getenv(variable)) return commit(std::getenv(variable));
    CHECK(errors_of(printing, "print") == "before after\n");
}

#ifdef PLUMB_SANITIZED

TEST_CASE(reporting, "[unit]")
{
    if (std::getenv(variable)) return commit(std::getenv(variable));
    for (const char* when : {"", " afterwards"}) {
        CHECK_THAT(errors_of(reporting, std::string("memory") + when),
                   ContainsSubstring("AddressSanitizer: heap-buffer-overflow"));
        CHECK_THAT(errors_of(reporting, std::string("number") + when),
                   ContainsSubstring("runtime error: signed integer overflow"));
    }
}

#endif
