// SPDX-License-Identifier: MIT

#include "plumb/scene_file/scene_file.h"
#include "scene_file/catalog.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/nori_words.h"
#include "support/catch.h"
#include "support/element_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// What stands in the scene, in our own words.
std::string arranged(const std::string& inner, DialectName name, const DialectWishes& wishes = {})
{
    Diagnostics diagnostics;
    auto root = parse_document("scene.xml", "<scene>" + inner + "</scene>", diagnostics);
    REQUIRE(root);
    DialectWishes with_name = wishes;
    with_name.name = name;
    const DialectChoice choice = choose_dialect(*root, with_name, diagnostics);
    const std::string text = text_of(arrange(*std::move(root), choice.dialect, with_name, diagnostics));
    CHECK(diagnostics.all().empty());
    const std::string begin = "<scene>", end = "</scene>";
    return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

const Vocabulary& mitsuba3()
{
    Diagnostics diagnostics;
    const auto root = parse_document("scene.xml", "<scene version='3.0.0'/>", diagnostics);
    return *mitsuba_vocabulary(*root, diagnostics);
}

// The parameters of our type, as its manual page has them, which another test compares with the constructor.
std::vector<std::string_view> parameters_of(std::string_view kind, std::string_view type)
{
    for (const TypeInfo& info : known_types())
        if (info.kind == kind && info.name == type) return parameters_in(info.manual);
    return {};
}

bool has_type(std::string_view kind, std::string_view type)
{
    const auto& types = known_types();
    return std::any_of(types.begin(), types.end(),
                       [&](const TypeInfo& info) { return info.kind == kind && info.name == type; });
}

// Whether any of the types has it, where the row is for all.
bool has_parameter(const Vocabulary& words, std::string_view kind, std::string_view theirs,
                   std::string_view name)
{
    const std::string_view plugin_kind =
        kind == "film" ? "camera" : kind; // whose parameters become the camera's
    for (const Vocabulary* from = &words; from; from = from->base)
        for (const TypeName& type : from->types)
            if (type.kind == plugin_kind && (theirs.empty() || kind == "film" || type.theirs == theirs)) {
                const auto names = parameters_of(plugin_kind, type.ours);
                if (std::find(names.begin(), names.end(), name) != names.end()) return true;
            }
    const auto names = parameters_of(plugin_kind, theirs); // of a type without a row
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

TEST_CASE("what the rows of a dialect name is in the catalog", "[unit][vocabulary]")
{
    std::vector<const Vocabulary*> all = {&mitsuba3()};
    for (const DialectName name : all_dialects) all.push_back(&nori_vocabulary(name));
    for (const Vocabulary* top : all)
        for (const Vocabulary* words = top; words; words = words->base) {
            CAPTURE(words->name);
            for (const TypeName& row : words->types) {
                CAPTURE(row.kind, row.theirs, row.ours);
                if (row.kind == "film" || row.ours == "moment" || row.ours == "aov" || row.ours == "merge")
                    continue; // order_mitsuba()
                CHECK(has_type(row.kind, row.ours));
            }
            const auto check_parameter = [&](std::string_view kind, std::string_view type,
                                             std::string_view name) {
                CAPTURE(kind, type, name);
                CHECK(has_parameter(*top, kind, type, name));
            };
            for (const ParamName& row : words->params)
                if (row.theirs != "*" && !row.ours.empty()) check_parameter(row.kind, row.type, row.ours);
            for (const Preset& row : words->presets) check_parameter(row.kind, row.type, row.name);
        }
}

TEST_CASE("courses differ by presets", "[unit][vocabulary]")
{
    for (const DialectName name : all_dialects) {
        CAPTURE(to_string(name));
        const std::string point = name == DialectName::eth      ? "<color name='power' value='1 1 1'/>"
                                  : name == DialectName::mcgill ? "<color name='radiance' value='0 0 0'/>"
                                                                : "";
        CHECK(arranged("<emitter type='point'/>", name) ==
              (point.empty() ? "<emitter type='point'/>" : "<emitter type='point'>" + point + "</emitter>"));
        CHECK(arranged("<emitter type='area'/>", name) ==
              (name == DialectName::mcgill
                   ? "<emitter type='area'><color name='radiance' value='0 0 0'/></emitter>"
                   : "<emitter type='area'/>"));
        CHECK(arranged("<camera type='perspective'/>", name) ==
              (name == DialectName::eth
                   ? "<camera type='perspective'><boolean name='mirrored' value='true'/></camera>"
                   : "<camera type='perspective'/>"));
        CHECK(arranged("<emitter type='directional'/>", name) ==
              (name == DialectName::mcgill
                   ? "<emitter type='directional'><boolean name='pointsToLight' value='true'/></emitter>"
                   : "<emitter type='directional'/>"));
        CHECK(arranged("<emitter type='environment'/>", name) ==
              (name == DialectName::zaragoza
                   ? "<emitter type='environment'><boolean name='flipped' value='true'/>"
                     "<float name='imageScale' value='0.003921569'/></emitter>"
                   : "<emitter type='environment'/>"));
    }
}

TEST_CASE("what a file gives wins over presets", "[unit][vocabulary]")
{
    const auto stays = [](const std::string& text, DialectName name) { CHECK(arranged(text, name) == text); };
    stays("<emitter type='point'><color name='radiance' value='2 2 2'/></emitter>", DialectName::eth);
    stays("<emitter type='point'><color name='power' value='2 2 2'/></emitter>", DialectName::eth);
    stays("<emitter type='point'><color name='power' value='2 2 2'/></emitter>", DialectName::mcgill);
    stays("<emitter type='area'><texture type='checker'/></emitter>", DialectName::mcgill);
    stays("<camera type='perspective'><boolean name='mirrored' value='false'/></camera>", DialectName::eth);
}

TEST_CASE("the command line wins over dialect and file", "[unit][vocabulary]")
{
    DialectWishes wishes;
    wishes.mirrored_view = false;
    wishes.environment_scale = 2.f;
    CHECK(arranged("<camera type='perspective'><boolean name='mirrored' value='true'/></camera>"
                   "<emitter type='environment'><float name='imageScale' value='7'/></emitter>",
                   DialectName::plumb, wishes) ==
          "<camera type='perspective'><boolean name='mirrored' value='false'/></camera>"
          "<emitter type='environment'><float name='imageScale' value='2'/></emitter>");
    CHECK(arranged("<camera type='thinlens'/>", DialectName::eth, wishes) ==
          "<camera type='perspective'><boolean name='mirrored' value='false'/>"
          "<float name='lensRadius' value='0'/></camera>");
}

TEST_CASE("other names of our types", "[unit][vocabulary]")
{
    const auto camera = [](const char* type, const std::string& inner) {
        return arranged(fmt::format("<camera type='{}'>{}</camera>", type, inner), DialectName::plumb);
    };
    const std::string lens = "<camera type='perspective'><float name='lensRadius' value='2'/>"
                             "<float name='focalDistance' value='3'/></camera>";
    CHECK(camera("thinlens", "<float name='lensRadius' value='2'/><float name='focalLength' value='3'/>") ==
          lens);
    CHECK(camera("perspective_dof",
                 "<float name='lensRadius' value='2'/><float name='focalDistance' value='3'/>") == lens);
    CHECK(camera("perspective_depth",
                 "<float name='apertureradius' value='2'/>"
                 "<float name='focaldistance' value='3'/><float name='focallength' value='1'/>") == lens);
    CHECK(camera("thinlens", "<float name='lensRadius' value='2'/>") ==
          "<camera type='perspective'><float name='lensRadius' value='0'/></camera>");
    CHECK(arranged("<emitter type='pointlight'/>", DialectName::mcgill) ==
          "<emitter type='point'><point name='position' value='0 100 0'/></emitter>");
    CHECK(arranged("<integrator type='path_ems'/>", DialectName::epfl) == "<integrator type='path_nee'/>");
}
