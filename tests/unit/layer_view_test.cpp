// SPDX-License-Identifier: MIT

// Layers as images for screens.

#include "plumb/display/layer_view.h"

#include "plumb/base/error.h"
#include "plumb/image/development.h"
#include "plumb/image/false_color.h"
#include "support/catch.h"

#include <algorithm>

using namespace plumb;

namespace {

using Names = std::vector<std::string>;

// Four pixels with these values of these channels.
Image image_of(const Names& channels, const std::vector<std::vector<float>>& pixels)
{
    Image image({0, 0, static_cast<int>(pixels.size()), 1}, static_cast<int>(pixels.size()), 1, channels);
    for (std::size_t x = 0; x < pixels.size(); ++x)
        std::copy(pixels[x].begin(), pixels[x].end(), image.pixel(static_cast<int>(x), 0));
    return image;
}

// What a file for screens has, from 0 to 255.
int shown(const ImageView& view, int x, int channel)
{
    const Color color = Developer(view.development)(view.image.color(x, 0));
    return static_cast<int>(color[channel] * 255.f + 0.5f);
}

const float not_a_number = std::numeric_limits<float>::quiet_NaN();

ViewOptions of_layer(const std::string& layer)
{
    ViewOptions options;
    options.layer = layer;
    return options;
}

} // namespace

TEST_CASE("colours are developed", "[unit][display]")
{
    const Image image = image_of({"R", "G", "B", "depth.Z"}, {{0.1f, 0.5f, 2.f, 7.f}, {1.f, 0.f, 0.f, 8.f}});
    ViewOptions options;
    options.development = {1.f, ToneCurve::aces};
    const ImageView view = view_layer(image, options);
    CHECK(view.image.channel_names() == Names{"R", "G", "B"});
    CHECK(view.image.color(0, 0) == Color(0.1f, 0.5f, 2.f));
    CHECK(view.development == options.development);
    CHECK(view.legend == Names{"R, G, B: exposure 1, tonemap aces"});
    CHECK(display_text(view.image.metadata) == "exposure 1, tonemap aces");
    CHECK(view_layer(image, {}).legend == Names{"R, G, B: white is 1"});
    CHECK(display_text(view_layer(image, {}).image.metadata).empty());
}

TEST_CASE("grey images stay grey", "[unit][display]")
{
    const ImageView view = view_layer(image_of({"Y"}, {{0.25f}}), {});
    CHECK(view.image.channel_names() == Names{"Y"});
    CHECK(view.image.pixel(0, 0)[0] == 0.25f);
}

TEST_CASE("layers of colours are developed, and the header says that they are a layer", "[unit][display]")
{
    // As files have them: by name, with alpha.
    const Image image =
        image_of({"R", "G", "B", "c.A", "c.B", "c.G", "c.R"}, {{0.f, 0.f, 0.f, 1.f, 0.3f, 0.2f, 0.1f}});
    const ImageView view = view_layer(image, of_layer("c"));
    CHECK(view.image.color(0, 0) == Color(0.1f, 0.2f, 0.3f));
    CHECK(view.legend == Names{"c.R, c.G, c.B: white is 1"});
    CHECK(display_text(view.image.metadata) == "c.R, c.G, c.B: white is 1");
    CHECK(view_layer(image, of_layer("c.G")).image.color(0, 0).r == 0.f); // the smallest value is black
}

TEST_CASE("numbers go from the smallest in black to the largest in white", "[unit][display]")
{
    const Image image = image_of(
        {"R", "G", "B", "depth.Z"},
        {{0, 0, 0, 2.f}, {0, 0, 0, 3.f}, {0, 0, 0, 6.f}, {0, 0, 0, not_a_number}, {0, 0, 0, infinity}});
    const std::string layer = GENERATE("depth", "depth.Z");
    const ImageView view = view_layer(image, of_layer(layer));
    for (int c = 0; c < 3; ++c) {
        CHECK(shown(view, 0, c) == 0);
        CHECK(shown(view, 1, c) == 64); // a quarter of the way
        CHECK(shown(view, 2, c) == 255);
    }
    for (const int x : {3, 4}) CHECK(view.image.color(x, 0) == not_finite_color);
    CHECK(view.legend == Names{"depth.Z: 2 (black) to 6 (white)", "2 pixels are not finite: green"});
    CHECK(display_text(view.image.metadata) == "depth.Z: 2 (black) to 6 (white)");
}

