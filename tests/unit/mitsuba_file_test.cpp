// SPDX-License-Identifier: MIT

#include "plumb/scene_file/scene_file.h"
#include "scene_file/mitsuba06_words.h"
#include "scene_file/mitsuba_expand.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/spectra.h"
#include "support/catch.h"
#include "support/element_text.h"
#include "support/temp_directory.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Read {
    std::string text;     // of what stands in the scene, in our own words
    std::string messages; // without the lines that they point to
};

const std::string rest =
    "<integrator type='path'/><sensor type='perspective'><float name='fov' value='40'/></sensor>";

Read read(const std::string& inner, const std::string& version = "3.0.0", const Definitions& definitions = {},
          bool lenient = false)
{
    const TempDirectory directory;
    directory.write("grey.xml",
                    "<bsdf type='diffuse' version='3.0.0'><rgb name='reflectance' value='$g'/></bsdf>");
    directory.write("list.xml",
                    "<scene version='3.0.0'><default name='g' value='0.25'/><shape type='sphere'/></scene>");
    const std::string text = "<scene version='" + version + "'>" + inner + "</scene>";
    Diagnostics diagnostics;
    auto root = parse_document(directory / "a.xml", text, diagnostics);
    REQUIRE(root);
    Expansion expansion = expand_mitsuba(*std::move(root), definitions, diagnostics);
    Read result;
    if (const Vocabulary* words = mitsuba_vocabulary(expansion.root, diagnostics)) {
        const Element arranged =
            arrange(std::move(expansion.root), *words, {.overrides = {}, .lenient = lenient}, diagnostics);
        for (const Element& child : arranged.children)
            if (child.tag == "shape" || child.tag == "bsdf" || child.tag == "emitter")
                result.text += text_of(child);
    }
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        std::string message = diagnostic.text();
        message = message.substr(0, message.find('\n')) + "\n";
        if (const std::size_t path = message.find(directory.path().string()); path != std::string::npos)
            message.erase(path, directory.path().string().size() + 1);
        result.messages += message;
    }
    return result;
}

std::string bsdf(const std::string& inner)
{
    const Read result = read("<bsdf type='diffuse' id='m'>" + inner + "</bsdf>" + rest);
    CHECK(result.messages.empty());
    const std::string begin = "<bsdf type='diffuse' id='m'>", end = "</bsdf>";
    REQUIRE(result.text.starts_with(begin));
    return result.text.substr(begin.size(), result.text.size() - begin.size() - end.size());
}

std::string messages(const std::string& inner)
{
    return read(inner + rest).messages;
}

} // namespace

TEST_CASE("colours of Mitsuba", "[unit][mitsuba]")
{
    CHECK(bsdf("<rgb name='reflectance' value='.1 .2,.3'/>") == "<color name='albedo' value='.1 .2,.3'/>");
    CHECK(bsdf("<rgb name='reflectance' value='0.5'/>") == "<color name='albedo' value='0.5, 0.5, 0.5'/>");
    CHECK(bsdf("<float name='reflectance' value='0.5'/>") == "<color name='albedo' value='0.5, 0.5, 0.5'/>");
    CHECK(bsdf("<spectrum name='reflectance' value='0.5'/>") ==
          "<color name='albedo' value='0.5, 0.5, 0.5'/>");
    CHECK(bsdf("<spectrum type='uniform' name='reflectance'><float name='value' value='0.5'/></spectrum>") ==
          "<color name='albedo' value='0.5, 0.5, 0.5'/>");
    CHECK(bsdf("<texture type='srgb' name='reflectance'><rgb name='color' value='.1 .2 .3'/></texture>") ==
          "<color name='albedo' value='.1 .2 .3'/>");
    CHECK(bsdf("<ref id='t' name='reflectance'/>") == "<ref id='t' name='albedo'/>");
    CHECK(messages("<bsdf type='diffuse' id='m'><rgb name='reflectance' value='#ff8000'/></bsdf>") ==
          "a.xml:1:83: error: '#ff8000' is not a number\n");
    CHECK(messages("<bsdf type='diffuse' id='m'><spectrum name='reflectance' value='1 2 3'/></bsdf>") ==
          "a.xml:1:88: error: expected one number or pairs wavelength:value, not '1'\n");
    CHECK(messages("<bsdf type='diffuse' id='m'><spectrum name='reflectance' value='500:1 400:1'/></bsdf>") ==
          "a.xml:1:94: error: wavelengths must rise, and 400 does not\n");
}

