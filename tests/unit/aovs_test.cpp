// SPDX-License-Identifier: MIT

// AOVs against closed forms.

#include "plumb/render/aovs.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;
using Catch::Matchers::WithinAbs;

namespace {

using Names = std::vector<std::string>;

// An image of 8 x 8 pixels from the origin along +z, with all AOVs.
class Rendered {
public:
    Rendered(const std::string& shapes, float fov = 40.f, std::uint64_t samples = 16,
             const std::string& integrator = "path")
        : scene_(load_text(fmt::format(
              "<scene dialect='plumb'><integrator type='{}'/><sampler type='independent'/>"
              "<camera type='perspective'><integer name='width' value='8'/><integer name='height' value='8'/>"
              "<float name='fov' value='{}'/><rfilter type='box'/></camera>{}</scene>",
              integrator, fov, shapes))),
          state_(render(scene_.job, options(samples, aov_names()))),
          image_(state_.film.develop())
    {}

    static RenderOptions options(std::uint64_t samples, Names aovs)
    {
        RenderOptions options;
        options.samples_per_pixel = samples;
        options.aovs = std::move(aovs);
        return options;
    }

    float at(int x, int y, const std::string& channel) const
    {
        const Names& names = image_.channel_names();
        const auto found = std::find(names.begin(), names.end(), channel);
        if (found == names.end()) throw std::runtime_error("no channel " + channel);
        return image_.pixel(x, y)[found - names.begin()];
    }
    Vec3f vector(int x, int y, const std::string& layer) const
    {
        return {at(x, y, layer + ".X"), at(x, y, layer + ".Y"), at(x, y, layer + ".Z")};
    }
    Color color(int x, int y, const std::string& layer) const
    {
        return {at(x, y, layer + ".R"), at(x, y, layer + ".G"), at(x, y, layer + ".B")};
    }
    double mean(const std::string& channel) const
    {
        double sum = 0.0;
        each([&](int x, int y) { sum += static_cast<double>(at(x, y, channel)); });
        return sum / 64.0;
    }
    static void each(const std::function<void(int, int)>& action)
    {
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) action(x, y);
    }
    const LoadedScene& scene() const { return scene_; }
    const RenderState& state() const { return state_; }
    const Image& image() const { return image_; }

private:
    LoadedScene scene_;
    RenderState state_;
    Image image_;
};

// Across the view at this z; its front looks along the normal.
std::string wall(float z, float normal, const std::string& inner)
{
    return fmt::format("<shape type='rectangle'><point name='center' value='0,0,{}'/>"
                       "<float name='width' value='100'/><float name='height' value='100'/>"
                       "<vector name='normal' value='0,0,{}'/>{}</shape>",
                       z, normal, inner);
}

const std::string red = "<bsdf type='diffuse'><color name='albedo' value='0.7,0.3,0.1'/></bsdf>";
const std::string lamp = "<emitter type='environment'><color name='radiance' value='0.5,0.5,0.5'/></emitter>";

bool is_near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-5f)
{
    return length(a - b) <= tolerance;
}

} // namespace

TEST_CASE("AOVs of a wall are those of a plane", "[unit][aov]")
{
    const Rendered seen(wall(2.f, -1.f, red));
    Rendered::each([&](int x, int y) {
        CHECK(seen.color(x, y, "albedo").r == Approx(0.7).epsilon(1e-6));
        CHECK(seen.color(x, y, "albedo").b == Approx(0.1).epsilon(1e-6));
        CHECK(seen.color(x, y, "albedo") == seen.color(x, y, "albedo_behind"));
        CHECK(is_near(seen.vector(x, y, "normal"), {0.f, 0.f, -1.f}));
        CHECK(is_near(seen.vector(x, y, "geometric_normal"), {0.f, 0.f, -1.f}));
        CHECK(seen.at(x, y, "depth_z.Z") == Approx(2.0).epsilon(1e-5));
        CHECK(seen.vector(x, y, "position").z == Approx(2.0).epsilon(1e-5));
        CHECK(seen.at(x, y, "coverage.A") == 1.f);
        CHECK(seen.at(x, y, "object.id") == 1.f);
        CHECK(seen.at(x, y, "depth.Z") > 2.f);
        CHECK(seen.at(x, y, "depth.Z") == seen.at(x, y, "depth_behind.Z"));
    });
    // The mean of 1/cos over a square of half side a = tan(20 degrees) at distance 1, times 2: by quadrature.
    const double a = std::tan(20.0 * pi_d / 180.0);
    double expected = 0.0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            expected += 2.0 * std::sqrt(1.0 + sqr(a * (i + 0.5) / n) + sqr(a * (j + 0.5) / n)) / (n * n);
    CHECK(seen.mean("depth.Z") == Approx(expected).epsilon(2e-3));
}

