// SPDX-License-Identifier: MIT

#include "plumb/image/image.h"
#include "plumb/model/emitter.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"
#include "support/statistics.h"
#include "support/temp_directory.h"

#include <map>

namespace plumb {
class EnvironmentEmitter;
}

using namespace plumb;
using plumb::test::ParamsBuilder;
using plumb::test::TestRandom;

namespace {

constexpr int width = 6;
constexpr int height = 4;

Color texel(int x, int y)
{
    return {static_cast<float>(1 + x + 10 * y), static_cast<float>(x * x), static_cast<float>(y)};
}

// The images under test: all texels different; one bright texel in the dark, in a corner; all black but a row.
enum class Texels { varied, one_texel, one_row };

Image image(Texels which)
{
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool lit = which == Texels::varied ||
                             (which == Texels::one_texel && x == width - 1 && y == 0) ||
                             (which == Texels::one_row && y == 2);
            const Color color = lit ? texel(x, y) : Color(0.f);
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = color[c];
        }
    return image;
}

// As in the Zaragoza dialect, or as in ours.
ParamsBuilder environment_params(bool flipped)
{
    ParamsBuilder params("emitter", "environment");
    if (flipped) params.boolean("flipped", true).number("imageScale", 0.5);
    return params;
}

std::unique_ptr<Emitter> environment(Texels which, bool flipped, const Color& radiance = Color(1.f))
{
    const TempDirectory directory;
    write_image(directory / "sky.exr", image(which));
    return environment_params(flipped)
        .directory(directory.path())
        .string("filename", "sky.exr")
        .color("radiance", radiance)
        .build<EnvironmentEmitter, Emitter>();
}

Vec3f direction(double phi, double theta)
{
    return Vec3f(Vec3d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
}

// The integral over the sphere by the midpoint rule in phi and theta, on a grid that the cells of the table divide.
template <class Function>
double integral(const Function& f)
{
    constexpr int fine = 40;
    double sum = 0.0;
    for (int j = 0; j < fine * height; ++j) {
        const double theta = pi_d * (j + 0.5) / (fine * height);
        const double ring = std::cos(pi_d * j / (fine * height)) - std::cos(pi_d * (j + 1) / (fine * height));
        for (int i = 0; i < fine * width; ++i)
            sum += f(direction(2.0 * pi_d * (i + 0.5) / (fine * width), theta)) * ring;
    }
    return sum * 2.0 * pi_d / (fine * width);
}

EmitterValue seen(const Emitter& emitter, const Vec3f& wi, const SkyView& sky = {})
{
    LightReceiver receiver{Vec3f(0.f)};
    receiver.sky = sky;
    return emitter.evaluate(receiver, wi, nullptr, Measure::best);
}

// Of a cell of the table: rounding may find the direction on either side.
bool is_beside_border(const Vec2f& place)
{
    const Vec2f cell(place.x * width, place.y * height);
    return std::abs(cell.x - std::round(cell.x)) < 1e-4f || std::abs(cell.y - std::round(cell.y)) < 1e-4f;
}

// Parts of the map: some beyond its right border, one with little of it, one with a border of a row.
constexpr SkyRectangle rectangles[] = {
    {0.1f, 0.5f, 0.2f, 0.7f}, {0.8f, 0.5f, 0.f, 1.f}, {0.99f, 0.02f, 0.01f, 0.02f}, {0.3f, 1.f, 0.5f, 0.75f}};

void check_color(const Color& a, const Color& b)
{
    CAPTURE(a.r, a.g, a.b, b.r, b.g, b.b);
    CHECK(std::abs(a.r - b.r) < 2e-4f);
    CHECK(std::abs(a.g - b.g) < 2e-4f);
    CHECK(std::abs(a.b - b.b) < 2e-4f);
}

} // namespace

TEST_CASE("zUp exchanges y and z of an environment's directions", "[unit][environment]")
{
    const TempDirectory directory;
    write_image(directory / "sky.exr", image(Texels::varied));
    const auto make = [&](bool z_up) {
        ParamsBuilder params("emitter", "environment");
        params.string("filename", (directory / "sky.exr").string()).boolean("zUp", z_up);
        return params.build<EnvironmentEmitter, Emitter>();
    };
    const auto y_up = make(false), z_up = make(true);
    TestRandom random(7);
    for (int i = 0; i < 100; ++i) {
        const Vec3f d = random.direction();
        const EmitterValue a = y_up->evaluate({Vec3f(0.f)}, d, nullptr, Measure::solid_angle);
        const EmitterValue b =
            z_up->evaluate({Vec3f(0.f)}, Vec3f(d.x, d.z, d.y), nullptr, Measure::solid_angle);
        CHECK(a.radiance == b.radiance);
        CHECK(a.pdf == b.pdf);
    }
}

