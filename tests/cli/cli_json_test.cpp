// SPDX-License-Identifier: MIT

// --json: errors, and the verbs that render no whole image.

#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"

#include <cstdint>
#include <cstring>

using namespace plumb;

namespace {

std::string wrong_scene()
{
    std::string scene = small_scene();
    return scene.replace(scene.find("name=\"albedo\""), 13, "name=\"albdo\"");
}

} // namespace

TEST_CASE("an error is JSON where a report would be", "[cli][json]")
{
    const SceneDirectory directory;
    directory.write("wrong.xml", wrong_scene());
    const RunResult run = directory.run({"wrong.xml", "--json", "-"});
    CHECK(run.exit_code == 1);
    CHECK(run.out == "{\n  \"schema\": 1,\n  \"kind\": \"error\",\n  \"software\": \"Plumb " PLUMB_VERSION
                     "\",\n"
                     "  \"exit_code\": 1,\n  \"errors\": [\n    {\n      \"file\": \"wrong.xml\",\n"
                     "      \"line\": 12,\n      \"column\": 39,\n      \"severity\": \"error\",\n"
                     "      \"message\": \"unknown parameter 'albdo' for bsdf 'diffuse'\",\n"
                     "      \"suggestion\": \"did you mean 'albedo'?\"\n    }\n  ]\n}\n");
    CHECK(
        run.err.starts_with("wrong.xml:12:39: error: unknown parameter 'albdo' for bsdf 'diffuse'; did you"));
    for (const char* verb : {"check", "agree", "race"})
        CHECK(directory.run({verb, "wrong.xml", "--json", "-"}).out == run.out);
    CHECK(directory.run({"replay", "wrong.xml", "--pixel", "0,0", "--sample", "0", "--json=-"}).out ==
          run.out);

    const RunResult usage = directory.run({"scene.xml", "--json", "out.json", "--sppp", "4"});
    CHECK(usage.exit_code == 2);
    const std::string json = read_bytes(directory / "out.json");
    CHECK_THAT(json, ContainsSubstring("\"exit_code\": 2,"));
    CHECK_THAT(json, ContainsSubstring("\"file\": null,\n      \"line\": null,\n      \"column\": null,"));
    CHECK_THAT(json, ContainsSubstring("\"suggestion\": \"did you mean '--spp'?\""));
    // A report of an earlier run does not stay as if it were this one's.
    CHECK(directory.run({"compare", "none.exr", "none.exr", "--json", "out.json"}).exit_code == 1);
    CHECK_THAT(read_bytes(directory / "out.json"), ContainsSubstring("\"exit_code\": 1,"));
}

TEST_CASE("an error replaces no file that is not a report", "[cli][json]")
{
    const SceneDirectory directory;
    const std::string scene = read_bytes(directory / "scene.xml");
    CHECK(directory.run({"scene.xml", "--spp", "1", "--json", "scene.xml"}).exit_code == 1);
    CHECK(read_bytes(directory / "scene.xml") == scene);
    CHECK(directory.run({"check", "none.xml", "--json", "scene.xml"}).exit_code == 1);
    CHECK(read_bytes(directory / "scene.xml") == scene);
    // Nor is there anything to be written where it cannot be.
    const RunResult nowhere = directory.run({"none.xml", "--json", "none/out.json"});
    CHECK(nowhere.exit_code == 1);
    CHECK(std::count(nowhere.err.begin(), nowhere.err.end(), '\n') == 1);
    CHECK(directory.run({"scene.xml", "--json"}).exit_code == 2);
}

