// SPDX-License-Identifier: MIT

// What Nori's forks call things: every row of the table, and what takes more than a row.

#include "build_paths.h"
#include "plumb/model/emitter.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "scene_file/catalog.h"
#include "scene_file/folded_name.h"
#include "scene_file/foreign_names.h"
#include "scene_file/fork_words.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/nori_words.h"
#include "support/catch.h"
#include "support/element_text.h"
#include "support/scene_text.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Arranged {
    Element root;
    std::string text;     // what stands in the scene
    std::string messages; // one a line
};

Arranged arranged(const std::string& inner, bool lenient = false, bool unset = false)
{
    Diagnostics diagnostics;
    auto root = parse_document("scene.xml", "<scene>" + inner + "</scene>", diagnostics);
    REQUIRE(root);
    Arranged result;
    result.root = arrange(*std::move(root), nori_vocabulary(DialectName::plumb),
                          {.lenient = lenient, .unset = unset}, diagnostics);
    const std::string text = text_of(result.root);
    if (text.size() > 17) result.text = text.substr(7, text.size() - 15);
    for (const Diagnostic& diagnostic : diagnostics.all()) result.messages += diagnostic.message + "\n";
    return result;
}

std::string shouted(std::string_view name)
{
    std::string text;
    for (const char c : name)
        text += c == '_' ? '-' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return text;
}

// An element of a type with nothing in it, in which what a type needs is there.
std::string element(std::string_view kind, std::string_view type, const std::string& inner = "")
{
    std::string needed;
    if (folded(type) == "parallelogram" && kind == "shape")
        needed = "<point name='origin' value='0 0 0'/><vector name='u' value='1 0 0'/>"
                 "<vector name='v' value='0 1 0'/>";
    return fmt::format("<{0} type='{1}'>{2}{3}</{0}>", kind, type, needed, inner);
}

const Element& only(const Arranged& result)
{
    REQUIRE(result.root.children.size() == 1);
    return result.root.children.front();
}

} // namespace

TEST_CASE("every type of the forks, written in any way, is the type that its row names", "[unit][vocabulary]")
{
    std::set<std::string> seen;
    for (const TypeName& row : fork_words.types) {
        CAPTURE(row.kind, row.theirs);
        CHECK(seen.insert(std::string(row.kind) + " " + folded(row.theirs)).second);
        for (const std::string& name : {std::string(row.theirs), shouted(row.theirs)}) {
            const Arranged result = arranged(element(row.kind, name));
            CHECK(only(result).value("type") == row.ours);
            CHECK(only(result).written_type() == name);
            CHECK(result.messages == (row.warning.empty() ? "" : std::string(row.warning) + "\n"));
        }
        // It must not be an exact name of ours, and the table of what is only advised must not have it.
        for (const TypeInfo& type : known_types())
            CHECK_FALSE((type.kind == row.kind && type.name == row.theirs));
        CHECK_FALSE(foreign_type(row.kind, row.theirs));
    }
}

TEST_CASE("every parameter of the forks becomes the one that its row names", "[unit][vocabulary]")
{
    const auto tag = [](const ParamName& row) {
        return row.ours == "toWorld"    ? "<transform name='{0}'/>"
               : row.convert == negated ? "<boolean name='{0}' value='true'/>"
                                        : "<float name='{0}' value='0.25'/>";
    };
    for (const ParamName& row : fork_words.params) {
        const std::string_view type = !row.type.empty()          ? row.type
                                      : row.kind == "integrator" ? "path_mis"
                                      : row.kind == "camera"     ? "perspective"
                                      : row.kind == "shape"      ? "obj"
                                                                 : "diffuse";
        CAPTURE(row.kind, type, row.theirs);
        const Arranged result =
            arranged(element(row.kind, type, fmt::format(fmt::runtime(tag(row)), row.theirs)));
        CHECK(result.messages.empty());
        const auto& children = only(result).children;
        CHECK(std::count_if(children.begin(), children.end(), [&](const Element& child) {
                  return child.value("name") == row.ours && child.written_name() == row.theirs;
              }) == 1);
    }
}

