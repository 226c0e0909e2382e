// SPDX-License-Identifier: MIT
#include "base/memory.h"
#include "plumb/model/shape.h"
#include "plumb/model/surface.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/scene_text.h"
#include "support/temp_directory.h"

#include <algorithm>
#include <fmt/format.h>

using namespace plumb;
using test::camera;
using test::errors;
using test::load_text;
using test::start;

namespace {

std::string messages(const std::vector<Diagnostic>& diagnostics)
{
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += diagnostic.text() + "\n";
    return text;
}

Color albedo(const SceneObject& object)
{
    SurfacePoint at;
    const Vec3f up(0.f, 0.f, 1.f);
    return object.bsdf->evaluate(at, up, up).f_cos * pi;
}

} // namespace

TEST_CASE("the smallest scene, and its defaults", "[unit][loader]")
{
    const LoadedScene loaded = load_text("<scene><integrator type='normals'/><camera type='perspective'/>"
                                         "<mesh type='sphere'/></scene>");
    CHECK(loaded.job.camera->resolution() == Vec2i(1280, 720));
    CHECK(loaded.job.sampler->samples_per_pixel() == 1);
    CHECK(loaded.sampler == "independent");
    CHECK(loaded.integrator == "normals");
    CHECK(loaded.job.filter->radius() == 2.f);
    REQUIRE(loaded.job.scene->objects().size() == 1);
    CHECK(albedo(loaded.job.scene->objects()[0]).g == Approx(0.5f));
    CHECK(loaded.job.scene->objects()[0].name == "mesh 'sphere' (scene.xml:1)");
    CHECK(loaded.job.scene->emitters().empty());
    CHECK(loaded.parse_seconds > 0.0);
    CHECK(loaded.build_seconds > 0.0);
}

TEST_CASE("the order of children does not matter", "[unit][loader]")
{
    const LoadedScene loaded =
        load_text("<scene dialect='plumb'><shape type='sphere'><emitter type='area'><color name='radiance' "
                  "value='1 2 3'/></emitter>"
                  "<bsdf type='diffuse'><color name='albedo' value='.1 .2 .3'/></bsdf><float name='radius' "
                  "value='2'/></shape>"
                  "<emitter type='point'><color name='radiance' value='1 1 1'/></emitter>"
                  "<sampler type='independent'><integer name='sampleCount' value='+7'/></sampler>"
                  "<camera type='perspective'><rfilter type='box'/><integer name='width' value='3'/></camera>"
                  "<integrator type='path_mis'/></scene>");
    const SceneObject& object = loaded.job.scene->objects().at(0);
    CHECK(object.shape->bounds().max.x == Approx(2.f));
    CHECK(albedo(object).b == Approx(0.3f));
    CHECK(object.emitter != nullptr);
    CHECK(loaded.job.scene->emitters().size() == 2);
    CHECK(loaded.job.sampler->samples_per_pixel() == 7);
    CHECK(loaded.job.filter->radius() == Approx(0.5f));
    CHECK(loaded.job.camera->resolution() == Vec2i(3, 720));
    CHECK(loaded.integrator == "path_mis");
    CHECK(loaded.warnings.empty());
}

