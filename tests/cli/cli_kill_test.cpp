// SPDX-License-Identifier: MIT

// kill -9 at any moment of any phase, many times in a row: the image that comes out at last is that of a rendering
// nobody disturbed.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"
#include "support/random.h"

#include <cstdlib>
#include <map>
#include <random>

using namespace plumb;
using test::TestRandom;

namespace {

const std::string phases[] = {"load", "build", "pass", "write", "flush", "rename"};

// "write:3:half". Most renderings come to a few of each.
std::string random_kill(TestRandom& random)
{
    const auto choose = [&](int count) { return static_cast<int>(random.next_double() * count); };
    const std::string& phase = phases[choose(6)];
    const std::string moments[] = {"before", "half", "after"};
    if (phase == "load") return phase + ":1:" + std::to_string(choose(12000));
    if (phase == "build") return phase + ":1:" + std::to_string(choose(500));
    if (phase == "pass") return phase + ":1:" + std::to_string(choose(60000));
    return phase + ":" + std::to_string(1 + choose(3)) + ":" + moments[choose(3)];
}

std::string last_line(const std::string& text)
{
    if (text.empty()) return "load"; // before the library was there
    const std::size_t end = text.size() - 1;
    const std::size_t before = text.rfind('\n', end - 1);
    return text.substr(before == std::string::npos ? 0 : before + 1,
                       end - (before == std::string::npos ? 0 : before + 1));
}

void check_kills(int kills_wanted)
{
    const char* const given = std::getenv("PLUMB_TEST_SEED");
    const std::uint64_t seed = given ? std::strtoull(given, nullptr, 10) : std::random_device()();
    INFO("PLUMB_TEST_SEED=" << seed);
    TestRandom random(seed);
    const SceneDirectory directory;
    const Names words = {"scene.xml", "--quiet", "--spp", "200", "-o"};
    const auto with = [&](const Names& more) {
        Names all = words;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    REQUIRE(directory.run(with({"whole.exr"})).exit_code == 0);
    const std::string whole = read_bytes(directory / "whole.exr");

    // LD_PRELOAD is a list: a space or a colon in the name of the build directory would end the name.
    std::filesystem::create_symlink(PLUMB_KILLER, directory / "killer.so");
    const std::string preload = "LD_PRELOAD=" + (directory / "killer.so").string();

    std::map<std::string, int> kills;
    int images = 0;
    for (int killed = 0; killed < kills_wanted;) {
        directory.write("trace", "");
        const std::string moment = random_kill(random);
        const RunResult result =
            run_renderer(with({"a.exr", "--checkpoint", "c.exr", "--checkpoint-every", "0.02s", "--resume"}),
                         directory.path(), "", {},
                         {preload, "ASAN_OPTIONS=verify_asan_link_order=0", "PLUMB_KILL=" + moment,
                          "PLUMB_KILL_TRACE=" + (directory / "trace").string()});
        INFO(moment << ": " << result.err);
        if (result.exit_code == 128 + SIGKILL) {
            ++killed;
            ++kills[last_line(read_bytes(directory / "trace"))];
            continue;
        }
        REQUIRE(result.exit_code == 0);
        REQUIRE(result.err.empty()); // no generation was damaged
        REQUIRE(read_bytes(directory / "a.exr") == whole);
        ++images;
        for (const char* file : {"a.exr", "c.exr", "c.previous.exr"})
            std::filesystem::remove(directory / file);
    }
    // Undisturbed, it comes to its end.
    REQUIRE(directory.run(with({"a.exr", "--checkpoint", "c.exr", "--resume"})).exit_code == 0);
    REQUIRE(read_bytes(directory / "a.exr") == whole);
    std::string counts;
    for (const std::string& phase : phases) counts += " " + phase + " " + std::to_string(kills[phase]);
    WARN("kills:" << counts << "; images on the way: " << images);
    if (kills_wanted >= 100)
        for (const std::string& phase : phases) CHECK(kills[phase] > 0);
}

} // namespace

TEST_CASE("a rendering survives kill -9 at any moment", "[cli][checkpoint][kill]")
{
    check_kills(24);
}

TEST_CASE("a rendering survives kill -9 at any moment: at length", "[cli][checkpoint][kill][slow]")
{
    check_kills(400);
}