TEST_CASE("an environment image starts at +y, and its columns run from +x over +z", "[unit][environment]")
{
    const Color tint(2.f, 1.f, 0.5f);
    const auto emitter = environment(Texels::varied, false, tint);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double phi = 2.0 * pi_d * (x + 0.5) / width;
            const double theta = pi_d * (y + 0.5) / height;
            check_color(seen(*emitter, direction(phi, theta)).radiance, texel(x, y) * tint);
        }
    // At +x, the first and the last column meet; at the poles, the first and the last row go on.
    check_color(seen(*emitter, direction(0.0, pi_d * 0.5 / height)).radiance,
                (texel(0, 0) + texel(width - 1, 0)) * 0.5f * tint);
    check_color(seen(*emitter, direction(pi_d / width, 1e-3)).radiance, texel(0, 0) * tint);
    check_color(seen(*emitter, direction(pi_d / width, pi_d - 1e-3)).radiance, texel(0, height - 1) * tint);
}

TEST_CASE("in Zaragoza's dialect an environment image runs the other way", "[unit][environment]")
{
    const auto emitter = environment(Texels::varied, true);
    for (int y = 1; y < height; ++y) // row 0 is at the poles
        for (int x = 0; x < width; ++x) {
            const double phi = 2.0 * pi_d * (1.0 - static_cast<double>(x) / width);
            const double theta = pi_d * (1.0 - static_cast<double>(y) / height);
            check_color(seen(*emitter, direction(phi, theta)).radiance, texel(x, y) * 0.5f);
        }
    // Near +y lies the upper end of v: between the last row and the first.
    check_color(seen(*emitter, direction(2.0 * pi_d * (1.0 - 2.0 / width), pi_d * 0.25 / height)).radiance,
                (texel(2, 0) * 0.75f + texel(2, height - 1) * 0.25f) * 0.5f);
}

TEST_CASE("the density of environment light integrates to 1, and its power is that of the image",
          "[unit][environment]")
{
    const bool flipped = GENERATE(false, true);
    const Texels which = GENERATE(Texels::varied, Texels::one_texel, Texels::one_row);
    const auto emitter = environment(which, flipped);
    CHECK(integral([&](const Vec3f& wi) { return seen(*emitter, wi).pdf; }) == Approx(1.0).epsilon(1e-5));
    for (const SkyRectangle& rectangle : rectangles) {
        const SkyView view = emitter->sky_map()->view(rectangle);
        CHECK(integral([&](const Vec3f& wi) { return seen(*emitter, wi, view).pdf; }) ==
              Approx(1.0).epsilon(1e-5));
    }

    const double radiance = integral([&](const Vec3f& wi) { return luminance(seen(*emitter, wi).radiance); });
    emitter->prepare({Vec3f(5.f), 3.f});
    CHECK(emitter->power() == Approx(radiance * pi_d * 9.0).epsilon(1e-3));
    emitter->prepare({Vec3f(5.f), 0.f});
    CHECK(emitter->power() == Approx(radiance * pi_d).epsilon(1e-3));
}

TEST_CASE("environment light can be sampled wherever it is not black", "[unit][environment]")
{
    const bool flipped = GENERATE(false, true);
    const Texels which = GENERATE(Texels::varied, Texels::one_texel, Texels::one_row);
    const auto emitter = environment(which, flipped);
    TestRandom random;
    int lit = 0;
    for (int i = 0; i < 20000; ++i) {
        const EmitterValue value = seen(*emitter, random.direction());
        if (value.radiance.is_black()) continue;
        ++lit;
        CHECK(value.pdf > 0.f);
    }
    CHECK(lit > 100);
}

