// SPDX-License-Identifier: MIT
#include "plumb/model/params.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/temp_directory.h"

#include <fstream>

using namespace plumb;

namespace {

// Params with one parameter, `x`, and what they complain of.
class OneParameter {
public:
    OneParameter(const std::string& tag, Property::Value value, const std::string& text = "text")
    {
        Property property;
        property.tag = tag;
        property.text = text;
        property.value = std::move(value);
        property.name_at.file = "name";
        property.value_at.file = "value";
        params_.add("x", std::move(property));
    }

    OneParameter() = default;

    const Params& operator*() const { return params_; }
    const Params* operator->() const { return &params_; }
    Params* operator->() { return &params_; }

    // "place: message" of the only error; empty if there is none.
    std::string error() const
    {
        if (diagnostics_.all().empty()) return {};
        REQUIRE(diagnostics_.all().size() == 1);
        return diagnostics_.all()[0].location.file + ": " + diagnostics_.all()[0].message;
    }

    const Diagnostics& diagnostics() const { return diagnostics_; }

private:
    static SourceLocation element()
    {
        SourceLocation at;
        at.file = "element";
        return at;
    }

    Diagnostics diagnostics_;
    Params params_{"bsdf", "diffuse", element(), diagnostics_, {}};
};

using Numbers = std::vector<double>;

} // namespace

TEST_CASE("parameters that are not given have their default", "[unit][params]")
{
    const OneParameter none;
    CHECK(none->boolean("b", true));
    CHECK(none->integer("i", -7) == -7);
    CHECK(none->number("n", 2.5f) == 2.5f);
    CHECK(none->string("s", "word") == "word");
    CHECK(none->choice("c", "one", {"one", "two"}) == "one");
    CHECK(none->point("p", Vec3f(1, 2, 3)) == Vec3f(1, 2, 3));
    CHECK(none->vector("v", Vec3f(1, 2, 3)) == Vec3f(1, 2, 3));
    CHECK(none->vector2("v2", Vec2f(1, 2)) == Vec2f(1, 2));
    CHECK(none->color("k", Color(0.25f)) == Color(0.25f));
    CHECK(none->transform("t").is_identity());
    CHECK(none->color_texture("tx", Color(0.5f))->color({0, 0}) == Color(0.5f));
    CHECK(none->number_texture("st", 0.1f, Range::any())->number({0, 0}) == 0.1f);
    CHECK_FALSE(none->has("h"));
    none->reject_unused();
    CHECK(none.diagnostics().all().empty());
    CHECK(none->asked_names().size() == 13);
}

TEST_CASE("parameters have the value that was given", "[unit][params]")
{
    CHECK(OneParameter("boolean", true)->boolean("x", false));
    CHECK(OneParameter("integer", std::int64_t{1} << 40)->integer("x", 0) == std::int64_t{1} << 40);
    CHECK(OneParameter("float", 0.1)->number("x", 0.f) == 0.1f);
    CHECK(OneParameter("integer", std::int64_t{3})->number("x", 0.f) == 3.f);
    CHECK(OneParameter("string", std::string("a b"))->string("x") == "a b");
    CHECK(OneParameter("string", std::string("two"))->choice("x", "one", {"one", "two"}) == "two");
    CHECK(OneParameter("point", Numbers{1, 2, 3})->point("x", Vec3f(0)) == Vec3f(1, 2, 3));
    CHECK(OneParameter("vector", Numbers{1, 2, 3})->point("x", Vec3f(0)) == Vec3f(1, 2, 3));
    CHECK(OneParameter("point", Numbers{1, 2, 3})->vector("x", Vec3f(0)) == Vec3f(1, 2, 3));
    CHECK(OneParameter("point", Numbers{1, 2})->vector2("x", Vec2f(0)) == Vec2f(1, 2));
    CHECK(OneParameter("color", Numbers{1, 2, 3})->color("x") == Color(1, 2, 3));
    CHECK(OneParameter("color", Numbers{1, 2, 3})->color_texture("x", Color(0.f))->color({0, 0}) ==
          Color(1, 2, 3));
    CHECK(OneParameter("float", 0.1)->number_texture("x", 0.f, Range::any())->number({0, 0}) == 0.1f);
    CHECK(OneParameter("transform", Transform::translate({1, 2, 3}))->transform("x").point(Vec3f(0)) ==
          Vec3f(1, 2, 3));
}

