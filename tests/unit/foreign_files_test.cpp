// SPDX-License-Identifier: MIT

// Files of other programs, given as scenes: one error that says what they are.

#include "support/catch.h"
#include "support/scene_text.h"

using namespace plumb;

namespace {

// The errors' first lines, without the directory.
std::string complaint(const std::string& text, const std::string& name = "a.xml")
{
    const TempDirectory directory;
    try {
        load_scene(directory.write(name, text));
    } catch (const SceneError& error) {
        std::string lines;
        for (const Diagnostic& diagnostic : error.diagnostics()) {
            const std::string whole = diagnostic.text();
            lines += whole.substr(0, whole.find('\n')) + "\n";
        }
        const std::string prefix = directory.path().string() + "/";
        for (std::size_t i = lines.find(prefix); i != lines.npos; i = lines.find(prefix))
            lines.erase(i, prefix.size());
        return lines;
    }
    return {};
}

} // namespace

TEST_CASE("a scene of Mitsuba without a version gets one error", "[unit][foreign_files]")
{
    const std::string inner = R"(<integrator type="path"/>
  <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="16"/></film></sensor>
  <shape type="obj"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
</scene>)";
    CHECK(complaint("<scene>" + inner) == "a.xml:2:3: error: this is a scene of Mitsuba, but its root has no "
                                          "version: <scene version=\"3.0.0\">\n");
    // One of ours with a slip is no scene of Mitsuba.
    CHECK_THAT(complaint("<scene dialect='plumb'>" + inner),
               ContainsSubstring("error: <sensor> is <camera> here\n"));
    CHECK_THAT(complaint("<scene><mesh type='sphere'><bsdf type='diffuse'><rgb name='albedo' "
                         "value='1'/></bsdf></mesh></scene>"),
               !ContainsSubstring("Mitsuba"));
}

TEST_CASE("a scene of Mitsuba that one of ours includes gets one error", "[unit][foreign_files]")
{
    const TempDirectory directory;
    directory.write("m.xml", "<scene version='2.1.0'><sensor type='perspective'/><rgb/></scene>");
    const auto main = directory.write("a.xml", test::start + "<include filename='m.xml'/></scene>");
    CHECK_THROWS_WITH(
        load_scene(main),
        ContainsSubstring(
            "m.xml:1:8: error: this is a scene of Mitsuba 2.1.0, which one of Plumb's own scenes "
            "cannot include\n") &&
            !ContainsSubstring("<rgb> is"));
}

TEST_CASE("files that are no scenes are named", "[unit][foreign_files]")
{
    CHECK(complaint(std::string("\x76\x2f\x31\x01\x02\0\0\0", 8)) ==
          "a.xml: error: this is an image (OpenEXR), not a scene; 'renderer info' prints what is in its "
          "header\n");
    CHECK(
        complaint("\x89PNG\r\n\x1a\n") ==
        "a.xml: error: this is an image (PNG), not a scene; 'renderer info' prints what is in its header\n");
    CHECK(complaint("# a cube\n\nv 1 2 3\n") ==
          "a.xml: error: this is an OBJ mesh; a scene refers to it: <mesh type=\"obj\"> with <string "
          "name=\"filename\" value=\"...\"/>\n");
    CHECK(complaint("ply\nformat ascii 1.0\n") ==
          "a.xml: error: this is a PLY mesh; a scene refers to it as an .obj file: <mesh type=\"obj\">\n");
    CHECK(complaint("# pbrt\nLookAt 3 4 1.5  .5 .5 0  0 0 1\n") ==
          "a.xml: error: this is a scene of pbrt; Plumb reads its own XML scenes only\n");
    CHECK(complaint("{\"asset\": {}}") ==
          "a.xml: error: this is JSON; Plumb reads its own XML scenes only\n");
    CHECK_THAT(complaint("hello"), ContainsSubstring("a.xml:1:1: error:"));
}