TEST_CASE("samples of environment light agree with evaluate", "[unit][environment]")
{
    const bool flipped = GENERATE(false, true);
    const Texels which = GENERATE(Texels::varied, Texels::one_texel, Texels::one_row);
    const auto emitter = environment(which, flipped);
    CHECK(emitter->is_infinite());
    CHECK_FALSE(emitter->is_delta());
    TestRandom random;
    for (int i = 0; i < 2000; ++i) {
        const double u_select = random.next_double();
        const Vec2f u = random.next_2d();
        const Measure measure = i % 2 == 0 ? Measure::best : Measure::area;
        const auto sample = emitter->sample({Vec3f(1.f, 2.f, 3.f)}, u_select, u, measure);
        REQUIRE(sample);
        const EmitterValue value = emitter->evaluate({Vec3f(1.f, 2.f, 3.f)}, sample->wi, nullptr, measure);
        CHECK(length(sample->wi) == Approx(1.f));
        CHECK(sample->distance == infinity);
        CHECK_FALSE(sample->is_delta);
        if (is_beside_border(emitter->sky_map()->place_of(sample->wi))) continue;
        CHECK(sample->pdf == value.pdf);
        check_color(sample->radiance, value.radiance);
    }
    const SurfacePoint surface;
    CHECK(emitter->evaluate({Vec3f(0.f)}, Vec3f(0, 1, 0), &surface, Measure::best).radiance.is_black());
}

TEST_CASE("environment light is sampled with the density it claims", "[statistical][environment]")
{
    const bool flipped = GENERATE(false, true);
    const Texels which = GENERATE(Texels::varied, Texels::one_texel, Texels::one_row);
    const int part = GENERATE(-1, 0, 1, 2, 3); // of the map; -1: all of it
    const auto emitter = environment(which, flipped);
    const double level = test::sidak_level(test::significance, 60);
    LightReceiver receiver{Vec3f(0.f)};
    if (part >= 0) receiver.sky = emitter->sky_map()->view(rectangles[part]);

    // Chi-square over the cells of the table, each cut into 2 x 2, whose probability is density times solid angle.
    constexpr int columns = 2 * width;
    constexpr int rows = 2 * height;
    const auto cell_of = [&](const Vec3f& wi) {
        const double phi = std::atan2(wi.z, wi.x);
        const double turn = (phi < 0.0 ? phi + 2.0 * pi_d : phi) / (2.0 * pi_d);
        const double theta = std::atan2(std::hypot(wi.x, wi.z), wi.y) / pi_d;
        return std::pair(std::min(int(turn * columns), columns - 1), std::min(int(theta * rows), rows - 1));
    };
    const auto run = [&](std::uint64_t samples, std::uint64_t seed) {
        std::map<std::pair<int, int>, double> counts;
        TestRandom random(seed);
        for (std::uint64_t i = 0; i < samples; ++i) {
            const double u_select = random.next_double();
            const Vec2f u = random.next_2d();
            counts[cell_of(emitter->sample(receiver, u_select, u, Measure::best)->wi)] += 1.0;
        }
        double statistic = 0.0;
        int used = 0;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const Vec3f middle = direction(2.0 * pi_d * (i + 0.5) / columns, pi_d * (j + 0.5) / rows);
                const double solid_angle =
                    2.0 * pi_d / columns * (std::cos(pi_d * j / rows) - std::cos(pi_d * (j + 1) / rows));
                const double expected =
                    seen(*emitter, middle, receiver.sky).pdf * solid_angle * double(samples);
                const double found = counts[{i, j}];
                // A handful may be rounded over the border of a cell.
                if (expected < 5.0) {
                    statistic += found > 3.0 ? infinity : 0.0;
                    continue;
                }
                statistic += sqr(found - expected) / expected;
                ++used;
            }
        const double p = test::chi2_survival(statistic, used - 1);
        return test::Outcome{p, "chi2 = " + std::to_string(statistic) + " in " + std::to_string(used) +
                                    " cells"};
    };
    test::check_statistic("environment", run, 20000, level);

    // Light sampling alone finds all the light.
    const double expected =
        integral([&](const Vec3f& wi) { return luminance(seen(*emitter, wi).radiance) * (1.5 + wi.y); });
    const auto estimate = [&](std::uint64_t samples, std::uint64_t seed) {
        MeanAndVariance mean;
        TestRandom random(seed + 77);
        for (std::uint64_t i = 0; i < samples; ++i) {
            const double u_select = random.next_double();
            const Vec2f u = random.next_2d();
            const auto sample = emitter->sample(receiver, u_select, u, Measure::best);
            mean.add(luminance(sample->radiance) * (1.5 + sample->wi.y) / sample->pdf);
        }
        return mean;
    };
    test::check_mean("environment, all light", expected, estimate, 20000, level, 1,
                     1e-4); // 1e-4: the quadrature's error
}

