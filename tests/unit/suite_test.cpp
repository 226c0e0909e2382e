// SPDX-License-Identifier: MIT

// Suites: what their entries are, and the exact text of what is wrong with them.

#include "plumb/reports/suite_report.h"
#include "plumb/suite_file/suite.h"
#include "reports/image_data.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <limits>
#include <variant>

using namespace plumb;

namespace {

using Texts = std::vector<std::string>;

struct SuiteDirectory : TempDirectory {
    std::vector<SuiteJob> plan(const std::string& xml,
                               const std::map<std::string, std::string>& definitions = {}) const
    {
        return plan_suite(write("suite.xml", xml).string(), definitions);
    }

    // "name: command", one for each entry, without this directory.
    Texts commands(const std::string& xml, const std::map<std::string, std::string>& definitions = {}) const
    {
        Texts texts;
        for (const SuiteJob& job : plan(xml, definitions))
            texts.push_back(inside(job.entry.title() + ": " + command_text(job.entry.scene, job.image)));
        return texts;
    }

    // What is wrong with a suite; only the first lines of messages.
    std::string complaint(const std::string& xml,
                          const std::map<std::string, std::string>& definitions = {}) const
    {
        try {
            plan(xml, definitions);
        } catch (const SceneError& error) {
            std::string text;
            for (const Diagnostic& diagnostic : error.diagnostics()) {
                const std::string whole = diagnostic.text();
                text += (text.empty() ? "" : "\n") + whole.substr(0, whole.find('\n'));
            }
            return inside(text);
        }
        return "nothing";
    }

    std::string inside(std::string text) const
    {
        const std::string prefix = path().string() + "/";
        for (std::size_t i = text.find(prefix); i != text.npos; i = text.find(prefix, i))
            text.erase(i, prefix.size());
        return text;
    }
};

} // namespace

TEST_CASE("an entry of a suite is a command", "[unit][suite]")
{
    const SuiteDirectory directory;
    CHECK(directory.commands("<suite><render scene='a/b.xml'/></suite>") == Texts{"b: renderer a/b.xml"});
    CHECK(
        directory.commands("<suite><render scene='b.xml' spp='1, 16 64' name='x/y' max='rmse=1'/></suite>") ==
        Texts{"x/y_1: renderer b.xml --spp 1", "x/y_16: renderer b.xml --spp 16",
              "x/y_64: renderer b.xml --spp 64"});
    CHECK(directory.commands("<suite><render scene='b.xml' no-variance='true' lenient='false' size='4x3'>"
                             "<define name='a' value='1 2'/></render></suite>") ==
          Texts{"b: renderer b.xml --no-variance --size 4x3 --define 'a=1 2'"});
}

TEST_CASE("what a group says holds inside it", "[unit][suite]")
{
    const SuiteDirectory directory;
    const std::string xml = "<suite spp='4' seed='$seed'>"
                            "  <default name='seed' value='9'/>"
                            "  <define name='a' value='0'/>"
                            "  <group name='g' seed='2'>"
                            "    <define name='a' value='1'/>"
                            "    <group name='h' spp=''><render scene='b.xml'/></group>"
                            "    <render scene='b.xml'><define name='a' value='2'/></render>"
                            "  </group>"
                            "  <render scene='b.xml'/>"
                            "</suite>";
    CHECK(directory.commands(xml) == Texts{"g/h/b: renderer b.xml --seed 2 --define a=1",
                                           "g/b_4: renderer b.xml --spp 4 --seed 2 --define a=2",
                                           "b_4: renderer b.xml --spp 4 --seed 9 --define a=0"});
    CHECK(directory.commands(xml, {{"seed", "5"}}).back() ==
          "b_4: renderer b.xml --spp 4 --seed 5 --define a=0");
}