TEST_CASE("parameters of another type are errors at their value", "[unit][params]")
{
    const OneParameter text("string", std::string("1"));
    CHECK(text->number("x", 5.f) == 5.f);
    CHECK(text.error() == "value: x must be given as <float>, not <string>");

    const OneParameter number("float", 1.0);
    CHECK(number->integer("x", 5) == 5);
    CHECK(number.error() == "value: x must be given as <integer>, not <float>");

    const OneParameter vector("vector", Numbers{1, 1, 1});
    CHECK(vector->color("x", Color(0.f)).is_black());
    CHECK(vector.error() == "value: x must be given as <color>, not <vector>");

    const OneParameter two("vector", Numbers{1, 1});
    CHECK(two->vector("x", Vec3f(0)) == Vec3f(0));
    CHECK(two.error() == "value: x must have 3 numbers, not 2");

    const OneParameter three("vector", Numbers{1, 1, 1});
    three->vector2("x", Vec2f(0));
    CHECK(three.error() == "value: x must have 2 numbers, not 3");

    const OneParameter word("string", std::string("three"));
    CHECK(word->choice("x", "one", {"one", "two"}) == "one");
    CHECK(word.error() == "value: x must be 'one' or 'two', not 'three'");
}

TEST_CASE("required parameters", "[unit][params]")
{
    const OneParameter none;
    none->string("s");
    CHECK(none.error() ==
          "element: bsdf 'diffuse' needs a parameter 's': <string name=\"s\" value=\"...\"/>");
    const OneParameter no_color;
    no_color->color("k");
    CHECK(no_color.error() ==
          "element: bsdf 'diffuse' needs a parameter 'k': <color name=\"k\" value=\"1 1 1\"/>");
    const OneParameter no_file;
    no_file->file("f");
    CHECK(no_file.error() ==
          "element: bsdf 'diffuse' needs a parameter 'f': <string name=\"f\" value=\"...\"/>");
    CHECK(no_file->missing_file());
}

TEST_CASE("ranges", "[unit][params]")
{
    const auto [value, range, good] = GENERATE(table<double, Range, bool>({
        {0.0, Range::at_least(0.0), true},
        {-1e-40, Range::at_least(0.0), false},
        {0.0, Range::positive(), false},
        {1e-30, Range::positive(), true},
        {1e-60, Range::positive(), false}, // 0 as a float
        {1.0, Range::closed(0, 1), true},
        {1.0000001, Range::closed(0, 1), false},
        {1.0, Range::open(0, 1), false},
        {0.9999, Range::open(0, 1), true},
        {0.999999999, Range::open(0, 1), false}, // 1 as a float
        {1.0, Range::positive_to(1), true},
        {0.0, Range::positive_to(1), false},
        {-1e30, Range::any(), true},
    }));
    CAPTURE(value, range.text());
    CHECK(range.contains(value) == good);
    const OneParameter number("float", value, "given");
    number->number("x", 0.25f, range);
    CHECK(number.error() == (good ? "" : "value: x must be " + range.text() + ", not given"));
    const OneParameter color("color", Numbers{0.5, 0.5, value}, "given");
    color->color("x", Color(0.f), range);
    CHECK(color.error().empty() == (good && range.contains(0.5)));
}

TEST_CASE("ranges as text", "[unit][params]")
{
    CHECK(Range::positive_to(1).text() == "in (0, 1]");
    CHECK(Range::open(0, 180).text() == "in (0, 180)");
    CHECK(Range::closed(-1, 0.5).text() == "in [-1, 0.5]");
    CHECK(Range::at_least(1).text() == "at least 1");
    CHECK(Range::positive().text() == "greater than 0");
    CHECK(Range{-infinity, 3, false, false}.text() == "at most 3");
}

TEST_CASE("integers in range", "[unit][params]")
{
    const OneParameter good("integer", std::int64_t{65535}, "65535");
    CHECK(good->integer("x", 1, Range::closed(1, 65535)) == 65535);
    const OneParameter bad("integer", std::int64_t{0}, "0");
    CHECK(bad->integer("x", 7, Range::closed(1, 65535)) == 7);
    CHECK(bad.error() == "value: x must be in [1, 65535], not 0");
    const OneParameter below("integer", std::int64_t{0}, "0");
    below->integer("x", 7, Range::positive());
    CHECK(below.error() == "value: x must be greater than 0, not 0");
}

TEST_CASE("a parameter that could not be read is reported once", "[unit][params]")
{
    OneParameter broken;
    Property property;
    property.tag = "string";
    property.broken = true;
    broken->add("x", property);
    CHECK(broken->number("x", 2.f) == 2.f);
    CHECK(broken->string("x") == "");
    CHECK(broken->color("x").is_black());
    CHECK(broken->has("x"));
    broken->reject_unused();
    CHECK(broken.diagnostics().all().empty());
}

