// SPDX-License-Identifier: MIT
// What the command line changes of a scene.

#include "plumb/model/shape.h"
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
    RenderSettings options;
    CHECK(load_text(xml).job.sampler->samples_per_pixel() == 5);
    options.view.size = Vec2i(30, 20);
    options.method.integrator = "path_mis";
    options.scene.definitions["r"] = "3";
    options.scene.dialect = DialectName::eth;
    options.scene.emitters_absorb = true;
    LoadedScene loaded = load_text(xml, options);
    CHECK(loaded.job.sampler->samples_per_pixel() == 5);
    CHECK(loaded.job.camera->resolution() == Vec2i(30, 20));
    CHECK(loaded.integrator == "path_mis");
    CHECK(loaded.job.scene->objects()[0].shape->bounds().max.x == Approx(3.f));
    CHECK(loaded.dialect.name == DialectName::eth);
    CHECK(loaded.dialect.mirrored_view);
    CHECK(loaded.job.scene->emitters_absorb());

    options.method.sampler = "independent"; // takes as many samples as the file's
    loaded = load_text(xml, options);
    CHECK(loaded.job.sampler->samples_per_pixel() == 5);
}

TEST_CASE("a scene can be rendered with another integrator than the unsupported one it asks for",
          "[unit][loader]")
{
    const std::string xml =
        "<scene><integrator type='photonmapper'><integer name='photonCount' value='1'/></integrator>" +
        camera + "</scene>";
    RenderSettings options;
    options.method.integrator = "path_mis";
    CHECK(load_text(xml, options).integrator == "path_mis");
    CHECK(load_text("<scene>" + camera + "</scene>", options).integrator == "path_mis");
}

TEST_CASE("mistakes on the command line have no place in a file", "[unit][loader]")
{
    const std::string xml = start + "</scene>";
    RenderSettings options;
    options.method.integrator = "path_miss";
    options.method.sampler = "sobl";
    options.view.size = Vec2i(0, 70000);
    options.scene.definitions["x"] = "1";
    const std::string text = errors(xml, options);
    CHECK_THAT(
        text,
        ContainsSubstring("error: --integrator path_miss: unknown integrator 'path_miss'; did you mean") &&
            ContainsSubstring("error: --sampler sobl: unknown sampler 'sobl'; did you mean 'sobol'?") &&
            ContainsSubstring("error: width must be in [1, 65535], not 0") &&
            ContainsSubstring("error: height must be in [1, 65535], not 70000") &&
            ContainsSubstring("error: -D x=1: no file of this scene uses $x"));
    CHECK_THAT(text, !ContainsSubstring("scene.xml"));
}

TEST_CASE("one scene file makes several methods and views, as separate loads would", "[unit][loader]")
{
    const TempDirectory directory;
    const auto path = directory.write(
        "scene.xml", start +
                         "<shape type='sphere'/><emitter type='point'><vector name='position' value='0 2 3'/>"
                         "</emitter></scene>");
    SceneFile file(path);
    std::shared_ptr<const Scene> shared;
    for (const char* integrator : {"path_mis", "path", "path_nee"}) {
        for (const Vec2i& size : {Vec2i(6, 4), Vec2i(5, 7)}) {
            RenderSettings settings;
            settings.method.integrator = integrator;
            settings.method.sampler = "sobol";
            settings.view.size = size;
            const LoadedScene of_many = file.load(settings.method, settings.view);
            const LoadedScene alone = load_scene(path, settings);
            CHECK(of_many.integrator == integrator);
            CHECK(of_many.input_hash == alone.input_hash);
            CHECK(of_many.warnings.size() == alone.warnings.size());
            CHECK((!shared || shared == of_many.job.scene));
            shared = of_many.job.scene;
            RenderOptions how;
            how.samples_per_pixel = 4;
            const Image a = render(of_many.job, how).film.develop();
            const Image b = render(alone.job, how).film.develop();
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) CHECK(a.color(x, y) == b.color(x, y));
        }
    }
    // A mistake in a method is none of the next one.
    CHECK_THROWS_AS(file.load({.integrator = "path_miss"}), SceneError);
    CHECK(file.load({.integrator = "path_mis"}).job.scene == shared);
}
