// SPDX-License-Identifier: MIT

// renderer batch: verdicts, exit codes, what is rendered again, references and reports.

#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"

#include <pugixml.hpp>

using namespace plumb;

namespace {

// Renders of the small scene; "dark" is half as bright as its reference.
struct BatchDirectory : SceneDirectory {
    BatchDirectory()
    {
        // Without caustics, whose noise leaves a verdict on so few samples undecided.
        std::string scene = small_scene();
        scene.replace(scene.find("dielectric"), 10, "diffuse");
        write("scene.xml", scene);
        std::string dark = scene;
        dark.replace(dark.find("20,20,18"), 8, "10,10,9");
        write("dark.xml", dark);
    }
    RunResult batch(const std::string& entries, Names words = {}) const
    {
        write("suite.xml", "<suite size=\"16x12\">\n" + entries + "\n</suite>\n");
        words.insert(words.begin(), {"batch", "suite.xml"});
        return run(words);
    }
    std::string report(const char* name) const { return read_bytes(path() / "batch" / "suite" / name); }
};

const std::string same =
    "<render scene=\"scene.xml\" spp=\"64\" reference=\"ref/*.exr\" reference-seed=\"5\"/>";
const std::string dark = "<render scene=\"dark.xml\" spp=\"64\" reference=\"ref/scene.exr\"/>";
const std::string few = "<render scene=\"scene.xml\" name=\"few\" spp=\"1\" reference=\"ref/scene.exr\" "
                        "reference-spp=\"64\"/>";
const std::string missing = "<render scene=\"none.xml\" spp=\"4\"/>";

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t i = text.find(part); i != text.npos; i = text.find(part, i + 1)) ++count;
    return count;
}

} // namespace

TEST_CASE("batch makes references and compares with them", "[cli][batch]")
{
    const BatchDirectory directory;
    const RunResult before = directory.batch(same);
    CHECK(before.exit_code == 1);
    CHECK_THAT(before.out, ContainsSubstring("suite.xml:2:47: error: reference 'ref/scene.exr' does not "
                                             "exist; 'renderer batch suite.xml --update' makes it\n"));

    const RunResult update = directory.batch(same, {"--update"});
    INFO(update.out << update.err);
    CHECK(update.exit_code == 0);
    CHECK(update.out.starts_with("ref/scene.exr  made "));
    CHECK(update.out.ends_with("\n1 made; reports: batch/suite/references/report.html\n"));
    CHECK(read_image(directory / "ref/scene.exr", false).data_window() == PixelRect{0, 0, 16, 12});
    CHECK(std::filesystem::exists(directory / "ref/scene.png"));

    const RunResult after = directory.batch(same);
    CHECK(after.exit_code == 0);
    CHECK_THAT(after.out, ContainsSubstring("scene_64  passes     rmse "));
    CHECK(after.out.ends_with("\n1 passes; 1 up to date; reports: batch/suite/report.html\n"));

    // The reference is what the words of the report make.
    CHECK(directory
              .run({"scene.xml", "--seed", "5", "--size", "16x12", "--spp", "64", "--quiet", "-o",
                    "by_hand.exr"})
              .exit_code == 0);
    CHECK(directory.run({"compare", "by_hand.exr", "ref/scene.exr"})
              .out.find("every pixel is the same in both") != std::string::npos);
}

TEST_CASE("the exit code of batch is the worst of its verdicts", "[cli][batch]")
{
    const BatchDirectory directory;
    CHECK(directory.batch(same, {"--update"}).exit_code == 0);

    const RunResult undecided = directory.batch(same + few);
    CHECK(undecided.exit_code == 4);
    CHECK_THAT(undecided.out, ContainsSubstring("few_1     undecided  rmse "));
    const RunResult differs = directory.batch(same + few + dark);
    CHECK(differs.exit_code == 3);
    CHECK_THAT(differs.out, ContainsSubstring("dark_64   differs    rmse "));
    CHECK_THAT(differs.out, ContainsSubstring("\n"
                                              "    the difference exceeds the noise: p "));
    CHECK_THAT(differs.out, ContainsSubstring("1 passes, 1 differs, 1 undecided; 2 up to date"));
    const RunResult error = directory.batch(same + few + dark + missing);
    CHECK(error.exit_code == 1);
    CHECK_THAT(error.out, ContainsSubstring("error: scene file 'none.xml' does not exist\n"));
    CHECK_THAT(error.out, ContainsSubstring("1 passes, 1 differs, 1 undecided, 1 error; 3 up to date"));
    // A limit alone decides where that is asked for.
    const std::string limit =
        "<render scene=\"dark.xml\" spp=\"64\" reference=\"ref/scene.exr\" no-verdict=\"true\" max=\"";
    CHECK(directory.batch(limit + "rmse=100\"/>").exit_code == 0);
    const RunResult above = directory.batch(limit + "rmse=0.001\"/>");
    CHECK(above.exit_code == 3);
    CHECK_THAT(above.out, ContainsSubstring(" is above 0.001\n"));
}