TEST_CASE("AOVs of a sphere around the camera are those of its directions", "[unit][aov]")
{
    const Rendered seen("<shape type='sphere'><float name='radius' value='3'/></shape>");
    Rendered::each([&](int x, int y) {
        const Vec3f position = seen.vector(x, y, "position");
        CHECK(seen.at(x, y, "depth.Z") == Approx(3.0).epsilon(1e-5));
        // Seen from inside: the normal towards the viewer is the opposite of the outward one.
        CHECK(is_near(seen.vector(x, y, "normal"), position * (-1.f / 3.f)));
        CHECK(seen.at(x, y, "depth_z.Z") == Approx(static_cast<double>(position.z)).epsilon(1e-5));
    });
}

TEST_CASE("behind a mirror AOVs are of what it shows", "[unit][aov]")
{
    const std::string integrator = GENERATE("path", "path_nee", "path_mis", "path_mats");
    const Rendered seen(wall(2.f, -1.f, "<bsdf type='mirror'/>") + wall(-3.f, 1.f, red) + lamp, 40.f, 16,
                        integrator);
    Rendered::each([&](int x, int y) {
        CHECK(seen.color(x, y, "albedo") == Color(1.f));
        CHECK(is_near(seen.vector(x, y, "normal"), {0.f, 0.f, -1.f}));
        CHECK(seen.at(x, y, "depth_z.Z") == Approx(2.0).epsilon(1e-5));
        CHECK(seen.at(x, y, "object.id") == 1.f);
        CHECK(seen.color(x, y, "albedo_behind").r == Approx(0.7).epsilon(1e-6));
        CHECK(is_near(seen.vector(x, y, "normal_behind"), {0.f, 0.f, 1.f}));
        // Along z the way is 2 to the mirror and 5 back.
        CHECK(seen.at(x, y, "depth_behind.Z") ==
              Approx(3.5 * double(seen.at(x, y, "depth.Z"))).epsilon(1e-5));
        CHECK(seen.at(x, y, "object_behind.id") == 2.f);
    });
}

TEST_CASE("paths that roulette ends are made up for in AOVs as in beauty", "[unit][aov]")
{
    // `whitted` ends 5 % of the paths at the mirror. 25,600 samples: a standard error of 0.0014.
    const Rendered seen(wall(2.f, -1.f, "<bsdf type='mirror'/>") + wall(-3.f, 1.f, red) + lamp, 40.f, 400,
                        "whitted");
    CHECK(seen.mean("albedo_behind.R") / 0.7 == Approx(1.0).margin(0.007));
    Rendered::each([&](int x, int y) {
        CHECK(is_near(seen.vector(x, y, "normal_behind"), {0.f, 0.f, 1.f}));
    });
}