TEST_CASE("parameters that change nothing are left out", "[unit][vocabulary]")
{
    for (const Ignored& row : fork_words.ignored) {
        if (row.only_unset) continue;
        const std::string_view type = row.type.empty() ? std::string_view("area") : row.type;
        const std::string name = row.name == "*" ? "whatever" : std::string(row.name);
        CAPTURE(row.kind, type, name);
        const Arranged result =
            arranged(element(row.kind, type, fmt::format("<float name='{}' value='1'/>", name)));
        for (const Element& child : only(result).children) CHECK(child.value("name") != name);
    }
    // What our integrator has is kept.
    CHECK(arranged("<integrator type='ppm'><integer name='maxDepth' value='3'/><integer name='photonCount' "
                   "value='9'/></integrator>")
              .text == "<integrator type='path_mis'><integer name='maxDepth' value='3'/></integrator>");
}

TEST_CASE("Disney's BSDF has Burley's defaults and its parameters are fractions", "[unit][vocabulary]")
{
    const std::string defaults =
        "<float name='sheenTint' value='0.5'/><float name='clearcoatGloss' value='1'/></bsdf>";
    CHECK(arranged("<bsdf type='disney'><color name='albedo' value='1 0 0'/><float name='subsurface' "
                   "value='0.25'/></bsdf>")
              .text == "<bsdf type='principled'><color name='baseColor' value='1 0 0'/>"
                       "<float name='flatness' value='0.25'/>" +
                           defaults);
    // Our own type has its own defaults.
    CHECK(arranged("<bsdf type='principled'/>").text == "<bsdf type='principled'/>");
    const Arranged limited = arranged("<bsdf type='disney'><float name='sheen' value='2'/></bsdf>");
    CHECK(limited.text == "<bsdf type='principled'><float name='sheen' value='1'/>" + defaults);
    CHECK(limited.messages == "sheen must be in [0, 1], not 2; 1 is used\n");
    // An unnamed texture, and an image by its name, which replaces the value.
    CHECK(arranged("<bsdf type='disney'><texture type='checker'/></bsdf>").text ==
          "<bsdf type='principled'><texture type='checker' name='baseColor'/>" + defaults);
    CHECK(arranged("<bsdf type='disney'><color name='baseColor' value='1 1 1'/><string name='albedoTexture' "
                   "value='a.png'/></bsdf>")
              .text == "<bsdf type='principled'><texture name='baseColor' type='bitmap'>"
                       "<string name='filename' value='a.png'/></texture>" +
                           defaults);
}

TEST_CASE("angles of spots may be cosines", "[unit][vocabulary]")
{
    const auto angle = [](const std::string& value) {
        const Arranged result = arranged(fmt::format(
            "<emitter type='spotlight'><float name='cosTotalWidth' value='{}'/></emitter>", value));
        return std::stod(only(result).children.front().value("value"));
    };
    CHECK(angle("0.5") == Approx(60.0));
    CHECK(angle("1") == Approx(0.0));
    CHECK(angle("-1") == Approx(180.0));
    CHECK(angle("30") == 30.0);
    CHECK(arranged("<emitter type='spot'><float name='falloffStart' value='20'/></emitter>").text ==
          "<emitter type='spot'><float name='beamWidth' value='20'/>"
          "<string name='falloff' value='quartic'/></emitter>");
    CHECK(arranged("<emitter type='spot'><float name='beamWidth' value='20'/></emitter>").text ==
          "<emitter type='spot'><float name='beamWidth' value='20'/></emitter>");
}

TEST_CASE("scales and shifts of an image become one transform, scales first", "[unit][vocabulary]")
{
    const auto texture = [](const std::string& inner) {
        return arranged("<bsdf type='diffuse'><texture type='png_texture'>" + inner + "</texture></bsdf>")
            .text;
    };
    CHECK(texture("<float name='offsetU' value='0.5'/><float name='scaleU' value='2'/><float name='scaleV' "
                  "value='3'/><string name='file' value='a.png'/>") ==
          "<bsdf type='diffuse'><texture type='bitmap'><string name='filename' value='a.png'/>"
          "<transform name='toUv'><scale value='2 1 1'/><scale value='1 3 1'/><translate value='0.5 0 0'/>"
          "</transform></texture></bsdf>");
    CHECK(texture("<vector name='scale' value='2 3'/>") ==
          "<bsdf type='diffuse'><texture type='bitmap'><transform name='toUv'><scale value='2 3 1'/>"
          "</transform></texture></bsdf>");
    CHECK(texture("<boolean name='linear_rgb' value='true'/>") ==
          "<bsdf type='diffuse'><texture type='bitmap'><boolean name='raw' value='false'/></texture></bsdf>");
}

