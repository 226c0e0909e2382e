// SPDX-License-Identifier: MIT
#include "scene_file/property_values.h"
#include "support/catch.h"

using namespace plumb;

namespace {

constexpr int scene_tag = 7; // characters before the text

Element parse(const std::string& text)
{
    Diagnostics diagnostics;
    const auto scene = parse_document("scene.xml", "<scene>" + text + "</scene>", diagnostics);
    REQUIRE(scene);
    REQUIRE(scene->children.size() == 1);
    return scene->children[0];
}

// Of <float v="..."/>.
template <class Read>
auto read_value(const std::string& text, const Read& read)
{
    const Element element = parse("<float v=\"" + text + "\"/>");
    Diagnostics diagnostics;
    auto value = read(element, element.attributes[0], diagnostics);
    CHECK(value.has_value() == diagnostics.all().empty());
    return value;
}

Transform transform(const std::string& operations)
{
    Diagnostics diagnostics;
    const auto result = read_transform(parse("<transform>" + operations + "</transform>"), diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.all()) UNSCOPED_INFO(diagnostic.text());
    REQUIRE(result);
    return *result;
}

void check_near(const Vec3f& found, const Vec3f& expected)
{
    CAPTURE(found.x, found.y, found.z);
    CHECK(length(found - expected) < 1e-6f);
}

} // namespace

TEST_CASE("numbers", "[unit][values]")
{
    const auto [text, value] = GENERATE(table<std::string, double>({{"1", 1.0},
                                                                    {"+1.5", 1.5},
                                                                    {"-2", -2.0},
                                                                    {".5", 0.5},
                                                                    {"5.", 5.0},
                                                                    {"1e-6", 1e-6},
                                                                    {"3.76E4", 37600.0},
                                                                    {"-0", 0.0},
                                                                    {" 7\t", 7.0},
                                                                    {"3.4028234e38", 3.4028234e38},
                                                                    {"1e-50", 1e-50}}));
    CHECK(read_value(text, read_number) == value);
}

TEST_CASE("what is no number", "[unit][values]")
{
    const std::string text =
        GENERATE("", " ", "x", "1x", "x1", "1 2", "1,2", "0x10", "1e", "+", "-", "++1", "+-1", "-+1", "nan",
                 "NaN", "inf", "-inf", "infinity", "1e39", "-1e39", "1e400", "1f", "1.2.3", "\xC2\xBD");
    CAPTURE(text);
    CHECK_FALSE(read_value(text, read_number));
}

TEST_CASE("integers", "[unit][values]")
{
    CHECK(read_value("0", read_integer) == 0);
    CHECK(read_value("+12", read_integer) == 12);
    CHECK(read_value(" -3 ", read_integer) == -3);
    CHECK(read_value("9223372036854775807", read_integer) == 9223372036854775807);
    CHECK(read_value("007", read_integer) == 7);
    const std::string bad = GENERATE("", "1.0", "1e3", "0x1", "9223372036854775808", "1 2", "+-1", "a");
    CHECK_FALSE(read_value(bad, read_integer));
}

TEST_CASE("booleans", "[unit][values]")
{
    CHECK(read_value("true", read_boolean) == true);
    CHECK(read_value("False", read_boolean) == false);
    CHECK(read_value("TRUE", read_boolean) == true);
    const std::string bad = GENERATE("", "1", "0", "yes", "truee", "t");
    CHECK_FALSE(read_value(bad, read_boolean));
}

TEST_CASE("lists of numbers", "[unit][values]")
{
    const auto three = [](const Element& element, const Attribute& attribute, Diagnostics& diagnostics) {
        return read_numbers(element, attribute, {3}, diagnostics);
    };
    const std::vector<double> expected = {0.5, -1.0, 2.0};
    const std::string good = GENERATE("0.5 -1 2", "0.5,-1,2", "0.5, -1, 2", " 0.5\t-1\n2 ", ",0.5,,-1 , 2,");
    CHECK(read_value(good, three) == expected);
    const std::string bad = GENERATE("", "1", "1 2", "1 2 3 4", "1 2 x", "1;2;3", "1 2 nan");
    CHECK_FALSE(read_value(bad, three));
}