TEST_CASE("references of a suite", "[unit][suite]")
{
    const SuiteDirectory directory;
    const std::vector<SuiteJob> jobs = directory.plan(
        "<suite spp='4' seed='1' reference='ref/*.exr' reference-spp='64' reference-seed='2' size='8x8'>"
        "<group name='g'><render scene='a.xml' exact='B' max='rmse=0.1,flip=1' no-verdict='true'/></group>"
        "<render scene='b.xml' reference='c.exr' reference-spp=''/>"
        "<render scene='c.xml' reference=''/></suite>");
    REQUIRE(jobs.size() == 3);
    CHECK(directory.inside(jobs[0].entry.reference.string()) == "ref/g/a.exr");
    CHECK(directory.inside(command_text(jobs[0].entry.scene, jobs[0].reference)) ==
          "renderer a.xml --spp 64 --seed 2 --size 8x8");
    CHECK(jobs[0].compare ==
          CompareSettings{.verdict = false, .exact = Side::b, .thresholds = {{"rmse", 0.1}, {"flip", 1.0}}});
    CHECK(directory.inside(jobs[1].entry.reference.string()) == "c.exr");
    CHECK(directory.inside(command_text(jobs[1].entry.scene, jobs[1].reference)) ==
          "renderer b.xml --spp 4 --seed 2 --size 8x8");
    CHECK(jobs[2].entry.reference.empty());
}

TEST_CASE("a suite takes all scenes that match", "[unit][suite]")
{
    const SuiteDirectory directory;
    for (const char* name : {"scenes/b.xml", "scenes/a.xml", "scenes/a.txt", "scenes/deep/c.xml"})
        directory.write(name, "");
    CHECK(directory.commands("<suite><render scene='scenes/*.xml'/></suite>") ==
          Texts{"a: renderer scenes/a.xml", "b: renderer scenes/b.xml"});
    CHECK(directory.commands("<suite><render scene='scenes/?.xml' name='all' spp='2'/></suite>") ==
          Texts{"all/a_2: renderer scenes/a.xml --spp 2", "all/b_2: renderer scenes/b.xml --spp 2"});
    CHECK(directory.complaint("<suite><render scene='scenes/*.scene'/></suite>") ==
          "suite.xml:1:23: error: no file matches 'scenes/*.scene'");
}

TEST_CASE("a suite includes others", "[unit][suite]")
{
    const SuiteDirectory directory;
    directory.write("parts/more.xml",
                    "<suite><default name='n' value='3'/><render scene='b.xml' spp='$n'/></suite>");
    directory.write("parts/scene.xml", "<scene/>");
    CHECK(directory.commands("<suite><group seed='1'><include filename='parts/more.xml'/></group></suite>") ==
          Texts{"b_3: renderer parts/b.xml --spp 3 --seed 1"});
    CHECK(
        directory.complaint("<suite><include filename='parts/scene.xml'/><render scene='a.xml'/></suite>") ==
        "parts/scene.xml:1:1: error: the root of an included file must be <suite>, not <scene>");
    CHECK(directory.complaint("<suite><render scene='a.xml'/></suite>", {{"x", "1"}}) ==
          "error: -D x=1: no file of this suite uses $x");
}