TEST_CASE("textures of normals and heights stand around the BSDF", "[unit][vocabulary]")
{
    const std::string image = "<string name='filename' value='n.png'/>";
    const std::string wrapped = "<bsdf type='normalmap'><texture type='bitmap' name='normal'>" + image +
                                "<boolean name='raw' value='true'/></texture><bsdf type='mirror'/></bsdf>";
    for (const char* texture :
         {"<texture type='image_normal'>", "<texture type='normal_map'>",
          "<texture type='bitmap' name='normal_map'>", "<texture type='bitmap' name='normal'>"}) {
        CAPTURE(texture);
        const std::string map = texture + image + "</texture>";
        CHECK(arranged("<mesh type='obj'>" + map + "<bsdf type='mirror'/></mesh>").text ==
              "<mesh type='obj'>" + wrapped + "</mesh>");
        CHECK(arranged("<mesh type='obj'><bsdf type='mirror'>" + map + "</bsdf></mesh>").text ==
              "<mesh type='obj'>" + wrapped + "</mesh>");
    }
    CHECK(arranged("<mesh type='obj'><texture type='checker' name='bump'/></mesh>").text ==
          "<mesh type='obj'><bsdf type='bumpmap'><texture type='checker' name='height'/>"
          "<bsdf type='diffuse'/></bsdf></mesh>");
    // The id goes with the whole; our own maps stay as they are.
    CHECK(
        arranged("<bsdf type='mirror' id='a'><texture type='checker' name='normal'/></bsdf>").text ==
        "<bsdf type='normalmap' id='a'><texture type='checker' name='normal'/><bsdf type='mirror'/></bsdf>");
    const std::string ours = "<bsdf type='normalmap'><texture type='checker' name='normal'/>"
                             "<bsdf type='mirror'/></bsdf>";
    CHECK(arranged(ours).text == ours);
}

TEST_CASE("an environment takes the image or the colour of its texture", "[unit][vocabulary]")
{
    const std::string end = "<boolean name='zUp' value='true'/><boolean name='rowsAtPoles' value='true'/>";
    const auto around = [&](const std::string& texture) {
        return arranged("<emitter type='env_map'>" + texture + "</emitter>").text;
    };
    CHECK(
        around(
            "<texture type='png_texture' name='albedo'><string name='filename' value='a.png'/></texture>") ==
        "<emitter type='environment'>" + end + "<string name='filename' value='a.png'/></emitter>");
    CHECK(around("<texture type='constant_color'><color name='value' value='1 2 3'/></texture>") ==
          "<emitter type='environment'>" + end + "<color name='radiance' value='1 2 3'/></emitter>");
    CHECK(around("<string name='mapname' value='a.exr'/><float name='strength' value='2'/>"
                 "<boolean name='zUp' value='false'/>") ==
          "<emitter type='environment'><string name='filename' value='a.exr'/><float name='scale' value='2'/>"
          "<boolean name='zUp' value='false'/><boolean name='rowsAtPoles' value='true'/></emitter>");
    CHECK(arranged("<emitter type='environment'/>").text == "<emitter type='environment'/>");
}

TEST_CASE("a parallelogram is origin + s u + t v, and shines along u x v", "[unit][vocabulary]")
{
    const LoadedScene loaded = load_text(
        start +
        "<mesh type='parallelogram'><point name='origin' value='1 2 3'/><vector name='u' value='0 2 0'/>"
        "<vector name='v' value='0 1 3'/><emitter type='parallelogram_emitter'>"
        "<color name='radiance' value='1 1 1'/></emitter></mesh></scene>");
    const SceneObject& object = loaded.job.scene->objects().front();
    CHECK(object.shape->area() == Approx(6.0)); // |u x v| = |(6, 0, 0)|
    CHECK(object.shape->bounds().min == Vec3f(1.f, 2.f, 3.f));
    CHECK(object.shape->bounds().max == Vec3f(1.f, 5.f, 6.f));
    const ShapeSample sample = object.shape->sample_area(0.5, Vec2f(0.25f, 0.75f));
    CHECK(sample.normal.x == Approx(1.0));
    CHECK(errors(start + "<mesh type='parallelogram'/></scene>")
              .find("a parallelogram needs a parameter 'u'") != std::string::npos);
}

