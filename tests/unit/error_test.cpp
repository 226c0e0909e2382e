// SPDX-License-Identifier: MIT
#include "plumb/base/error.h"
#include "support/catch.h"

using namespace plumb;

namespace {

std::string error_text(std::string_view text, std::size_t offset, std::size_t length)
{
    return Diagnostic{Severity::error, SourceLocation::from_offset("scene.xml", text, offset, length),
                      "wrong"}
        .text();
}

std::string second_line(const std::string& text)
{
    return text.substr(text.find('\n') + 1, text.rfind('\n') - text.find('\n') - 1);
}

std::string last_line(const std::string& text)
{
    return text.substr(text.rfind('\n') + 1);
}

} // namespace

TEST_CASE("an error shows its line and marks the place", "[unit][error]")
{
    const std::string text = "<scene>\n\n\n    <color name=\"albdo\" value=\"0.5 0.5 0.5\"/>\n</scene>\n";
    const auto at = SourceLocation::from_offset("scene.xml", text, text.find("albdo"), 5);
    CHECK(at.line == 4);
    CHECK(at.column == 18);
    const Diagnostic diagnostic{Severity::error, at,
                                "unknown parameter 'albdo' for bsdf 'diffuse'; did you mean 'albedo'?"};
    CHECK(diagnostic.text() ==
          "scene.xml:4:18: error: unknown parameter 'albdo' for bsdf 'diffuse'; did you mean 'albedo'?\n"
          "    <color name=\"albdo\" value=\"0.5 0.5 0.5\"/>\n"
          "                 ^~~~~");
}

TEST_CASE("places at the edges of a file", "[unit][error]")
{
    CHECK(error_text("", 0, 1) == "scene.xml:1:1: error: wrong\n\n^");
    CHECK(error_text("ab\n", 3, 1) == "scene.xml:2:1: error: wrong\n\n^");
    CHECK(error_text("ab", 99, 1) == "scene.xml:1:3: error: wrong\nab\n  ^");
    CHECK(error_text("ab\r\ncd\r\n", 5, 1) == "scene.xml:2:2: error: wrong\ncd\n ^");
    // A mark ends with its line.
    CHECK(error_text("abcd\nefgh", 2, 5) == "scene.xml:1:3: error: wrong\nabcd\n  ^~");
    CHECK(Diagnostic{Severity::warning, {}, "odd"}.text() == "warning: odd");
    SourceLocation file;
    file.file = "mesh.obj";
    CHECK(Diagnostic{Severity::note, file, "odd"}.text() == "mesh.obj: note: odd");
}

TEST_CASE("the caret stands below the mark after tabs and wide characters", "[unit][error]")
{
    CHECK(error_text("\tab\tcd", 4, 2) ==
          "scene.xml:1:5: error: wrong\n        ab      cd\n                ^~");
    CHECK(error_text("gr\xC3\xBC\xC3\x9F x", 7, 1) ==
          "scene.xml:1:8: error: wrong\ngr\xC3\xBC\xC3\x9F x\n     ^");
    // The mark covers characters, not bytes.
    CHECK(error_text("\xC3\xBC\xC3\x9Fx", 0, 4) == "scene.xml:1:1: error: wrong\n\xC3\xBC\xC3\x9Fx\n^~");
}

TEST_CASE("what a file contains cannot steer the terminal", "[unit][error]")
{
    CHECK(error_text("a\x1B[2Jb", 5, 1) == "scene.xml:1:6: error: wrong\na?[2Jb\n     ^");
    const Diagnostic diagnostic{Severity::error, {}, "unknown \x1B[31m"};
    CHECK(diagnostic.text() == "error: unknown \\x1b[31m");
}

TEST_CASE("long lines are shown in part", "[unit][error]")
{
    const std::size_t length = GENERATE(161u, 1000u, 100000u);
    const std::size_t offset = GENERATE(0u, 80u, 160u);
    const std::size_t from_end = GENERATE(false, true) ? length - 161 : 0;
    std::string text(length, '.');
    text.replace(offset + from_end, 1, "X");
    const std::string shown = error_text(text, offset + from_end, 1);
    const std::string line = second_line(shown), marks = last_line(shown);
    CHECK(line.size() <= 166);
    CHECK(line.size() >= 150);
    REQUIRE(marks.find('^') < line.size());
    CHECK(line[marks.find('^')] == 'X');
    CHECK_THAT(shown, ContainsSubstring("scene.xml:1:" + std::to_string(offset + from_end + 1) + ": "));

    std::string short_line(160, '.');
    CHECK(second_line(error_text(short_line, 3, 1)) == short_line);
}

TEST_CASE("diagnostics are kept once, with their order", "[unit][error]")
{
    Diagnostics diagnostics;
    const auto at = SourceLocation::from_offset("a", "text", 1);
    diagnostics.warning(at, "odd");
    CHECK_FALSE(diagnostics.has_errors());
    diagnostics.error(at, "odd");
    diagnostics.error(at, "odd");
    diagnostics.error(at, "wrong");
    CHECK(diagnostics.has_errors());
    REQUIRE(diagnostics.all().size() == 3);
    const SceneError error(diagnostics.all());
    CHECK(error.what() == diagnostics.all()[0].text() + "\n" + diagnostics.all()[1].text() + "\n" +
                              diagnostics.all()[2].text());
}

TEST_CASE("the closest name", "[unit][error]")
{
    const std::vector<std::string_view> names = {"alpha", "albedo", "intIOR", "extIOR", "kd", "toWorld"};
    CHECK(closest_name("albdo", names) == "albedo");   // a letter missing
    CHECK(closest_name("albeddo", names) == "albedo"); // one too many
    CHECK(closest_name("aplha", names) == "alpha");    // two swapped count once
    CHECK(closest_name("towolrd", names) == "toWorld");
    CHECK(closest_name("INTIOR", names) == "intIOR"); // case counts for nothing
    CHECK(closest_name("ks", names) == "kd");         // one letter is always allowed
    CHECK(closest_name("beta", names).empty());       // 2 > 4 / 3
    CHECK(closest_name("roughness", names).empty());
    CHECK(closest_name("x", {"y"}).empty()); // nothing in common
    CHECK(closest_name("", names).empty());
    CHECK(closest_name(std::string(1000000, 'a'), names).empty());
    CHECK(closest_name("ab", {}).empty());
}

TEST_CASE("the way out of an unknown name", "[unit][error]")
{
    CHECK(way_out("albdo", {"alpha", "albedo"}) == "; did you mean 'albedo'?");
    CHECK(way_out("zzzzz", {"a", "b", "c"}) == "; known are a, b and c");
    CHECK(way_out("zzzzz", {"a", "b"}) == "; known are a and b");
    CHECK(way_out("zzzzz", {"a"}) == "; known is a");
    CHECK(way_out("zzzzz", {}).empty());
}