TEST_CASE("every form that the courses write is understood", "[unit][loader]")
{
    const std::string body = GENERATE(
        // EPFL
        "<integrator type='simple'><point name='position' value='0,1,0'/><color name='energy' value='1 1 "
        "1'/></integrator>",
        "<integrator type='whitted'/><mesh type='sphere'><bsdf type='microfacet'><float name='alpha' "
        "value='.2'/>"
        "<color name='kd' value='0.1 0.2 0.3'/></bsdf></mesh>",
        // ETH
        "<integrator type='direct'/><emitter type='point' name='p'><point name='position' value='0 0 2'/>"
        "<color name='power' value='1 1 1'/></emitter><mesh type='sphere'><bsdf type='diffuse'>"
        "<texture type='checkerboard_color' name='albedo'><vector name='scale' value='0.1,0.2'/>"
        "<point name='delta' value='0 0'/><color name='value1' value='.1 .1 .1'/><color name='value2' "
        "value='.2 .2 .2'/>"
        "</texture></bsdf></mesh>",
        "<integrator type='av'><float name='length' value='10'/></integrator>",
        // Zaragoza
        "<integrator type='path_nee'/><emitter type='environment'><color name='radiance' value='1 1 "
        "1'/></emitter>",
        "<integrator type='direct_whitted'/><emitter type='pointlight'><point name='position' value='0 5 0'/>"
        "<color name='radiance' value='1 1 1'/></emitter><mesh type='sphere'><bsdf type='roughsubstrate'>"
        "<texture type='checker' name='kd'><integer name='scalex' value='4'/></texture></bsdf></mesh>",
        "<integrator type='path'/><mesh type='sphere'><bsdf type='roughconductor'><color name='R0' value='1 "
        ".5 .5'/>"
        "</bsdf><emitter type='area'><color name='radiance' value='1 1 1'/><float name='scale' "
        "value='2'/></emitter></mesh>",
        // McGill
        "<integrator type='path'><boolean name='isExplicit' value='TRUE'/><string name='termination' "
        "value='russian-roulette'/><float name='termination-param' value='0.2'/><string "
        "name='direct-measure' "
        "value='solid-angle'/><string name='indirect-measure' value='hemisphere'/><string name='direct-warp' "
        "value='none'/>"
        "<string name='indirect-warp' value='cosine-hemisphere'/></integrator><shape type='sphere'>"
        "<string name='name' value='light'/><emitter type='area'><color name='radiance' value='1 1 "
        "1'/></emitter></shape>",
        "<integrator type='ao'><integer name='nSamples' value='2'/><string name='sampling' "
        "value='cosine'/></integrator>",
        "<integrator type='direct'><integer name='nSamples' value='1'/><string name='measure' value='area'/>"
        "<string name='warp' value='cosine'/></integrator><shape type='rectangle'><emitter type='area'>"
        "<color name='radiance' value='1 1 1'/></emitter></shape><emitter type='directional'>"
        "<vector name='direction' value='0 1 0'/><color name='radiance' value='1 1 1'/></emitter>",
        // Cameras with a lens
        "<integrator type='depth'/>");
    const std::string lens = GENERATE("<camera type='perspective'/>",
                                      "<camera type='thinlens'><float name='lensRadius' value='.1'/>"
                                      "<float name='focalLength' value='3'/></camera>");
    const LoadedScene loaded =
        load_text("<?xml version='1.0'?>\r\n<!-- c -->\r\n<scene>" + body + lens + "</scene>\r\n");
    for (const Diagnostic& warning : loaded.warnings)
        CHECK_THAT(warning.text(), !ContainsSubstring("unknown"));
}

TEST_CASE("unknown parameters are warnings if asked for", "[unit][loader]")
{
    const std::string xml =
        start + "<integer name='spp' value='1'/><shape type='sphere'><float name='raduis' value='2'/>"
                "</shape></scene>";
    CHECK_THAT(errors(xml), ContainsSubstring("error: unknown parameter 'raduis'"));
    RenderSettings options;
    options.scene.lenient = true;
    const LoadedScene loaded = load_text(xml, options);
    CHECK_THAT(messages(loaded.warnings), ContainsSubstring("warning: unknown parameter 'raduis'") &&
                                              ContainsSubstring("warning: unknown parameter 'spp'"));
    // Other errors stay errors.
    CHECK_THAT(
        errors(start + "<shape type='sphere'><float name='radius' value='x'/></shape></scene>", options),
        ContainsSubstring("error: 'x' is not a number"));
}