TEST_CASE("an environment of one colour", "[unit][environment]")
{
    const Color radiance(0.5f, 1.f, 2.f);
    const auto emitter = environment_params(GENERATE(false, true)) // which changes images only
                             .color("radiance", radiance)
                             .build<EnvironmentEmitter, Emitter>();
    emitter->prepare({Vec3f(0.f), 2.f});
    CHECK(emitter->power() == Approx(luminance(radiance) * 4.0 * pi_d * pi_d * 4.0));
    CHECK(seen(*emitter, Vec3f(0, -1, 0)).radiance == radiance);
    CHECK(seen(*emitter, Vec3f(0, -1, 0)).pdf == Approx(0.25 / pi_d));
    const auto sample = emitter->sample({Vec3f(0.f)}, 0.3, {0.2f, 0.8f}, Measure::best);
    REQUIRE(sample);
    CHECK(sample->radiance == radiance);
    CHECK(sample->pdf == Approx(0.25 / pi_d));

    TestRandom random;
    for (const SkyRectangle& rectangle : rectangles) {
        LightReceiver receiver{Vec3f(0.f)};
        receiver.sky = emitter->sky_map()->view(rectangle);
        int shown = 0;
        for (int i = 0; i < 1000; ++i) {
            const double u_select = random.next_double();
            const auto chosen = emitter->sample(receiver, u_select, random.next_2d(), Measure::best);
            REQUIRE(chosen);
            CHECK(chosen->radiance == radiance);
            shown +=
                emitter->sky_map()->shows(receiver.sky, emitter->sky_map()->place_of(chosen->wi)) ? 1 : 0;
        }
        CHECK(shown > 850); // seven of eight
    }
}

TEST_CASE("black environments give no samples", "[unit][environment]")
{
    const TempDirectory directory;
    write_image(directory / "black.exr", Image(3, 2));
    const auto image_of_nothing = ParamsBuilder("emitter", "environment")
                                      .directory(directory.path())
                                      .string("filename", "black.exr")
                                      .build<EnvironmentEmitter, Emitter>();
    const auto black = ParamsBuilder("emitter", "environment")
                           .color("radiance", Color(0.f))
                           .build<EnvironmentEmitter, Emitter>();
    for (const Emitter* emitter : {image_of_nothing.get(), black.get()}) {
        emitter->evaluate({Vec3f(0.f)}, Vec3f(0, 1, 0), nullptr, Measure::best);
        CHECK_FALSE(emitter->sample({Vec3f(0.f)}, 0.5, {0.5f, 0.5f}, Measure::best));
        CHECK(seen(*emitter, Vec3f(0, 1, 0)).pdf == 0.f);
        CHECK(emitter->power() == 0.f);
    }
}

TEST_CASE("environment images that are not light", "[unit][environment]")
{
    const TempDirectory directory;
    Image image(4, 3);
    image.pixel(2, 1)[1] = -1.f;
    image.pixel(1, 1)[1] = 1.f;
    write_image(directory / "negative.exr", image);
    const auto negative = ParamsBuilder("emitter", "environment")
                              .directory(directory.path())
                              .string("filename", "negative.exr");
    const auto complaints = negative.complaints<EnvironmentEmitter, Emitter>();
    REQUIRE(complaints.size() == 1);
    CHECK_THAT(complaints[0], ContainsSubstring("warning: the image has negative values"));
    const auto emitter = negative.build<EnvironmentEmitter, Emitter>();
    CHECK(integral([&](const Vec3f& wi) { return min_component(seen(*emitter, wi).radiance); }) == 0.0);

    image.pixel(3, 2)[0] = infinity;
    write_image(directory / "infinite.exr", image);
    const auto infinite = ParamsBuilder("emitter", "environment")
                              .directory(directory.path())
                              .string("filename", "infinite.exr");
    CHECK_THROWS_WITH((infinite.build<EnvironmentEmitter, Emitter>()),
                      ContainsSubstring("pixel (3, 2) is not finite"));

    const auto rotated = ParamsBuilder("emitter", "environment").number("rotate", 180.0);
    const auto warnings = rotated.complaints<EnvironmentEmitter, Emitter>();
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], ContainsSubstring("warning: 'rotate' of an environment is ignored"));
}