TEST_CASE("spectra have the colours that Mitsuba gives them", "[unit][mitsuba]")
{
    const auto check = [](const Vec3d& color, double r, double g, double b) {
        CHECK(color.x == Approx(r).epsilon(2e-5));
        CHECK(color.y == Approx(g).epsilon(2e-5));
        CHECK(color.z == Approx(b).epsilon(2e-5));
    };
    const SpectrumPoint flat[] = {{360.0, 1.0}, {830.0, 1.0}};
    check(color_of_light(flat), 1.2048841, 0.9482280, 0.9092670);
    const SpectrumPoint rising[] = {{400.0, 0.0}, {500.0, 8.0}, {600.0, 15.6}, {700.0, 18.4}};
    check(color_of_light(rising), 20.7108364, 10.8546343, 2.7711520);
    const SpectrumPoint grey[] = {{360.0, 0.78}, {830.0, 0.78}};
    check(color_under_d65(grey), 0.7792090, 0.7791220, 0.7790650);
    const SpectrumPoint middle[] = {{400.0, 0.78}, {700.0, 0.78}};
    check(color_under_d65(middle), 0.7763670, 0.7798100, 0.7760290);
    // Wien: the blue end of a hotter body gains more.
    const Vec3d warm = color_of_black_body(3000.0), hot = color_of_black_body(6000.0);
    CHECK(hot.z / warm.z > hot.y / warm.y);
    CHECK(hot.y / warm.y > hot.x / warm.x);
    // Luminance by Planck's law at 555 nm, roughly: 2 h c^2 / l^5 / (e^(h c / (l k T)) - 1).
    CHECK(hot.y == Approx(2.9e4).epsilon(0.1));
}

TEST_CASE("numbers and transforms of Mitsuba", "[unit][mitsuba]")
{
    const auto shape = [](const std::string& inner) {
        const Read result = read("<shape type='sphere'>" + inner + "</shape>" + rest);
        CHECK(result.messages.empty());
        const std::string begin = "<shape type='sphere'>";
        return result.text.substr(begin.size(), result.text.rfind("</shape>") - begin.size());
    };
    CHECK_THAT(shape("<point name='center' x='1' y='2' z='3'/>"),
               ContainsSubstring("<point name='center' value='1, 2, 3'/>"));
    const auto operation = [&](const std::string& one) {
        const std::string text = shape("<transform name='to_world'>" + one + "</transform>");
        const std::string begin = "<transform name='toWorld'>";
        REQUIRE_THAT(text, ContainsSubstring(begin));
        const std::size_t at = text.find(begin) + begin.size();
        return text.substr(at, text.find("</transform>") - at);
    };
    CHECK(operation("<translate y='1'/>") == "<translate value='0, 1, 0'/>");
    CHECK(operation("<translate value='2'/>") == "<translate value='2, 2, 2'/>");
    CHECK(operation("<scale x='2'/>") == "<scale value='2, 1, 1'/>");
    CHECK(operation("<scale value='2'/>") == "<scale value='2, 2, 2'/>");
    CHECK(operation("<rotate z='1' angle='90'/>") == "<rotate angle='90' axis='0, 0, 1'/>");
    CHECK(operation("<rotate value='0 0 1' angle='90'/>") == "<rotate axis='0 0 1' angle='90'/>");
    CHECK(operation("<lookat origin='0 0 0' target='1 0 0'/>") ==
          "<lookat origin='0 0 0' target='1 0 0' up='0, 0, -1'/>");
    CHECK(operation("<matrix value='0 -1 0 1 0 0 0 0 1'/>") ==
          "<matrix value='0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1'/>");

    CHECK_THAT(
        messages(
            "<shape type='sphere'><transform name='to_world'><rotate z='2' angle='90'/></transform></shape>"),
        ContainsSubstring("warning: the axis has the length 2 and is made a unit vector"));
    CHECK(messages("<shape type='sphere'><point name='center' x='1' y='2'/></shape>") ==
          "a.xml:1:45: error: <point> needs x, y and z, or value\n");
    CHECK(messages("<shape type='sphere'><float name='radius' value='1&#10;'/></shape>") ==
          "a.xml:1:73: error: numbers are separated by commas or blanks, as in Mitsuba, not by tabs or line "
          "ends\n");
}

