// SPDX-License-Identifier: MIT

// Files that scenes, tests and suites name: where they are looked for, and what is said when they are not there.

#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/run.h"

using namespace plumb;

namespace {

using Names = std::vector<std::string>;

const std::string square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                           "f 1/1 2/2 3/3 4/4\n";
const std::string part = "<scene><mesh type='sphere'/></scene>";

std::string scene(const std::string& more)
{
    return R"(<scene dialect="plumb"><integrator type="path_mis"/>
<camera type="perspective"><integer name="width" value="8"/><integer name="height" value="6"/></camera>
<emitter type="point"><point name="position" value="0,0,3"/></emitter>
)" + more + "\n</scene>\n";
}

// One way to name a file in a scene.
struct Parameter {
    std::string name;
    std::string file;          // that there is
    std::string before, after; // around the name, in the scene
};

const Parameter parameters[] = {
    {"filename", "Data/square.obj", "<mesh type='obj'><string name='filename' value='", "'/></mesh>"},
    {"filepath", "Data/dots.hdr",
     "<mesh type='sphere'><bsdf type='diffuse'><texture type='imagetexture_color3f' name='albedo'><string "
     "name='filepath' value='",
     "'/></texture></bsdf></mesh>"},
    {"filename", "Data/dots.hdr", "<emitter type='environment'><string name='filename' value='",
     "'/></emitter>"},
    {"", "Data/part.xml", "<include filename='", "'/>"},
};

// A directory with the files, in `below`, and a scene in scenes/ that names one.
struct Files : TempDirectory {
    explicit Files(const std::string& below)
    {
        write(below + "Data/square.obj", square);
        write(below + "Data/part.xml", part);
        write(below + "Data/dots.hdr",
              "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + std::string(16, 'z'));
    }
    RunResult check(const Parameter& parameter, const std::string& name) const
    {
        write("scenes/a.xml", scene(parameter.before + name + parameter.after));
        return run_renderer({"check", "scenes/a.xml"}, path());
    }
};

std::string in_lines(const std::string& name, char separator)
{
    std::string text = name;
    std::replace(text.begin(), text.end(), '/', separator);
    return text;
}

} // namespace

TEST_CASE("a file beside the scene is found, with backslashes too", "[cli][named_files]")
{
    const Files files("scenes/");
    for (const Parameter& parameter : parameters) {
        for (const std::string& name : {parameter.file, ".\\" + in_lines(parameter.file, '\\')}) {
            CAPTURE(name);
            const RunResult result = files.check(parameter, name);
            CHECK_THAT(result.out, ContainsSubstring("memory: "));
            CHECK_THAT(result.err, !ContainsSubstring("warning") && !ContainsSubstring("error"));
        }
    }
}

TEST_CASE("a file in the working directory is found, and the notice says what to write", "[cli][named_files]")
{
    const Files files("");
    for (const Parameter& parameter : parameters) {
        for (const std::string& name : {parameter.file, in_lines(parameter.file, '\\')}) {
            CAPTURE(name);
            const RunResult result = files.check(parameter, name);
            CHECK(result.exit_code == 3);
            CHECK_THAT(result.err,
                       ContainsSubstring("warning: '" + parameter.file +
                                         "' is not beside 'scenes' but in the working directory, so another "
                                         "run may find another file or none; write '../" +
                                         parameter.file + "'\n"));
            // What it says to write is right.
            CHECK_THAT(files.check(parameter, "../" + parameter.file).err, !ContainsSubstring("warning"));
        }
    }
}

TEST_CASE("a file of that name in other letters, or elsewhere, is suggested", "[cli][named_files]")
{
    for (const Parameter& parameter : parameters) {
        const std::string file = parameter.file.substr(parameter.file.find('/') + 1);
        const bool is_include = parameter.name.empty();
        const std::string start = is_include
                                      ? "error: file '"
                                      : "error: " + parameter.name + " names a file that does not exist: '";
        const std::string end = is_include ? "' does not exist" : "'";
        const auto suggests = [&](const Files& files, const std::string& name,
                                  const std::string& suggestion) {
            CAPTURE(name);
            const RunResult result = files.check(parameter, name);
            CHECK(result.exit_code == 1);
            CHECK_THAT(result.err, ContainsSubstring(start + "scenes/") || ContainsSubstring(start + "/"));
            CHECK_THAT(result.err, ContainsSubstring(end + "; did you mean '" + suggestion + "'?\n"));
            CHECK_THAT(files.check(parameter, suggestion).out, ContainsSubstring("memory: "));
        };
        const Files beside("scenes/"), here("");
        suggests(beside, "data/" + file, "Data/" + file);
        suggests(beside, "DATA\\" + file, "Data/" + file);
        suggests(here, "data/" + file, "../Data/" + file);
    }
    const Files files("scenes/");
    CHECK_THAT(files.check(parameters[0], "none.obj").err,
               ContainsSubstring("error: filename names a file that does not exist: 'scenes/none.obj'\n"));
}

