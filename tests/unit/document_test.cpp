// SPDX-License-Identifier: MIT
#include "scene_file/document.h"
#include "scene_file/xml_scan.h"
#include "support/catch.h"
#include "support/temp_folder.h"

#include <fstream>

using namespace plumb;

namespace {

std::optional<Element> parse(const std::string& text, Diagnostics& diagnostics)
{
    return parse_document("scene.xml", text, diagnostics);
}

Element parse(const std::string& text)
{
    Diagnostics diagnostics;
    auto root = parse(text, diagnostics);
    REQUIRE(diagnostics.all().empty());
    REQUIRE(root);
    return *root;
}

// "line:column: message" of the only error.
std::string parse_error(const std::string& text)
{
    Diagnostics diagnostics;
    parse(text, diagnostics);
    REQUIRE(diagnostics.all().size() == 1);
    const Diagnostic& found = diagnostics.all()[0];
    return std::to_string(found.location.line) + ":" + std::to_string(found.location.column) + ": " +
           found.message;
}

} // namespace

// The places rely on pugixml parsing in place: this pins it for the version in use.
TEST_CASE("every name and value has its place", "[unit][document]")
{
    const std::string bom = GENERATE("", "\xEF\xBB\xBF");
    const std::string eol = GENERATE("\n", "\r\n");
    const std::string text = bom + "<?xml version='1.0'?>" + eol + "<!-- <mesh> -->" + eol + "<scene>" + eol +
                             "  <a x=\"1 &lt; &#65;2\"  yy = 'b" + eol + "\tc' e=''/>" + eol + "</scene>" +
                             eol;
    const Element root = parse(text);
    CHECK(root.tag == "scene");
    CHECK(root.place().line == 3);
    CHECK(root.place().column == 1);
    REQUIRE(root.children.size() == 1);
    const Element& a = root.children[0];
    CHECK(a.place().line == 4);
    CHECK(a.place().column == 3);
    REQUIRE(a.attributes.size() == 3);

    const Attribute& x = a.attributes[0];
    CHECK(x.value == "1 < A2");
    CHECK_FALSE(x.verbatim);
    CHECK(a.name_place(x).column == 6);
    CHECK(a.value_place(x).column == 9);
    CHECK(a.value_place(x).length == 13);

    const Attribute& yy = a.attributes[1];
    CHECK(yy.name == "yy");
    CHECK(a.name_place(yy).column == 25);
    CHECK(a.name_place(yy).length == 2);
    CHECK(a.value_place(yy).line == 4);
    CHECK(a.value_place(yy).column == 31);
    CHECK(yy.value.front() == 'b');
    CHECK(yy.value.back() == 'c');
    CHECK(yy.value.find_first_of("\r\n\t") == std::string::npos); // blanks of all kinds arrive as spaces

    const Attribute& e = a.attributes[2];
    CHECK(e.value.empty());
    CHECK(a.value_place(e).line == 5);
    CHECK(a.value_place(e).column == 8);
    CHECK(text.substr(e.value_offset - 1, 2) == "''");
}

TEST_CASE("parts of a value", "[unit][document]")
{
    const Element root = parse("<scene v='0 bad 1' w='0 &amp;bad'/>");
    const SourceLocation bad = root.part_place(root.attributes[0], 2, 3);
    CHECK(bad.column == 13);
    CHECK(bad.length == 3);
    CHECK(root.part_place(root.attributes[1], 2, 3).column == root.value_place(root.attributes[1]).column);
}

TEST_CASE("a file may be one long line", "[unit][document]")
{
    std::string text = "<scene>";
    for (int i = 0; i < 20000; ++i) text += "<float name='a' value='1'/>";
    const Element root = parse(text + "</scene>");
    REQUIRE(root.children.size() == 20000);
    const SourceLocation at = root.children.back().place();
    CHECK(at.line == 1);
    CHECK(at.column == 8 + 19999 * 27);
    CHECK(at.line_text.size() < 1000);
}