TEST_CASE("what nobody reads is ignored; with a warning if the image could be meant to differ",
          "[unit][loader]")
{
    const LoadedScene silent = load_text(
        start +
        "<string name='accelerator' value='bvh'/><shape type='sphere' name='a' id='b'><string name='name' "
        "value='ball'/><bsdf type='mirror' name='c'/></shape></scene>");
    CHECK(silent.warnings.empty());
    const LoadedScene phong = load_text(
        start +
        "<shape type='sphere'><bsdf type='phong'><float name='shininess' value='20'/>"
        "<float name='diffuseCoef' value='0.5'/><integer name='exponent' value='3'/></bsdf></shape></scene>");
    CHECK(phong.warnings.size() == 2);
    CHECK_THAT(
        messages(phong.warnings),
        ContainsSubstring("'shininess' is read neither here nor in the course's own code: exponent is 3") &&
            ContainsSubstring("diffuse-coefficients is 0 0 0"));
    const LoadedScene map =
        load_text(start + "<emitter type='environment'><float name='rotate' value='90'/></emitter></scene>");
    CHECK(map.warnings.size() == 1);
    CHECK_THAT(messages(map.warnings), ContainsSubstring("'rotate'"));
}

TEST_CASE("paths are relative to the file that they stand in", "[unit][loader]")
{
    const TempDirectory directory;
    directory.write("meshes/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    directory.write(
        "parts/mesh.xml",
        "<scene><mesh type='obj'><string name='filename' value='../meshes/t.obj'/></mesh></scene>");
    const auto path = directory.write("main.xml", start + "<include filename='parts/mesh.xml'/></scene>");
    const LoadedScene loaded = load_scene(path);
    CHECK(loaded.job.scene->triangle_count() == 1);
    CHECK(loaded.job.scene->objects()[0].name == "mesh 'obj' (mesh.xml:1)");
}

TEST_CASE("the hash of a scene is that of everything it reads", "[unit][loader]")
{
    const auto hash = [](const std::string& mesh, const std::string& part,
                         const RenderSettings& options = {}) {
        const TempDirectory directory; // each time another one
        directory.write("t.obj", mesh);
        directory.write("part.xml", part);
        const auto path = directory.write(
            "main.xml", start + "<default name='x' value='1'/><include filename='part.xml'/>"
                                "<mesh type='obj'><string name='filename' value='t.obj'/></mesh>"
                                "</scene>");
        return load_scene(path, options).input_hash;
    };
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string first = hash(mesh, "<scene/>");
    CHECK(first.size() == 64);
    CHECK(first == hash(mesh, "<scene/>"));
    CHECK(first != hash(mesh + "\n", "<scene/>"));
    CHECK(first != hash(mesh, "<scene />"));
    RenderSettings options;
    options.samples.per_pixel = 3; // more of the same
    options.method.instruction_set = "sse2";
    CHECK(first == hash(mesh, "<scene/>", options));
    options.scene.definitions["x"] = "2";
    CHECK(first != hash(mesh, "<scene/>", options));
    options.scene.definitions.clear();
    options.method.integrator = "path_mis";
    CHECK(first != hash(mesh, "<scene/>", options));
    options.method.integrator.reset();
    options.scene.mirrored_view = true;
    CHECK(first != hash(mesh, "<scene/>", options));
}

TEST_CASE("all errors of all files come at once, in order", "[unit][loader]")
{
    const TempDirectory directory;
    directory.write("part.xml",
                    "<scene>\n<shape type='sphere'><float name='radius' value='x'/></shape></scene>");
    directory.write("bad.obj", "v 0 0 0\nf 1 1 9\n");
    const auto path =
        directory.write("main.xml", "<scene>\n<shape type='ball'/>\n<include filename='part.xml'/>\n"
                                    "<mesh type='obj'><string name='filename' value='bad.obj'/></mesh>\n"
                                    "<integrator type='nothing'/>\n</scene>\n");
    try {
        load_scene(path);
        FAIL("no error");
    } catch (const SceneError& error) {
        std::string places;
        for (const Diagnostic& found : error.diagnostics())
            places += std::filesystem::path(found.location.file).filename().string() + ":" +
                      std::to_string(found.location.line) + " ";
        CHECK(places == "main.xml:1 main.xml:2 bad.obj:2 main.xml:4 main.xml:5 part.xml:2 ");
    }
}

