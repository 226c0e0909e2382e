// SPDX-License-Identifier: MIT

// BSDFs inside BSDFs, and <ref>.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

const Bsdf* bsdf_of(const LoadedScene& scene, std::size_t object)
{
    return scene.job.scene->objects().at(object).bsdf.get();
}

float albedo_of(const Bsdf& bsdf)
{
    const Vec3f up(0, 0, 1);
    return bsdf.evaluate(SurfacePoint(), up, up).f_cos.r * pi;
}

// The first line of the errors, without the directory.
std::string first_error(const std::string& xml)
{
    const std::string all = errors(start + xml + "</scene>");
    const std::size_t at = all.find("scene.xml:");
    REQUIRE(at != all.npos);
    return all.substr(at, all.find('\n', at) - at);
}

const std::string ball = "<shape type='sphere'>";

} // namespace

TEST_CASE("one BSDF of many shapes is one object", "[unit][shared_objects]")
{
    const LoadedScene scene =
        load_text(start + "<shape type='sphere'><ref id='a'/></shape>" // before it stands there
                  + "<bsdf type='diffuse' id='a'><color name='albedo' value='0.25 0 0'/></bsdf>" + ball +
                  "<ref id='a'/></shape>" + ball + "<bsdf type='diffuse' id='b'/></shape>" + ball +
                  "<ref id='b'/></shape></scene>");
    CHECK(bsdf_of(scene, 0) == bsdf_of(scene, 1));
    CHECK(bsdf_of(scene, 2) == bsdf_of(scene, 3));
    CHECK(bsdf_of(scene, 0) != bsdf_of(scene, 2));
    CHECK(albedo_of(*bsdf_of(scene, 0)) == Approx(0.25));
}

TEST_CASE("BSDFs and textures inside BSDFs, in place and by reference", "[unit][shared_objects]")
{
    const LoadedScene scene =
        load_text(start + ball +
                  "<bsdf type='twosided'><ref id='in'/><bsdf type='diffuse'><color name='albedo' value='0.75 "
                  "0 0'/></bsdf></bsdf>"
                  "</shape><bsdf type='diffuse' id='in'><ref id='paint' name='albedo'/></bsdf>"
                  "<texture type='constant_color' id='paint'><color name='value' value='0.125 0 "
                  "0'/></texture></scene>");
    const Bsdf& bsdf = *bsdf_of(scene, 0);
    CHECK(albedo_of(bsdf) == Approx(0.125));
    const Vec3f down(0, 0, -1);
    CHECK(bsdf.evaluate(SurfacePoint(), down, down).f_cos.r * pi == Approx(0.75));
}

TEST_CASE("a texture by reference needs no name where one parameter takes it", "[unit][shared_objects]")
{
    const LoadedScene scene = load_text(
        start + "<texture type='constant_color' id='t'><color name='value' value='0.5 0 0'/></texture>" +
        ball + "<bsdf type='diffuse'><ref id='t'/></bsdf></shape></scene>");
    CHECK(albedo_of(*bsdf_of(scene, 0)) == Approx(0.5));
}

TEST_CASE("references that lead nowhere are located errors", "[unit][shared_objects]")
{
    const std::string gold = "<bsdf type='diffuse' id='gold'/>";
    CHECK_THAT(first_error(gold + ball + "<ref id='gild'/></shape>"),
               ContainsSubstring("error: no <bsdf> or <texture> has the id 'gild'; did you mean 'gold'?"));
    CHECK_THAT(first_error(ball + "<ref id='gold'/></shape>"),
               ContainsSubstring("error: no <bsdf> or <texture> has the id 'gold'"));
    CHECK_THAT(first_error(ball + "<ref/></shape>"),
               ContainsSubstring("error: <ref> needs an attribute 'id'"));
    CHECK_THAT(first_error("<texture type='checker' id='t'/>" + ball + "<ref id='t'/></shape>"),
               ContainsSubstring("error: 't' is a <texture>, not a <bsdf>"));
    CHECK_THAT(first_error(gold + gold + ball + "<ref id='gold'/></shape>"),
               ContainsSubstring("error: the id 'gold' is given twice; first given at line 1"));
    CHECK_THAT(
        first_error("<bsdf type='diffuse'/>"),
        ContainsSubstring("error: a <bsdf> that stands in <scene> needs an id, for a <ref> to name: <bsdf "
                          "id=\"...\" ...>"));
    CHECK_THAT(first_error(gold + ball + "<emitter type='area'><ref id='gold'/></emitter></shape>"),
               ContainsSubstring("error: an <emitter> cannot contain a <bsdf>"));
}

TEST_CASE("children that a BSDF does not take, or lacks, are located errors", "[unit][shared_objects]")
{
    const auto inside = [](const std::string& bsdf) { return first_error(ball + bsdf + "</shape>"); };
    CHECK_THAT(
        inside("<bsdf type='twosided'/>"),
        ContainsSubstring("error: bsdf 'twosided' needs a <bsdf> inside it: <bsdf type=\"diffuse\"/>"));
    CHECK_THAT(inside("<bsdf type='diffuse'><bsdf type='mirror'/></bsdf>"),
               ContainsSubstring("error: bsdf 'diffuse' takes no <bsdf> inside it"));
    CHECK_THAT(inside("<bsdf type='normalmap'><bsdf type='diffuse'/><bsdf type='mirror'/></bsdf>"),
               ContainsSubstring("error: bsdf 'normalmap' takes one <bsdf> inside it"));
    CHECK_THAT(inside("<bsdf type='twosided'><bsdf type='dielectric'/></bsdf>"),
               ContainsSubstring(
                   "error: a BSDF that transmits light has a back already; use it without 'twosided'"));
}