TEST_CASE("what is not XML", "[unit][document]")
{
    CHECK_THAT(parse_error(""), ContainsSubstring("1:1: the file has no root element"));
    CHECK_THAT(parse_error("  \n<!-- nothing -->\n"), ContainsSubstring("the file has no root element"));
    CHECK_THAT(parse_error("Dear renderer\n"),
               ContainsSubstring("1:1: unexpected text before the root element"));
    CHECK_THAT(parse_error("<scene/>\n x"),
               ContainsSubstring("2:2: unexpected text after the end of the root"));
    CHECK_THAT(parse_error("<scene/><scene/>"), ContainsSubstring("1:9: <scene> is a second root element"));
    CHECK_THAT(parse_error("<scene>\n<mesh>\n</scene>"),
               ContainsSubstring("3:1: </scene> does not close <mesh>, opened at line 2"));
    CHECK_THAT(parse_error("<scene>\n  <mesh>\n"), ContainsSubstring("2:3: <mesh> is never closed"));
    CHECK_THAT(parse_error("</scene>"), ContainsSubstring("1:1: </scene> closes nothing"));
    CHECK_THAT(parse_error("<scene></scene x>"), ContainsSubstring("expected '>' at the end of </scene"));
    CHECK_THAT(parse_error("<scene"), ContainsSubstring("expected '>' at the end of <scene"));
    CHECK_THAT(parse_error("<scene>\n<a <b/></scene>"),
               ContainsSubstring("2:1: expected '>' at the end of <a"));
    CHECK_THAT(parse_error("<scene>< a/></scene>"),
               ContainsSubstring("1:8: expected a tag's name after '<'"));
    CHECK_THAT(parse_error("<scene><a x></scene>"), ContainsSubstring("1:11: attribute 'x' needs a value"));
    CHECK_THAT(parse_error("<scene><a x=1/></scene>"),
               ContainsSubstring("1:13: the value of attribute 'x' needs quotes"));
    CHECK_THAT(parse_error("<scene><a x='1/>\n</scene>"),
               ContainsSubstring("1:13: the closing quote of attribute 'x'"));
    CHECK_THAT(parse_error("<scene><a x='fov y='1'/></scene>"),
               ContainsSubstring("1:21: expected a blank, '>' or"));
    CHECK_THAT(parse_error("<scene><a 'x'/></scene>"),
               ContainsSubstring("1:11: expected an attribute, '>' or"));
    CHECK_THAT(parse_error("<scene>\n<!-- a\n</scene>"),
               ContainsSubstring("2:1: this comment is never closed"));
    CHECK_THAT(parse_error("<?xml"), ContainsSubstring("1:1: this declaration is never closed"));
    CHECK_THAT(parse_error("<!DOCTYPE [ <x> "), ContainsSubstring("1:1: this declaration is never closed"));
    CHECK_THAT(parse_error("<scene><![CDATA[ x </scene>"),
               ContainsSubstring("1:8: this CDATA section is never closed"));
    CHECK_THAT(parse_error(std::string("<scene>\n\0</scene>", 17)),
               ContainsSubstring("2:1: the file contains a zero byte"));
    CHECK_THAT(parse_error("\xFF\xFE<\0"), ContainsSubstring("the file is UTF-16"));
    CHECK_THAT(parse_error("\x1F\x8B\x08"), ContainsSubstring("the file is compressed"));
}

TEST_CASE("text between tags is an error; comments and declarations are not", "[unit][document]")
{
    CHECK(parse_error("<scene>\n  hello there\n</scene>") ==
          "2:3: unexpected text 'hello'; a scene file consists of elements and comments");
    CHECK_THAT(parse_error("<scene><a/><![CDATA[ x ]]></scene>"),
               ContainsSubstring("1:22: unexpected text 'x'"));
    const Element root =
        parse("<?xml version='1.0'?><!DOCTYPE scene [ <!ELEMENT a (b)> ]>\n<!-- -- --><scene>\n"
              "<!-- <b> --><a/> <?pi?> </scene> <!-- end -->\n");
    CHECK(root.children.size() == 1);
}

TEST_CASE("an attribute given twice", "[unit][document]")
{
    CHECK(parse_error("<scene><a x='1' x='2'/></scene>") == "1:17: attribute 'x' is given twice");
}