TEST_CASE("media are refused once in a file, and left out with --lenient", "[unit][vocabulary]")
{
    const std::string media = "<medium type='homogeneous'><phase type='hg'/></medium>"
                              "<shape type='sphere'><medium type='a'/></shape><volume/>";
    CHECK(arranged(media).messages == "<medium> is not supported; Plumb renders surfaces in a vacuum only; "
                                      "--lenient leaves it and all others out\n");
    const Arranged lenient = arranged(media, true);
    CHECK(lenient.messages ==
          "<medium> is not supported; Plumb renders surfaces in a vacuum only; it and all "
          "others are left out\n");
    CHECK(lenient.text == "<shape type='sphere'/>");
}

TEST_CASE("--integrator says what stands in for another method", "[unit][vocabulary]")
{
    RenderSettings options;
    options.method.integrator = "photonmapper";
    const LoadedScene loaded = load_text(start + "</scene>", options);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(loaded.warnings.front().message ==
          "--integrator photonmapper: this is rendered by 'path_mis', which "
          "finds the same light up to noise");
    options.method.integrator = "mipath";
    CHECK(load_text(start + "</scene>", options).warnings.empty());
}

TEST_CASE("a spot's power and quartic fall-off are pbrt's", "[unit][vocabulary][emitter]")
{
    const LoadedScene loaded = load_text(
        start +
        "<emitter type='spot'><point name='position' value='0 0 2'/><point name='target' value='0 0 0'/>"
        "<color name='power' value='3 3 3'/><float name='cosTotalWidth' value='0.5'/>"
        "<float name='cosFalloffStart' value='0.8'/></emitter></scene>");
    const Emitter& spot = *loaded.job.scene->emitters().front();
    const double intensity = 3.0 / (2.0 * pi_d * (1.0 - 0.65));
    for (const double cosine : {1.0, 0.9, 0.81, 0.75, 0.65, 0.55, 0.49}) {
        CAPTURE(cosine);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        LightReceiver receiver;
        receiver.position =
            Vec3f(static_cast<float>(sine), 0.f, static_cast<float>(2.0 - cosine)); // distance 1
        const auto light = spot.sample(receiver, 0.5, Vec2f(0.5f), Measure::best);
        const double part = cosine >= 0.8 ? 1.0 : std::pow((cosine - 0.5) / 0.3, 4.0);
        if (cosine < 0.5)
            CHECK_FALSE(light);
        else
            CHECK(light->radiance[0] == Approx(intensity * part).epsilon(1e-4));
    }
    // The integral of the fall-off over the sphere: 1 - 0.8 + 0.3 / 5 of 2 pi.
    CHECK(spot.power() == Approx(intensity * 2.0 * pi_d * 0.26).epsilon(1e-5));
    CHECK_THAT(errors(start + "<emitter type='spot'><point name='target' value='0 0 0'/></emitter></scene>"),
               ContainsSubstring("target must not be where the light stands"));
    CHECK_THAT(errors(start +
                      "<emitter type='spot'><color name='power' value='1 1 1'/><color name='intensity' "
                      "value='1 1 1'/></emitter></scene>"),
               ContainsSubstring("power cannot be given together with intensity"));
}

TEST_CASE("the page of the scene language lists every type of the forks", "[unit][vocabulary]")
{
    const std::string page =
        read_bytes(std::filesystem::path(PLUMB_SOURCE_DIR) / "docs" / "scene-language.md");
    for (const TypeName& row : fork_words.types) {
        CAPTURE(row.kind, row.theirs);
        const std::size_t name =
            page.find(fmt::format("`{}`", row.theirs), page.find("## Words of Nori's forks"));
        REQUIRE(name != page.npos);
    }
}

