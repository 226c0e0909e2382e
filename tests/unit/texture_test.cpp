// SPDX-License-Identifier: MIT

#include "plumb/image/image.h"
#include "plumb/model/surface.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"
#include "support/temp_directory.h"

namespace plumb {
class Checker;
class Checkerboard;
class ConstantTexture;
class TextMap;
class ImageTexture;
class BitmapTexture;
class Quarters;
class RawConstant;
class MeshAttributeTexture;
} // namespace plumb

using namespace plumb;
using plumb::test::ParamsBuilder;
using plumb::test::TestRandom;

namespace {

void check_close(const Color& a, const Color& b, float tolerance = 1e-5f)
{
    CAPTURE(a.r, a.g, a.b, b.r, b.g, b.b);
    CHECK(max_component(a - b) <= tolerance);
    CHECK(min_component(a - b) >= -tolerance);
}

// Mean and bounds against a fine grid of lookups over the unit square; the bounds hold outside it too.
void check_statistics(const Texture& texture, float tolerance)
{
    constexpr int n = 500;
    double sum[3] = {};
    float smallest = infinity;
    float largest = -infinity;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Vec2f uv((static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n);
            const Color color = texture.color(uv);
            for (int c = 0; c < 3; ++c) sum[c] += color[c] / double(n * n);
            smallest = std::min(smallest, min_component(color));
            largest = std::max(largest, max_component(color));
        }
    check_close(texture.mean(), Color(float(sum[0]), float(sum[1]), float(sum[2])), tolerance);
    CHECK(texture.min_value() <= smallest);
    CHECK(texture.max_value() >= largest);
    TestRandom random;
    for (int i = 0; i < 1000; ++i) {
        const Vec2f uv(float(random.between(-50, 50)), float(random.between(-50, 50)));
        const Color color = texture.color(uv);
        CHECK(min_component(color) >= texture.min_value() - 1e-6f);
        CHECK(max_component(color) <= texture.max_value() + 1e-6f);
        CHECK(texture.number(uv) == number_of(color));
    }
}

// 3 x 2 texels, all different, each a multiple of 1/255.
Color texel(int x, int y)
{
    return Color(static_cast<float>(x * 60 + y * 20 + 20), static_cast<float>(x * 100),
                 static_cast<float>(y * 200)) /
           255.f;
}

Image small_image()
{
    Image image(3, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = linear_from_srgb(texel(x, y)[c]);
    return image;
}

Color decoded(const Color& c)
{
    return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}

} // namespace

TEST_CASE("checker alternates between two colours, below zero too", "[unit][texture]")
{
    const Color first(0.8f, 0.1f, 0.3f);
    const Color second(0.2f, 0.6f, 0.f);
    const auto texture = ParamsBuilder("texture", "checker")
                             .integer("scalex", 4)
                             .number("scaley", 2.5)
                             .color("color1", first)
                             .color("color2", second)
                             .build<Checker, Texture>();
    for (int j = -5; j < 5; ++j)
        for (int i = -5; i < 5; ++i) {
            const Color expected = (i + j) % 2 == 0 ? first : second;
            CHECK(texture->color({(static_cast<float>(i) + 0.5f) / 4.f,
                                  (static_cast<float>(j) + 0.5f) / 2.5f}) == expected);
            CHECK(texture->color({(static_cast<float>(i) + 0.01f) / 4.f,
                                  (static_cast<float>(j) + 0.99f) / 2.5f}) == expected);
        }
    check_statistics(*texture, 1e-6f);
}

TEST_CASE("checker has the course's defaults, and its reading of color", "[unit][texture]")
{
    const auto plain = ParamsBuilder("texture", "checker").integer("scalex", 2).build<Checker, Texture>();
    CHECK(plain->color({0.25f, 0.5f}) == Color(0.9f));
    CHECK(plain->color({0.75f, 0.5f}) == Color(0.1f));

    std::vector<Diagnostic> found;
    const auto both = ParamsBuilder("texture", "checker")
                          .color("color", Color(0.5f))
                          .integer("scalex", 2)
                          .build_with([](const Params& p) { return build<Checker, Texture>(p); }, found);
    CHECK(both->color({0.25f, 0.5f}) == Color(0.5f));
    CHECK(both->color({0.75f, 0.5f}) == Color(0.5f));
    REQUIRE(found.size() == 1);
    CHECK(found[0].severity == Severity::warning);
    CHECK_THAT(found[0].message, ContainsSubstring("sets both colours"));

    CHECK(ParamsBuilder("texture", "checker").number("scalex", -1.0).complaints<Checker, Texture>() ==
          std::vector<std::string>{"error: scalex must be greater than 0, not -1"});
}

TEST_CASE("a checker of which one black cell shows is not black on average", "[unit][texture]")
{
    const auto texture = ParamsBuilder("texture", "checker")
                             .color("color1", Color(0.f))
                             .color("color2", Color(0.5f))
                             .build<Checker, Texture>();
    CHECK_FALSE(texture->mean().is_black());
}

TEST_CASE("checkerboard has cells of the given size and offset", "[unit][texture]")
{
    const Color first(0.8f, 0.1f, 0.3f);
    const Color second(0.2f, 0.6f, 0.f);
    const auto texture = ParamsBuilder("texture", "checkerboard_color")
                             .color("value1", first)
                             .color("value2", second)
                             .vector2("scale", {0.2f, 0.35f})
                             .vector2("delta", {0.5f, -0.1f})
                             .build<Checkerboard, Texture>();
    for (int j = -5; j < 5; ++j)
        for (int i = -5; i < 5; ++i) {
            // Cells are counted from delta, in cells.
            const Vec2f uv(0.2f * (0.5f + static_cast<float>(i) + 0.5f),
                           0.35f * (-0.1f + static_cast<float>(j) + 0.5f));
            CHECK(texture->color(uv) == ((i + j) % 2 == 0 ? first : second));
        }
    check_statistics(*texture, 2e-3f); // the grid does not meet the cells' borders
}

TEST_CASE("checkerboard of numbers, and its defaults", "[unit][texture]")
{
    const auto numbers = ParamsBuilder("texture", "checkerboard_float")
                             .number("value1", 0.25)
                             .number("value2", 0.75)
                             .build<Checkerboard, Texture>();
    CHECK(numbers->color({0.5f, 0.5f}) == Color(0.25f));
    CHECK(numbers->color({1.5f, 0.5f}) == Color(0.75f));
    CHECK(numbers->number({1.5f, 0.5f}) == 0.75f);
    const auto plain = ParamsBuilder("texture", "checkerboard_color").build<Checkerboard, Texture>();
    CHECK(plain->color({0.5f, 0.5f}) == Color(0.f));
    CHECK(plain->color({0.5f, 1.5f}) == Color(1.f));
    CHECK(ParamsBuilder("texture", "checkerboard_color")
              .vector2("scale", {1.f, 0.f})
              .complaints<Checkerboard, Texture>() ==
          std::vector<std::string>{"error: scale must be greater than 0 in both, not 1 0"});
}

TEST_CASE("constant textures", "[unit][texture]")
{
    const Color value(0.1f, 0.2f, 0.3f);
    const auto color =
        ParamsBuilder("texture", "constant_color").color("value", value).build<ConstantTexture, Texture>();
    CHECK(color->color({0.3f, -7.f}) == value);
    CHECK(color->mean() == value);
    CHECK(color->min_value() == 0.1f);
    CHECK(color->max_value() == 0.3f);
    const auto number =
        ParamsBuilder("texture", "constant_float").number("value", 0.4).build<ConstantTexture, Texture>();
    CHECK(number->color({0.3f, -7.f}) == Color(0.4f));
}

TEST_CASE("textmap reads against u and v, undecoded, with texels at whole coordinates", "[unit][texture]")
{
    const TempDirectory directory;
    write_image(directory / "a.png", small_image());
    const Color tint(1.f, 0.5f, 0.25f);
    const auto texture = ParamsBuilder("texture", "textmap")
                             .directory(directory.path())
                             .string("filename", "a.png")
                             .color("color", tint)
                             .build<TextMap, Texture>();
    for (int period = -2; period <= 2; ++period)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x) {
                const auto shift = static_cast<float>(period);
                const Vec2f uv(1.f - static_cast<float>(x) / 3.f + shift,
                               1.f - static_cast<float>(y) / 2.f - shift);
                check_close(texture->color(uv), texel(x, y) * tint);
            }
    // Halfway between columns, and a quarter of the way from the last row to the first.
    check_close(texture->color({1.f - 0.5f / 3.f, 1.f}), (texel(0, 0) + texel(1, 0)) * 0.5f * tint);
    check_close(texture->color({1.f - 2.5f / 3.f, 1.f}), (texel(2, 0) + texel(0, 0)) * 0.5f * tint);
    check_close(texture->color({1.f, 1.f - 1.25f / 2.f}), (texel(0, 1) * 0.75f + texel(0, 0) * 0.25f) * tint);
    check_statistics(*texture, 1e-4f);
}

