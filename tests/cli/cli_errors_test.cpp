// SPDX-License-Identifier: MIT

// What the program says and how it exits when something is wrong.

#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

TEST_CASE("a wrong command line exits with 2 and says why", "[cli][errors]")
{
    const SceneDirectory directory;
    const auto complaint = [&](const Names& words) {
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        return result.err;
    };
    CHECK(complaint({}) == "error: no scene file given; 'renderer --help' shows how\n");
    CHECK(complaint({"scene.xml", "--sp", "4"}) == "error: unknown option '--sp'; did you mean '--spp'?\n");
    CHECK(complaint({"scene.xml", "--spp", "0"}) ==
          "error: --spp must be an integer from 1 to 67108864, not '0'\n");
    CHECK(complaint({"scene.xml", "--threads", "0"}) ==
          "error: --threads must be an integer from 1 to 1024, not '0'\n");
    CHECK(complaint({"scene.xml", "-o", "a.exr", "-o", "a.exr"}) ==
          "error: 'a.exr' is listed as an output twice\n");
    const std::string absolute = (directory / "a.exr").string();
    CHECK(complaint({"scene.xml", "-o", "a.exr", "-o", absolute}) ==
          "error: '" + absolute + "' is listed as an output twice\n");
    CHECK(complaint({"types", "difuse"}) == "error: unknown type 'difuse'; did you mean 'diffuse'?\n");
    CHECK(directory.files() == Names{"scene.xml"});
}

TEST_CASE("a wrong scene exits with 1, says where, and writes nothing", "[cli][errors]")
{
    const SceneDirectory directory;
    const auto complaint = [&](const Names& words) {
        const Names before = directory.files();
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 1);
        CHECK(result.out.empty());
        std::filesystem::remove(directory / "bad.json"); // the error, as --json asks
        CHECK(directory.files() == before);
        return result.err;
    };
    CHECK(complaint({"none.xml"}) == "error: scene file 'none.xml' does not exist\n");
    CHECK_THAT(complaint({"scene.xml", "--crop", "40,0,9,1"}),
               ContainsSubstring("error: the crop 40,0,9,1 is not inside the image of 48x36 pixels\n"));
    CHECK_THAT(complaint({"scene.xml", "--integrator", "path_miss"}),
               ContainsSubstring("did you mean 'path_mis'?"));
    CHECK_THAT(complaint({"scene.xml", "--integrator", "material"}),
               ContainsSubstring("integrator 'material' is not supported; use 'normals'"));

    directory.write(
        "bad.xml",
        small_scene(R"(<integrator type="path_mis"><float name="rrDeph" value="3"/></integrator>)"));
    const std::string error = complaint({"bad.xml", "-o", "bad.exr", "-o", "bad.png", "--json", "bad.json"});
    CHECK(error == "bad.xml:2:44: error: unknown parameter 'rrDeph' for integrator 'path_mis'; did you mean "
                   "'rrDepth'?\n"
                   "  <integrator type=\"path_mis\"><float name=\"rrDeph\" value=\"3\"/></integrator>\n"
                   "                                           ^~~~~~\n");
    CHECK(directory.run({"bad.xml", "--lenient", "-o", "lenient.exr"}).exit_code == 0);
}

TEST_CASE("what a scene is read from is not overwritten", "[cli][errors]")
{
    const SceneDirectory directory;
    directory.write("part.xml", small_scene());
    directory.write("main.xml", "<scene dialect=\"plumb\"><include filename=\"part.xml\"/></scene>");
    const Names before = directory.files();
    const std::string part = read_bytes(directory / "part.xml");
    const RunResult result = directory.run({"main.xml", "-o", "a.exr", "--json", "./part.xml"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring("error: cannot write './part.xml': the scene reads this file"));
    CHECK(read_bytes(directory / "part.xml") == part);
    CHECK(directory.files() == before);
}

TEST_CASE("an output that cannot be written is found out before rendering", "[cli][errors]")
{
    const SceneDirectory directory;
    const auto complaint = [&](const Names& words) {
        // Were it rendered first, this would take hours.
        Names all = {"scene.xml", "--spp", "67108864", "--size", "1024x1024"};
        all.insert(all.end(), words.begin(), words.end());
        const Names before = directory.files();
        const RunResult result = directory.run(all);
        CHECK(result.exit_code == 1);
        CHECK(directory.files() == before);
        return result.err;
    };
    CHECK_THAT(complaint({"-o", "none/a.exr"}), ContainsSubstring("none/a.exr"));
    CHECK_THAT(complaint({"-o", "a.xyz"}), ContainsSubstring("a.xyz"));
    CHECK_THAT(complaint({"-o", "a"}), ContainsSubstring("'a'"));
    CHECK_THAT(complaint({"-o", "scene.xml/a.exr"}), ContainsSubstring("scene.xml/a.exr"));
    CHECK_THAT(complaint({"-o", "a.exr", "-o", "/proc/a.png"}), ContainsSubstring("/proc/a.png"));
    CHECK(complaint({"-o", "a.exr", "--json", "none/a.json"}) ==
          "error: cannot write 'none/a.json': No such file or directory\n");
    std::filesystem::create_directory(directory / "directory.exr");
    CHECK_THAT(complaint({"-o", "directory.exr"}), ContainsSubstring("directory.exr"));
    directory.write("old.exr", "not touched");
    CHECK_THAT(complaint({"-o", "old.exr", "-o", "none/a.exr"}), ContainsSubstring("none/a.exr"));
    CHECK(read_bytes(directory / "old.exr") == "not touched");
}
