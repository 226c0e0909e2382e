// SPDX-License-Identifier: MIT
#include "plumb/dialect.h"
#include "scene_file/dialects.h"
#include "support/catch.h"

using namespace plumb;

namespace {

Element scene(const std::string& body, const std::string& attributes = "")
{
    Diagnostics diagnostics;
    auto root = parse_document("scene.xml", "<scene" + attributes + ">\n" + body + "\n</scene>", diagnostics);
    REQUIRE(diagnostics.all().empty());
    return *root;
}

// A lamp that reflects, so that it matters whether emitters scatter.
const std::string lamp = "<mesh type='obj'><emitter type='area'/></mesh>";
const std::string black_lamp =
    "<mesh type='obj'><emitter type='area'/><bsdf type='diffuse'><color name='albedo' "
    "value='0 0,0.0'/></bsdf></mesh>";

} // namespace

TEST_CASE("dialects have names", "[unit][dialect]")
{
    for (const DialectName name : all_dialects) {
        CHECK(dialect_from_string(to_string(name)) == name);
        CHECK(Dialect::standard(name).name == name);
        CHECK(Dialect::standard(name).reason.empty());
    }
    CHECK_FALSE(dialect_from_string("auto"));
    CHECK_FALSE(dialect_from_string("Plumb"));
    CHECK_FALSE(dialect_from_string(""));
}

TEST_CASE("what the dialects disagree on", "[unit][dialect]")
{
    for (const DialectName name : all_dialects) {
        const Dialect dialect = Dialect::standard(name);
        const bool zaragoza = name == DialectName::zaragoza;
        CHECK(dialect.mirrored_view == (name == DialectName::eth));
        CHECK(dialect.point_takes_power == (name == DialectName::eth));
        CHECK(dialect.emitters_absorb == (zaragoza || name == DialectName::mcgill));
        CHECK(dialect.environment_flipped == zaragoza);
        CHECK(dialect.environment_scale == (zaragoza ? 1.f / 255.f : 1.f));
    }
}

TEST_CASE("evidence that only one course has decides", "[unit][dialect]")
{
    struct Case {
        const char* body;
        DialectName name;
    };
    const auto test = GENERATE(values<Case>({
        {"<emitter type='point'><color name='power' value='1 1 1'/></emitter>", DialectName::eth},
        {"<mesh type='obj'><bsdf type='diffuse'><texture type='checkerboard_color' "
         "name='albedo'/></bsdf></mesh>",
         DialectName::eth},
        {"<mesh type='obj'><bsdf type='diffuse'><texture type='imagetexture_color3f' "
         "name='albedo'/></bsdf></mesh>",
         DialectName::eth},
        {"<mesh type='obj'><bsdf type='diffuse'><texture type='constant_color' name='albedo'/></bsdf></mesh>",
         DialectName::eth},
        {"<integrator type='av'/>", DialectName::eth},
        {"<integrator type='whitted'/>", DialectName::epfl},
        {"<integrator type='path_ems'/>", DialectName::epfl},
        {"<emitter type='pointlight'/>", DialectName::zaragoza},
        {"<emitter type='environment'/>", DialectName::zaragoza},
        {"<integrator type='path_nee'/>", DialectName::zaragoza},
        {"<integrator type='path'/>", DialectName::zaragoza},
        {"<integrator type='direct_whitted'/>", DialectName::zaragoza},
        {"<mesh type='obj'><bsdf type='roughsubstrate'/></mesh>", DialectName::zaragoza},
        {"<mesh type='obj'><bsdf type='roughconductor'/></mesh>", DialectName::zaragoza},
        {"<mesh type='obj'><bsdf type='diffuse'><texture type='checker' name='albedo'/></bsdf></mesh>",
         DialectName::zaragoza},
        {"<integrator type='path'><boolean name='isExplicit' value='true'/></integrator>",
         DialectName::mcgill},
        {"<integrator type='path'><string name='termination' value='max-depth'/></integrator>",
         DialectName::mcgill},
        {"<integrator type='direct'><string name='measure' value='area'/></integrator>", DialectName::mcgill},
        {"<emitter type='directional'/>", DialectName::mcgill},
        {"<emitter type='point'><color name='radiance' value='1 1 1'/></emitter>", DialectName::mcgill},
        {"<shape type='obj'><bsdf type='phong'/></shape>", DialectName::mcgill},
        {"<shape type='rectangle'/>", DialectName::mcgill},
        // What several courses share takes nothing from that.
        {"<integrator type='path_mats'/><emitter type='point'><color name='power' value='1 1 1'/></emitter>",
         DialectName::eth},
        {"<integrator type='path_ems'/><mesh type='obj'><bsdf type='microfacet'/></mesh>", DialectName::epfl},
    }));
    CAPTURE(test.body);
    const DialectEvidence evidence = find_dialect(scene(test.body + lamp));
    CHECK(to_string(evidence.name) == to_string(test.name));
    CHECK_FALSE(evidence.emitters_open);
    CHECK_FALSE(evidence.mirror_open);
    CHECK_THAT(evidence.reason,
               ContainsSubstring("only " + std::string(to_string(test.name)) + " files have"));
}