TEST_CASE("what is wrong with a suite", "[unit][suite]")
{
    const SuiteDirectory directory;
    const std::pair<const char*, const char*> cases[] = {
        {"<suite/>", R"(suite.xml:1:1: error: the suite is empty; it needs a <render scene="..."/>)"},
        {"<suite><group name='a'/></suite>",
         R"(suite.xml:1:1: error: the suite is empty; it needs a <render scene="..."/>)"},
        {"<scene/>", "suite.xml:1:1: error: a <scene> file is not a suite; 'renderer FILE' renders it"},
        {"<test/>", "suite.xml:1:1: error: a <test> file is not a suite; 'renderer test FILE' runs it"},
        {"<list/>", "suite.xml:1:1: error: the root of a suite must be <suite>, not <list>"},
        {"<suite><render/></suite>",
         R"(suite.xml:1:8: error: <render> needs an attribute 'scene', or 'image' or 'command' for images of other programs: <render scene="..." .../>)"},
        {"<suite><render scene=''/></suite>", "suite.xml:1:23: error: the name of the scene file is empty"},
        {"<suite>\n<render scene='a.xml' spp='4'/>\n<render scene='b/a.xml' spp='4'/></suite>",
         "suite.xml:3:1: error: two entries write 'a_4.exr'; give one of them another name: <render "
         "name=\"...\" .../>\n"
         "suite.xml:2:1: note: the other one is here"},
        {"<suite><render scene='a.xml' spp='4,4'/></suite>",
         "suite.xml:1:8: error: two entries write 'a_4.exr'; give one of them another name: <render "
         "name=\"...\" .../>\n"
         "suite.xml:1:8: note: the other one is here"},
        {"<suite>\n<render name='a' command='x {image} {seed}' replicas='3'/>\n<render name='a_r3' "
         "image='b.exr'/>\n"
         "<render name='a_r4' image='b.exr'/></suite>",
         "suite.xml:3:1: error: two entries write 'a_r3.exr'; give one of them another name: <render "
         "name=\"...\" .../>\n"
         "suite.xml:2:1: note: the other one is here"},
        {"<suite>\n<render name='a_diff' image='b.exr'/>\n<render scene='a.xml' reference='c.exr' spp='4' "
         "name='b'/>\n"
         "<render name='a' image='b.exr' reference='c.exr'/><render name='b_4_work' image='b.exr'/></suite>",
         "suite.xml:2:1: error: two entries write 'a_diff.png'; give one of them another name: <render "
         "name=\"...\" .../>\n"
         "suite.xml:4:1: note: the other one is here"},
        {"<suite><render scene='a.xml' refrence='b.exr'/></suite>",
         "suite.xml:1:30: error: unknown attribute 'refrence' for <render>; did you mean 'reference'?"},
        {"<suite><render scene='a.xml' colour='red'/></suite>",
         "suite.xml:1:30: error: unknown attribute 'colour' for <render>; 'renderer batch --help' lists "
         "them"},
        {"<suite scene='a.xml'><render scene='a.xml'/></suite>",
         "suite.xml:1:8: error: unknown attribute 'scene' for <suite>; 'renderer batch --help' lists them"},
        {"<suite><rendr scene='a.xml'/></suite>",
         "suite.xml:1:8: error: unknown tag <rendr>; did you mean 'render'?"},
        {"<suite><render scene='a.xml'><render scene='b.xml'/></render></suite>",
         "suite.xml:1:30: error: a <render> cannot contain a <render>; it belongs in <suite> or "
         "<group>"},
        {"<suite><render scene='a.xml'><define name='x'/></render></suite>",
         R"(suite.xml:1:30: error: <define> needs an attribute 'value': <define value="..." .../>)"},
        {"<suite><render scene='a.xml' name='../a'/></suite>",
         "suite.xml:1:36: error: '../a' cannot name an image; use the name of a file in the output directory "
         "without its extension, such as box or hw4/box"},
        {"<suite><render scene='a.xml' spp=' , '/></suite>",
         "suite.xml:1:35: error: spp needs a number of samples per pixel"},
        {"<suite><render scene='$a.xml'/></suite>", "suite.xml:1:23: error: $a has no value; give it one "
                                                    "with -D a=... or <default name=\"a\" value=\"...\"/>"},
        {"<suite><render scene='a.xml' spp='many' size='4' lenient='yes' max='rms=1' "
         "reference-spp='0'/></suite>",
         "suite.xml:1:35: error: spp must be an integer from 1 to 67108864, not 'many'\n"
         "suite.xml:1:47: error: size must be WIDTHxHEIGHT, integers from 1 to 65535 as in 640x480, not '4'\n"
         "suite.xml:1:59: error: lenient must be true or false, not 'yes'\n"
         "suite.xml:1:69: error: max cannot be 'rms'; did you mean 'rmse'?\n"
         "suite.xml:1:91: error: reference-spp must be an integer from 1 to 67108864, not '0'"},
    };
    for (const auto& [xml, expected] : cases) {
        CAPTURE(xml);
        CHECK(directory.complaint(xml) == expected);
    }
    CHECK_THROWS_WITH(plan_suite((directory / "none.xml").string(), {}),
                      "file '" + (directory / "none.xml").string() + "' does not exist");
}