TEST_CASE("names that start with other names, and values before their use", "[unit][mitsuba]")
{
    const Read result =
        read("<default name='r' value='1'/><default name='rr' value='2'/><default name='r' value='9'/>"
             "<shape type='sphere'><float name='radius' value='$r$rr0'/></shape>" +
                 rest,
             "3.0.0", {});
    CHECK(result.messages.empty());
    CHECK_THAT(result.text, ContainsSubstring("name='radius' value='120'"));
    CHECK_THAT(
        read("<default name='r' value='1'/><shape type='sphere'><float name='radius' value='$r'/></shape>" +
                 rest,
             "3.0.0", {{"r", "5"}})
            .text,
        ContainsSubstring("name='radius' value='5'"));
    CHECK(
        messages(
            "<shape type='sphere'><float name='radius' value='$r'/></shape><default name='r' value='1'/>") ==
        "a.xml:1:73: error: $r has no value here; give it one with -D r=..., or with <default name=\"r\" "
        "value=\"...\"/> before it\n");
    CHECK_THAT(
        messages(
            "<default name='d' value='1'/><shape type='sphere'><float name='radius' value='${d}'/></shape>"),
        ContainsSubstring("write $name, without braces"));
    CHECK(read(rest, "3.0.0", {{"r", "5"}}).messages == "error: -D r=5: no file of this scene uses $r\n");
}

TEST_CASE("includes of scenes and of objects", "[unit][mitsuba]")
{
    CHECK(read("<include filename='list.xml'/><include filename='grey.xml' name='n'/>" + rest).text ==
          "<shape type='sphere'><boolean name='flipU' value='true'/></shape>");
    const Read inside =
        read("<default name='g' value='.5'/><shape type='rectangle'><include filename='grey.xml'/></shape>" +
             rest);
    CHECK(inside.messages.empty());
    CHECK_THAT(inside.text,
               ContainsSubstring("<bsdf type='diffuse'><color name='albedo' value='0.5, 0.5, 0.5'/></bsdf>"));
    CHECK_THAT(messages("<include filename='none.xml'/>"), ContainsSubstring("does not exist"));
}

TEST_CASE("ids and aliases", "[unit][mitsuba]")
{
    CHECK(
        read("<bsdf type='diffuse' id='m'/><alias id='m' as='n'/><shape type='sphere'><ref id='n'/></shape>" +
             rest)
            .text == "<bsdf type='diffuse' id='m'/><shape type='sphere'><ref id='m'/><boolean name='flipU' "
                     "value='true'/></shape>");
    CHECK(messages("<bsdf type='diffuse' id='m'/><shape type='sphere' id='m'/>") ==
          "a.xml:1:78: error: the id 'm' is given twice; first given at line 1\n");
}

TEST_CASE("what Mitsuba's files need and Plumb has not is refused in their words", "[unit][mitsuba]")
{
    CHECK(messages("<medium type='homogeneous' name='interior'/>") ==
          "a.xml:1:24: error: <medium> is not supported; Plumb renders surfaces in a vacuum only; --lenient "
          "leaves it and all others out\n");
    CHECK(messages("<shape type='sdfgrid'/>") ==
          "a.xml:1:37: error: shape 'sdfgrid' is not supported; export it as a mesh\n");
    CHECK(messages("<bsdf type='difuse' id='m'/>") ==
          "a.xml:1:36: error: unknown bsdf 'difuse'; did you mean 'diffuse'?\n");
    // A word of our own language that is none of Mitsuba's.
    CHECK_THAT(messages("<bsdf type='roughsubstrate' id='m'/>"),
               ContainsSubstring("unknown bsdf 'roughsubstrate'"));
    CHECK(messages("<bsdf type='diffuse' id='m'><rgb name='albedo' value='1'/></bsdf>") ==
          "a.xml:1:63: error: unknown parameter 'albedo' for bsdf 'diffuse'; known is reflectance\n");
    CHECK(messages("<foo/>").starts_with("a.xml:1:24: error: unknown tag <foo>"));
    const Read lenient =
        read("<medium type='homogeneous'/><shape type='sdfgrid'/><shape type='sphere'/>" + rest, "3.0.0", {},
             true);
    CHECK(lenient.text == "<shape type='sphere'><boolean name='flipU' value='true'/></shape>");
    CHECK_THAT(
        lenient.messages,
        ContainsSubstring("warning: shape 'sdfgrid' is not supported; export it as a mesh; it is left out"));
}

