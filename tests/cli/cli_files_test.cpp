// SPDX-License-Identifier: MIT

// Which files the program writes, and that it finds out before it renders.

#include "base/visible_text.h"
#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"

#include <sys/stat.h>

using namespace plumb;

namespace {

namespace fs = std::filesystem;

// Longer than anybody waits: what is wrong must be found before.
const Names long_rendering = {"scene.xml", "--spp", "60000000", "--quiet"};

RunResult run_long(const SceneDirectory& directory, const Names& more)
{
    Names words = long_rendering;
    words.insert(words.end(), more.begin(), more.end());
    return directory.run(words);
}

// What an error that is found before the rendering leaves behind: nothing.
void check_refused(const SceneDirectory& directory, const Names& more, const std::string& reason,
                   int exit_code = 1)
{
    const auto before = directory.files();
    const RunResult run = run_long(directory, more);
    INFO(run.err);
    CHECK(run.exit_code == exit_code);
    CHECK_THAT(run.err, ContainsSubstring(reason));
    CHECK(directory.files() == before);
}

} // namespace

TEST_CASE("names that are too long are found before the rendering", "[cli][files]")
{
    const SceneDirectory directory;
    const std::string too_long = std::string(256, 'z');
    const std::string longest = std::string(251, 'z') + ".exr";
    const std::string reason = "File name too long";
    check_refused(directory, {"-o", too_long + ".exr"}, reason);
    check_refused(directory, {"-o", too_long + ".png"}, reason);
    check_refused(directory, {"-o", "a.exr", "--json", too_long}, reason);
    check_refused(directory, {"-o", "a.exr", "--checkpoint", too_long + ".exr"}, reason);
    // Its name is good, that of its previous generation is not.
    check_refused(directory, {"-o", "a.exr", "--checkpoint", longest}, reason);
    check_refused(directory, {"--part", "1/2", "-o", longest}, reason);
    check_refused(directory, {"-o", std::string(3000, 'z') + "/a.exr"}, "");
    // By default an image is named after its scene.
    const std::string scene = std::string(245, 's') + ".xml";
    directory.write(scene, small_scene());
    const RunResult named = directory.run({scene, "--spp", "60000000", "--quiet"});
    CHECK(named.exit_code == 1);
    CHECK_THAT(named.err, ContainsSubstring(reason));
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--quiet", "--spp", "2", "--size", "8x6"}).exit_code ==
            0);
    const RunResult difference = directory.run({"compare", "a.exr", "a.exr", "--diff", too_long + ".png"});
    CHECK(difference.exit_code == 1);
    CHECK_THAT(difference.err, ContainsSubstring(reason));
    directory.write("suite.xml", "<suite size=\"8x6\"><render scene=\"scene.xml\" spp=\"4\" name=\"" +
                                     std::string(245, 'n') + "\" reference=\"a.exr\"/></suite>");
    const RunResult batch = directory.run({"batch", "suite.xml"}); // a.exr, but not a_diff.png would fit
    CHECK(batch.exit_code == 1);
    CHECK_THAT(batch.out, ContainsSubstring(reason));
    CHECK_FALSE(fs::exists(directory / "batch/suite" / (std::string(245, 'n') + "_4.exr")));
}

TEST_CASE("one file under two names is found before the rendering", "[cli][files]")
{
    const SceneDirectory directory;
    fs::create_symlink("a.exr", directory / "b.exr");
    check_refused(directory, {"-o", "a.exr", "-o", "b.exr"}, "'b.exr' is listed as an output twice", 2);
    check_refused(directory, {"-o", "c.previous.exr", "--checkpoint", "c.exr"},
                  "is listed as an output twice", 2);
    fs::create_symlink("c.previous.exr", directory / "d.exr");
    check_refused(directory, {"-o", "d.exr", "--checkpoint", "c.exr"}, "is listed as an output twice", 2);
}

TEST_CASE("a link to nothing is written through", "[cli][files]")
{
    const SceneDirectory directory;
    fs::create_directory(directory / "sub");
    for (const char* ending : {".exr", ".png", ".json"})
        fs::create_symlink(std::string("sub/to") + ending, directory / (std::string("link") + ending));
    fs::create_symlink("sub/state.exr", directory / "state.exr");
    REQUIRE(directory
                .run({"scene.xml", "--quiet", "-o", "link.exr", "-o", "link.png", "--json", "link.json",
                      "--checkpoint", "state.exr"})
                .exit_code == 0);
    for (const char* ending : {".exr", ".png", ".json"}) {
        CHECK(fs::is_symlink(directory / (std::string("link") + ending)));
        CHECK(fs::is_regular_file(directory / (std::string("sub/to") + ending)));
    }
    CHECK(fs::is_symlink(directory / "state.exr"));
    CHECK(fs::is_regular_file(directory / "sub/state.exr"));
}