TEST_CASE("a reference that cannot be compared is an error", "[cli][batch]")
{
    const BatchDirectory directory;
    CHECK(
        directory.run({"scene.xml", "--spp", "4", "--size", "16x9", "--quiet", "-o", "ref.exr"}).exit_code ==
        0);
    const std::string entry = "<render scene=\"scene.xml\" spp=\"4\" reference=\"ref.exr\"/>";
    const RunResult sizes = directory.batch(entry);
    CHECK(sizes.exit_code == 1);
    CHECK_THAT(sizes.out,
               ContainsSubstring("error: cannot compare A, 'batch/suite/scene_4.exr', with B, 'ref.exr': the "
                                 "images have different sizes: A is 16x12 pixels, B is 16x9 pixels\n"));
    const std::string bytes = read_bytes(directory / "ref.exr");
    directory.write("ref.exr", bytes.substr(0, bytes.size() / 2));
    const RunResult cut = directory.batch(entry);
    CHECK(cut.exit_code == 1);
    CHECK_THAT(cut.out, ContainsSubstring("error: cannot read 'ref.exr'"));
    // The report is written all the same.
    CHECK_THAT(directory.report("report.html"), ContainsSubstring("cannot read 'ref.exr'"));
}

TEST_CASE("batch renders again what has changed, and nothing else", "[cli][batch]")
{
    const BatchDirectory directory;
    const std::string entries =
        "<render scene=\"scene.xml\" spp=\"2\"/><render scene=\"dark.xml\" spp=\"2\"/>";
    // How many of the two were up to date.
    const auto up_to_date = [&](const Names& words = {}, const std::string& text = "") {
        return count_of(directory.batch(text.empty() ? entries : text, words).out, "  up to date\n");
    };
    CHECK(up_to_date() == 0);
    const std::string image = read_bytes(directory / "batch/suite/scene_2.exr");
    CHECK(up_to_date() == 2);
    CHECK(up_to_date({"--force"}) == 0);
    CHECK(read_bytes(directory / "batch/suite/scene_2.exr") == image);
    CHECK(up_to_date({"--threads", "1"}) == 2); // changes no bit

    SECTION("an image that was removed, cut or changed")
    {
        std::filesystem::remove(directory / "batch/suite/scene_2.png");
        CHECK(up_to_date() == 1);
        directory.write("batch/suite/scene_2.exr", image.substr(0, 100));
        CHECK(up_to_date() == 1);
        CHECK(read_bytes(directory / "batch/suite/scene_2.exr") == image);
        CHECK(up_to_date() == 2);
    }
    SECTION("a scene that was changed")
    {
        directory.write("dark.xml", read_bytes(directory.path() / "scene.xml"));
        CHECK(up_to_date() == 1);
        CHECK(up_to_date() == 2);
    }
    SECTION("options that were changed")
    {
        CHECK(up_to_date({}, "<render scene=\"scene.xml\" spp=\"2\" seed=\"1\"/>"
                             "<render scene=\"dark.xml\" spp=\"2\" exposure=\"1\"/>") == 0);
        CHECK(up_to_date() == 0);
    }
    SECTION("a state that cannot be read")
    {
        directory.write("batch/suite/state.txt", "nonsense\n");
        CHECK(up_to_date() == 0);
        CHECK(up_to_date() == 2);
    }
}