TEST_CASE("textmap warns of the scales that the course ignores", "[unit][texture]")
{
    const TempDirectory directory;
    write_image(directory / "a.png", small_image());
    const auto builder =
        ParamsBuilder("texture", "textmap").directory(directory.path()).string("filename", "a.png");
    CHECK(ParamsBuilder(builder)
              .number("scalex", 1.0)
              .number("scaley", 1.0)
              .complaints<TextMap, Texture>()
              .empty());
    const auto complaints = ParamsBuilder(builder).number("scaley", 3.0).complaints<TextMap, Texture>();
    REQUIRE(complaints.size() == 1);
    CHECK_THAT(complaints[0], ContainsSubstring("warning: 'scaley' of a textmap has no effect"));
}

TEST_CASE("imagetexture_color3f shows images upright and decoded", "[unit][texture]")
{
    const TempDirectory directory;
    write_image(directory / "a.png", small_image());
    const bool raw = GENERATE(false, true);
    const auto texture = ParamsBuilder("texture", "imagetexture_color3f")
                             .directory(directory.path())
                             .string("filepath", "a.png")
                             .boolean("raw", raw)
                             .build<ImageTexture, Texture>();
    const auto expected = [raw](int x, int y) { return raw ? texel(x, y) : decoded(texel(x, y)); };
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            const Vec2f middle((static_cast<float>(x) + 0.5f) / 3.f,
                               1.f - (static_cast<float>(y) + 0.5f) / 2.f);
            check_close(texture->color(middle), expected(x, y));
            check_close(texture->color(middle + Vec2f(-3.f, 5.f)), expected(x, y));
        }
    check_close(texture->color({0.f, 0.75f}), (expected(0, 0) + expected(2, 0)) * 0.5f); // repeats
    check_statistics(*texture, 1e-4f);
}