TEST_CASE("behind glass AOVs are of what it shows, times what it lets through", "[unit][aov]")
{
    // One surface, seen almost straight on: Fresnel reflects (n - 1)^2 / (n + 1)^2 = 4 %, and that leaves the scene.
    const std::string glass = "<bsdf type='dielectric'><float name='intIOR' value='1.5'/>"
                              "<float name='extIOR' value='1'/></bsdf>";
    constexpr std::uint64_t samples = 400;
    const Rendered seen(wall(1.f, -1.f, glass) + wall(3.f, -1.f, red) + lamp, 2.f, samples);
    Rendered::each([&](int x, int y) {
        CHECK(seen.color(x, y, "albedo").g == Approx(1.0).epsilon(1e-6));
        CHECK(is_near(seen.vector(x, y, "normal_behind"), {0.f, 0.f, -1.f}));
        CHECK(seen.at(x, y, "depth_behind.Z") == Approx(3.0).epsilon(1e-3));
        CHECK(seen.color(x, y, "albedo_behind").r ==
              Approx(7.0 / 3.0 * double(seen.color(x, y, "albedo_behind").g)).epsilon(1e-5));
    });
    // 25,600 samples of a chance of 0.96: a standard error of 0.0012.
    CHECK(seen.mean("albedo_behind.R") / 0.7 == Approx(0.96).margin(0.006));
}

TEST_CASE("the albedo of a textured plane is the texture", "[unit][aov]")
{
    // The plane fills the view exactly, and a cell of the checkerboard is two pixels wide.
    const Rendered seen(
        "<shape type='rectangle'><point name='center' value='0,0,1'/>"
        "<float name='width' value='2'/><float name='height' value='2'/>"
        "<vector name='normal' value='0,0,-1'/><bsdf type='diffuse'>"
        "<texture type='checkerboard_color' name='albedo'><color name='value1' value='0.2,0.4,0.6'/>"
        "<color name='value2' value='0.8,0.6,0.4'/><vector name='scale' value='0.25,0.25'/>"
        "</texture></bsdf></shape>",
        90.f, 64);
    Rendered::each([&](int x, int y) {
        const float u = seen.at(x, y, "uv.U");
        const float v = seen.at(x, y, "uv.V");
        const bool even = (static_cast<int>(u * 4.f) + static_cast<int>(v * 4.f)) % 2 == 0;
        CHECK(seen.color(x, y, "albedo").r == Approx(even ? 0.2 : 0.8).epsilon(1e-5));
        CHECK(seen.color(x, y, "albedo").b == Approx(even ? 0.6 : 0.4).epsilon(1e-5));
        CHECK(std::abs(u * 8.f - std::floor(u * 8.f) - 0.5f) < 0.2f); // the mean over a pixel: its middle
    });
    CHECK(seen.mean("uv.U") == Approx(0.5).epsilon(0.01));
    CHECK(seen.mean("uv.V") == Approx(0.5).epsilon(0.01));
}

TEST_CASE("AOVs of nothing are 0", "[unit][aov]")
{
    const Rendered seen(wall(-2.f, 1.f, red) + lamp);
    const Names& names = seen.image().channel_names();
    for (std::size_t i = 3; i < names.size(); ++i)
        if (!names[i].starts_with("xyz") && !names[i].starts_with("rays") &&
            !names[i].starts_with("variance_of_xyz")) // what arrives, from anywhere
            CHECK(seen.mean(names[i]) == 0.0);
    CHECK(seen.mean("R") == Approx(0.5).epsilon(1e-5));
    CHECK(seen.mean("rays.N") == 1.0);
}

TEST_CASE("a mean over an edge is not darkened by what is not there", "[unit][aov]")
{
    // The wall ends in the middle of the view's pixel column.
    const Rendered seen("<shape type='rectangle'><point name='center' value='5,0,1'/>"
                        "<float name='width' value='9.9'/><float name='height' value='9'/>"
                        "<vector name='normal' value='0,0,-1'/></shape>",
                        90.f, 64);
    int partly = 0;
    Rendered::each([&](int x, int y) {
        const float coverage = seen.at(x, y, "coverage.A");
        if (coverage == 0.f) return;
        if (coverage < 1.f) ++partly;
        CHECK(is_near(seen.vector(x, y, "normal"), {0.f, 0.f, -1.f}));
        CHECK(seen.at(x, y, "depth_z.Z") == Approx(1.0).epsilon(1e-5));
        CHECK(seen.at(x, y, "albedo.R") == Approx(0.5 * double(coverage)).epsilon(1e-5));
    });
    CHECK(partly == 8);
}

