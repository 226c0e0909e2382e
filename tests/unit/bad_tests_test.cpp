// SPDX-License-Identifier: MIT
// Every file in tests/scenes/bad_tests, a test file of a course, beside the exact text of what is wrong with it.

#include "build_paths.h"
#include "plumb/test_file/test_file.h"
#include "support/bad_files.h"

using namespace plumb;

namespace {

const std::filesystem::path directory =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "bad_tests";

TestFile load_text(const std::string& text)
{
    const TempDirectory files;
    return load_test(files.write("test.xml", text));
}

const std::string scene_start = "<scene><integrator type='normals'/><camera type='perspective'/>";

} // namespace

TEST_CASE("bad tests", "[unit][test_file]")
{
    const std::filesystem::path path = GENERATE(from_range(xml_files(directory)));
    check_complaints(path, [](const std::filesystem::path& test) { load_test(test); });
}

TEST_CASE("there are bad tests", "[unit][test_file]")
{
    CHECK(xml_files(directory).size() >= 24);
}

TEST_CASE("a ttest has the courses' defaults", "[unit][test_file]")
{
    const TestFile file =
        load_text("<test type='ttest'><string name='angles' value='0, 30 60'/>"
                  "<string name='references' value='.5,\n\t+.5 5e-1'/><bsdf type='diffuse'/></test>");
    CHECK(file.type == TestType::ttest);
    CHECK(file.significance_level == Approx(0.01));
    CHECK(file.sample_count == 100'000);
    CHECK(file.angles == std::vector<double>{0, 30, 60});
    CHECK(file.references == std::vector<double>{0.5, 0.5, 0.5});
    CHECK(file.test_count() == 3);
    CHECK(file.bsdfs.front().name == "bsdf 'diffuse' (line 2)");
}

TEST_CASE("a chi2test has the courses' defaults", "[unit][test_file]")
{
    const TestFile file =
        load_text("<test type='chi2test'><bsdf type='diffuse'/><bsdf type='phong'/></test>");
    CHECK(file.type == TestType::chi2test);
    CHECK(file.significance_level == Approx(0.01));
    CHECK(file.resolution == 10);
    CHECK(file.min_expected == 5.0);
    CHECK(file.directions == 5);
    CHECK(file.sample_count == 1'000'000); // 5000 a cell
    CHECK(file.test_count() == 10);
}

TEST_CASE("angles without a bsdf are not read", "[unit][test_file]")
{
    const TestFile file = load_text("<test type='ttest' dialect='epfl'><string name='angles' value='0'/>"
                                    "<string name='references' value='0'/>" +
                                    scene_start + "</scene></test>");
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings.front().message == "angles are for tests of bsdfs; these are not read");
    CHECK(file.scenes.front().name == "scene (line 1), normals");
}

TEST_CASE("the scenes of a ttest are read in one dialect", "[unit][test_file][dialect]")
{
    const auto dialect = [](const std::string& attribute, const std::string& integrator) {
        return load_text("<test type='ttest'" + attribute +
                         "><string name='references' value='0'/><scene><integrator type='" + integrator +
                         "'/><camera type='perspective'/></scene></test>")
            .scenes.front()
            .dialect;
    };
    CHECK(dialect("", "direct_mis").name == DialectName::epfl); // a scene alone would be plumb's
    CHECK_FALSE(dialect("", "direct_mis").emitters_absorb);
    CHECK(dialect(" dialect='mcgill'", "path_ems").name == DialectName::mcgill);

    // The evidence of one scene holds for all; a scene that says otherwise is on its own.
    const TestFile file = load_text(
        "<test type='ttest'><string name='references' value='0 0 0'/>"
        "<scene><integrator type='path_mis'/><camera type='perspective'/></scene>"
        "<scene><integrator type='path_mis'/><camera type='perspective'/><emitter type='point'>"
        "<color name='power' value='1 1 1'/></emitter></scene>"
        "<scene dialect='zaragoza'><integrator type='path_mis'/><camera type='perspective'/></scene></test>");
    REQUIRE(file.scenes.size() == 3);
    CHECK(file.scenes[0].dialect.name == DialectName::eth);
    CHECK(file.scenes[1].dialect.name == DialectName::eth);
    CHECK(file.scenes[2].dialect.name == DialectName::zaragoza);
    CHECK(file.warnings.empty());
}

TEST_CASE("a ttest of emitters", "[unit][test_file]")
{
    const std::string point = "<emitter type='point'><color name='power' value='1 1 1'/></emitter>";
    const TestFile file = load_text("<test type='ttest'><string name='distances' value='0.5,2'/>"
                                    "<string name='references' value='1 2, 3 4'/>" +
                                    point + "<emitter type='environment'/></test>");
    REQUIRE(file.emitters.size() == 2);
    CHECK(file.emitters[0].name == "emitter 'point' (line 1)");
    CHECK(file.distances == std::vector{0.5, 2.0});
    CHECK(file.test_count() == 4);
    CHECK(file.warnings.empty());
    const auto complaint = [](const std::string& text) {
        try {
            load_text(text);
            return std::string();
        } catch (const SceneError& error) {
            return error.diagnostics().front().message;
        }
    };
    const std::string references = "<string name='references' value='1'/>";
    CHECK(complaint("<test type='ttest'>" + references + point + "</test>") ==
          "test 'ttest' needs a parameter 'distances': <string name=\"distances\" value=\"...\"/>");
    CHECK(complaint("<test type='ttest'><string name='distances' value='1 2'/>" + references + point +
                    "</test>") == "references must hold one number for each distance, 2 in all, not 1");
    CHECK(complaint("<test type='ttest'><string name='distances' value='1'/>" + references +
                    "<emitter type='area'/></test>") ==
          "a test has no shape for an 'area' emitter; test a <scene> with it");
    CHECK(complaint("<test type='chi2test'>" + point + "</test>") ==
          "a chi2test cannot contain a <emitter>; it tests bsdfs");
}

TEST_CASE("the scenes of a ttest include files and name values", "[unit][test_file]")
{
    const TempDirectory files;
    files.write("part.xml",
                "<scene><default name='kind' value='normals'/><camera type='perspective'/></scene>");
    const std::string text = "<test type='ttest'><string name='references' value='0 $zero'/>"
                             "<scene><include filename='part.xml'/><integrator type='$kind'/></scene>" +
                             scene_start + "<default name='zero' value='0'/></scene></test>";
    const TestFile file = load_test(files.write("test.xml", text));
    CHECK(file.references == std::vector<double>{0, 0});
    REQUIRE(file.scenes.size() == 2);
    CHECK(file.scenes.front().name == "scene (line 1), normals");
}