TEST_CASE("of a motion, --lenient takes the first transform", "[unit][mitsuba]")
{
    const std::string shape =
        "<shape type='sphere'><animation name='to_world'><transform time='0'><translate x='1'/>"
        "</transform><transform time='1'/></animation></shape>";
    CHECK(messages(shape) ==
          "a.xml:1:45: error: <animation> is not supported; Plumb renders one moment: use one "
          "<transform>\n");
    const Read lenient = read(shape + rest, "3.0.0", {}, true);
    CHECK(
        lenient.text ==
        read("<shape type='sphere'><transform name='to_world'><translate x='1'/></transform></shape>" + rest,
             "3.0.0", {}, true)
            .text);
    CHECK_THAT(lenient.messages, ContainsSubstring("; the first stands for all"));
}

TEST_CASE("a group of which nothing is left is left out with its instances", "[unit][mitsuba]")
{
    const Read lenient =
        read("<shape type='shapegroup' id='g'><shape type='sdfgrid'/></shape><shape type='instance'>"
             "<ref id='g'/></shape><shape type='disk'/>" +
                 rest,
             "3.0.0", {}, true);
    CHECK(lenient.text == "<shape type='disk'/>");
    CHECK_THAT(lenient.messages,
               ContainsSubstring("the group 'g' has no shapes; it is left out with its instances"));
}

TEST_CASE("what is shared speaks the words of the file, too", "[unit][mitsuba]")
{
    const TempDirectory directory;
    const auto error = [&](const std::string& inner) {
        const auto file =
            directory.write("shared.xml", "<scene version='3.0.0'>" + rest + inner + "</scene>");
        try {
            SceneFile(file, {}).load({}, {});
        } catch (const SceneError& refused) {
            return refused.diagnostics().front().message;
        }
        return std::string("no error");
    };
    const std::string inside = "<float name='int_ior' value='-3'/></bsdf>";
    for (const std::string& scene :
         {"<shape type='sphere'><bsdf type='dielectric'>" + inside + "</shape>",
          "<bsdf type='dielectric' id='g'>" + inside + "<shape type='sphere'><ref id='g'/></shape>"})
        CHECK(error(scene) == "int_ior must be in [0.01, 100], not -3");
}

TEST_CASE("references to emitters, films and samplers", "[unit][mitsuba]")
{
    const std::string flip = "<boolean name='flipU' value='true'/>";
    CHECK(read("<emitter type='area' id='e'><rgb name='radiance' value='2 1 1'/></emitter>"
               "<shape type='sphere'><ref id='e'/><bsdf type='diffuse'/></shape>"
               "<shape type='sphere'><ref name='emitter' id='e'/><bsdf type='diffuse'/></shape>" +
               rest)
              .text ==
          std::string("<shape type='sphere'><emitter type='area'><color name='radiance' value='2 1 1'/>"
                      "</emitter><bsdf type='diffuse'/>" +
                      flip +
                      "</shape><shape type='sphere'><emitter type='area'><color name='radiance' "
                      "value='2 1 1'/></emitter><bsdf type='diffuse'/>" +
                      flip + "</shape>"));
    const Read outside = read("<integrator type='path'/><film type='hdrfilm' id='f'><ref id='r'/></film>"
                              "<rfilter type='box' id='r'/><sampler type='independent' id='s'/>"
                              "<sensor type='perspective'><ref id='f'/><ref id='s'/></sensor>");
    CHECK(outside.messages.empty());
    CHECK(messages("<film type='hdrfilm' id='f'><ref id='f'/></film><sensor type='perspective'><ref "
                   "id='f'/></sensor>")
              .find("'f' contains itself") != std::string::npos);
    // An instance's group may have a name.
    CHECK(read("<shape type='shapegroup' id='g'><shape type='disk'/></shape><shape type='instance'><ref "
               "name='shapegroup' "
               "id='g'/></shape>" +
               rest)
              .messages.empty());
}