TEST_CASE("the name of the previous generation takes no file of others", "[cli][files][checkpoint]")
{
    const SceneDirectory directory;
    fs::copy_file(directory / "scene.xml", directory / "c.previous.exr");
    const std::string scene = read_bytes(directory / "scene.xml");
    SECTION("when a rendering begins")
    {
        check_refused(directory, {"-o", "a.exr", "--checkpoint", "c.exr"}, "'c.previous.exr' already exists");
    }
    SECTION("when one is resumed")
    {
        fs::remove(directory / "c.previous.exr");
        REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--spp", "2", "--checkpoint", "c.exr", "--quiet"})
                    .exit_code == 0);
        fs::copy_file(directory / "scene.xml", directory / "c.previous.exr");
        check_refused(directory, {"-o", "a.exr", "--checkpoint", "c.exr", "--resume"},
                      "the previous state is kept as 'c.previous.exr', which is another file");
        // Or it is that of another rendering.
        fs::remove(directory / "c.previous.exr");
        REQUIRE(directory
                    .run({"scene.xml", "-o", "a.exr", "--spp", "2", "--seed", "9", "--checkpoint",
                          "c.previous.exr", "--quiet"})
                    .exit_code == 0);
        check_refused(directory, {"-o", "a.exr", "--checkpoint", "c.exr", "--resume"},
                      "which is the state of another rendering");
        return;
    }
    SECTION("when it is a scene")
    {
        const auto run =
            directory.run({"c.previous.exr", "-o", "a.exr", "--checkpoint", "c.exr", "--resume"});
        CHECK(run.exit_code == 1);
    }
    SECTION("when parts are merged")
    {
        REQUIRE(directory.run({"scene.xml", "--part", "1/1", "-o", "p.exr", "--quiet"}).exit_code == 0);
        const auto run = directory.run({"merge", "p.exr", "--checkpoint", "c.exr"});
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.err, ContainsSubstring("which is another file"));
    }
    CHECK(read_bytes(directory / "c.previous.exr") == scene);
}

TEST_CASE("pipes in the way hold nobody up", "[cli][files]")
{
    const SceneDirectory directory;
    for (const char* name : {".a.exr.part0", "c.previous.exr"})
        REQUIRE(mkfifo((directory / name).c_str(), 0600) == 0);
    CHECK(directory.run({"scene.xml", "-o", "a.exr", "--quiet"}).exit_code == 0);
    check_refused(directory, {"-o", "b.exr", "--checkpoint", "c.exr"}, "'c.previous.exr' already exists");
    const RunResult resumed = run_long(directory, {"-o", "b.exr", "--checkpoint", "c.exr", "--resume"});
    CHECK(resumed.exit_code == 1);
    CHECK_THAT(resumed.err, ContainsSubstring("it is a device or a pipe, not a regular file"));
}

TEST_CASE("names of files steer no terminal, in whatever message or table they are", "[cli][files]")
{
    const SceneDirectory directory;
    // ESC, BEL, C1 as a character and as a byte, a mark that turns the direction, a line that looks like ours.
    const std::string evil = "\x1b[31m\x07\xc2\x9b"
                             "31m\x9b\xe2\x80\xae\n::error::forged";
    const std::string scene = evil + ".xml";
    directory.write(scene, small_scene());
    directory.write("wrong" + scene, "<scene>\n<a" + evil + "=\"\"/></scene>\n");
    directory.write("mesh.xml",
                    "<scene><mesh type=\"obj\"><string name=\"filename\" value=\"bad.obj\"/></mesh></scene>");
    directory.write("bad.obj", "v 0 0 " + std::string("\x1b[31m\xc2\x9b\xe2\x80\xae\x9b") + "\n");
    directory.write(
        "suite.xml",
        "<suite size=\"8x6\"><render scene=\"scene.xml\" spp=\"4\" name=\"\xe2\x80\xae\xc2\x9b\"/>"
        "<render scene=\"no\xc2\x9b.xml\" spp=\"4\" name=\"b\"/></suite>");
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--quiet"}).exit_code == 0);
    const std::vector<Names> runs = {
        {scene, "-o", evil + ".exr", "--checkpoint", evil + ".state.exr"},
        {scene, "-o", evil + ".exr", "--checkpoint", evil + ".state.exr"}, // already exists
        {scene, "-o", evil + ".exr", "--checkpoint", evil + ".state.exr", "--resume"},
        {scene, "-o", "no/" + evil + ".exr"},
        {scene, "-o", "a" + evil},
        {scene, "-o", scene},
        {scene, "-D", evil},
        {scene, "--integrator", evil},
        {scene, "--" + evil},
        {scene, evil},
        {"wrong" + scene},
        {"mesh.xml"},
        {"none" + scene},
        {"info", evil + ".exr"},
        {"info", scene},
        {"types", evil},
        {"rerun", evil + ".exr", "-o", "again.exr"},
        {"rerun", scene, "-o", "again.exr"},
        {"merge", evil + ".state.exr", "-o", evil + "2.exr"},
        {"merge", scene, "-o", "b.exr"},
        {"compare", evil + ".exr", evil + ".exr"},
        {"compare", evil + ".exr", scene},
        {"compare", evil + ".exr", evil + ".exr", "--json", "-"},
        {"check", scene},
        {"agree", scene, "--spp", "2", "--size", "8x6"},
        {"agree", scene, "--spp", "2", "--size", "8x6", "--json", "-"},
        {"race", scene, "--spp", "2", "--size", "8x6", "--rounds", "3"},
        {"test", scene},
        {"replay", scene, "--pixel", "1,1", "--sample", "0"},
        {"batch", "suite.xml", "--out", evil},
        {"batch", scene},
        {scene, "-o", "c.exr", "--json", "-"}};
    for (const Names& words : runs) {
        const RunResult run = directory.run(words);
        std::string command;
        for (const std::string& word : words) command += " " + visible_text(word);
        INFO(command << ": " << run.exit_code);
        CHECK(run.exit_code < 128);
        std::string all = run.out + run.err;
        CHECK(all.find("\n::error") == all.npos);
        std::erase(all, '\n');
        std::erase(all, '\t');
        CHECK(visible_text(all) == all);
    }
}