TEST_CASE("parameters that nobody asks for", "[unit][params]")
{
    const OneParameter unused("float", 1.0);
    unused->number("xx", 0.f);
    unused->reject_unused();
    CHECK(unused.error() == "name: unknown parameter 'x' for bsdf 'diffuse'; did you mean 'xx'?");

    OneParameter none("float", 1.0);
    none->set_lenient(true);
    none->reject_unused();
    CHECK(none.error() == "name: unknown parameter 'x' for bsdf 'diffuse'; it takes none");
    CHECK_FALSE(none.diagnostics().has_errors());

    const OneParameter ignored("float", 1.0);
    ignored->ignore("x", "x is not read");
    ignored->ignore("y", "y is not read"); // was not given
    ignored->reject_unused();
    CHECK(ignored.error() == "name: x is not read");
    CHECK_FALSE(ignored.diagnostics().has_errors());

    OneParameter texture;
    texture->add_texture({"albdo", test::two_tone_texture(Color(0.f), Color(1.f)), {}});
    texture->color_texture("albedo", Color(0.5f));
    texture->reject_unused();
    CHECK(texture.error() == ": unknown texture 'albdo' for bsdf 'diffuse'; did you mean 'albedo'?");
}

TEST_CASE("textures in place of values", "[unit][params]")
{
    OneParameter params("color", Numbers{1, 1, 1});
    SourceLocation at;
    at.file = "texture";
    params->add_texture({"t", test::two_tone_texture(Color(0.25f), Color(2.f)), at});
    CHECK(params->has("t"));
    CHECK(params->color_texture("t", Color(0.f))->color({0.25f, 0.f}) == Color(0.25f));
    CHECK(params.diagnostics().all().empty());
    CHECK(params->color_texture("t", Color(0.125f), Range::closed(0, 1))->color({0.25f, 0.f}) ==
          Color(0.125f));
    CHECK(params.error() == "texture: t must be in [0, 1] everywhere, but the texture reaches 2");

    OneParameter both("color", Numbers{1, 1, 1});
    both->add_texture({"x", test::two_tone_texture(Color(0.25f), Color(2.f)), at});
    both->color_texture("x", Color(0.f));
    CHECK(both.error() == "texture: x is given twice, as a value and as a texture");
}

TEST_CASE("messages about a parameter", "[unit][params]")
{
    const OneParameter given("float", 1.5);
    given->fail("x", "must be in (0, 1], not 1.5");
    CHECK(given.error() == "value: x must be in (0, 1], not 1.5");
    const OneParameter absent;
    absent->fail("y", "must be given");
    CHECK(absent.error() == "element: y must be given");
    const OneParameter warned("float", 1.5);
    warned->warn("x", "this is odd");
    CHECK(warned.error() == "value: this is odd");
    CHECK_FALSE(warned.diagnostics().has_errors());
}

TEST_CASE("files are found beside the scene file", "[unit][params]")
{
    const TempDirectory directory;
    std::filesystem::create_directory(directory.path() / "sub");
    std::ofstream(directory.path() / "mesh.obj") << "v 0 0 0\n";
    Diagnostics diagnostics;
    const auto given = [&](const std::string& name) {
        Params params("mesh", "obj", {}, diagnostics, directory.path() / "sub");
        Property property;
        property.tag = "string";
        property.value = name;
        params.add("filename", property);
        return params;
    };
    const Params good = given("../mesh.obj");
    CHECK(good.file("filename") == directory.path() / "mesh.obj");
    CHECK_FALSE(good.missing_file());
    CHECK(good.files().size() == 1);
    CHECK(given((directory.path() / "mesh.obj").string()).file("filename") == directory.path() / "mesh.obj");
    CHECK(diagnostics.all().empty());

    for (const char* wrong : {"mesh.obj", "..", "/dev/zero"}) {
        const Params params = given(wrong);
        params.file("filename");
        CHECK((params.missing_file() && params.files().empty()));
    }
    const std::string missing = (directory.path() / "sub" / "mesh.obj").string();
    REQUIRE(diagnostics.all().size() == 3);
    CHECK(diagnostics.all()[0].message == "filename names a file that does not exist: '" + missing + "'");
    CHECK_THAT(diagnostics.all()[1].message, ContainsSubstring("filename is a directory, not a file: '"));
    CHECK_THAT(diagnostics.all()[2].message, ContainsSubstring("is a device or a pipe, not a regular file"));
}