TEST_CASE("what people's files have beside shapes and materials", "[unit][mitsuba]")
{
    CHECK(read("<shape type='merge'><shape type='sphere'/><shape type='merge'><shape type='disk'/></shape>"
               "</shape>" +
               rest)
              .text ==
          "<shape type='sphere'><boolean name='flipU' value='true'/></shape><shape type='disk'/>");
    CHECK(bsdf("<spectrum type='regular' name='reflectance'><float name='wavelength_min' value='360'/><float "
               "name='wavelength_max' value='830'/><string name='values' value='.5 .5'/></spectrum>") ==
          bsdf("<spectrum name='reflectance' value='360:.5 830:.5'/>"));
    CHECK(messages("<bsdf type='diffuse' id='m'><spectrum type='regular' name='reflectance'/></bsdf>") ==
          "a.xml:1:52: error: a regular spectrum needs a string 'values', and 'wavelength_min' below "
          "'wavelength_max'\n");
    CHECK(
        read("<emitter type='constant'><spectrum type='d65' name='radiance'><rgb name='color' value='1 2 3'/>"
             "<float name='scale' value='2'/></spectrum></emitter>" +
             rest)
            .text == "<emitter type='environment'><color name='radiance' value='2, 4, 6'/></emitter>");
    const auto film = [](const std::string& format) {
        return read("<integrator type='path'/><sensor type='perspective'><film type='hdrfilm'><string "
                    "name='pixel_format' value='" +
                    format + "'/></film></sensor>")
            .messages;
    };
    CHECK(film("rgb").empty());
    CHECK(film("RGBA").empty());
    CHECK_THAT(film("luminance"),
               ContainsSubstring("warning: the image is written as linear RGB, not as luminance"));
    CHECK_THAT(film("rgbb"), ContainsSubstring("error: unknown pixel_format 'rgbb'; did you mean 'rgb"));
    // The sampling of a BSDF is Plumb's business.
    CHECK(messages("<bsdf type='principled' id='m'><float name='clearcoat_sampling_rate' value='2'/></bsdf>")
              .empty());
}

TEST_CASE("spectra in files", "[unit][mitsuba]")
{
    const TempDirectory directory;
    directory.write("a.spd", "# nm value\n360 0.25\n\n500 .5 # here\n830\t1\r\n");
    directory.write("b.spd", "360 secret\n");
    directory.write("c.spd", "# nothing\n");
    const auto load = [&](const std::string& name) -> std::string {
        const auto file =
            directory.write("scene.xml", "<scene version='3.0.0'>" + rest +
                                             "<emitter type='constant'><spectrum name='radiance' filename='" +
                                             name + "'/></emitter></scene>");
        try {
            const LoadedScene scene = SceneFile(file, {}).load({}, {});
            return scene.warnings.empty() ? "fine" : scene.warnings.front().message;
        } catch (const SceneError& refused) {
            return refused.diagnostics().front().message;
        }
    };
    CHECK(load("a.spd") == "fine");
    CHECK_THAT(load("b.spd"), ContainsSubstring("b.spd', line 1: expected a wavelength and a value"));
    CHECK_THAT(load("b.spd"), !ContainsSubstring("secret"));
    CHECK_THAT(load("c.spd"), ContainsSubstring("has no wavelengths"));
    CHECK_THAT(load("none.spd"), ContainsSubstring("none.spd"));
}

TEST_CASE("the channels of Mitsuba's aov and moment become layers", "[unit][mitsuba][aov]")
{
    const TempDirectory directory;
    const std::string sensor = "<sensor type='perspective'><float name='fov' value='40'/></sensor>";
    std::string warned;
    const auto aovs = [&](const std::string& integrator) {
        const LoadedScene scene =
            SceneFile(
                directory.write("scene.xml", "<scene version='3.0.0'>" + integrator + sensor + "</scene>"),
                {})
                .load({}, {});
        warned.clear();
        for (const Diagnostic& warning : scene.warnings) warned += warning.message + "\n";
        std::string text;
        for (const std::string& aov : scene.aovs) text += aov + " ";
        return text;
    };
    const std::string path = "<integrator type='path' name='img'/>";
    CHECK(aovs("<integrator type='aov'><string name='aovs' value='dd.y:depth, nn:sh_normal,p:position'/>" +
               path + "</integrator>") == "dd.y:mean_depth nn:mean_normal p:mean_position ");
    CHECK(warned.empty());
    CHECK(aovs("<integrator type='aov'><string name='aovs' value='a:albedo,x:duv_dx,noname'/>" + path +
               "</integrator>") == "a:albedo ");
    CHECK_THAT(warned, ContainsSubstring("the channel 'x:duv_dx' is not written"));
    CHECK_THAT(warned, ContainsSubstring("the channel 'noname' is not written"));
    CHECK_THAT(warned, ContainsSubstring("'albedo' is all that a surface reflects"));
    CHECK(aovs("<integrator type='moment'>" + path + "</integrator>") == "img:xyz m2_img:xyz_squared ");
    CHECK(aovs("<integrator type='moment'><integrator type='aov' name='o'><string name='aovs' "
               "value='d:depth'/>" +
               path + "</integrator></integrator>") == "o:xyz m2_o:xyz_squared o.d:mean_depth ");
    CHECK(aovs("<integrator type='aov'><string name='aovs' value='d:depth'/></integrator>") ==
          "d:mean_depth ");
    CHECK(aovs("<integrator type='path'/>").empty());
}

