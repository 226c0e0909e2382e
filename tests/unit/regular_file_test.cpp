// SPDX-License-Identifier: MIT
// Files that a scene may name and that must not be read, through every door that reads files.

#include "io/regular_file.h"
#include "plumb/image.h"
#include "plumb/mesh.h"
#include "plumb/scene_file.h"
#include "plumb/suite.h"
#include "plumb/test_file.h"
#include "scene_file/document.h"
#include "support/catch.h"
#include "support/temp_folder.h"

#include <fcntl.h>
#include <functional>
#include <sys/stat.h>

using namespace plumb;

namespace {

std::string complaint(const std::function<void()>& read)
{
    try {
        read();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "nothing";
}

// What each of the program's readers says of the file.
std::vector<std::string> complaints(const std::filesystem::path& path)
{
    const TempFolder folder;
    const auto including = [&](const std::string& element) {
        return folder.write(
            "main.xml", "<scene dialect='plumb'><integrator type='normals'/><camera type='perspective'/>" +
                            element + "</scene>");
    };
    const std::string name = path.string();
    std::vector<std::string> texts = {
        complaint([&] {
            RegularFile file(path);
            file.fail("it was read");
        }),
        complaint([&] {
            read_text(path);
            throw Error("it was read");
        }),
        complaint([&] { load_scene(path); }),
        complaint([&] { load_test(path); }),
        complaint([&] { load_suite(path, {}, {}); }),
        complaint([&] { read_obj(path); }),
        complaint([&] { load_scene(including("<include filename='" + name + "'/>")); }),
        complaint([&] {
            load_scene(including("<mesh type='obj'><string name='filename' value='" + name + "'/></mesh>"));
        }),
        complaint([&] {
            load_scene(including("<emitter type='environment'><string name='filename' value='" + name +
                                 "'/></emitter>"));
        }),
    };
    for (const std::string type : {"textmap", "imagetexture_color3f"})
        texts.push_back(complaint([&] {
            load_scene(including("<mesh type='sphere'><bsdf type='diffuse'><texture name='albedo' type='" +
                                 type + "'><string name='" + (type == "textmap" ? "filename" : "filepath") +
                                 "' value='" + name + "'/></texture></bsdf></mesh>"));
        }));
    return texts;
}

} // namespace

TEST_CASE("pipes and devices are not read, whoever names them", "[unit][files]")
{
    const TempFolder folder;
    const auto pipe = folder / "pipe.png"; // nobody writes into it: opening it to read would never end
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::filesystem::path& path :
         {pipe, std::filesystem::path("/dev/zero"), std::filesystem::path("/dev/full")})
        for (const std::string& text : complaints(path))
            CHECK_THAT(text, ContainsSubstring("is a device or a pipe, not a regular file"));
}

TEST_CASE("what a Git LFS pointer stands for is missing, and is said to be", "[unit][files]")
{
    const TempFolder folder;
    for (const std::string extension : {".xml", ".obj", ".png", ".jpg", ".exr", ".hdr", ".tif"}) {
        const auto path = folder.write(
            "a" + extension, "version https://git-lfs.github.com/spec/v1\n"
                             "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\n"
                             "size 12345\n");
        for (const std::string& text : complaints(path))
            CHECK_THAT(text,
                       ContainsSubstring(
                           "it is a Git LFS pointer, not the file itself; 'git lfs pull' fetches that"));
        CHECK_THAT(complaint([&] { read_image(path, false); }), ContainsSubstring("Git LFS pointer"));
    }
    // Not every text about LFS is one.
    CHECK(problem_of_file(folder.write("long.txt", "version https://git-lfs.github.com/spec/v1\n" +
                                                       std::string(1024, 'x')))
              .empty());
    CHECK(problem_of_file(folder.write("other.txt", "versions")).empty());
}

TEST_CASE("what this process knows is not shown to whoever names a file under /proc", "[unit][files]")
{
    if (!std::filesystem::exists("/proc/self/environ")) return;
    REQUIRE(setenv("PLUMB_TEST_SECRET", "hushhush", 1) == 0);
    for (const std::string path : {"/proc/self/environ", "/proc/self/cmdline", "/proc/version"})
        for (const std::string& text : complaints(path)) {
            CAPTURE(path, text);
            CHECK_FALSE(text.find("hushhush") != text.npos);
            CHECK_FALSE(text.find("Linux version") != text.npos);
            CHECK_FALSE(text.find("plumb_tests") != text.npos);
            CHECK(text != "nothing");
        }
    CHECK(RegularFile("/proc/self/environ").size() == 0);
    CHECK(problem_of_file("/proc/self/environ") == "the file is empty");
}

TEST_CASE("of a file that is not a scene nothing is shown", "[unit][files]")
{
    const TempFolder folder;
    const std::string secret =
        GENERATE(as<std::string>{}, "root:hushhush:0\n", "hushhush=1\nx=2\n",
                 "<settings><password>hushhush</password></settings>\n", "<settings>\n<hushhush",
                 "<settings hushhush hushhush='1'", "  \n\t<a>hushhush</b>\n", "<!-- hushhush\n",
                 "<?xml version='1.0'?><!DOCTYPE hushhush><settings hushhush='1' hushhush='2'/>",
                 "</hush hushhush", "\xEF\xBB\xBF<settings>hushhush</settings>", "[core]\n\thushhush = 1\n",
                 "\xff\xfehushhush", "hushhush");
    for (const std::string& text : complaints(folder.write("secret.xml", secret))) {
        CAPTURE(secret, text);
        CHECK(text.find("hushhush") == text.npos);
    }
}

TEST_CASE("a regular file is read as it was when it was opened", "[unit][files]")
{
    const TempFolder folder;
    const auto path = folder.write("a.txt", "0123456789");
    const RegularFile file(path);
    CHECK(file.size() == 10);
    char bytes[4];
    file.read(5, bytes);
    CHECK(std::string(bytes, 4) == "5678");
    folder.write("a.txt", "0123456"); // the same file, now shorter
    CHECK_THROWS_WITH(file.read(5, bytes), "cannot read '" + path.string() + "': the file ends early");
    CHECK_THROWS_WITH(RegularFile(folder / "none"),
                      "cannot read '" + (folder / "none").string() + "': no such file");
    CHECK_THROWS_WITH(RegularFile(folder.path()), ContainsSubstring("it is a directory"));
    CHECK(problem_of_file(folder / "none") == "no such file");
}
