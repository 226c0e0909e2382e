// SPDX-License-Identifier: MIT
#include "plumb/image/image.h"
#include "plumb/model/dialect.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/dialects.h"
#include "support/catch.h"
#include "support/scene_text.h"

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

const std::string power = "<emitter type='point'><color name='power' value='1 1 1'/></emitter>";
const std::string sphere = "<mesh type='sphere'/>";
const std::string path_mis = "<integrator type='path_mis'/>";

// What is warned of a <scene> without a built scene, so without its view and its numbers.
std::string warnings(const std::string& body, const DialectWishes& wishes = {})
{
    const Element root = scene(body);
    Diagnostics diagnostics;
    warn_of_open_readings(root, choose_dialect(root, wishes, diagnostics), wishes, nullptr, diagnostics);
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics.all()) text += diagnostic.text();
    return text;
}

// A scene that can be loaded, around a body.
std::string whole(const std::string& body, const std::string& integrator = path_mis)
{
    return "<scene>" + integrator + test::camera + body + "</scene>";
}

std::string loading_warnings(const std::string& xml, const RenderSettings& options = {})
{
    std::string text;
    for (const Diagnostic& warning : test::load_text(xml, options).warnings) text += warning.text() + "\n";
    return text;
}

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
        CHECK(dialect.sun_points_to_light == (name == DialectName::mcgill));
        CHECK(dialect.emitters_absorb == (zaragoza || name == DialectName::mcgill));
        CHECK(dialect.environment_flipped == zaragoza);
        CHECK(dialect.environment_scale == (zaragoza ? 1.f / 255.f : 1.f));
    }
}

TEST_CASE("signs decide alone", "[unit][dialect]")
{
    const auto [body, name] = GENERATE(table<std::string, DialectName>({
        {"<emitter type='pointlight'/>", DialectName::zaragoza},
        {"<mesh type='obj'><bsdf type='diffuse'><texture type='textmap' name='albedo'/></bsdf></mesh>",
         DialectName::zaragoza},
        {"<integrator type='path_nee'/>", DialectName::zaragoza},
        {"<integrator type='path'><boolean name='isExplicit' value='true'/></integrator>",
         DialectName::mcgill},
        {"<integrator type='ao'><string name='sampling' value='cosine'/></integrator>", DialectName::mcgill},
        {"<integrator type='direct'><string name='warp' value='cosine'/></integrator>", DialectName::mcgill},
        {"<mesh type='obj'><bsdf type='phong'><float name='shininess' value='1'/></bsdf></mesh>",
         DialectName::mcgill},
        // A name of another course is no contradiction, and neither is what only Plumb has.
        {"<integrator type='path_nee'/><mesh type='sphere'/><mesh type='rectangle'/>", DialectName::zaragoza},
        {"<integrator type='path_nee'/><sampler type='sobol'/>", DialectName::zaragoza},
    }));
    CAPTURE(body);
    const DialectEvidence evidence = find_dialect(scene(body + lamp));
    CHECK(to_string(evidence.name) == to_string(name));
    CHECK(evidence.suspects.empty());
    CHECK_FALSE(evidence.has_second_mark);
    CHECK_THAT(evidence.reason, ContainsSubstring("only " + std::string(to_string(name)) + " files have"));
}

TEST_CASE("a parameter of one course decides with a second mark, and not alone", "[unit][dialect]")
{
    const auto [first, second, name] = GENERATE(table<std::string, std::string, DialectName>({
        {power, "<mesh type='sphere'/>", DialectName::eth},
        {power, "<shape type='sphere'/>", DialectName::eth},
        {power,
         "<mesh type='obj'><bsdf type='diffuse'><texture type='checkerboard_color' "
         "name='albedo'/></bsdf></mesh>",
         DialectName::eth},
        {power, sphere + path_mis, DialectName::eth},
        {"<integrator type='direct'><string name='measure' value='area'/></integrator>",
         "<mesh type='obj'><bsdf type='phong'/></mesh>", DialectName::mcgill},
        {"<emitter type='environment'><float name='rotate' value='90'/></emitter>",
         "<emitter type='environment'><string name='filename' value='a.exr'/><color name='radiance' "
         "value='350 350 350'/></emitter>",
         DialectName::zaragoza},
    }));
    CAPTURE(first, second);
    const DialectEvidence both = find_dialect(scene(first + second));
    CHECK(to_string(both.name) == to_string(name));
    CHECK_THAT(both.reason, ContainsSubstring("have both"));
    CHECK(both.has_second_mark == (name != DialectName::mcgill));
    const DialectEvidence alone = find_dialect(scene(first));
    CHECK(alone.name == DialectName::plumb);
    CHECK(alone.suspects == std::vector{name});
    // What only Plumb has speaks against it, and ends the suspicion.
    const DialectEvidence ours = find_dialect(scene(first + second + "<sampler type='sobol'/>"));
    CHECK(ours.name == DialectName::plumb);
}