TEST_CASE("batch takes a part of a suite, and stops where it is told", "[cli][batch]")
{
    const BatchDirectory directory;
    const std::string entries =
        "<render scene=\"scene.xml\" spp=\"1,16\"/>" + missing + "<render scene=\"dark.xml\" spp=\"1\"/>";
    const RunResult part = directory.batch(entries, {"--filter", "scene"});
    CHECK(part.exit_code == 0);
    CHECK_THAT(part.out, ContainsSubstring("\n2 rendered; reports"));
    CHECK_THAT(directory.batch(entries, {"--filter", "*_1"}).out,
               ContainsSubstring("\n2 rendered; 1 up to date"));
    CHECK_THAT(directory.batch(entries, {"--filter", "s*_1"}).out,
               ContainsSubstring("\n1 rendered; 1 up to date"));
    const RunResult nothing = directory.batch(entries, {"--filter", "nothing"});
    CHECK(nothing.exit_code == 1);
    CHECK(nothing.err == "error: no image of 'suite.xml' matches 'nothing'; the first image is scene_1\n");

    const RunResult fast = directory.batch(entries, {"--fail-fast", "--out", "elsewhere"});
    CHECK(fast.exit_code == 1);
    CHECK_THAT(fast.out,
               ContainsSubstring("2 rendered, 1 error, 1 not run; reports: elsewhere/report.html\n"));
    CHECK_FALSE(std::filesystem::exists(directory / "elsewhere/dark_1.exr"));
    CHECK(std::filesystem::exists(directory / "elsewhere/scene_16.exr"));
    CHECK(directory.batch(entries, {"--quiet", "--filter", "scene"}).out.empty());
}

TEST_CASE("no batch replaces a scene or a reference", "[cli][batch]")
{
    const BatchDirectory directory;
    CHECK(directory.batch("<render scene=\"scene.xml\" spp=\"2\" reference=\"scene_2.exr\"/>", {"--update"})
              .exit_code == 0);
    const std::string reference = read_bytes(directory / "scene_2.exr");
    const RunResult here = directory.batch(
        "<render scene=\"scene.xml\" spp=\"2\" seed=\"3\" reference=\"scene_2.exr\"/>", {"--out", "."});
    CHECK(here.exit_code == 1);
    CHECK_THAT(here.out,
               ContainsSubstring(
                   "error: cannot write './scene_2.exr': it is a scene or a reference of the suite\n"));
    CHECK(read_bytes(directory / "scene_2.exr") == reference);

    const std::string scene = read_bytes(directory / "scene.xml");
    const RunResult update =
        directory.batch("<render scene=\"scene.xml\" spp=\"2\" reference=\"scene.xml\"/>", {"--update=all"});
    CHECK(update.exit_code == 1);
    CHECK_THAT(update.out,
               ContainsSubstring("error: cannot write 'scene.xml': it is a scene of the suite\n"));
    CHECK(read_bytes(directory / "scene.xml") == scene);
}

TEST_CASE("entries that share a reference say how it is made", "[cli][batch]")
{
    const BatchDirectory directory;
    const RunResult run =
        directory.batch("<render scene=\"scene.xml\" spp=\"1, 4\" reference=\"ref.exr\"/>", {"--update"});
    CHECK(run.exit_code == 1);
    CHECK(run.err.starts_with(
        "suite.xml:2:49: error: several entries share 'ref.exr'; say how the first of them, "
        "'scene_1', makes it: reference-spp=\"...\"\n"));
    const RunResult none = directory.batch("<render scene=\"scene.xml\" spp=\"1\"/>", {"--update"});
    CHECK(none.err == "error: no entry has a reference to make\n");
    const RunResult shared = directory.batch(
        "<render scene=\"scene.xml\" spp=\"2, 4\" reference=\"ref.exr\" reference-spp=\"8\"/>", {"--update"});
    CHECK(shared.exit_code == 0);
    CHECK(count_of(shared.out, "made") == 2); // the line and the sum
    CHECK_THAT(directory.run({"info", "ref.exr"}).out, ContainsSubstring("plumb:set.spp          8\n"));
}

TEST_CASE("a scene's own sample count names its image", "[cli][batch]")
{
    const BatchDirectory directory;
    const RunResult run =
        directory.batch("<render scene=\"scene.xml\"/><render scene=\"scene.xml\" spp=\"4\"/>");
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.out, ContainsSubstring(
                            "error: another entry also writes 'scene_4.exr'; give one of them another name"));
    CHECK(std::filesystem::exists(directory / "batch/suite/scene_4.exr"));
}