TEST_CASE("a BSDF that contains itself is an error with the way around", "[unit][shared_objects]")
{
    const std::string all = errors(start + R"(
<bsdf type='twosided' id='a'><ref id='b'/></bsdf>
<bsdf type='twosided' id='b'><bsdf type='normalmap' id='c'><ref id='a'/></bsdf></bsdf>
<shape type='sphere'><ref id='c'/></shape></scene>)");
    CHECK_THAT(all, ContainsSubstring("scene.xml:3:60: error: bsdf 'a' contains itself"));
    CHECK_THAT(all, ContainsSubstring("scene.xml:3:1: note: through bsdf 'b'"));
    CHECK_THAT(all, ContainsSubstring("scene.xml:3:30: note: through bsdf 'c'"));
    CHECK(all.find("contains itself") == all.rfind("contains itself"));
}

TEST_CASE("BSDFs are nested 64 deep at most", "[unit][shared_objects]")
{
    const auto chain = [](int length) {
        std::string text = start + "<bsdf type='diffuse' id='b0'/>";
        for (int i = 1; i < length; ++i)
            text += fmt::format("<bsdf type='twosided' id='b{}'><ref id='b{}'/></bsdf>", i, i - 1);
        return text + fmt::format("<shape type='sphere'><ref id='b{}'/></shape></scene>", length - 1);
    };
    CHECK(errors(chain(64)).empty());
    // The last one comes first, so that all are built below it.
    std::string deep = start + ball + "<ref id='b99'/></shape>";
    for (int i = 99; i > 0; --i)
        deep += fmt::format("<bsdf type='twosided' id='b{}'><ref id='b{}'/></bsdf>", i, i - 1);
    CHECK_THAT(errors(deep + "<bsdf type='diffuse' id='b0'/></scene>"),
               ContainsSubstring("error: more than 64 BSDFs are inside each other"));
}

TEST_CASE("only oriented BSDFs turn the shading frame along dp/du", "[unit][shared_objects]")
{
    const std::string turned =
        "<shape type='rectangle'><transform name='toWorld'><rotate axis='0,0,1' angle='30'/>"
        "</transform>";
    const LoadedScene scene =
        load_text(start + turned + "<bsdf type='normalmap'><bsdf type='diffuse'/></bsdf></shape></scene>");
    const LoadedScene plain = load_text(start + turned + "<bsdf type='diffuse'/></shape></scene>");
    const Ray ray(Vec3f(0.1f, 0.1f, 1), Vec3f(0, 0, -1));
    const auto along = scene.job.scene->intersect(ray), as_ever = plain.job.scene->intersect(ray);
    REQUIRE((along && as_ever));
    const Vec3f dp_du = along->shape->tangents(*along).dp_du;
    CHECK(length(along->shading.s - normalize(dp_du)) < 1e-6f);
    CHECK(as_ever->shading.s == Frame(Vec3f(0, 0, 1)).s);
    CHECK(along->shading.n == as_ever->shading.n);
}

TEST_CASE("textures that are built side by side say each thing once, in the order of the file",
          "[unit][shared_objects]")
{
    const auto texture = [](const std::string& file) {
        return "<texture type='bitmap' name='albedo'><string name='filename' value='" + file +
               "'/></texture>";
    };
    std::string scene = start;
    for (int i = 0; i < 12; ++i)
        scene += fmt::format(
            "<bsdf type='diffuse' id='b{0}'>{1}</bsdf>\n<shape type='sphere'><ref id='b{0}'/></shape>\n"
            "<shape type='sphere'><ref id='b{0}'/></shape>\n",
            i, texture(fmt::format("none{}.png", i)));
    const std::string all = errors(scene + "</scene>");
    std::size_t at = 0;
    for (int i = 0; i < 12; ++i) {
        const std::size_t next = all.find(fmt::format("/none{}.png'", i), at);
        REQUIRE(next != all.npos);
        CHECK(all.find(fmt::format("/none{}.png'", i), next + 1) == all.npos);
        at = next;
    }

    // Files count, and the memory that their images take.
    const TempDirectory directory;
    const std::string tga_of_2x2("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\30\40", 18); // 24 bits a pixel
    for (const char* name : {"a.tga", "b.tga"}) directory.write(name, tga_of_2x2 + std::string(12, 'z'));
    const LoadedScene loaded = load_scene(
        directory.write("scene.xml", start + "<bsdf type='diffuse' id='a'>" + texture("a.tga") +
                                         "</bsdf><bsdf type='diffuse' id='b'>" + texture("b.tga") +
                                         "</bsdf><shape type='sphere'><ref id='a'/></shape></scene>"));
    CHECK(loaded.inputs.size() == 3);
    CHECK(loaded.texture_bytes == 2 * 12);
}