TEST_CASE("info as JSON, and pixels for numpy", "[cli][json]")
{
    const SceneDirectory directory;
    CHECK(
        directory
            .run({"scene.xml", "--spp", "2", "--crop", "1,2,3,4", "--no-variance", "--quiet", "-o", "a.exr"})
            .exit_code == 0);
    const RunResult info = directory.run({"info", "a.exr", "--json", "-", "--pixels", "a.npy"});
    CHECK(info.exit_code == 0);
    for (const char* part : {"\"kind\": \"info\"", "\"resolution\": [\n    48,\n    36\n  ]",
                             "\"window\": [\n    1,\n    2,\n    3,\n    4\n  ]",
                             "\"channels\": [\n    \"R\",\n    \"G\",\n    \"B\"",
                             "\"plumb:samplesPerPixel\": 2", "\"plumb:seed\": \"0\""})
        CHECK_THAT(info.out, ContainsSubstring(part));
    CHECK(directory.run({"info", "a.exr"}).out.find('{') == std::string::npos);

    const std::string npy = read_bytes(directory / "a.npy");
    REQUIRE(npy.size() > 10);
    CHECK(npy.starts_with(std::string("\x93NUMPY\1\0", 8)));
    const auto header = static_cast<std::size_t>(static_cast<unsigned char>(npy[8])) +
                        256 * static_cast<std::size_t>(static_cast<unsigned char>(npy[9]));
    CHECK((10 + header) % 64 == 0);
    CHECK_THAT(npy.substr(10, header), ContainsSubstring("'fortran_order': False, 'shape': (4, 3, 3)"));
    REQUIRE(npy.size() == 10 + header + 4 * 3 * 3 * sizeof(float));
    const Image image = read_image(directory / "a.exr", false);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 3; ++x) {
            float values[3];
            std::memcpy(values,
                        npy.data() + 10 + header + static_cast<std::size_t>(3 * y + x) * sizeof values,
                        sizeof values);
            for (int i = 0; i < 3; ++i) CHECK(values[i] == image.pixel(1 + x, 2 + y)[i]);
        }
    }
    const std::string bytes = read_bytes(directory / "a.exr");
    CHECK(directory.run({"info", "a.exr", "--pixels", "a.exr"}).err ==
          "error: cannot write 'a.exr': it is the image to read\n");
    CHECK(directory.run({"info", "a.exr", "--pixels", "x", "--json", "./x"}).exit_code == 2);
    CHECK(read_bytes(directory / "a.exr") == bytes);
}

TEST_CASE("types as JSON has every parameter of the manual", "[cli][json]")
{
    const SceneDirectory directory;
    const std::string all = directory.run({"types", "--json", "-"}).out;
    for (const char* part : {"\"kind\": \"types\"", "\"name\": \"roughconductor\"", "\"names\": [\n"})
        CHECK_THAT(all, ContainsSubstring(part));
    const RunResult one = directory.run({"types", "roughconductor", "--json", "-"});
    CHECK(one.exit_code == 0);
    CHECK_THAT(one.out, ContainsSubstring(
                            "{\n          \"name\": \"alpha\",\n"
                            "          \"type\": \"float or texture\",\n"
                            "          \"description\": \"roughness, in [0, 1]; less than 0.0001 counts as "
                            "0.0001\",\n          \"default\": \"0.1\"\n"));
    CHECK(one.out.find("\"name\": \"diffuse\"") == std::string::npos);
    // No row of a manual was misread.
    CHECK(all.find("\"type\": \"\"") == std::string::npos);
    const RunResult none = directory.run({"types", "roughconducto", "--json", "-"});
    CHECK(none.exit_code == 2);
    CHECK_THAT(none.out, ContainsSubstring("\"suggestion\": \"did you mean 'roughconductor'?\""));
}

TEST_CASE("check and replay as JSON", "[cli][json]")
{
    const SceneDirectory directory;
    const RunResult clean = directory.run({"check", "scene.xml", "--json", "-"});
    INFO(clean.out);
    CHECK_THAT(clean.out, ContainsSubstring("\"kind\": \"check\""));
    CHECK_THAT(clean.out, ContainsSubstring("\"clean\": true"));
    CHECK(clean.exit_code == 0);
    std::string dark = small_scene();
    directory.write("dark.xml", dark.replace(dark.find("20,20,18"), 8, "0,0,0"));
    const RunResult doubtful = directory.run({"check", "dark.xml", "--json", "-"});
    CHECK(doubtful.exit_code == 3);
    CHECK_THAT(doubtful.out, ContainsSubstring("\"clean\": false"));
    CHECK_THAT(doubtful.out, ContainsSubstring("\"likely_mistakes\": [\n    {\n      \"object\": "));

    const Names replay = {"replay", "scene.xml", "--pixel", "20,30", "--sample", "1"};
    Names as_json = replay;
    as_json.insert(as_json.end(), {"--json", "-"});
    const RunResult path = directory.run(as_json);
    CHECK(path.exit_code == 0);
    for (const char* part : {"\"kind\": \"replay\"", "\"pixel\": [\n    20,\n    30\n  ]", "\"sample\": 1",
                             "\"events\": [\n    {\n      \"kind\": \"ray\",", "\"status\": "})
        CHECK_THAT(path.out, ContainsSubstring(part));
    CHECK_THAT(directory.run(replay).out, ContainsSubstring("sample 1 of pixel 20,30"));
}
