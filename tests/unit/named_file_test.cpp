// SPDX-License-Identifier: MIT
#include "base/named_file.h"
#include "support/catch.h"
#include "support/temp_directory.h"

using namespace plumb;

TEST_CASE("a name of no file is looked for and not found, whatever its form", "[unit][named_file]")
{
    const TempDirectory directory;
    for (const std::string name : {"none.obj",
                                   "a/none.obj",
                                   "../none.obj",
                                   "../../a/none.obj",
                                   "..",
                                   "../",
                                   "/",
                                   "//",
                                   "/.",
                                   "/..",
                                   "/none",
                                   "/none/",
                                   "/none/a/b.obj",
                                   "/none/../b.obj",
                                   "C:\\none\\b.obj",
                                   "C:\\",
                                   "C:",
                                   "\\\\host\\none\\b.obj",
                                   "./",
                                   "a//none.obj",
                                   "/a//none.obj"}) {
        INFO(name);
        const NamedFile found = find_named_file(directory.path(), name);
        CHECK(found.notice.empty());
    }
}
