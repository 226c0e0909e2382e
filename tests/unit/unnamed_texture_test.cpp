// SPDX-License-Identifier: MIT

// A <texture> without a name is for the one parameter that can be a texture.

#include "scene_file/catalog.h"
#include "support/catch.h"
#include "support/scene_text.h"

using namespace plumb;
using namespace plumb::test;

namespace {

std::string with_texture(const std::string& kind, const std::string& type, const std::string& attributes,
                         const std::string& more = "")
{
    const std::string object = "<" + kind + " type='" + type + "'>" + more +
                               "<texture type='constant_color' " + attributes + "/></" + kind + ">";
    return start + "<mesh type='sphere'>" + object + "</mesh></scene>";
}

} // namespace

TEST_CASE("an unnamed texture is taken where only one parameter can be one", "[unit][texture]")
{
    CHECK(errors(with_texture("bsdf", "diffuse", "")).empty());
    CHECK(errors(with_texture("emitter", "area", "")).empty());
    // It is the texture that is seen, not the default.
    const LoadedScene scene =
        load_text(start + "<mesh type='sphere'><bsdf type='diffuse'><texture type='constant_color'>"
                          "<color name='value' value='0.25,0.5,0.75'/></texture></bsdf></mesh></scene>");
    const auto value =
        scene.job.scene->objects().front().bsdf->evaluate(SurfacePoint(), Vec3f(0, 0, 1), Vec3f(0, 0, 1));
    CHECK_THAT(value.f_cos.g, Catch::Matchers::WithinRel(0.5f * inv_pi, 1e-5f));
    CHECK_THAT(value.f_cos.b, Catch::Matchers::WithinRel(0.75f * inv_pi, 1e-5f));
}

TEST_CASE("an unnamed texture that could be for several parameters gets their names", "[unit][texture]")
{
    CHECK_THAT(
        errors(with_texture("bsdf", "roughconductor", "")),
        ContainsSubstring(
            "error: <texture> needs an attribute 'name', for bsdf 'roughconductor' takes several: "
            "name=\"alpha\", name=\"alphaU\", name=\"alphaV\", name=\"R0\", name=\"eta\", name=\"k\" or "
            "name=\"specularReflectance\"\n"));
    CHECK_THAT(errors(with_texture("bsdf", "mirror", "")),
               ContainsSubstring("error: bsdf 'mirror' takes no texture\n"));
    CHECK_THAT(errors(with_texture("bsdf", "diffuse", "", "<color name='albedo' value='1,1,1'/>")),
               ContainsSubstring("error: 'albedo' is given twice; first given at line 1\n"));
    CHECK_THAT(errors(with_texture("bsdf", "diffuse", "", "<texture type='constant_color'/>")),
               ContainsSubstring("error: 'albedo' is given twice; first given at line 1\n"));
}

// The manual's word against the constructors'.
TEST_CASE("the manuals say which parameters can be textures", "[unit][texture]")
{
    for (const TypeInfo& type : known_types()) {
        const std::string kind(type.kind), name(type.name);
        if (kind != "bsdf" && name != "area") continue;
        CAPTURE(name);
        const std::vector<std::string_view> textures = texture_parameters_of(kind, name);
        for (const std::string_view parameter : parameters_in(type.manual)) {
            CAPTURE(parameter);
            const bool listed = std::find(textures.begin(), textures.end(), parameter) != textures.end();
            const bool taken = errors(with_texture(kind, name, "name='" + std::string(parameter) + "'"))
                                   .find("unknown texture") == std::string::npos;
            CHECK(listed == taken);
        }
        std::string more; // the BSDFs that it needs inside
        for (int i = 0; i < 2; ++i)
            if (errors(with_texture(kind, name, "", more)).find("<bsdf>") != std::string::npos)
                more += "<bsdf type='diffuse'/>";
        CHECK(errors(with_texture(kind, name, "", more)).empty() == (textures.size() == 1));
    }
}