TEST_CASE("image textures of floats are not decoded", "[unit][texture]")
{
    const TempDirectory directory;
    Image image(1, 1);
    for (int c = 0; c < 3; ++c) image.pixel(0, 0)[c] = 0.5f;
    write_image(directory / "a.exr", image);
    const auto texture = ParamsBuilder("texture", "imagetexture_color3f")
                             .directory(directory.path())
                             .string("filepath", "a.exr")
                             .build<ImageTexture, Texture>();
    CHECK(texture->color({0.2f, 0.9f}) == Color(0.5f));
}

TEST_CASE("image textures with values that are not finite are errors", "[unit][texture]")
{
    const TempDirectory directory;
    Image image(4, 3);
    image.pixel(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
    write_image(directory / "a.exr", image);
    const auto builder = ParamsBuilder("texture", "imagetexture_color3f")
                             .directory(directory.path())
                             .string("filepath", "a.exr");
    CHECK_THROWS_WITH((builder.build<ImageTexture, Texture>()),
                      ContainsSubstring("pixel (2, 1) is not finite"));
}

namespace {

// One row: 0, 1, 2, 3 in red.
ParamsBuilder ramp(const TempDirectory& directory)
{
    Image image(4, 1);
    for (int x = 0; x < 4; ++x) image.pixel(x, 0)[0] = static_cast<float>(x);
    write_image(directory / "ramp.exr", image);
    return ParamsBuilder("texture", "bitmap").directory(directory.path()).string("filename", "ramp.exr");
}

// At the middles of 16 equal parts of u.
void check_row(const Texture& texture, const std::vector<float>& expected)
{
    for (std::size_t i = 0; i < 16; ++i) {
        CAPTURE(i);
        const Color color = texture.color({(static_cast<float>(i) + 0.5f) / 16.f, 0.3f});
        CHECK(color.r == Approx(expected[i]).margin(1e-6));
        CHECK(color.g == 0.f);
    }
}

} // namespace

TEST_CASE("bitmap has the wrap modes and filters of Mitsuba 3", "[unit][texture][mitsuba]")
{
    const TempDirectory directory;
    const std::vector<float> edges = {0.f,    0.f,    .125f,  .375f,  .625f,  .875f,  1.125f, 1.375f,
                                      1.625f, 1.875f, 2.125f, 2.375f, 2.625f, 2.875f, 3.f,    3.f};
    std::vector<float> repeated = edges;
    repeated[0] = 1.125f, repeated[1] = 0.375f, repeated[14] = 2.625f, repeated[15] = 1.875f;
    check_row(*ramp(directory).build<BitmapTexture, Texture>(), repeated);
    check_row(*ramp(directory).string("wrap", "clamp").build<BitmapTexture, Texture>(), edges);
    check_row(*ramp(directory).string("wrap", "mirror").build<BitmapTexture, Texture>(), edges);
    check_row(*ramp(directory).string("filter", "nearest").build<BitmapTexture, Texture>(),
              {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3});
    const Transform to_uv = Transform::translate({0.25, 0, 0}) * *Transform::scale({2, 1, 1});
    check_row(
        *ramp(directory).string("filter", "nearest").transform("toUv", to_uv).build<BitmapTexture, Texture>(),
        {1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3, 0, 0});

    // Beyond the unit square: every second copy is mirrored; clamped, the edge goes on.
    const auto mirrored = ramp(directory).string("wrap", "mirror").build<BitmapTexture, Texture>();
    const auto clamped = ramp(directory).string("wrap", "clamp").build<BitmapTexture, Texture>();
    for (const float u : {0.05f, 0.3f, 0.77f}) {
        CHECK(mirrored->color({-u, 0.f}).r == Approx(mirrored->color({u, 0.f}).r).margin(1e-5));
        CHECK(mirrored->color({2.f + u, 0.f}).r == Approx(mirrored->color({u, 0.f}).r).margin(1e-5));
        CHECK(clamped->color({-u, 0.f}).r == 0.f);
        CHECK(clamped->color({1.f + u, 7.f}).r == 3.f);
    }
}

TEST_CASE("bitmap stands upright or on its head, and keeps 8 bits", "[unit][texture]")
{
    const TempDirectory directory;
    write_image(directory / "a.png", small_image());
    const auto builder =
        ParamsBuilder("texture", "bitmap").directory(directory.path()).string("filename", "a.png");
    const auto upright = ParamsBuilder(builder).build<BitmapTexture, Texture>();
    const auto on_head = ParamsBuilder(builder).string("vOrigin", "top").build<BitmapTexture, Texture>();
    const auto raw = ParamsBuilder(builder).boolean("raw", true).build<BitmapTexture, Texture>();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / 3.f, v = (static_cast<float>(y) + 0.5f) / 2.f;
            check_close(upright->color({u, 1.f - v}), decoded(texel(x, y)));
            check_close(on_head->color({u, v}), decoded(texel(x, y)));
            check_close(raw->color({u, 1.f - v}), texel(x, y));
            CHECK(raw->number(Vec2f(u, 1.f - v)) == Approx(luminance(texel(x, y))).margin(1e-5));
        }
    check_statistics(*upright, 1e-4f);
    CHECK(upright->memory_bytes() == 3 * 2 * 3);
    CHECK_THAT((ParamsBuilder(builder).string("wrap", "black").complaints<BitmapTexture, Texture>().at(0)),
               ContainsSubstring("wrap must be 'repeat', 'mirror' or 'clamp', not 'black'"));
}

