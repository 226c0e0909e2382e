// SPDX-License-Identifier: MIT

// What others call things: the table points to what there is, and the messages are what a user sees.

#include "base/lower_case.h"
#include "scene_file/catalog.h"
#include "scene_file/foreign_names.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <set>

using namespace plumb;
using namespace plumb::test;

namespace {

bool is_type(std::string_view kind, std::string_view name)
{
    const auto& types = known_types();
    return std::any_of(types.begin(), types.end(), [&](const TypeInfo& type) {
        return (kind.empty() || type.kind == kind) && type.name == name;
    });
}

bool is_tag(std::string_view tag)
{
    const std::vector<std::string_view> tags = all_tags();
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

std::string folded(std::string_view name)
{
    std::string text;
    for (const char c : name)
        if (c != '_' && c != '-' && c != ' ') text += lower_case(c);
    return text;
}

} // namespace

TEST_CASE("the table of foreign names points to what there is", "[unit][foreign_names]")
{
    std::set<std::string> seen;
    for (const ForeignName& entry : foreign_names()) {
        CAPTURE(entry.kind, entry.name);
        const bool is_of_tags = entry.kind == "tag";
        CHECK((is_of_tags || is_tag(entry.kind)));
        CHECK(seen.insert(std::string(entry.kind) + " " + folded(entry.name)).second);
        // It must not hide a name of ours.
        CHECK_FALSE((is_of_tags ? is_tag(entry.name) : is_type(entry.kind, entry.name)));
        CHECK(entry.ours.empty() != entry.advice.empty());
        if (!entry.ours.empty()) CHECK((is_of_tags ? is_tag(entry.ours) : is_type(entry.kind, entry.ours)));
        // What advice quotes is a type, and what stands in brackets is an element.
        for (std::size_t i = entry.advice.find('\''); i != entry.advice.npos;
             i = entry.advice.find('\'', i)) {
            const std::size_t end = entry.advice.find('\'', i + 1);
            if (end == entry.advice.npos) break; // an apostrophe
            CHECK(is_type("", entry.advice.substr(i + 1, end - i - 1)));
            i = end + 1;
        }
        for (std::size_t i = entry.advice.find('<'); i != entry.advice.npos;
             i = entry.advice.find('<', i + 1)) {
            const std::size_t end = entry.advice.find_first_of(" >", i);
            CHECK(is_tag(entry.advice.substr(i + 1, end - i - 1)));
        }
    }
}

TEST_CASE("well-known names of other renderers are answered", "[unit][foreign_names]")
{
    CHECK(foreign_type("bsdf", "metal") == "bsdf 'metal' is 'roughconductor' here");
    CHECK(foreign_type("bsdf", "Rough_Metal") == "bsdf 'Rough_Metal' is 'roughconductor' here");
    CHECK(foreign_type("shape", "plane") ==
          "shape 'plane' is not supported; use 'rectangle', or an 'obj' mesh");
    CHECK(foreign_tag("rgb") == "<rgb> is <color> here");
    CHECK_FALSE(foreign_type("integrator", "metal"));
    CHECK_FALSE(foreign_type("integrator", "path_miss"));
}

TEST_CASE("scenes and options with foreign names are told what to write", "[unit][foreign_names]")
{
    const std::string scene = "<scene dialect='plumb'><integrator type='material'/>" + camera + "</scene>";
    CHECK_THAT(errors(scene), ContainsSubstring("scene.xml:1:42: error: integrator 'material' is not "
                                                "supported; use 'normals', or 'direct' with a "
                                                "'point' light\n"));
    CHECK_THAT(
        errors(
            start +
            "<mesh type='sphere'><bsdf type='diffuse'><rgb name='albedo' value='1'/></bsdf></mesh></scene>"),
        ContainsSubstring("error: <rgb> is <color> here\n"));
    RenderSettings options;
    options.method.integrator = "material";
    CHECK(errors(start + "</scene>", options) == "error: --integrator material: integrator 'material' is not "
                                                 "supported; use 'normals', or 'direct' with "
                                                 "a 'point' light");
}
