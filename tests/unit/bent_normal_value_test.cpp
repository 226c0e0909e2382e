// SPDX-License-Identifier: MIT

// Normal and bump maps beside Mitsuba 3.9.1: a white square of width 2 under a sun of irradiance pi.

#include "plumb/image/image.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/temp_directory.h"

using namespace plumb;

namespace {

// The radiance towards +z where the square's BSDF is `bsdf`, with light from `sun`. Files are found in the directory.
float radiance(const TempDirectory& directory, const std::string& bsdf, const Vec3f& sun, double width = 2.0)
{
    const std::string size = std::to_string(width);
    const LoadedScene loaded = load_scene(directory.write(
        "scene.xml", "<scene dialect='plumb'><integrator type='normals'/><camera type='perspective'/>"
                     "<shape type='rectangle'><float name='width' value='" +
                         size + "'/><float name='height' value='" + size + "'/>" + bsdf +
                         "</shape></scene>"));
    const Scene& scene = *loaded.job.scene;
    const auto at = scene.intersect(Ray{Vec3f(0.01f, 0.01f, 5.f), Vec3f(0.f, 0.f, -1.f), 0.f, infinity});
    REQUIRE(at);
    const Vec3f wi = at->shading.to_local(Vec3f(0.f, 0.f, 1.f)), wo = at->shading.to_local(sun);
    return at->bsdf->evaluate(*at, wi, wo).f_cos.g * pi;
}

const std::string white = "<bsdf type='diffuse'><color name='albedo' value='1,1,1'/></bsdf>";

std::string normal_map(const std::string& normal)
{
    return "<bsdf type='normalmap'><boolean name='useShadowing' value='true'/><color name='normal' value='" +
           normal + "'/>" + white + "</bsdf>";
}

std::string bump_map(const std::string& file, const std::string& scale = "1", const std::string& name = "x")
{
    return "<bsdf type='bumpmap'><boolean name='useShadowing' value='true'/><float name='scale' value='" +
           scale + "'/><texture type='bitmap' name='" + name +
           "'><string name='wrap' value='clamp'/><string name='vOrigin' value='top'/>"
           "<string name='filename' value='" +
           file + "'/></texture>" + white + "</bsdf>";
}

const Vec3f up(0.f, 0.f, 1.f), from_x(0.6f, 0.f, 0.8f), from_minus_x(-0.6f, 0.f, 0.8f),
    from_y(0.f, 0.6f, 0.8f), from_minus_y(0.f, -0.6f, 0.8f);

} // namespace

TEST_CASE("normal maps have the values that Mitsuba 3 has", "[unit][bsdf][mitsuba]")
{
    const TempDirectory directory;
    const auto value = [&](const std::string& normal, const Vec3f& sun) {
        return radiance(directory, normal_map(normal), sun);
    };
    CHECK(value("0.5,0.5,1", up) == Approx(1.0).epsilon(1e-5));
    CHECK(value("0.8,0.5,0.9", from_x) == Approx(.990303).epsilon(1e-4));
    CHECK(value("0.8,0.5,0.9", from_minus_x) == Approx(.277285).epsilon(1e-4));
    CHECK(value("0.5,0.8,0.9", from_y) == Approx(.990303).epsilon(1e-4));
    CHECK(value("0.5,0.8,0.9", from_minus_y) == Approx(.277285).epsilon(1e-4));
    CHECK(value("0.65,0.5,0.7", from_x) == Approx(.990303).epsilon(1e-4)); // not of unit length
    CHECK(value("0.9,0.5,0.8", Vec3f(-0.8f, 0.f, 0.6f)) == 0.f);
    // Without the shadowing it is the cosine alone.
    const std::string plain =
        "<bsdf type='normalmap'><color name='normal' value='0.8,0.5,0.9'/>" + white + "</bsdf>";
    CHECK(radiance(directory, plain, from_minus_x) == Approx(.28).epsilon(1e-5));
}

TEST_CASE("bump maps have the values that Mitsuba 3 has", "[unit][bsdf][mitsuba]")
{
    // Heights that rise by 1 over the width or the height of the image.
    const TempDirectory directory;
    Image along_u(64, 2), along_v(2, 64);
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 2; ++j)
            for (int c = 0; c < 3; ++c)
                along_u.pixel(i, j)[c] = along_v.pixel(j, i)[c] = static_cast<float>(i) / 64.f;
    write_image(directory / "u.exr", along_u);
    write_image(directory / "v.exr", along_v);
    const auto value = [&](const std::string& bsdf, const Vec3f& sun, double width = 2.0) {
        return radiance(directory, bsdf, sun, width);
    };
    CHECK(value(bump_map("u.exr"), up) == Approx(.894427).epsilon(1e-4));
    CHECK(value(bump_map("u.exr"), from_x) == Approx(.445265).epsilon(1e-4));
    CHECK(value(bump_map("u.exr"), from_minus_x) == Approx(.979584).epsilon(1e-4));
    CHECK(value(bump_map("v.exr"), from_y) == Approx(.445265).epsilon(1e-4));
    CHECK(value(bump_map("v.exr"), from_minus_y) == Approx(.979584).epsilon(1e-4));
    CHECK(value(bump_map("u.exr", "2"), from_x) == Approx(.139019).epsilon(1e-4));
    CHECK(value(bump_map("u.exr"), up, 4.0) ==
          Approx(.970142).epsilon(1e-4)); // the slope is that of the world
    CHECK(value(bump_map("u.exr", "1", "whatever"), up) == Approx(.894427).epsilon(1e-4));
}