TEST_CASE("AOVs change no bit of beauty, and trace no ray", "[unit][aov]")
{
    const std::string integrator =
        GENERATE("path", "path_mis", "path_nee", "direct_mis", "whitted", "normals");
    const std::string glass =
        "<shape type='sphere'><point name='center' value='0,0,4'/><bsdf type='dielectric'/></shape>";
    const Rendered with(wall(8.f, -1.f, red) + glass + lamp, 40.f, 16, integrator);
    const RenderState without = render(with.scene().job, Rendered::options(16, {}));
    Rendered::each([&](int x, int y) {
        CHECK(with.state().film.words({x, y}) == without.film.words({x, y}));
    });
    CHECK(with.state().rays.total() == without.rays.total());
    CHECK(with.state().rays.camera == 64 * 16);
    if (integrator == "normals") CHECK(with.state().rays.total() == 64 * 16);
}

TEST_CASE("AOVs of a furnace lose nothing in glass", "[unit][aov]")
{
    // A glass ball in a closed room of one albedo: all that it reflects and refracts arrives at the room.
    const Rendered seen(
        "<shape type='sphere'><float name='radius' value='9'/><boolean name='flipNormals' value='true'/>" +
            red +
            "</shape><shape type='sphere'><point name='center' value='0,0,4'/>"
            "<bsdf type='dielectric'/></shape>" +
            lamp,
        40.f, 64);
    // The weights of 4096 samples are 1 but for roulette, which looks at some of 0.2 % of them: a standard error of 0.0002.
    CHECK(seen.mean("albedo_behind.R") == Approx(0.7).epsilon(1e-3));
    CHECK(seen.mean("albedo_behind.B") == Approx(0.1).epsilon(1e-3));
    CHECK(seen.mean("coverage.A") == 1.0);
    Rendered::each([&](int x, int y) { CHECK(seen.at(x, y, "object_behind.id") == 1.f); });
}

TEST_CASE("the variance of an AOV is that of its mean", "[unit][aov]")
{
    // x is uniform over a pixel of the width w at the wall, so that the variance of the mean of n is w^2 / (12 n). At 1e7
    // the squares are beyond the range of small ones.
    const double distance = GENERATE(2.0, 1e7);
    constexpr std::uint64_t samples = 400;
    const Rendered seen(
        fmt::format(
            "<shape type='rectangle'><point name='center' value='0,0,{}'/><float name='width' value='{}'/>"
            "<float name='height' value='{}'/><vector name='normal' value='0,0,-1'/></shape>",
            distance, distance * 10.0, distance * 10.0),
        40.f, samples);
    const double w = 2.0 * distance * std::tan(20.0 * pi_d / 180.0) / 8.0;
    const double expected = w * w / (12.0 * samples);
    // A pixel's estimate has a relative standard error of sqrt(0.8 / 400), the mean of 64 of 0.0056.
    CHECK(seen.mean("variance_of_position.X") == Approx(expected).epsilon(0.028));
    CHECK(seen.mean("variance_of_coverage.A") == 0.0);
    CHECK(seen.mean("variance_of_depth_z.Z") <= 1e-12 * distance * distance);
}

TEST_CASE("the variance of a coverage is that of a proportion", "[unit][aov]")
{
    const Rendered seen("<shape type='rectangle'><point name='center' value='5,0,1'/>"
                        "<float name='width' value='9.9'/><float name='height' value='9'/>"
                        "<vector name='normal' value='0,0,-1'/></shape>",
                        90.f, 64);
    Rendered::each([&](int x, int y) {
        const double p = double(seen.at(x, y, "coverage.A"));
        CHECK(double(seen.at(x, y, "variance_of_coverage.A")) == Approx(p * (1.0 - p) / 63.0).margin(1e-9));
        if (p == 0.0) CHECK(seen.at(x, y, "variance_of_normal.Z") == 0.f);
    });
    const Rendered once(wall(2.f, -1.f, red), 40.f, 1);
    CHECK(std::isnan(once.at(0, 0, "variance_of_normal.Z")));
    CHECK(std::isnan(once.at(0, 0, "variance_of_albedo.R")));
}