TEST_CASE("a file that is missing or broken hides no other mistake", "[unit][loader]")
{
    const TempDirectory directory;
    directory.write("bad.obj", "f 1 2 3\n");
    directory.write("bad.png", "no image");
    const std::string name = GENERATE(as<std::string>{}, "none", "bad");
    const auto path = directory.write(
        "main.xml",
        "<scene dialect='plumb'>\n<integrator type='normals'/><camera type='perspective'/>\n<mesh "
        "type='obj'>\n"
        "<string name='filename' value='" +
            name +
            ".obj'/>\n"
            "<transform name='toWrld'/>\n"
            "<emitter type='area'>\n<color name='radiance' value='-1 1 1'/>\n<float name='scl' "
            "value='1'/></emitter>\n"
            "<bsdf type='diffuse'>\n<texture type='imagetexture_color3f' name='albdo'>\n"
            "<string name='filepath' value='" +
            name +
            ".png'/>\n"
            "<boolean name='rw' value='true'/>\n<boolean name='raw' "
            "value='perhaps'/></texture></bsdf></mesh>\n"
            "<emitter type='environment'>\n<string name='filename' value='" +
            name +
            ".png'/>\n"
            "<color name='radiance' value='-1 1 1'/>\n<float name='rot' value='1'/></emitter>\n"
            "<shape type='sphere'><bsdf type='diffuse'>\n<texture type='textmap' name='albdo'>\n"
            "<string name='filename' value='" +
            name +
            ".png'/>\n<color name='color' value='1 -1 1'/>\n"
            "<float name='sclx' value='1'/>\n</texture></bsdf></shape>\n</scene>\n");
    try {
        load_scene(path);
        FAIL("no error");
    } catch (const SceneError& error) {
        std::vector<int> lines;
        for (const Diagnostic& found : error.diagnostics())
            if (found.severity == Severity::error && found.location.file == path.string())
                lines.push_back(found.location.line);
        if (name == "bad") lines.insert(lines.begin(), 4); // the error is in bad.obj
        CHECK(lines == std::vector<int>{4, 5, 7, 8, 10, 11, 12, 13, 15, 16, 17, 19, 20, 21, 22});
    }
}