TEST_CASE("false colours, with a range and a logarithm", "[unit][display]")
{
    const Image image = image_of({"d.Z"}, {{1.f}, {10.f}, {100.f}, {0.f}});
    ViewOptions options = of_layer("d");
    options.false_color = true;
    const ImageView plain = view_layer(image, options);
    CHECK(plain.legend == Names{"d.Z: 0 (dark purple) to 100 (light yellow)"});
    CHECK(plain.image.color(1, 0) == false_color(0.1));

    options.range = NumberRange{5.0, 15.0};
    const ImageView ranged = view_layer(image, options);
    CHECK(ranged.image.color(0, 0) == false_color(0.0));
    CHECK(ranged.image.color(1, 0) == false_color(0.5));
    CHECK(ranged.image.color(2, 0) == false_color(1.0));
    CHECK(ranged.legend == Names{"d.Z: 5 (dark purple) to 15 (light yellow)"});

    options.range.reset();
    options.logarithmic = true;
    const ImageView logarithmic = view_layer(image, options);
    CHECK(logarithmic.legend == Names{"d.Z: 1 (dark purple) to 100 (light yellow), logarithmic"});
    CHECK(logarithmic.image.color(1, 0).g == Approx(false_color(0.5).g).epsilon(1e-5));
    CHECK(logarithmic.image.color(3, 0) == false_color(0.0)); // 0 has no logarithm: the end of the range
}

TEST_CASE("false colours of colours and vectors are of luminance and length", "[unit][display]")
{
    ViewOptions options;
    options.false_color = true;
    const Image colors = image_of({"R", "G", "B"}, {{1.f, 1.f, 1.f}, {0.f, 0.f, 0.f}, {0.f, 0.5f, 0.f}});
    const ImageView luminances = view_layer(colors, options);
    CHECK(luminances.legend.front().starts_with("luminance of R, G, B: 0 (dark purple) to 1"));
    CHECK(luminances.image.color(2, 0).g == Approx(false_color(0.5 * 0.71516).g).epsilon(1e-4));

    options.layer = "v";
    const Image vectors = image_of({"v.X", "v.Y", "v.Z"}, {{3.f, 4.f, 0.f}, {0.f, 0.f, 0.f}});
    CHECK(view_layer(vectors, options).legend ==
          Names{"length of v.X, v.Y, v.Z: 0 (dark purple) to 5 (light yellow)"});
}

TEST_CASE("directions are shown from -1 to 1, other vectors by their values", "[unit][display]")
{
    const Image image = image_of({"n.X", "n.Y", "n.Z", "p.X", "p.Y", "p.Z", "uv.U", "uv.V"},
                                 {{0.f, 0.6f, -0.8f, 10.f, -2.f, 5.f, 0.25f, 0.5f},
                                  {1.f, 0.f, 0.f, 20.f, 2.f, 5.f, 0.75f, 0.5f},
                                  {0.f, not_a_number, 0.f, 15.f, 0.f, 5.f, 0.5f, 0.5f}});
    const ImageView normals = view_layer(image, of_layer("n"));
    CHECK(normals.legend == Names{"n.X: -1 to 1 as red", "n.Y: -1 to 1 as green", "n.Z: -1 to 1 as blue",
                                  "1 pixels are not finite: green"});
    CHECK(shown(normals, 0, 0) == 128);
    CHECK(shown(normals, 0, 1) == 204);
    CHECK(shown(normals, 0, 2) == 26); // 25.5, rounded
    CHECK(shown(normals, 1, 0) == 255);
    CHECK(normals.image.color(2, 0) == not_finite_color);

    const ImageView positions = view_layer(image, of_layer("p"));
    CHECK(positions.legend == Names{"p.X: 10 to 20 as red", "p.Y: -2 to 2 as green", "p.Z: 5 to 5 as blue"});
    CHECK(shown(positions, 1, 0) == 255);
    CHECK(shown(positions, 2, 1) == 128);

    const ImageView uvs = view_layer(image, of_layer("uv"));
    CHECK(uvs.legend == Names{"uv.U: 0 to 1 as red", "uv.V: 0 to 1 as green"});
    CHECK(shown(uvs, 0, 0) == 64);
    CHECK(shown(uvs, 0, 2) == 0);
}

