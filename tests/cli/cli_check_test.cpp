// SPDX-License-Identifier: MIT

// renderer check.

#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

// The faces of the cube [-1, 1]^3 run counter-clockwise seen from outside, or from inside.
std::string cube(bool inside_out)
{
    std::string obj;
    for (const char* z : {"-1", "1"})
        for (const char* corner : {"-1 -1 ", "1 -1 ", "1 1 ", "-1 1 "})
            obj += std::string("v ") + corner + z + "\n";
    for (const char* face : {"1 4 3 2", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"}) {
        const std::string corners = face;
        const std::string reversed = {corners[6], ' ', corners[4], ' ', corners[2], ' ', corners[0]};
        obj += "f " + (inside_out ? reversed : corners) + "\n";
    }
    return obj;
}

// With a sun, a camera at (0, 0, -5) that looks along z, and `more`.
std::string scene(const std::string& more, const std::string& integrator = "path_mis")
{
    return R"(<scene dialect="plumb"><integrator type=")" + integrator + R"("/>
  <camera type="perspective"><integer name="width" value="40"/><integer name="height" value="30"/>
    <transform name="toWorld"><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform></camera>
)" + more + "\n</scene>\n";
}

const std::string sun =
    R"(<emitter type="directional"><vector name="direction" value="0,-1,1"/><color name="radiance" value="1,1,1"/></emitter>)";

// Seen through glass, too.
const std::string sky = R"(<emitter type="environment"><color name="radiance" value="1,1,1"/></emitter>)";

std::string mesh(const std::string& inner)
{
    return R"(<mesh type="obj"><string name="filename" value="mesh.obj"/>)" + inner + "</mesh>";
}

// Of scenes with one light.
const std::string black = "although there is a light, all 4096 paths through the image are black\n";

const std::string glass = R"(<bsdf type="dielectric"/>)";
const std::string lamp = R"(<emitter type="area"><color name="radiance" value="1,1,1"/></emitter>)";

// What check prints of the scene, without the line about memory.
std::string doubts(const std::string& more, const std::string& obj = cube(false),
                   const std::string& integrator = "path_mis")
{
    const TempDirectory directory;
    directory.write("a.xml", scene(more, integrator));
    directory.write("mesh.obj", obj);
    const RunResult run = run_renderer({"check", "a.xml"}, directory.path());
    INFO(run.err);
    const std::size_t memory = run.out.find("memory: ");
    REQUIRE(memory != std::string::npos);
    const std::string doubts = run.out.substr(0, memory);
    CHECK(run.exit_code == (doubts.empty() ? 0 : 3));
    CHECK((run.out.find("no mistakes found\n") != std::string::npos) == doubts.empty());
    return doubts;
}

} // namespace

TEST_CASE("a good scene leaves no doubt", "[cli][check]")
{
    CHECK(doubts(sky + mesh(glass)).empty());
    CHECK(doubts(mesh(lamp)).empty());
    CHECK(doubts(sky + R"(<shape type="sphere">)" + glass + "</shape>").empty());
    const SceneDirectory directory;
    CHECK(directory.run({"check", "scene.xml", "--quiet"}).exit_code == 0);
    CHECK(directory.files() == Names{"scene.xml"}); // nothing is rendered
}

TEST_CASE("glass that is open or turned inside out is doubtful", "[cli][check]")
{
    CHECK(doubts(sky + mesh(glass), cube(true)) ==
          "mesh 'obj' (a.xml:4): its front faces inwards, so inside and outside are swapped\n");
    const std::string open = cube(false).substr(0, cube(false).rfind("f "));
    CHECK(doubts(sky + mesh(glass), open) ==
          "mesh 'obj' (a.xml:4): light enters its material, but the surface is not closed\n");
    CHECK(doubts(sky + mesh(""), open).empty()); // what is opaque may be open

    // A lid of another material, but of glass, closes it; one that is elsewhere does not.
    const auto lid = [](const std::string& x, const std::string& bsdf) {
        return R"(<shape type="rectangle"><float name="width" value="2"/><float name="height" value="2"/>
        <point name="center" value=")" +
               x + R"(,0,0"/><vector name="normal" value="-1,0,0"/>)" + bsdf + "</shape>";
    };
    CHECK(doubts(sky + mesh(glass) + lid("-1", glass), open).empty());
    CHECK(doubts(sky + mesh(glass) + lid("-1.5", glass), open) ==
          "mesh 'obj' (a.xml:4): light enters its material, but the surface is not closed\n"
          "shape 'rectangle' (a.xml:4): light enters its material, but the surface is not closed\n");
    CHECK(doubts(sky + mesh(glass) + lid("-1", ""), open) ==
          "mesh 'obj' (a.xml:4): light enters its material, but the surface is not closed\n");
}