TEST_CASE("types that no table has are known by the words of their names", "[unit][vocabulary]")
{
    const auto becomes = [](const std::string& kind, const std::string& theirs) {
        return only(arranged(element(kind, theirs))).value("type");
    };
    for (const auto& [kind, theirs, ours] : {
             std::tuple{"integrator", "volumetricPhotonMapper", "path_mis"},
             std::tuple{"integrator", "vol_path_integrator", "path_mis"},
             std::tuple{"integrator", "path_mis2", "path_mis"},
             std::tuple{"integrator", "direct_mis_new", "direct_mis"},
             std::tuple{"integrator", "direct_illumination_bsdf", "direct_mats"},
             std::tuple{"integrator", "direct_lights_ems", "direct_ems"},
             std::tuple{"texture", "image_texture_simple", "bitmap"},
             std::tuple{"texture", "normaltexture", "bitmap"},
             std::tuple{"emitter", "HDR_environment_emitter", "environment"},
             std::tuple{"emitter", "my_spot_light", "spot"},
             std::tuple{"emitter", "distant_directional_light", "directional"},
             std::tuple{"bsdf", "disneyPrincipledBRDF", "principled"},
             std::tuple{"bsdf", "rough_glass_bsdf", "roughdielectric"},
             std::tuple{"bsdf", "rough_conductor", "roughconductor"},
             std::tuple{"bsdf", "thin_dielectric", "thindielectric"},
             std::tuple{"bsdf", "metalMaterial", "conductor"},
             std::tuple{"bsdf", "texturedDiffuse", "diffuse"},
             std::tuple{"bsdf", "diffuseCoatedDielectric", "plastic"},
             std::tuple{"camera", "thinlens_camera_dof", "perspective"},
             std::tuple{"sampler", "halton_sequence", "sobol"},
             std::tuple{"sampler", "adaptive", "independent"},
         }) {
        CAPTURE(kind, theirs);
        CHECK(becomes(kind, theirs) == ours);
    }
    // One unknown word, or none that says what it is, and it stays what it is.
    for (const auto& [kind, theirs] :
         {std::pair{"integrator", "path_miss"}, std::pair{"integrator", "albedo"},
          std::pair{"integrator", "simple2"}, std::pair{"texture", "procedural_texture"},
          std::pair{"emitter", "texturearea"}, std::pair{"emitter", "textured_area_light"},
          std::pair{"bsdf", "difuse"}, std::pair{"bsdf", "velvet_diffuse"},
          std::pair{"sampler", "indpendent"}, std::pair{"camera", "fisheye"}, std::pair{"shape", "image"}}) {
        CAPTURE(kind, theirs);
        CHECK(becomes(kind, theirs) == theirs);
    }
    CHECK(arranged(
              "<integrator type='photon_map_integrator'><integer name='photonCount' value='9'/></integrator>")
              .messages == "this is rendered by 'path_mis', which finds the same light up to noise\n");
}

TEST_CASE("what integrators, samplers, mirrors and diffuse surfaces are told in other programs is not used, "
          "where no "
          "dialect is set",
          "[unit][vocabulary]")
{
    const std::string inner = "<integrator type='path_mis'><boolean name='rr' value='true'/></integrator>"
                              "<bsdf type='diffuse'><float name='roughness' value='1'/></bsdf>";
    const Arranged unset = arranged(inner, false, true);
    CHECK(unset.text == "<integrator type='path_mis'/><bsdf type='diffuse'/>");
    CHECK(unset.messages == "'rr' is not used: integrator 'path_mis' has no such parameter\n"
                            "'roughness' is not used: bsdf 'diffuse' has no such parameter\n");
    CHECK(arranged(inner).text == inner);
    // Neither misspellings, nor textures, nor what other BSDFs are told.
    for (const char* kept : {"<bsdf type='diffuse'><color name='albdo' value='1'/></bsdf>",
                             "<bsdf type='diffuse'><texture type='checker' name='shine'/></bsdf>",
                             "<bsdf type='dielectric'><color name='tint' value='1'/></bsdf>",
                             "<integrator type='path_mis'><integer name='maxDept' value='1'/></integrator>",
                             "<camera type='perspective'><boolean name='distortion' value='true'/></camera>"})
        CHECK(arranged(kept, false, true).text == kept);
}