TEST_CASE("where nothing decides: Zaragoza's reading, and what another one would change", "[unit][dialect]")
{
    const DialectEvidence plain = find_dialect(scene("<integrator type='path_mis'/>" + black_lamp));
    CHECK(plain.name == DialectName::zaragoza);
    CHECK_FALSE(plain.emitters_open); // nothing for the lamp to scatter
    CHECK_FALSE(plain.mirror_open);

    const DialectEvidence open = find_dialect(scene("<integrator type='path_mis'/>" + lamp));
    CHECK(open.name == DialectName::zaragoza);
    CHECK(open.emitters_open);
    CHECK(open.mirror_open);

    // Pictures in which no light is transported do not depend on emitters.
    CHECK_FALSE(find_dialect(scene("<integrator type='normals'/>" + lamp)).emitters_open);
    // A sphere under <mesh> is ETH's, but not enough to mirror the picture.
    const DialectEvidence sphere = find_dialect(scene("<integrator type='normals'/><mesh type='sphere'/>"));
    CHECK(sphere.name == DialectName::zaragoza);
    CHECK(sphere.mirror_open);
    // <shape> instead of <mesh> changes nothing.
    CHECK(find_dialect(scene("<integrator type='path'/><shape type='sphere'/>")).name ==
          DialectName::zaragoza);
}

TEST_CASE("what EPFL and ETH share is not mirrored", "[unit][dialect]")
{
    const DialectEvidence evidence = find_dialect(scene("<integrator type='path_mats'/>" + lamp));
    CHECK(evidence.name == DialectName::epfl);
    CHECK_FALSE(evidence.emitters_open); // both scatter
    CHECK(evidence.mirror_open);
}

TEST_CASE("contradicting evidence never mirrors", "[unit][dialect]")
{
    const std::string power = "<emitter type='point'><color name='power' value='1 1 1'/></emitter>";
    const auto [body, name, emitters_open] = GENERATE(table<std::string, DialectName, bool>(
        {{"<integrator type='path_nee'/>", DialectName::zaragoza, true},
         {"<integrator type='path_ems'/>", DialectName::epfl, false},
         {"<emitter type='directional'/>", DialectName::mcgill, true}}));
    const DialectEvidence evidence = find_dialect(scene(body + power + lamp));
    CHECK(evidence.name == name);
    CHECK(evidence.emitters_open == emitters_open);
    CHECK(evidence.mirror_open);
    CHECK_THAT(evidence.reason, ContainsSubstring("mixes"));
}

TEST_CASE("who decides on the dialect", "[unit][dialect]")
{
    const std::string eth_body = "<integrator type='av'/>" + lamp;
    Diagnostics diagnostics;
    CHECK(decide_dialect(scene(eth_body), {}, diagnostics).name == DialectName::eth);
    CHECK(decide_dialect(scene(eth_body, " dialect='auto'"), {}, diagnostics).name == DialectName::eth);
    CHECK(decide_dialect(scene(eth_body, " dialect='plumb'"), {}, diagnostics).name == DialectName::plumb);
    const DialectWishes epfl{DialectName::epfl, {}, {}, {}};
    CHECK(decide_dialect(scene(eth_body, " dialect='plumb'"), epfl, diagnostics).name == DialectName::epfl);
    CHECK(diagnostics.all().empty());

    const DialectWishes all{DialectName::zaragoza, false, true, 2.f};
    const Dialect overridden = decide_dialect(scene(eth_body), all, diagnostics);
    CHECK(overridden.name == DialectName::zaragoza);
    CHECK_FALSE(overridden.emitters_absorb);
    CHECK(overridden.mirrored_view);
    CHECK(overridden.environment_scale == 2.f);
    CHECK(overridden.environment_flipped);
    CHECK(overridden.reason == "--dialect says so; --emitters scatter; --mirror on; --envmap-scale 2");
}

TEST_CASE("open readings are warned of unless the command line closes them", "[unit][dialect]")
{
    const Element undecided = scene("<integrator type='path_mis'/>" + lamp);
    const auto warnings = [&](const DialectWishes& wishes) {
        Diagnostics diagnostics;
        decide_dialect(undecided, wishes, diagnostics);
        std::string text;
        for (const Diagnostic& diagnostic : diagnostics.all()) text += diagnostic.text();
        return text;
    };
    CHECK_THAT(warnings({}), ContainsSubstring("scene.xml:1:1: warning: ") &&
                                 ContainsSubstring("--emitters scatter") && ContainsSubstring("--mirror on"));
    CHECK_THAT(warnings({{}, true, {}, {}}),
               !ContainsSubstring("--emitters") && ContainsSubstring("--mirror on"));
    CHECK_THAT(warnings({{}, {}, false, {}}),
               ContainsSubstring("--emitters") && !ContainsSubstring("--mirror"));
    CHECK(warnings({{}, true, false, {}}).empty());
    CHECK(warnings({DialectName::epfl, {}, {}, {}}).empty());
}
