// SPDX-License-Identifier: MIT
// What the command line changes of a scene.

#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/scene_text.h"

using namespace plumb;
using test::camera;
using test::errors;
using test::load_text;
using test::start;

TEST_CASE("what the command line changes", "[unit][loader]")
{
    const std::string xml =
        start + "<default name='r' value='2'/><sampler type='independent'><integer name='sampleCount' "
                "value='5'/></sampler><shape type='sphere'><float name='radius' value='$r'/></shape>"
                "</scene>";
    LoadOptions options;
    CHECK(load_text(xml).job.sampler->samples_per_pixel() == 5);
    options.samples_per_pixel = 9;
    options.resolution = Vec2i(30, 20);
    options.integrator = "path_mis";
    options.definitions["r"] = "3";
    options.dialect = DialectName::eth;
    options.emitters_absorb = true;
    LoadedScene loaded = load_text(xml, options);
    CHECK(loaded.job.sampler->samples_per_pixel() == 9);
    CHECK(loaded.job.camera->resolution() == Vec2i(30, 20));
    CHECK(loaded.integrator == "path_mis");
    CHECK(loaded.job.scene.objects()[0].shape->bounds().max.x == Approx(3.f));
    CHECK(loaded.dialect.name == DialectName::eth);
    CHECK(loaded.dialect.mirrored_view);
    CHECK(loaded.job.scene.emitters_absorb());

    options.samples_per_pixel.reset();
    options.sampler = "independent"; // takes as many samples as the file's
    loaded = load_text(xml, options);
    CHECK(loaded.job.sampler->samples_per_pixel() == 5);
}

TEST_CASE("a scene can be rendered with another integrator than the unsupported one it asks for",
          "[unit][loader]")
{
    const std::string xml =
        "<scene><integrator type='photonmapper'><integer name='photonCount' value='1'/></integrator>" +
        camera + "</scene>";
    LoadOptions options;
    options.integrator = "path_mis";
    CHECK(load_text(xml, options).integrator == "path_mis");
    CHECK(load_text("<scene>" + camera + "</scene>", options).integrator == "path_mis");
}

TEST_CASE("mistakes on the command line have no place in a file", "[unit][loader]")
{
    const std::string xml = start + "</scene>";
    LoadOptions options;
    options.integrator = "path_miss";
    options.sampler = "sobl";
    options.samples_per_pixel = 0;
    options.resolution = Vec2i(0, 70000);
    options.definitions["x"] = "1";
    const std::string text = errors(xml, options);
    CHECK_THAT(
        text,
        ContainsSubstring("error: --integrator path_miss: unknown integrator 'path_miss'; did you mean") &&
            ContainsSubstring("error: --sampler sobl: unknown sampler 'sobl'; did you mean 'sobol'?") &&
            ContainsSubstring("error: width must be in [1, 65535], not 0") &&
            ContainsSubstring("error: height must be in [1, 65535], not 70000") &&
            ContainsSubstring("error: -D x=1: no file of this scene uses $x"));
    CHECK_THAT(text, !ContainsSubstring("scene.xml"));
    options.sampler.reset();
    CHECK_THAT(errors(xml, options), ContainsSubstring("error: sampleCount must be in [1, 67108864], not 0"));
}