TEST_CASE("slopes of image textures are those of their numbers", "[unit][texture]")
{
    const TempDirectory directory;
    write_image(directory / "a.png", small_image());
    const Transform to_uv =
        Transform::translate({0.3, 0.1, 0}) * Transform::rotate({0, 0, 1}, 30) * *Transform::scale({2, 3, 1});
    std::vector<std::unique_ptr<Texture>> textures;
    for (const char* wrap : {"repeat", "mirror", "clamp"})
        textures.push_back(ParamsBuilder("texture", "bitmap")
                               .directory(directory.path())
                               .string("filename", "a.png")
                               .string("wrap", wrap)
                               .transform("toUv", to_uv)
                               .build<BitmapTexture, Texture>());
    textures.push_back(ParamsBuilder("texture", "imagetexture_color3f")
                           .directory(directory.path())
                           .string("filepath", "a.png")
                           .build<ImageTexture, Texture>());
    textures.push_back(ParamsBuilder("texture", "textmap")
                           .directory(directory.path())
                           .string("filename", "a.png")
                           .build<TextMap, Texture>());
    for (const auto& texture : textures) {
        TestRandom random(5);
        int wrong = 0;
        for (int i = 0; i < 300; ++i) {
            SurfacePoint at;
            at.uv = Vec2f(float(random.between(-2, 2)), float(random.between(-2, 2)));
            constexpr float step = 1e-3f;
            const auto difference = [&](const Vec2f& by) {
                return (texture->number(at.uv + by) - texture->number(at.uv - by)) / (2.f * step);
            };
            const Vec2f slope = texture->slope(at);
            const bool right = std::abs(slope.x - difference({step, 0.f})) < 0.02f &&
                               std::abs(slope.y - difference({0.f, step})) < 0.02f;
            wrong += right ? 0 : 1;
        }
        CHECK(wrong < 15); // those where a step crosses the line between two texels
    }
}

