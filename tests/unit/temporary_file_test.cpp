// SPDX-License-Identifier: MIT

// Files that appear whole: under which names, and what of others they leave alone.

#include "base/temporary_file.h"
#include "base/text_file.h"
#include "cli/outputs.h"
#include "cli/usage_error.h"
#include "plumb/base/error.h"
#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <sys/stat.h>

using namespace plumb;

namespace {

namespace fs = std::filesystem;

void write_over(const fs::path& path, std::string_view text)
{
    TemporaryFile file(path);
    file.write(text);
    file.take_place();
}

} // namespace

TEST_CASE("temporary files leave files of others alone and wait for nobody", "[unit][temporary_file]")
{
    const TempDirectory directory;
    const fs::path target = directory / "a.txt";
    // The name that the next temporary file would have.
    const fs::path reserved = unfinished_name(target, "part0");
    SECTION("a plain name of the older kind")
    {
        directory.write(".a.txt.part0", "mine");
        write_over(target, "new");
        CHECK(read_bytes(directory / ".a.txt.part0") == "mine");
    }
    SECTION("a pipe")
    {
        REQUIRE(mkfifo(reserved.c_str(), 0600) == 0);
        write_over(target, "new");
        CHECK(fs::is_fifo(reserved));
    }
    SECTION("another name of a file")
    {
        const fs::path mine = directory.write("mine", "mine");
        fs::create_hard_link(mine, reserved);
        write_over(target, "new");
        CHECK(read_bytes(mine) == "mine");
    }
    SECTION("a link")
    {
        const fs::path mine = directory.write("mine", "mine");
        fs::create_symlink(mine, reserved);
        write_over(target, "new");
        CHECK(read_bytes(mine) == "mine");
        CHECK(fs::is_symlink(reserved));
    }
    SECTION("a directory")
    {
        fs::create_directory(reserved);
        write_over(target, "new");
        CHECK(fs::is_directory(reserved));
    }
    SECTION("what a process that was killed left behind is used")
    {
        directory.write(reserved.filename(), "half of");
        write_over(target, "new");
        CHECK(directory.files() == std::vector<std::string>{"a.txt"});
    }
    CHECK(read_bytes(target) == "new");
}

TEST_CASE("links are written through, whether there is a file at their end or not", "[unit][temporary_file]")
{
    const TempDirectory directory;
    fs::create_directory(directory / "sub");
    fs::create_symlink("sub/b.txt", directory / "second.txt");
    fs::create_symlink("second.txt", directory / "first.txt");
    for (const char* text : {"once", "again"}) {
        write_over(directory / "first.txt", text);
        CHECK(fs::is_symlink(directory / "first.txt"));
        CHECK(fs::is_symlink(directory / "second.txt"));
        CHECK(read_bytes(directory / "sub/b.txt") == text);
    }
    fs::create_symlink("nowhere/c.exr", directory / "lost.exr");
    CHECK_THROWS_WITH(check_image_path(directory / "lost.exr"), ContainsSubstring("nowhere' does not exist"));
    fs::create_symlink("circle", directory / "circle");
    CHECK_THROWS_AS(TemporaryFile(directory / "circle"), Error);
}

TEST_CASE("one file under two names is written once", "[unit][temporary_file]")
{
    const TempDirectory directory;
    fs::create_symlink("a.exr", directory / "b.exr"); // to a file that is not there yet
    fs::create_symlink("b.exr", directory / "c.exr");
    const auto name = [&](const char* file) { return (directory / file).string(); };
    CHECK_THROWS_AS(check_outputs({name("a.exr"), name("b.exr")}, {}), UsageError);
    CHECK_THROWS_AS(check_outputs({name("c.exr"), name("b.exr")}, {}), UsageError);
    CHECK_THROWS_AS(check_outputs({name("d.exr"), name("a.exr")}, name("c.exr")), UsageError);
    CHECK_NOTHROW(check_outputs({name("d.exr"), name("a.exr")}, name("e.json")));
}

TEST_CASE("a name that is too long is found before anything is written", "[unit][temporary_file]")
{
    const TempDirectory directory;
    const std::string longest(251, 'z');
    CHECK_NOTHROW(check_image_path(directory / (longest + ".exr")));
    CHECK_NOTHROW(check_text_path(directory / (longest + ".txt")));
    write_over(directory / (longest + ".txt"), "new");
    for (const std::size_t length : {252, 400}) {
        const std::string name(length, 'z');
        CHECK_THROWS_WITH(check_image_path(directory / (name + ".exr")),
                          ContainsSubstring("File name too long"));
        CHECK_THROWS_WITH(check_text_path(directory / (name + ".txt")),
                          ContainsSubstring("File name too long"));
    }
    // Names that differ only at their ends do not share a temporary file.
    CHECK(unfinished_name(longest + "a", "part0") != unfinished_name(longest + "b", "part0"));
    CHECK(directory.files() == std::vector<std::string>{longest + ".txt"});
}