TEST_CASE("every type of the manual, alone, is plumb's, but for three", "[unit][dialect]")
{
    for (const TypeInfo& type : known_types()) {
        CAPTURE(type.kind, type.name);
        const std::string name(type.name);
        std::string body = "<" + std::string(type.kind) + " type='" + name + "'/>";
        if (type.kind == "bsdf") body = "<shape type='obj'>" + body + "</shape>";
        if (type.kind == "texture")
            body = "<shape type='obj'><bsdf type='diffuse'><texture name='albedo' type='" + name +
                   "'/></bsdf></shape>";
        if (type.kind == "emitter" && name == "area") body = "<shape type='obj'>" + body + "</shape>";
        if (type.kind == "rfilter") body = "<camera type='perspective'>" + body + "</camera>";
        const bool has_integrator = type.kind == "integrator";
        const bool is_sign = name == "pointlight" || name == "textmap" || name == "path_nee";
        for (const std::string& around :
             {lamp, "<shape type='rectangle'>" + std::string("<emitter type='area'/></shape>")}) {
            const std::string all = body + around + (has_integrator ? "" : path_mis);
            CHECK(find_dialect(scene(all)).name == (is_sign ? DialectName::zaragoza : DialectName::plumb));
            if (!is_sign && name != "sphere") CHECK(warnings(all).empty());
        }
        // On a sphere, as a beginner would write it.
        const std::string on_a_sphere = body + "<shape type='sphere'><emitter type='area'/></shape>";
        CHECK(find_dialect(scene(on_a_sphere + (has_integrator ? "" : path_mis))).name ==
              (is_sign ? DialectName::zaragoza : DialectName::plumb));
    }
}

TEST_CASE("where nothing decides", "[unit][dialect]")
{
    const DialectEvidence plain = find_dialect(scene(path_mis + lamp));
    CHECK(plain.name == DialectName::plumb);
    CHECK(plain.suspects.empty());
    CHECK(plain.reason == "no mark in the file indicates a course");
    CHECK(warnings(path_mis + lamp).empty()); // no file is warned of on every run
    const std::string nothing_of_its_own =
        "<emitter type='environment'/><mesh type='obj'><bsdf type='diffuse'>"
        "<texture name='albedo' type='imagetexture_color3f'/></bsdf></mesh>";
    CHECK(find_dialect(scene(nothing_of_its_own + sphere + path_mis)).name == DialectName::plumb);
}

TEST_CASE("contradicting marks: plumb, and what the others would change", "[unit][dialect]")
{
    const auto [body, first, second] = GENERATE(table<std::string, DialectName, DialectName>({
        {"<integrator type='path_nee'/>" + power, DialectName::zaragoza, DialectName::eth},
        {"<integrator type='path_nee'/><emitter type='environment'/><mesh type='obj'><bsdf "
         "type='phong'><float "
         "name='shininess' value='1'/></bsdf></mesh>",
         DialectName::zaragoza, DialectName::mcgill},
    }));
    const DialectEvidence evidence = find_dialect(scene(body + lamp));
    CHECK(evidence.name == DialectName::plumb);
    CHECK(evidence.suspects == std::vector{first, second});
    CHECK_THAT(evidence.reason, ContainsSubstring("the file mixes"));
    CHECK_THAT(warnings(body + lamp), ContainsSubstring("for zaragoza light ends at emitters") &&
                                          ContainsSubstring("--dialect zaragoza"));
    CHECK(warnings(body + black_lamp).empty());
}

TEST_CASE("files beside a scene tell whose it is", "[unit][dialect]")
{
    const TempDirectory directory;
    const auto dialect = [&](const std::string& name) { return load_scene(directory.path() / name).dialect; };
    directory.write("a_mis.xml", whole(""));
    CHECK(dialect("a_mis.xml").name == DialectName::plumb);

    SECTION("zaragoza")
    {
        directory.write("a_nee.xml", whole("", "<integrator type='path_nee'/>"));
        CHECK(dialect("a_mis.xml").name == DialectName::zaragoza);
        CHECK(dialect("a_mis.xml").reason ==
              "only zaragoza files have 'path_nee' (a_nee.xml:1), counting the files beside it");
        // Whoever writes the attribute once would have written it again.
        directory.write("b.xml", "<scene dialect='plumb'/>");
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
    }
    SECTION("epfl")
    {
        directory.write("a_ems.xml", whole("", "<integrator type='path_ems'/>"));
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
        directory.write("a_mats.xml", whole("", "<integrator type='path_mats'/>"));
        CHECK(dialect("a_mis.xml").name == DialectName::epfl);
        CHECK(dialect("a_ems.xml").name == DialectName::epfl);
    }
    SECTION("eth")
    {
        directory.write("a_ball.xml", whole(sphere));
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
        CHECK(dialect("a_ball.xml").name == DialectName::plumb);
        directory.write("a_direct.xml",
                        whole(sphere, "<integrator type='direct_mis'/>")); // a sphere is no second mark
        CHECK(dialect("a_ball.xml").name == DialectName::plumb);
        directory.write("a_mats.xml", whole(sphere, "<integrator type='path_mats'/>"));
        for (const char* name : {"a_mis.xml", "a_ball.xml", "a_mats.xml"}) {
            CHECK(dialect(name).name == DialectName::eth);
            CHECK(dialect(name).mirrored_view);
        }
        // What ETH's files have not.
        directory.write("b.xml", whole("<mesh type='rectangle'/>"));
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
    }
    SECTION("whatever else lies there")
    {
        directory.write("broken.xml", "<scene><integrator");
        directory.write("test.xml", "<test type='ttest'><scene><integrator type='path_nee'/></scene></test>");
        directory.write("notes.txt", whole("", "<integrator type='path_nee'/>"));
        std::filesystem::create_directory(directory.path() / "directory.xml");
        std::filesystem::create_symlink("nowhere", directory.path() / "link.xml");
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
    }
    SECTION("very many files are another matter")
    {
        directory.write("a_nee.xml", whole("", "<integrator type='path_nee'/>"));
        for (int i = 0; i < 70; ++i) directory.write("b" + std::to_string(i) + ".xml", "<scene/>");
        CHECK(dialect("a_mis.xml").name == DialectName::plumb);
    }
}

