// SPDX-License-Identifier: MIT
#include "base/json.h"
#include "base/text_file.h"
#include "plumb/reports/render_report.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <cstdlib>
#include <limits>

using namespace plumb;

TEST_CASE("JSON strings are escaped", "[unit][json]")
{
    CHECK(json_string("plain") == "\"plain\"");
    CHECK(json_string("a\"b\\c") == "\"a\\\"b\\\\c\"");
    CHECK(json_string("\n\r\t\x01\x1f\x7f") == "\"\\n\\r\\t\\u0001\\u001f\\u007f\"");
    CHECK(json_string(std::string_view("a\0b", 3)) == "\"a\\u0000b\"");
    CHECK(json_string("Möbius") == "\"Möbius\"");
    CHECK(json_string("\u009b31m\u202e") == "\"\\u009b31m\\u202e\"");
    CHECK(json_string("\xff") == "\"\xef\xbf\xbd\"");
}

TEST_CASE("JSON numbers read back the same, and are finite", "[unit][json]")
{
    for (const double value : {0.0, 1.0, -2.5, 0.1, 1.0 / 3.0, 1e300, 5e-324, 123456789012.0})
        CHECK(std::strtod(json_number(value).c_str(), nullptr) == value);
    CHECK(json_number(std::numeric_limits<double>::infinity()) == "null");
    CHECK(json_number(std::numeric_limits<double>::quiet_NaN()) == "null");
}

TEST_CASE("JSON nests", "[unit][json]")
{
    JsonWriter json;
    json.begin_object();
    json.integer("seed", 18446744073709551615u);
    json.begin_array("list");
    json.integer({}, 1);
    json.text({}, "two");
    json.end_array();
    json.begin_array("empty");
    json.end_array();
    json.begin_object("inner");
    json.boolean("yes", true);
    json.null("nothing");
    json.end_object();
    json.number("half", 0.5);
    json.end_object();
    CHECK(std::move(json).finish() == "{\n"
                                      "  \"seed\": 18446744073709551615,\n"
                                      "  \"list\": [\n    1,\n    \"two\"\n  ],\n"
                                      "  \"empty\": [],\n"
                                      "  \"inner\": {\n    \"yes\": true,\n    \"nothing\": null\n  },\n"
                                      "  \"half\": 0.5\n"
                                      "}\n");
}