TEST_CASE("objects with one BSDF have one material", "[unit][aov]")
{
    const std::string half = "<shape type='rectangle'><point name='center' value='{},0,2'/>"
                             "<float name='width' value='10'/><float name='height' value='100'/>"
                             "<vector name='normal' value='0,0,-1'/>{}</shape>";
    const auto placed = [&](int x, const std::string& bsdf) {
        return fmt::format(fmt::runtime(half), x, bsdf);
    };
    const Rendered shared("<bsdf type='diffuse' id='paint'/>" + placed(-5, "<ref id='paint'/>") +
                          placed(5, "<ref id='paint'/>"));
    CHECK(material_names(*shared.scene().job.scene) == Names{"paint"});
    CHECK(shared.at(0, 0, "material.id") == 1.f);
    CHECK(shared.at(7, 0, "material.id") == 1.f);
    CHECK(shared.at(0, 0, "object.id") != shared.at(7, 0, "object.id"));
    const Rendered two(placed(-5, "") + placed(5, red));
    CHECK(material_names(*two.scene().job.scene).size() == 2);
    CHECK(material_names(*two.scene().job.scene).front() == "bsdf 'diffuse' (default)");
    CHECK(two.at(0, 0, "material.id") + two.at(7, 0, "material.id") == 3.f);

    // An instance is one object of as many materials as its group has.
    const Rendered instance("<shape type='group' id='walls'>" + placed(-5, "") + placed(5, red) +
                            "</shape><shape type='instance'><ref id='walls'/></shape>");
    CHECK(instance.at(0, 0, "material.id") + instance.at(7, 0, "material.id") == 3.f);
    CHECK(instance.at(0, 0, "object.id") == 1.f);
    CHECK(instance.at(7, 0, "object.id") == 1.f);
}

TEST_CASE("the order of AOVs' names does not matter, and unknown ones are refused", "[unit][aov]")
{
    const ChannelSet layers = layers_of(Names{"depth", "albedo", "depth"});
    CHECK(layer_names(layers) == "albedo, depth");
    CHECK(layers == layers_of(Names{"albedo", "depth"}));
    CHECK(layers_of(Names{}).empty());
    CHECK_THROWS_WITH(
        layers_of(Names{"colour"}),
        "unknown AOV 'colour'; known are albedo, albedo_behind, normal, normal_behind, "
        "geometric_normal, depth, depth_behind, depth_z, position, uv, coverage, object, "
        "object_behind, material, material_behind, mean_depth, mean_position, mean_uv, mean_normal, "
        "mean_geometric_normal, mean_dp_du, mean_dp_dv, mean_object, mean_primitive, xyz, xyz_squared, rays, "
        "and "
        "variance_of_NAME of those that are no ids");
}

TEST_CASE("layers with names of their own", "[unit][aov]")
{
    CHECK(layer_names(layers_of(Names{"dd.y:mean_depth", "depth", "n-1:normal", "b:variance_of_depth"})) ==
          "depth, dd.y, n-1, b");
    const ChannelSet layers = layers_of(Names{"dd.y:mean_depth", "b:normal_behind"});
    CHECK(layers.front().channel(0) == "dd.y.T");
    CHECK(channel_set_from_text(to_text(layers)) == layers);
    CHECK_THROWS_WITH(layers_of(Names{"depth", "depth:mean_depth"}), "two layers are called 'depth'");
    CHECK_THROWS_WITH(layers_of(Names{"a:depth", "a:depth"}), "two layers are called 'a'");
    CHECK_THROWS_WITH(layers_of(Names(65, "a:depth")), "there can be 64 layers, not 65");
    for (const std::string bad : {"", ".a", "a.", "a b", "a:b", "variance", "\x1b"})
        CHECK_THROWS(layers_of(Names{bad + ":depth"}));
}