TEST_CASE("of a path on another computer the end counts, and relative ones may start above",
          "[cli][named_files]")
{
    for (const Parameter& parameter : parameters) {
        const std::string file = parameter.file.substr(parameter.file.find('/') + 1);
        const auto finds = [&](const Files& files, const std::string& name, const std::string& found) {
            CAPTURE(name);
            const RunResult result = files.check(parameter, name);
            CHECK_THAT(result.out, ContainsSubstring("memory: "));
            CHECK_THAT(result.err, ContainsSubstring("warning: '" + name + "' does not exist; '" + found +
                                                     "' is read instead"));
        };
        const Files beside("scenes/"), here("");
        for (const std::string& name :
             {"C:\\Users\\me\\" + parameter.file, "/nobody/course/" + parameter.file})
            finds(beside, name, parameter.file);
        const Files flat("scenes/");
        flat.write("scenes/" + file, read_bytes(flat / ("scenes/" + parameter.file)));
        finds(flat, "D:/nori/elsewhere/" + file, file);
        // As from a build directory beside.
        finds(here, "../../" + parameter.file, "../" + parameter.file);
    }
}

TEST_CASE("scenes of suites, and scenes on the command line, have the same way out", "[cli][named_files]")
{
    const Files files("");
    files.write("scenes/a.xml", scene("<mesh type='sphere'/>"));
    const auto batch = [&](const std::string& name) {
        files.write("suites/s.xml", "<suite size='8x6' spp='1'><render scene='" + name + "'/></suite>");
        return run_renderer({"batch", "suites/s.xml", "--out", "out", "--force"}, files.path());
    };
    CHECK(batch("..\\scenes\\a.xml").exit_code == 0);
    CHECK(batch("..\\scenes\\*.xml").exit_code == 0);
    CHECK(batch("scenes/a.xml").exit_code == 0); // from the working directory
    const RunResult absent = batch("../Scenes/a.xml");
    CHECK(absent.exit_code != 0);
    CHECK_THAT(absent.out + absent.err, ContainsSubstring("did you mean '../scenes/a.xml'?"));

    const RunResult slip = run_renderer({"check", "scenes/A.xml"}, files.path());
    CHECK(slip.exit_code == 1);
    CHECK(slip.err == "error: scene file 'scenes/A.xml' does not exist; did you mean 'scenes/a.xml'?\n");
}

TEST_CASE("an image whose mesh lay in the working directory is rendered again, or refused",
          "[cli][named_files]")
{
    const Files files("");
    files.write("scenes/a.xml",
                scene("<mesh type='obj'><string name='filename' value='Data/square.obj'/></mesh>"));
    REQUIRE(run_renderer({"scenes/a.xml", "-o", "a.exr"}, files.path()).exit_code == 0);
    REQUIRE(run_renderer({"rerun", "a.exr", "-o", "b.exr"}, files.path()).exit_code == 0);
    CHECK(read_bytes(files / "a.exr") == read_bytes(files / "b.exr"));
    // From another directory it is found above the scene, or there is another one.
    files.write("other/readme", "");
    const RunResult above =
        run_renderer({"rerun", "../a.exr", "-o", "c.exr", "--scene", "../scenes/a.xml"}, files / "other");
    CHECK(above.exit_code == 0);
    CHECK_THAT(above.err,
               ContainsSubstring("'Data/square.obj' does not exist; '../Data/square.obj' is read instead"));
    files.write("other/Data/square.obj", square + "v 0 0 0\n");
    const RunResult changed =
        run_renderer({"rerun", "../a.exr", "-o", "c.exr", "--scene", "../scenes/a.xml"}, files / "other");
    CHECK(changed.exit_code == 1);
    CHECK_THAT(changed.err, ContainsSubstring("the scene has changed"));
}