TEST_CASE("many thousand mistakes take little time, memory and output", "[unit][loader]")
{
    std::string inside;
    std::string shapes;
    for (int i = 0; i < 40'000; ++i) inside += "<bogus/>";
    for (int i = 0; i < 3000; ++i)
        shapes += "<shape type='sphere'><bogus/><bogus/><float name='radius' value='-1'/></shape>\n";
    const TempDirectory directory;
    const auto path = directory.write(
        "main.xml", "<scene dialect='plumb'><integrator type='normals'/><camera type='perspective'/>\n" +
                        inside + shapes + "</scene>");
    try {
        load_scene(path);
        FAIL("no error");
    } catch (const SceneError& error) {
        CHECK(error.diagnostics().size() == 40);
        const std::string text = error.what();
        CHECK(text.size() < 40'000);
        CHECK_THAT(
            text, ContainsSubstring("unknown tag <bogus>") && ContainsSubstring("; and 45980 more like it") &&
                      ContainsSubstring("radius must be greater than 0, not -1; and 2980 more like it"));
    }
}

TEST_CASE("an image must fit into memory", "[unit][loader]")
{
    const std::string xml =
        "<scene dialect='plumb'><integrator type='normals'/><camera type='perspective'>"
        "<integer name='width' value='65535'/><integer name='height' value='65535'/></camera></scene>";
    const auto available = available_memory();
    REQUIRE(available);
    if (*available > 370'000'000'000) return; // it does
    CHECK_THAT(errors(xml),
               ContainsSubstring("scene.xml:1:108: error: an image of 65535 x 65535 pixels needs") &&
                   ContainsSubstring("lower width and height"));
    RenderSettings options;
    options.view.crop = PixelRect{0, 0, 10, 10};
    CHECK(load_text(xml, options).job.camera->resolution() == Vec2i(65535, 65535));
    options = {};
    options.view.size = Vec2i(4, 4);
    CHECK(load_text(xml, options).job.camera->resolution() == Vec2i(4, 4));

    // Layers count: what fits without them may not fit with them, whether options or the scene ask for them.
    const double rows = 0.6 * static_cast<double>(*available) / (65535.0 * 136.0);
    options = {};
    options.view.crop = PixelRect{0, 0, 65535, std::clamp(static_cast<int>(rows), 1, 65535)};
    CHECK(load_text(xml, options).job.camera->resolution() == Vec2i(65535, 65535));
    options.view.aovs = {"albedo", "normal", "position"};
    CHECK_THROWS_WITH(load_text(xml, options), ContainsSubstring("GB of memory, but only"));
    options.view.aovs.clear();
    const std::string asking =
        "<scene dialect='plumb'><string name='aovs' value='albedo, normal, position'/>" +
        xml.substr(std::string("<scene dialect='plumb'>").size());
    CHECK_THROWS_WITH(load_text(asking, options), ContainsSubstring("GB of memory, but only"));
}

TEST_CASE("scene files that cannot be read", "[unit][loader]")
{
    const TempDirectory directory;
    CHECK_THROWS_WITH(load_scene(directory / "none.xml"), ContainsSubstring("none.xml' does not exist"));
    CHECK_THROWS_AS(load_scene(directory / "none.xml"), Error);
    CHECK_THROWS_WITH(load_scene(directory.path()), ContainsSubstring("is a directory"));
}

TEST_CASE("an integrator that cannot render the scene is an error at its place", "[unit][loader]")
{
    const std::string text =
        errors("<scene>\n<integrator type='path'><boolean name='isExplicit' value='true'/>"
               "<string name='termination' value='max-depth'/>"
               "<string name='direct-measure' value='solid-angle'/></integrator>" +
               camera +
               "<shape type='rectangle'><transform name='toWorld'><matrix value='1 1 0 0  0 1 0 0  0 0 1 0  "
               "0 0 0 1'/>"
               "</transform><emitter type='area'><color name='radiance' value='1 1 1'/>"
               "</emitter></shape></scene>");
    CHECK_THAT(text, ContainsSubstring("scene.xml:2:1: error: ") && ContainsSubstring("solid"));
}

TEST_CASE("meshes that are read at the same time give their errors and files in the order of the scene",
          "[unit][loader]")
{
    const auto scene_with = [](const std::vector<int>& broken) {
        const TempDirectory directory;
        std::string scene = "<scene><integrator type='normals'/><camera type='perspective'/>\n";
        for (int i = 0; i < 12; ++i) {
            const bool is_broken = std::find(broken.begin(), broken.end(), i) != broken.end();
            // The earlier ones are the longer ones, which take longer.
            const std::string comments(static_cast<std::size_t>(12 - i) * 20000, '#');
            directory.write(fmt::format("{}.obj", i), "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + comments + "\n" +
                                                          (is_broken ? "f 1 2\n" : "f 1 2 3\n"));
            scene += fmt::format("<mesh type='obj'><string name='filename' value='{}.obj'/></mesh>\n", i);
        }
        return load_scene(directory.write("scene.xml", scene + "</scene>"));
    };
    const LoadedScene loaded = scene_with({});
    REQUIRE(loaded.inputs.size() == 13);
    REQUIRE(loaded.job.scene->objects().size() == 12);
    for (int i = 0; i < 12; ++i) {
        CHECK(loaded.inputs[static_cast<std::size_t>(i) + 1].path.filename() == fmt::format("{}.obj", i));
        CHECK(loaded.job.scene->objects()[static_cast<std::size_t>(i)].name ==
              fmt::format("mesh 'obj' (scene.xml:{})", i + 2));
    }
    std::string order;
    try {
        scene_with({2, 9, 5});
    } catch (const SceneError& error) {
        for (const Diagnostic& diagnostic : error.diagnostics())
            if (diagnostic.severity == Severity::error)
                order += std::filesystem::path(diagnostic.location.file).filename().string() + " ";
    }
    CHECK(order == "2.obj 5.obj 9.obj ");
}