TEST_CASE("an environment in a shape is the scene's", "[unit][vocabulary]")
{
    const Arranged result =
        arranged("<mesh type='sphere'><float name='radius' value='30'/><emitter type='environment'>"
                 "<string name='filename' value='a.exr'/></emitter></mesh><mesh type='sphere'/>");
    CHECK(result.text == "<emitter type='environment'><string name='filename' value='a.exr'/></emitter>"
                         "<mesh type='sphere'/>");
    CHECK(result.messages.starts_with("the sphere around an environment is left out"));
}

TEST_CASE("beams that end before they begin to fall off, and falloff as a number", "[unit][vocabulary]")
{
    const Arranged wide = arranged("<emitter type='spot'><float name='falloffStart' value='50'/>"
                                   "<float name='totalWidth' value='30'/></emitter>");
    CHECK(wide.text ==
          "<emitter type='spot'><float name='beamWidth' value='30'/><float name='cutoffAngle' value='30'/>"
          "<string name='falloff' value='quartic'/></emitter>");
    CHECK(wide.messages ==
          "the light would fall off from 50 degrees on, but ends at 30; it does not fall off\n");
    CHECK(arranged("<emitter type='spot'><float name='cone' value='20'/><float name='falloff' "
                   "value='10'/></emitter>")
              .text ==
          "<emitter type='spot'><float name='cutoffAngle' value='20'/>"
          "<float name='beamWidth' value='10'/><string name='falloff' value='quartic'/></emitter>");
    // Of our own words nothing is changed; they are checked when it is built.
    const std::string ours = "<emitter type='spot'><float name='beamWidth' value='50'/>"
                             "<float name='cutoffAngle' value='30'/></emitter>";
    CHECK(arranged(ours).text == ours);
}

TEST_CASE("a switch of the lens", "[unit][vocabulary]")
{
    const std::string lens = "<float name='lensRadius' value='1'/>";
    CHECK(
        arranged("<camera type='perspective'><boolean name='DoF' value='true'/>" + lens + "</camera>").text ==
        "<camera type='perspective'>" + lens + "</camera>");
    CHECK(arranged("<camera type='perspective'><boolean name='DoF' value='false'/>" + lens + "</camera>")
              .text == "<camera type='perspective'/>");
}

TEST_CASE("with --lenient, types that nobody knows are left out", "[unit][vocabulary]")
{
    const Arranged result =
        arranged("<bsdf type='velvet'/><bsdf type='diffuse'/><integrator type='albedo'/>", true);
    CHECK(result.text == "<bsdf type='diffuse'/><integrator type='albedo'/>");
    CHECK(result.messages == "unknown bsdf 'velvet'; it is left out\n");
    CHECK(arranged("<bsdf type='velvet'/>").text == "<bsdf type='velvet'/>");
}

TEST_CASE("a version does not make a scene of a fork one of Mitsuba's", "[unit][vocabulary]")
{
    const auto is_mitsuba = [](const std::string& inner, const std::string& attributes = "version='3.0.0'") {
        Diagnostics diagnostics;
        const auto root =
            parse_document("scene.xml", "<scene " + attributes + ">" + inner + "</scene>", diagnostics);
        return is_mitsuba_scene(*root);
    };
    CHECK(is_mitsuba(""));
    CHECK(is_mitsuba("<sensor type='perspective'/><shape type='sphere'/>"));
    CHECK(is_mitsuba("<shape type='sphere'/>"));
    CHECK_FALSE(is_mitsuba("<camera type='perspective'/>"));
    CHECK_FALSE(is_mitsuba("<mesh type='obj'/>"));
    CHECK(is_mitsuba("<sensor type='perspective'/><mesh type='obj'/>"));
    CHECK_FALSE(is_mitsuba("<sensor type='perspective'/>", "version='3.0.0' dialect='plumb'"));
    CHECK(load_text("<scene version='0.5.0'>" + start.substr(start.find('>') + 1) +
                    "<mesh type='sphere'/></scene>")
              .job.scene->objects()
              .size() == 1);
}