TEST_CASE("what is missing in a Mitsuba scene", "[unit][mitsuba]")
{
    CHECK(read("<sensor type='perspective'/>").messages ==
          "a.xml:1:1: error: the scene has no <integrator>; write <integrator type=\"path\"/>\n");
    CHECK(read("<integrator type='path'/>").messages ==
          "a.xml:1:1: error: the scene has no <sensor>; write <sensor type=\"perspective\"> ... </sensor>\n");
    // A lamp is black, unless it has a bsdf.
    CHECK(read("<shape type='sphere'><emitter type='area'/></shape>" + rest).text ==
          "<shape type='sphere'><emitter type='area'/><boolean name='flipU' value='true'/>"
          "<bsdf type='diffuse'><color name='albedo' value='0 0 0'/></bsdf></shape>");
    CHECK(read("<shape type='sphere'><emitter type='area'/><bsdf type='diffuse'/></shape>" + rest).text ==
          "<shape type='sphere'><emitter type='area'/><bsdf type='diffuse'/>"
          "<boolean name='flipU' value='true'/></shape>");
}

TEST_CASE("files of Mitsuba 0.4 to 0.6", "[unit][mitsuba]")
{
    CHECK(snake_case("intIOR") == "int_ior");
    CHECK(snake_case("toWorld") == "to_world");
    CHECK(snake_case("uscale") == "uscale");
    const auto old_bsdf = [](const std::string& inner) {
        const Read result = read("<bsdf type='diffuse' id='m'>" + inner + "</bsdf>" + rest, "0.6.0");
        CHECK(result.messages.empty());
        return result.text;
    };
    const auto albedo = [](const std::string& value) {
        return "<bsdf type='diffuse' id='m'><color name='albedo' value='" + value + "'/></bsdf>";
    };
    CHECK(old_bsdf("<spectrum name='reflectance' value='.1 .2 .3'/>") == albedo("0.1, 0.2, 0.3"));
    CHECK(old_bsdf("<rgb name='diffuseReflectance' value='.1 .2 .3'/>") == albedo("0.1, 0.2, 0.3"));
    CHECK_THAT(old_bsdf("<srgb name='reflectance' value='#ff8000'/>"),
               ContainsSubstring("value='1, 0.2158605"));
    CHECK_THAT(
        read("<emitter type='constant'><blackbody name='radiance' temperature='5000K'/></emitter>" + rest,
             "0.5.0")
            .messages,
        ContainsSubstring("Planck's law"));
    CHECK(read("<emitter type='constant'><spectrum name='radiance' value='2'/></emitter>" + rest, "0.6.0")
              .text == "<emitter type='environment'><color name='radiance' value='2, 2, 2'/></emitter>");

    const auto bsdf_of = [](const std::string& inner) {
        const Read result = read(inner + rest, "0.6.0");
        CHECK(result.messages.empty());
        return result.text;
    };
    CHECK(bsdf_of("<bsdf type='phong' id='m'><spectrum name='specularReflectance' value='.3'/></bsdf>") ==
          "<bsdf type='phong' id='m'><color name='specular-coefficients' value='0.3, 0.3, 0.3'/><color "
          "name='diffuse-coefficients' value='0.5 0.5 0.5'/><float name='exponent' value='30'/></bsdf>");
    CHECK(
        bsdf_of("<bsdf type='mixturebsdf' id='m'><string name='weights' value='.5 .5'/><bsdf type='diffuse'/>"
                "<bsdf type='diffuse'/></bsdf>") ==
        "<bsdf type='mixture' id='m'><string name='weights' value='.5 .5'/><bsdf type='diffuse'/><bsdf "
        "type='diffuse'/></bsdf>");
    CHECK_THAT(
        bsdf_of(
            "<bsdf type='coating' id='m'><float name='intIOR' value='1.7'/><bsdf type='diffuse'/></bsdf>"),
        ContainsSubstring("<float name='intIOR' value='1.7'/>"));
    CHECK_THAT(
        read("<bsdf type='ward' id='m'><string name='variant' value='ward-duer'/></bsdf>" + rest, "0.6.0")
            .messages,
        ContainsSubstring("the variant 'ward-duer' is rendered as 'balanced'"));
    CHECK_THAT(
        read("<bsdf type='roughcoating' id='m'><bsdf type='diffuse'/></bsdf>" + rest, "0.6.0").messages,
        ContainsSubstring("rendered as 'coating'"));
}
