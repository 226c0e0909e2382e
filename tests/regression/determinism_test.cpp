// SPDX-License-Identifier: MIT

// The same bits whatever the threads, tiles, passes and crops.

#include "support/catch.h"
#include "support/scene_text.h"

#include <cstring>

using namespace plumb;

namespace {

// Textured, glossy, glass, a mesh-like rectangle lamp, a sphere lamp and a point light; a filter with negative lobes.
constexpr const char* scene_text = R"(
<scene dialect="plumb">
    <integrator type="path_mis"/>
    <sampler type="independent"><integer name="sampleCount" value="20"/></sampler>
    <camera type="perspective">
        <integer name="width" value="53"/> <integer name="height" value="41"/>
        <float name="fov" value="50"/>
        <float name="lensRadius" value="0.05"/> <float name="focalDistance" value="4"/>
        <transform name="toWorld"><lookat origin="0,1.5,5" target="0,0.6,0" up="0,1,0"/></transform>
        <rfilter type="mitchell"/>
    </camera>
    <mesh type="rectangle">
        <vector name="normal" value="0,1,0"/> <float name="width" value="10"/> <float name="height" value="10"/>
        <bsdf type="diffuse">
            <texture type="checker" name="albedo">
                <integer name="scalex" value="8"/> <integer name="scaley" value="8"/>
            </texture>
        </bsdf>
    </mesh>
    <mesh type="sphere">
        <point name="center" value="-1,0.7,0"/> <float name="radius" value="0.7"/> <bsdf type="dielectric"/>
    </mesh>
    <mesh type="sphere">
        <point name="center" value="1,0.6,0.3"/> <float name="radius" value="0.6"/>
        <bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf>
    </mesh>
    <mesh type="rectangle">
        <point name="center" value="0,3,0"/> <vector name="normal" value="0,-1,0"/>
        <emitter type="area"><color name="radiance" value="6,5,4"/></emitter>
    </mesh>
    <mesh type="sphere">
        <point name="center" value="2,2,1"/> <float name="radius" value="0.1"/>
        <emitter type="area"><color name="radiance" value="60,50,70"/></emitter>
    </mesh>
    <emitter type="pointlight"><point name="position" value="-3,3,2"/><color name="radiance" value="9,9,9"/></emitter>
</scene>)";

bool same_bits(const Image& a, const Image& b, const PixelRect& window)
{
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (std::memcmp(a.pixel(x, y), b.pixel(x, y), 3 * sizeof(float)) != 0) return false;
    return true;
}

} // namespace

TEST_CASE("an image has the same bits for any threads, tiles and crop", "[regression][determinism]")
{
    const LoadedScene loaded = test::load_text(scene_text);
    RenderOptions options;
    options.seed = 5;
    options.threads = 1;
    const Image whole = render(loaded.job, options).film.develop();
    const PixelRect window = whole.data_window();
    REQUIRE(window == PixelRect{0, 0, 53, 41});

    for (const int threads : {3, 16}) {
        options.threads = threads;
        options.tile_size = 7 + threads;
        CHECK(same_bits(whole, render(loaded.job, options).film.develop(), window));
    }
    for (const PixelRect crop :
         {PixelRect{0, 0, 1, 1}, PixelRect{10, 5, 21, 13}, PixelRect{40, 30, 13, 11}}) {
        options.crop = crop;
        const Image part = render(loaded.job, options).film.develop();
        CHECK(part.data_window() == crop);
        CHECK(same_bits(whole, part, crop));
    }

    options.crop.reset();
    options.seed = 6; // and the test can fail
    CHECK_FALSE(same_bits(whole, render(loaded.job, options).film.develop(), window));
}

TEST_CASE("a replayed sample is the sample that was rendered", "[regression][determinism]")
{
    const LoadedScene loaded = test::load_text(scene_text);
    const Vec2i pixel(26, 20);
    RenderOptions options;
    options.seed = 9;
    options.crop = PixelRect{pixel.x, pixel.y, 1, 1};
    const RenderState rendered = render(loaded.job, options);

    Film film(*options.crop, 53, 41);
    for (std::uint64_t index = 0; index < 20; ++index) {
        const ReplayedSample sample = replay(loaded.job, options, pixel, index);
        CHECK_FALSE(sample.log.empty());
        REQUIRE(film.add(pixel, sample.value, sample.weight) == SampleStatus::accepted);
    }
    CHECK(same_bits(film.develop(), rendered.film.develop(), *options.crop));
}

TEST_CASE("render refuses options that make no sense", "[regression][determinism]")
{
    const LoadedScene loaded = test::load_text(scene_text);
    RenderOptions options;
    options.crop = PixelRect{50, 0, 4, 4};
    CHECK_THROWS_WITH(render(loaded.job, options),
                      "the crop 50,0,4,4 is not inside the image of 53x41 pixels");
    options.crop.reset();
    options.samples_per_pixel = film_max_samples + 1;
    CHECK_THROWS_WITH(render(loaded.job, options),
                      "samples per pixel must be from 1 to 67108864, not 67108865");
    CHECK_THROWS_WITH(replay(loaded.job, {}, {53, 0}, 0),
                      "pixel 53,0 is not inside the image of 53x41 pixels");
}