TEST_CASE("a scene asks for layers itself", "[unit][aov]")
{
    const auto scene = [](const std::string& aovs) {
        return start + "<string name='aovs' value='" + aovs + "'/>" + wall(2.f, -1.f, red) + "</scene>";
    };
    CHECK(load_text(scene("depth, dd.y:mean_depth")).aovs == Names{"depth", "dd.y:mean_depth"});
    CHECK(load_text(scene("")).aovs.empty());
    CHECK_THROWS_WITH(load_text(scene("colour")), ContainsSubstring("unknown AOV 'colour'"));
}

// What mean_NAME is of: all samples, whatever they see.
TEST_CASE("means over all samples count what sees nothing as 0", "[unit][aov]")
{
    // The wall ends in the middle of the view's pixel column.
    const Rendered half("<shape type='rectangle'><point name='center' value='5,0,1'/>"
                        "<float name='width' value='9.9'/><float name='height' value='9'/>"
                        "<vector name='normal' value='0,0,-1'/></shape>",
                        90.f, 256);
    Rendered::each([&](int x, int y) {
        const float coverage = half.at(x, y, "coverage.A");
        CHECK_THAT(half.at(x, y, "mean_depth.T"),
                   WithinAbs(static_cast<double>(half.at(x, y, "depth.Z") * coverage), 1e-4));
        CHECK_THAT(half.at(x, y, "mean_uv.U"),
                   WithinAbs(static_cast<double>(half.at(x, y, "uv.U") * coverage), 1e-4));
        CHECK_THAT(half.at(x, y, "mean_object.I"), WithinAbs(static_cast<double>(coverage), 1e-4));
        CHECK_THAT(half.at(x, y, "mean_position.Z"), WithinAbs(static_cast<double>(coverage), 1e-4));
    });
}

TEST_CASE("moments of light are those of the image", "[unit][aov]")
{
    // Rec. 709 white and its square; a constant light has no variance.
    const Rendered lit("<emitter type='environment'><color name='radiance' value='0.5 0.5 0.5'/></emitter>");
    Rendered::each([&](int x, int y) {
        CHECK_THAT(lit.at(x, y, "xyz.X"), WithinAbs(0.475228, 1e-5));
        CHECK_THAT(lit.at(x, y, "xyz.Y"), WithinAbs(0.5, 1e-5));
        CHECK_THAT(lit.at(x, y, "xyz.Z"), WithinAbs(0.544377, 1e-5));
        CHECK_THAT(lit.at(x, y, "xyz_squared.Y"), WithinAbs(0.25, 1e-5));
    });
    // Of a noisy one: the second moment is the variance of one sample and the square of the mean.
    const Rendered noisy("<emitter type='point'><point name='position' value='0 0 1'/></emitter>" +
                             wall(2.f, -1.f, red),
                         40.f, 4096, "path_mis");
    Rendered::each([&](int x, int y) {
        const double y1 = static_cast<double>(noisy.at(x, y, "xyz.Y"));
        const double y2 = static_cast<double>(noisy.at(x, y, "xyz_squared.Y"));
        const double variance = static_cast<double>(noisy.at(x, y, "variance_of_xyz.Y")) * 4096.0;
        CHECK_THAT(y2 - y1 * y1, WithinAbs(variance, 1e-3 * (variance + y1 * y1)));
    });
}

TEST_CASE("a rendering goes on with its own layers only", "[unit][aov]")
{
    const LoadedScene scene = load_text(start + wall(2.f, -1.f, red) + "</scene>");
    RenderState state = render(scene.job, Rendered::options(2, {"normal"}));
    CHECK_THROWS_WITH(Rendering(scene.job, Rendered::options(4, {"albedo"}), std::move(state)),
                      "the samples so far have the layers normal, not albedo");
}