TEST_CASE("properties", "[unit][values]")
{
    Diagnostics diagnostics;
    const auto color = read_property(parse("<color name='albedo' value='1 2 3'/>"), diagnostics);
    REQUIRE(color);
    CHECK(color->tag == "color");
    CHECK(color->text == "1 2 3");
    CHECK(std::get<std::vector<double>>(color->value) == std::vector<double>{1, 2, 3});
    CHECK(color->name_at.column == 14 + scene_tag);
    CHECK(color->value_at.column == 29 + scene_tag);
    CHECK_FALSE(color->broken);
    const auto vec2 = read_property(parse("<vector name='scale' value='1 2'/>"), diagnostics);
    CHECK(std::get<std::vector<double>>(vec2->value).size() == 2);
    CHECK(std::get<bool>(read_property(parse("<boolean name='b' value='true'/>"), diagnostics)->value));
    CHECK(std::get<std::string>(read_property(parse("<string name='s' value=' a '/>"), diagnostics)->value) ==
          " a ");
    CHECK(diagnostics.all().empty());

    const auto broken = read_property(parse("<float name='x' value='?'/>"), diagnostics);
    REQUIRE(broken);
    CHECK(broken->broken);
    CHECK(diagnostics.all().size() == 1);
    CHECK_FALSE(read_property(parse("<float value='1'/>"), diagnostics));
}

TEST_CASE("operations are applied in the order of the file", "[unit][values]")
{
    const Transform both = transform("<scale value='2 3 4'/><translate value='1 0 0'/>");
    check_near(both.point(Vec3f(1, 1, 1)), Vec3f(3, 3, 4));
    const Transform other = transform("<translate value='1 0 0'/><scale value='2 3 4'/>");
    check_near(other.point(Vec3f(1, 1, 1)), Vec3f(4, 3, 4));
    CHECK(transform("").is_identity());
}

TEST_CASE("rotations are counter-clockwise, in degrees, about an axis of any length", "[unit][values]")
{
    check_near(transform("<rotate axis='0 0 5' angle='90'/>").point(Vec3f(1, 0, 0)), Vec3f(0, 1, 0));
    check_near(transform("<rotate axis='1,0,0' angle='90'/>").point(Vec3f(0, 1, 0)), Vec3f(0, 0, 1));
    check_near(transform("<rotate axis='0 1 0' angle='-90'/>").point(Vec3f(1, 0, 0)), Vec3f(0, 0, 1));
}

TEST_CASE("matrices are written row by row and act on columns", "[unit][values]")
{
    const Transform matrix = transform("<matrix value='1 0 0 5, 0 0 -1 6, 0 1 0 7, 0 0 0 1'/>");
    check_near(matrix.point(Vec3f(1, 2, 3)), Vec3f(6, 3, 9));
    check_near(matrix.vector(Vec3f(1, 2, 3)), Vec3f(1, -3, 2));
}

TEST_CASE("lookat: +z looks forward, +y up, +x left", "[unit][values]")
{
    const Transform view = transform("<lookat origin='1 2 3' target='1 2 -7' up='0 5 0'/>");
    check_near(view.point(Vec3f(0, 0, 0)), Vec3f(1, 2, 3));
    check_near(view.vector(Vec3f(0, 0, 1)), Vec3f(0, 0, -1));
    check_near(view.vector(Vec3f(0, 1, 0)), Vec3f(0, 1, 0));
    check_near(view.vector(Vec3f(1, 0, 0)), Vec3f(-1, 0, 0)); // left, when looking along -z with +y up
    // A mirroring scale in front, as the Cornell boxes have it.
    const Transform mirrored =
        transform("<scale value='-1,1,1'/><lookat origin='1 2 3' target='1 2 -7' up='0 1 0'/>");
    check_near(mirrored.vector(Vec3f(1, 0, 0)), Vec3f(1, 0, 0));
    CHECK(mirrored.determinant() < 0.0);
}