TEST_CASE("deep nesting is an error, not a crash", "[unit][document]")
{
    const auto nested = [](int depth) {
        std::string text = "<scene>";
        for (int i = 1; i < depth; ++i) text += "<a>";
        for (int i = 1; i < depth; ++i) text += "</a>";
        return text + "</scene>";
    };
    Diagnostics diagnostics;
    CHECK(parse(nested(64), diagnostics));
    CHECK(diagnostics.all().empty());
    CHECK(parse_error(nested(65)) == "1:197: elements are nested deeper than 64 levels");
    CHECK(parse_error(nested(20000)) == "1:197: elements are nested deeper than 64 levels");
    CHECK(parse_error(std::string(3000000, '<')) ==
          "1:1: expected a tag's name after '<'; write &lt; for the sign itself");
}

TEST_CASE("elements have a bounded number of attributes, and files of both", "[unit][document]")
{
    const auto attributes = [](int count) {
        std::string text = "<scene>\n<a";
        for (int i = 0; i < count; ++i) text += " a" + std::to_string(i) + "=''";
        return text + "/></scene>";
    };
    CHECK(parse(attributes(256)).children[0].attributes.size() == 256);
    CHECK_THAT(parse_error(attributes(257)), ContainsSubstring("2:1942: <a> has more than 256 attributes"));
    const std::string text = "<scene><a x=''/><a/></scene>"; // 4 in all
    CHECK_FALSE(scan_xml(text, {.parts = 4}));
    REQUIRE(scan_xml(text, {.parts = 3}));
    CHECK(scan_xml(text, {.parts = 3})->message == "the file has more than 3 elements and attributes");
    CHECK(scan_xml(text, {.parts = 3})->offset == 16);
}

TEST_CASE("the root's tag is found before anything is read", "[unit][document]")
{
    CHECK(root_tag("<scene>") == "scene");
    CHECK(root_tag("\xEF\xBB\xBF <?xml?>\n<!-- <a> --><!DOCTYPE b [ <c> ]>\t<scene x") == "scene");
    for (const char* const text :
         {"", " \n", "scene", "x <scene>", "<!-- <scene>", "<? <scene>", "< scene>", "</scene>", "<"})
        CHECK(root_tag(text).empty());
    // Of other files there is no more than that tag.
    Diagnostics diagnostics;
    const auto other = parse(" <html a='1' a='2'><b></html>", diagnostics);
    REQUIRE(other);
    CHECK(diagnostics.all().empty());
    CHECK(other->tag == "html");
    CHECK(other->attributes.empty());
    CHECK(other->children.empty());
    CHECK(other->place().column == 2);
    CHECK(other->place().hides_line);
    CHECK_FALSE(parse("<scene/>").place().hides_line);
}

// Whatever the scan lets pass, the parser must understand in the same way; nothing may crash.
TEST_CASE("damaged files", "[unit][document]")
{
    const std::string good =
        "<?xml version=\"1.0\"?>\n<scene a='x'>\n  <!-- c --><mesh type=\"obj\"><f v='&amp;'/>"
        "</mesh>\n</scene>\n";
    const std::string damage = "<>/\"'=&;![]-? \nA\0\xFF";
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (const char c : damage) {
            std::string text = good;
            text[i] = c;
            Diagnostics diagnostics;
            const auto root = parse(text, diagnostics);
            CHECK((root.has_value() || diagnostics.has_errors()));
        }
        Diagnostics diagnostics;
        const auto root = parse(good.substr(0, i), diagnostics);
        // Where the root's tag is cut, too, nothing more is read.
        CHECK((i + 1 == good.size() || diagnostics.has_errors() || (root && root->tag != "scene")));
    }
}

TEST_CASE("files that cannot be read", "[unit][document]")
{
    const TempFolder folder;
    CHECK_THROWS_WITH(read_text(folder.path() / "none.xml"), ContainsSubstring("none.xml' does not exist"));
    CHECK_THROWS_WITH(read_text(folder.path()), ContainsSubstring("is a directory, not a scene file"));
    std::ofstream(folder.path() / "a.xml", std::ios::binary) << "a\r\n\0";
    CHECK(read_text(folder.path() / "a.xml") == "a\r\n");
}