TEST_CASE("who decides on the dialect", "[unit][dialect]")
{
    const std::string eth_body = power + sphere + lamp;
    Diagnostics diagnostics;
    const auto choose = [&](const std::string& attributes, const DialectWishes& wishes) {
        return choose_dialect(scene(eth_body, attributes), wishes, diagnostics).dialect;
    };
    CHECK(choose("", {}).name == DialectName::eth);
    CHECK(choose(" dialect='auto'", {}).name == DialectName::eth);
    CHECK(choose(" dialect='plumb'", {}).name == DialectName::plumb);
    CHECK(choose(" dialect='plumb'", {DialectName::epfl, {}, {}, {}}).name == DialectName::epfl);
    CHECK(diagnostics.all().empty());

    const Dialect overridden = choose("", {DialectName::zaragoza, false, true, 2.f});
    CHECK(overridden.name == DialectName::zaragoza);
    CHECK_FALSE(overridden.emitters_absorb);
    CHECK(overridden.mirrored_view);
    CHECK(overridden.environment_scale == 2.f);
    CHECK(overridden.environment_flipped);
    CHECK(overridden.reason == "set by --dialect; --emitters scatter; --mirror on; --envmap-scale 2");
}

TEST_CASE("a sphere with path_mis may be eth's", "[unit][dialect]")
{
    const std::string xml = whole(sphere);
    CHECK(test::load_text(xml).dialect.name == DialectName::plumb);
    CHECK_THAT(loading_warnings(xml),
               ContainsSubstring("'sphere' with 'path_mis'") && ContainsSubstring("eth files") &&
                   ContainsSubstring("it is read as plumb; for eth the view is mirrored (--mirror on)") &&
                   ContainsSubstring("--dialect eth") && !ContainsSubstring("lamp"));
    RenderSettings closed;
    closed.scene.mirrored_view = false;
    CHECK(loading_warnings(xml, closed).empty());
    CHECK(loading_warnings("<scene dialect='plumb'>" + xml.substr(7)).empty());
    CHECK(loading_warnings(whole(sphere, "<integrator type='path_mats'/>")).empty());
}

TEST_CASE("warnings name what would change this image, with numbers", "[unit][dialect]")
{
    const TempDirectory directory;
    Image map(8, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) std::fill_n(map.pixel(x, y), 3, 0.5f);
    write_image(directory / "map.exr", map);
    const std::string around =
        "<emitter type='environment'><string name='filename' value='map.exr'/></emitter>";
    const auto load = [&](const std::string& body, const RenderSettings& options = {}) {
        const LoadedScene loaded = load_scene(directory.write("scene.xml", body), options);
        std::string text;
        for (const Diagnostic& warning : loaded.warnings) text += warning.text() + "\n";
        return std::pair(loaded.dialect, text);
    };
    const std::string nee = "<integrator type='path_nee'/>";
    const std::string point = "<emitter type='pointlight'/>";

    // Nothing but Plumb's own names.
    const auto [plain, silence] = load(whole(around));
    CHECK(plain.environment_scale == 1.f);
    CHECK(silence.empty());
    // One mark decides on lamps, and not on the map.
    const auto [one, one_text] = load(whole(around, nee));
    CHECK((one.name == DialectName::zaragoza && one.emitters_absorb));
    CHECK((one.environment_scale == 1.f && !one.environment_flipped));
    CHECK_THAT(one_text, ContainsSubstring("divided by 255: mean 0.002, not 0.5") &&
                             ContainsSubstring("--dialect zaragoza") && !ContainsSubstring("lamps"));
    // Two do, and it is said what that makes of the image.
    const auto [two, two_text] = load(whole(around + point, nee));
    CHECK((two.environment_scale == 1.f / 255.f && two.environment_flipped));
    CHECK_THAT(two_text, ContainsSubstring("divided by 255: mean 0.002, not 0.5 (--envmap-scale 1"));
    RenderSettings scaled;
    scaled.scene.environment_scale = 1.f;
    CHECK(load(whole(around + point, nee), scaled).second.empty());
    // Without a map nothing is said of it.
    CHECK(load(whole(point, nee)).second.empty());
    CHECK(load(whole("<emitter type='environment'/>", nee)).second.empty());
}