TEST_CASE("lamps that light nothing are doubtful", "[cli][check]")
{
    CHECK(doubts(mesh(lamp), cube(true)) ==
          "mesh 'obj' (a.xml:4): it is closed and shines inwards only\n" + black);
    CHECK_THAT(doubts(sun + R"(<shape type="rectangle"><vector name="normal" value="0,1,0"/>
        <point name="center" value="0,-0.0005,0"/>)" +
                      lamp + R"(</shape><shape type="rectangle">
        <float name="width" value="9"/><float name="height" value="9"/><vector name="normal" value="0,-1,0"/></shape>)"),
               ContainsSubstring(
                   "shape 'rectangle' (a.xml:4): it faces a wall: its light reaches no farther than "));
    CHECK(
        doubts(
            sun +
            R"(<shape type="sphere"><emitter type="area"><color name="radiance" value="0,0,0"/></emitter></shape>)") ==
        "shape 'sphere' (a.xml:4): its emitter is black\n");
    CHECK(doubts(mesh("")) == "there is no light: the image will be black\n");
    CHECK(doubts(mesh(""), cube(false), "normals").empty()); // which needs none
}

TEST_CASE("a camera inside a thing is doubtful, and so is a warning", "[cli][check]")
{
    CHECK(doubts(sun + R"(<shape type="sphere"><float name="radius" value="50"/></shape>)") ==
          "shape 'sphere' (a.xml:4): the camera is inside it\n" + black);

    const SceneDirectory directory;
    directory.write("a.xml", scene(sun + mesh("")));
    directory.write("mesh.obj", cube(false) + "f 1 2 2\n");
    const RunResult run = directory.run({"check", "a.xml"});
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, ContainsSubstring("warning: 1 triangle has no area and was discarded"));
}

TEST_CASE("check tells errors as rendering does", "[cli][check]")
{
    const SceneDirectory directory;
    directory.write("bad.xml", scene(R"(<shape type="spere"/>)"));
    const RunResult run = directory.run({"check", "bad.xml"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err,
               ContainsSubstring("bad.xml:4:14: error: unknown shape 'spere'; did you mean 'sphere'?"));
}

TEST_CASE("a sun that lights nothing is warned of, and a black image doubted", "[cli][check]")
{
    const std::string floor =
        R"(<shape type="rectangle"><vector name="normal" value="0,1,0"/><float name="width" value="9"/>
        <float name="height" value="9"/><point name="center" value="0,-1,0"/></shape>)";
    const auto sun_along = [](const std::string& direction) {
        return R"(<emitter type="directional"><vector name="direction" value=")" + direction +
               R"("/></emitter>)";
    };
    const TempDirectory directory;
    const auto check = [&](const std::string& body) {
        directory.write("a.xml", scene(body));
        return run_renderer({"check", "a.xml"}, directory.path());
    };
    CHECK(check(floor + sun_along("0,-1,0.2")).exit_code == 0);

    const RunResult idle = check(floor + sun_along("0,1,0"));
    CHECK(idle.exit_code == 3);
    CHECK_THAT(idle.err,
               ContainsSubstring("this light reaches the front of no surface, so it lights nothing: it goes "
                                 "along (0, 1, 0), for 'direction' is where it goes"));
    CHECK_THAT(idle.out,
               ContainsSubstring("although there is a light, all 4096 paths through the image are black"));
    const RunResult rendered = run_renderer({"a.xml", "-o", "a.exr", "--spp", "1"}, directory.path());
    CHECK(rendered.exit_code == 0);
    CHECK_THAT(rendered.err, ContainsSubstring("warning: this light reaches the front of no surface") &&
                                 ContainsSubstring("warning: the image is black, although there is a light; "
                                                   "'renderer check a.xml' may say why"));
    // For mcgill it comes from there.
    CHECK(run_renderer({"check", "a.xml", "--dialect", "mcgill"}, directory.path()).exit_code == 0);

    // A roof between the sun and everything else.
    const std::string roof =
        R"(<shape type="rectangle"><vector name="normal" value="0,-1,0"/><float name="width" value="90"/>
        <float name="height" value="90"/><point name="center" value="0,5,0"/></shape>)";
    CHECK_THAT(check(floor + roof + sun_along("0,-1,0")).err, ContainsSubstring("lights nothing"));
    // One of two suns, by its place.
    const RunResult two = check(floor + sun_along("0,-1,0.1") + "\n" + sun_along("0,1,0"));
    CHECK_THAT(two.err, ContainsSubstring("a.xml:6:1: warning: this light"));
    CHECK(two.err.find("a.xml:5:") == std::string::npos);
    // Integrators that look at no lamp.
    directory.write("a.xml", scene(sun_along("0,1,0"), "normals"));
    CHECK(run_renderer({"check", "a.xml"}, directory.path()).exit_code == 0);
    // Lamps behind the camera's back wall: nothing is lit.
    const RunResult away =
        check(R"(<emitter type="pointlight"><point name="position" value="0,0,-90"/></emitter>)" + floor);
    CHECK(away.exit_code == 0); // the floor sees it
    CHECK_THAT(
        check(R"(<emitter type="pointlight"><point name="position" value="0,-9,0"/></emitter>)" + floor).out,
        ContainsSubstring("although there is a light"));
}