TEST_CASE("checkerboard has quarters, and numbers may be swapped", "[unit][texture][mitsuba]")
{
    const auto plain = ParamsBuilder("texture", "checkerboard").build<Quarters, Texture>();
    CHECK(plain->color({0.25f, 0.25f}) == Color(0.4f));
    CHECK(plain->color({0.75f, 0.25f}) == Color(0.2f));
    CHECK(plain->color({-0.25f, -0.25f}) == Color(0.4f));
    CHECK(plain->number(Vec2f(0.25f, 0.25f)) == 0.4f);
    const auto scaled = ParamsBuilder("texture", "checkerboard")
                            .transform("toUv", *Transform::scale({2, 1, 1}))
                            .boolean("swapNumbers", true)
                            .build<Quarters, Texture>();
    CHECK(scaled->color({0.125f, 0.25f}) == Color(0.4f));
    CHECK(scaled->color({0.375f, 0.25f}) == Color(0.2f));
    CHECK(scaled->number(Vec2f(0.125f, 0.25f)) == 0.2f);
    check_statistics(*plain, 1e-3f);
}

TEST_CASE("rawconstant takes numbers below zero, and meshattribute only names of attributes",
          "[unit][texture]")
{
    const auto data = ParamsBuilder("texture", "rawconstant")
                          .vector("value", Vec3f(-1.f, 2.f, 0.5f))
                          .build<RawConstant, Texture>();
    CHECK(data->color({0.f, 0.f}) == Color(-1.f, 2.f, 0.5f));
    const auto number =
        ParamsBuilder("texture", "rawconstant").number("value", -0.1).build<RawConstant, Texture>();
    CHECK(number->number(Vec2f(0.f)) == -0.1f);
    CHECK(ParamsBuilder("texture", "meshattribute")
              .string("attribute", "color")
              .complaints<MeshAttributeTexture, Texture>() ==
          std::vector<std::string>{"error: attribute must begin with 'vertex_' or 'face_', not 'color'"});
}