TEST_CASE("a report has what --json promises", "[unit][json]")
{
    Report report;
    report.scene = "a \"b\".xml";
    report.dialect = Dialect::standard(DialectName::eth);
    report.evidence.samples_per_pixel = 16;
    report.resolution = {64, 48};
    report.crop = PixelRect{1, 2, 3, 4};
    report.triangles = 12;
    report.render_seconds = 2.0;
    report.rays = {100, 50, 50};
    report.memory = {.meshes = 1000, .acceleration = 2000, .acceleration_peak = 3000, .images = 40};
    report.texture_bytes = 2;
    report.film_bytes = 500;
    report.peak_memory = 1048576;
    report.outputs = {"a.exr", "b.png"};

    SECTION("nothing left out")
    {
        const std::string json = report_json(report);
        for (const char* part :
             {"\"scene\": \"a \\\"b\\\".xml\"",
              "\"name\": \"eth\"",
              "\"mirrored_view\": true",
              "\"spp\": 16",
              "\"resolution\": [\n    64,\n    48\n  ]",
              "\"crop\": [\n    1,\n    2,\n    3,\n    4\n  ]",
              "\"triangles\": 12",
              "\"parsing\": ",
              "\"building\": ",
              "\"rendering\": 2",
              "\"writing\": ",
              "\"camera\": 100",
              "\"bounce\": 50",
              "\"shadow\": 50",
              "\"total\": 200",
              "\"rays_per_second\": 100",
              "\"memory_bytes\": {\n    \"meshes\": 1000,\n    \"acceleration\": 2000,\n"
              "    \"acceleration_while_built\": 3000,\n    \"textures\": 42,\n    \"film\": 500\n  }",
              "\"peak_memory_bytes\": 1048576",
              "\"count\": 0,\n    \"first\": null",
              "\"threads\": ",
              "\"instruction_set\": ",
              "\"embree_version\": ",
              "\"host\": ",
              "\"finished\": "})
            CHECK_THAT(json, ContainsSubstring(part));
    }
    SECTION("what makes it biased, and its noise")
    {
        CHECK_THAT(report_json(report),
                   ContainsSubstring("\"biased\": false,\n  \"biases\": [],\n  \"model\": [],\n"
                                     "  \"noise\": null,"));
        report.evidence.ledger.biases = {"this", "that"};
        report.evidence.ledger.model = {"emitters absorb"};
        report.evidence.noise = NoiseEstimate{0.5, 0.25, 0.75};
        CHECK_THAT(report_json(report),
                   ContainsSubstring("\"biased\": true,\n  \"biases\": [\n    \"this\",\n    \"that\"\n  ],\n"
                                     "  \"model\": [\n    \"emitters absorb\"\n  ],\n  \"noise\": {\n"
                                     "    \"rmse\": 0.5,\n    \"low\": 0.25,\n    \"high\": 0.75,\n    "
                                     "\"upper_bound\": false\n  },"));
    }
    SECTION("a sample left out has its place and its reason")
    {
        report.evidence.left_out.count = 3;
        report.evidence.left_out.first.pixel = {5, 6};
        report.evidence.left_out.first.index = 7;
        report.evidence.left_out.first.status = SampleStatus::not_finite;
        report.evidence.left_out.first.value = Color(std::numeric_limits<float>::quiet_NaN(), 1.f, infinity);
        CHECK_THAT(
            report_json(report),
            ContainsSubstring("\"count\": 3,\n    \"first\": {\n      \"pixel\": [\n        5,\n        6\n"
                              "      ],\n      \"sample\": 7,\n      \"why\": \"not finite\",\n"
                              "      \"value\": \"nan 1 inf\"\n    }"));
    }
    SECTION("a rate without time is null")
    {
        report.render_seconds = 0.0;
        CHECK_THAT(report_json(report), ContainsSubstring("\"rays_per_second\": null"));
    }
}

TEST_CASE("a report notes the machine", "[unit][json]")
{
    Report report;
    note_machine(report);
    CHECK(report.peak_memory > 1000000);
    CHECK_FALSE(report.host.empty());
    REQUIRE(report.finished.size() == 20);
    CHECK(report.finished[10] == 'T');
    CHECK(report.finished.back() == 'Z');
}

TEST_CASE("a text file appears whole or not at all", "[unit][text_file]")
{
    const TempDirectory directory;
    const std::filesystem::path file = directory / "report.json";

    check_text_path(file);
    CHECK(directory.files().empty()); // checking leaves nothing behind
    write_text_file(file, "one\n");
    CHECK(read_bytes(file) == "one\n");
    check_text_path(file);
    CHECK(read_bytes(file) == "one\n"); // nor does it touch what is there
    write_text_file(file, "two\n");
    CHECK(read_bytes(file) == "two\n");
    CHECK(directory.files() == std::vector<std::string>{"report.json"});

    SECTION("a link stays one")
    {
        std::filesystem::create_symlink(file, directory / "link.json");
        write_text_file(directory / "link.json", "three\n");
        CHECK(std::filesystem::is_symlink(directory / "link.json"));
        CHECK(read_bytes(file) == "three\n");
    }
    SECTION("a device stays one")
    {
        check_text_path("/dev/null");
        write_text_file("/dev/null", "gone\n");
        CHECK(std::filesystem::is_character_file("/dev/null"));
    }
    SECTION("what cannot be written is an error that says why")
    {
        const std::string directory_name = directory.path().string();
        const auto problem = [](const std::filesystem::path& path) -> std::string {
            try {
                check_text_path(path);
            } catch (const Error& error) {
                return error.what();
            }
            return "no error";
        };
        CHECK(problem(directory.path()) == "cannot write '" + directory_name + "': Is a directory");
        CHECK(problem(directory / "no/a.json") ==
              "cannot write '" + directory_name + "/no/a.json': No such file or directory");
        CHECK(problem(file / "a.json") == "cannot write '" + file.string() + "/a.json': Not a directory");
        CHECK_THAT(problem(directory / std::string(300, 'x')), ContainsSubstring("File name too long"));
        CHECK(directory.files() == std::vector<std::string>{"report.json"});
    }
}