TEST_CASE("the reports of batch", "[cli][batch]")
{
    const BatchDirectory directory;
    directory.write("<&\"'>.xml", "<scene><camera type=\"</script>&amp;\"/></scene>");
    CHECK(directory.batch(same, {"--update"}).exit_code == 0);
    const std::string odd = "<render scene=\"&lt;&amp;&quot;'&gt;.xml\" spp=\"1\"/>";
    CHECK(directory.batch(same + dark + odd + missing + few, {"--fail-fast", "--filter", "*_*"}).exit_code ==
          3);
    CHECK(directory.batch(same + dark + odd).exit_code == 1);

    pugi::xml_document junit;
    REQUIRE(junit.load_string(directory.report("junit.xml").c_str()));
    const pugi::xml_node suite = junit.child("testsuites").child("testsuite");
    CHECK(std::string(suite.attribute("name").value()) == "suite");
    CHECK(suite.attribute("tests").as_int() == 3);
    CHECK(suite.attribute("failures").as_int() == 1);
    CHECK(suite.attribute("errors").as_int() == 1);
    std::vector<std::string> names;
    for (const pugi::xml_node& test : suite.children("testcase"))
        names.emplace_back(test.attribute("name").value());
    CHECK(names == Names{"scene_64", "dark_64", "<&\"'>_1"});
    const pugi::xml_node failure = suite.find_child_by_attribute("name", "dark_64").child("failure");
    CHECK(std::string(failure.attribute("type").value()) == "differs");
    CHECK_THAT(failure.text().get(), ContainsSubstring("renderer ./dark.xml --spp 64 --size 16x12\n"));
    const pugi::xml_node error = suite.find_child_by_attribute("name", "<&\"'>_1").child("error");
    CHECK_THAT(error.text().get(), ContainsSubstring("</script>"));

    const std::string json = directory.report("report.json");
    for (const char* part : {"\"exit_code\": 1,", "\"name\": \"dark_64\",\n      \"verdict\": \"differs\"",
                             "\"image\": \"batch/suite/scene_64.exr\"", "\"up_to_date\": true",
                             "\"rmse\": ", "\"finding\": \"different\""})
        CHECK_THAT(json, ContainsSubstring(part));
    const std::string markdown = directory.report("summary.md");
    CHECK_THAT(markdown, ContainsSubstring("1 passes, 1 differs, 1 error; 2 up to date in "));
    CHECK_THAT(markdown, ContainsSubstring("| dark\\_64 | **differs** | "));

    // One page, with all images in it and nothing to fetch.
    const std::string page = directory.report("report.html");
    CHECK(page.starts_with("<!DOCTYPE html>\n"));
    CHECK(page.ends_with("</html>\n"));
    CHECK(count_of(page, "{{") == 0);
    CHECK(count_of(page, "<script type=\"text/plain\" id=\"data-") == 8);
    CHECK(count_of(page, "</script>") == 10);
    CHECK(count_of(page, "://") == 0);
    CHECK(count_of(page, "src=\"") + count_of(page, "url(") + count_of(page, "@import") +
              count_of(page, "fetch(") ==
          0);
    CHECK_THAT(page, ContainsSubstring("\\u003c/script>"));
    CHECK_THAT(page, ContainsSubstring("\"reference\": \"data-1\""));
    CHECK(std::filesystem::exists(directory / "batch/suite/dark_64_diff.png"));
}

TEST_CASE("batch says what it cannot write", "[cli][batch]")
{
    const BatchDirectory directory;
    directory.write("file", "");
    const RunResult inside = directory.batch(same, {"--out", "file/deep"});
    CHECK(inside.exit_code == 1);
    CHECK(inside.err == "error: cannot create the directory 'file/deep': Not a directory\n");
    std::filesystem::create_directories(directory / "taken/report.html");
    const RunResult taken = directory.batch(same, {"--out", "taken"});
    CHECK(taken.exit_code == 1);
    CHECK(taken.err == "error: cannot write 'taken/report.html': Is a directory\n");
    CHECK(directory.run({"batch"}).err == "error: no suite given; 'renderer --help' shows how\n");
    CHECK(directory.run({"batch", "suite.xml", "--spp", "4"}).err ==
          "error: option '--spp' cannot be used with batch\n");
    CHECK_THAT(directory.run({"batch", "--help"}).out, ContainsSubstring("reference-spp"));
}