TEST_CASE("ids have colours of their own, and names", "[unit][display]")
{
    Image image = image_of({"object.id"}, {{0.f}, {1.f}, {2.f}, {2.f}, {not_a_number}});
    image.metadata = {{"plumb:ids.object", std::string("1 floor.obj\n2 shape 'sphere' (s.xml:3)")}};
    const ImageView view = view_layer(image, of_layer("object"));
    CHECK(view.image.color(0, 0) == Color());
    CHECK(view.image.color(2, 0) == view.image.color(3, 0));
    CHECK(view.image.color(1, 0) != view.image.color(2, 0));
    REQUIRE(view.legend.size() == 5);
    CHECK(view.legend[0] == "object.id: 3 ids");
    CHECK(view.legend[1] == "  #000000 0 1 pixels nothing");
    CHECK_THAT(view.legend[2], ContainsSubstring(" 1 1 pixels floor.obj"));
    CHECK_THAT(view.legend[3], ContainsSubstring(" 2 2 pixels shape 'sphere' (s.xml:3)"));
    CHECK(view.legend[4] == "1 pixels have no id: green");
}

TEST_CASE("colours of ids differ", "[unit][display]")
{
    // Neighbours in number, by far; all of the first hundred, by what an 8-bit image shows.
    std::vector<ImageView> views;
    const auto distance = [](const Color& a, const Color& b) {
        float largest = 0.f;
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(srgb_from_linear(a[c]) - srgb_from_linear(b[c])));
        return largest;
    };
    std::vector<Color> colors;
    Image image({0, 0, 100, 1}, 100, 1, {"o.id"});
    for (int x = 0; x < 100; ++x) image.pixel(x, 0)[0] = static_cast<float>(x + 1);
    const ImageView view = view_layer(image, of_layer("o"));
    for (int x = 0; x < 100; ++x) {
        for (int y = 0; y < x; ++y)
            REQUIRE(distance(view.image.color(x, 0), view.image.color(y, 0)) > 2.f / 255.f);
        if (x > 0) CHECK(distance(view.image.color(x, 0), view.image.color(x - 1, 0)) > 0.1f);
    }
}

TEST_CASE("what cannot be shown is an error with a way out", "[unit][display]")
{
    const Image image = image_of({"R", "G", "B", "depth.Z", "o.id", "q.a", "q.b", "q.c", "q.d"},
                                 {{0, 0, 0, -1.f, 1.f, 0, 0, 0, 0}});
    const auto complaint = [&](const ViewOptions& options) {
        try {
            view_layer(image, options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(complaint(of_layer("normal")) ==
          "the image has no layer or channel 'normal'; its layers are depth, o, q, its channels R, G, B, "
          "depth.Z, o.id, q.a, q.b, q.c, q.d");
    CHECK(complaint(of_layer("q")) ==
          "the layer 'q' has 4 channels, and at most 3 can be shown; choose one of q.a, q.b, q.c, q.d");
    ViewOptions false_ids = of_layer("o");
    false_ids.false_color = true;
    CHECK(complaint(false_ids) ==
          "the layer 'o' has ids, which have colours of their own: false colours are for numbers");
    ViewOptions logarithmic;
    logarithmic.logarithmic = true;
    CHECK(complaint(logarithmic) ==
          "a logarithmic scale is for numbers, not for the colours; ask for false colours");
    ViewOptions ranged;
    ranged.range = NumberRange{0.0, 1.0};
    CHECK(complaint(ranged) ==
          "a range is for numbers and vectors, not for the colours; ask for false colours");
    ViewOptions negative = of_layer("depth");
    negative.logarithmic = true;
    CHECK(complaint(negative) == "no value is above 0, and a logarithmic range needs some");
    negative.range = NumberRange{-1.0, 1.0};
    CHECK(complaint(negative) == "a logarithmic range must begin above 0, not at -1");
    CHECK_THROWS_WITH(view_layer(image_of({"depth.Z"}, {{1.f}}), {}),
                      "the image has no colours; choose a layer or a channel with --layer: depth.Z");
}