TEST_CASE("patterns", "[unit][suite]")
{
    for (const char* pattern : {"cbox_16", "*", "c*", "*16", "c*_*6", "?box_??", "**cbox_16**", "cbox_16*"}) {
        CAPTURE(pattern);
        CHECK(matches_pattern("cbox_16", pattern));
    }
    for (const char* pattern : {"", "cbox", "?", "*17", "c*x", "cbox_16?", "*a*", "Cbox_16"}) {
        CAPTURE(pattern);
        CHECK_FALSE(matches_pattern("cbox_16", pattern));
    }
    CHECK(matches_pattern("", "*"));
    CHECK(matches_pattern("aaab", "*aab"));
}

TEST_CASE("bytes as base64", "[unit][suite]")
{
    // RFC 4648, section 10.
    const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : cases) CHECK(base64(bytes) == text);
    CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("colours with a shared exponent keep their value", "[unit][suite]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
    const Color colors[] = {Color(0.f),
                            Color(1.f, 0.5f, 0.25f),
                            Color(3e4f, 1.f, 700.f),
                            Color(1e-6f, 3e-7f, 0.f),
                            Color(-1.f, 2.f, 0.f),
                            Color(nan, 1.f, 1.f),
                            Color(1.f, infinite, 1.f)};
    Image image(7, 1);
    for (int x = 0; x < 7; ++x) {
        const Color color = colors[static_cast<std::size_t>(x)];
        image.pixel(x, 0)[0] = color.r;
        image.pixel(x, 0)[1] = color.g;
        image.pixel(x, 0)[2] = color.b;
    }
    const std::string bytes = shared_exponent_bytes(image, 1);
    REQUIRE(bytes.size() == 28);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[4 * i + k]); };
        const float scale = std::ldexp(1.f, byte(3) - 136);
        const float largest = std::max({colors[i].r, colors[i].g, colors[i].b});
        const float channels[] = {colors[i].r, colors[i].g, colors[i].b};
        for (std::size_t k = 0; k < 3; ++k) {
            CAPTURE(i, k);
            const float decoded = byte(3) == 0 ? 0.f : (static_cast<float>(byte(k)) + 0.5f) * scale;
            CHECK(std::abs(decoded - std::max(channels[k], 0.f)) <= largest / 255.f);
        }
    }
    CHECK(bytes.substr(20) == std::string("\0\0\0\xff\0\0\0\xff", 8));
    CHECK(bytes.substr(0, 4) == std::string(4, '\0'));

    // Four pixels, then three: a mean of 0.75, 0.5 and 0.3125, and what is broken stays broken.
    const std::string small = shared_exponent_bytes(image, 4);
    CHECK(small.size() == 8);
    CHECK(static_cast<unsigned char>(small[7]) == 255);
    CHECK(reduced_size(7, 4) == 2);
}

TEST_CASE("the exit code of a batch is its worst verdict's", "[unit][suite]")
{
    using Outcome = std::variant<JobState, Verdict>;
    const auto code = [](std::initializer_list<Outcome> outcomes) {
        SuiteRun run;
        for (const Outcome& outcome : outcomes) {
            SuiteResult& result = run.results.emplace_back();
            if (const auto* verdict = std::get_if<Verdict>(&outcome)) {
                result.state = JobState::compared;
                result.verdict = *verdict;
            } else {
                result.state = std::get<JobState>(outcome);
            }
        }
        return exit_code_of(run);
    };
    using enum Verdict;
    using enum JobState;
    CHECK(code({passes, rendered, made}) == 0);
    CHECK(code({passes, undecided, passes}) == 4);
    CHECK(code({undecided, differs, passes, not_run}) == 3);
    CHECK(code({undecided, differs, failed, passes}) == 1);
}

TEST_CASE("a suite may have ten thousand sample counts", "[unit][batch]")
{
    const SuiteDirectory directory;
    std::string counts;
    for (int i = 1; i <= 10000; ++i) counts += std::to_string(i) + " ";
    CHECK(directory.plan("<suite><render scene=\"a.xml\" spp=\"" + counts + "\"/></suite>").size() == 10000);
}
