// SPDX-License-Identifier: MIT

// Emitters: what sample() chooses follows what evaluate() says, and light that arrives has its closed form.
//
// [1] Siegel and Howell, "Thermal Radiation Heat Transfer", configuration factors of a differential element to a
//     sphere and to a parallel rectangle.

#include "plumb/model/shape.h"
#include "support/catch.h"
#include "support/lamp.h"
#include "support/statistics.h"

#include <cmath>
#include <vector>

namespace plumb::test {
namespace {

// Lambert's formula for a polygon wholly above the horizon, L / 2 times the sum of edge angles times the cosines of
// the edges' normals ([1], and Baum, Rushmeier and Winget 1989, equation 2): corners clockwise seen from the origin
// give a positive sign. The surface at the origin faces up.
double polygon_irradiance(const std::vector<Vec3d>& corners, double radiance)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i]);
        const Vec3d b = normalize(corners[(i + 1) % corners.size()]);
        const Vec3d normal = cross(a, b);
        sum += std::atan2(length(normal), dot(a, b)) * normal.y / length(normal);
    }
    return std::abs(sum) * radiance / 2.0;
}

// The chi-square tests of this file.
const double chi2_level = sidak_level(significance, 13);

DirectionSampler directions(const Lamp& lamp, const Vec3f& from, Measure measure)
{
    return [&lamp, from, measure](TestRandom& random) -> std::optional<Vec3f> {
        const double u_select = random.next_double();
        const Vec2f u = random.next_2d();
        const auto s = lamp.emitter().sample({from}, u_select, u, measure);
        if (!s) return std::nullopt;
        return s->wi;
    };
}

// The directions from the origin to a sphere, on a grid on which its silhouette is a border between cells.
void check_sphere_directions(const std::string& name, const Vec3f& center, double radius, Measure measure)
{
    const Lamp lamp = white(ball(center, radius));
    const double sine2 = radius * radius / length_squared(Vec3d(center));
    const double one_minus_cos = sine2 / (1.0 + std::sqrt(1.0 - sine2));
    SphereGrid grid;
    grid.axis = normalize(center);
    grid.concentration = std::log(one_minus_cos / 2.0) / std::log(0.75);
    const auto density = [&](const Vec3f& wi) {
        return static_cast<double>(lamp.look(Vec3f(0.f), wi, measure).pdf);
    };
    check_distribution(name, grid, directions(lamp, Vec3f(0.f), measure), density, 60000, chi2_level);
}

// The directions from a point to a flat lamp with the given sides, as points of the plane at distance 1 that is
// parallel to it: the grid is what the lamp covers.
void check_flat_directions(const std::string& name, const Lamp& lamp, const Vec3d& center, const Vec3d& width,
                           const Vec3d& height, const Vec3f& from)
{
    const Vec3d x_axis = normalize(width);
    const Vec3d y_axis = normalize(height);
    const Vec3d to_plane = normalize(cross(y_axis, x_axis)); // against the front's normal
    const Vec3d towards = center - Vec3d(from);
    const double distance = dot(towards, to_plane);
    REQUIRE(distance > 0.0);
    const double x = dot(towards, x_axis) / distance;
    const double y = dot(towards, y_axis) / distance;
    const double half_x = 0.5 * length(width) / distance;
    const double half_y = 0.5 * length(height) / distance;

    const Grid grid{x - half_x, x + half_x, y - half_y, y + half_y, 12, 12};
    const auto sample_direction = directions(lamp, from, Measure::best);
    const auto place = [&](TestRandom& random) -> std::optional<Imath::V2d> {
        const auto wi = sample_direction(random);
        if (!wi) return std::nullopt;
        const Vec3d w(*wi);
        return Imath::V2d(dot(w, x_axis), dot(w, y_axis)) / dot(w, to_plane);
    };
    const auto density = [&](double px, double py) {
        const Vec3d direction = x_axis * px + y_axis * py + to_plane;
        const double cosine = 1.0 / length(direction);
        return static_cast<double>(lamp.look(from, Vec3f(direction * cosine), Measure::best).pdf) * cosine *
               cosine * cosine;
    };
    check_distribution(name, grid, place, density, 60000, chi2_level);
}

// Each sample against what a ray in its direction sees: density and radiance.
void check_samples(const std::string& name, const Lamp& lamp, const Vec3f& from, Measure measure)
{
    INFO(name);
    TestRandom random(7);
    int compared = 0;
    for (int i = 0; i < 30000 && compared < 50; ++i) {
        const double u_select = random.next_double();
        const Vec2f u = random.next_2d();
        const auto s = lamp.emitter().sample({from}, u_select, u, measure);
        if (!s) continue;
        CHECK(length(s->position - (from + s->wi * s->distance)) <= 1e-5f * (s->distance + 1.f));
        CHECK(length(s->wi) == Approx(1.0).epsilon(1e-6));
        // Not at the silhouette, where the ray may miss, and the density changes quickly.
        if (dot(s->normal, s->wi) > -0.05f) continue;
        const EmitterValue value = lamp.look(from, s->wi, measure);
        if (value.radiance.is_black()) continue; // the ray missed an edge
        ++compared;
        CHECK(value.pdf == Approx(s->pdf).epsilon(1e-3));
        CHECK(value.radiance.r == Approx(s->radiance.r).epsilon(1e-3));
    }
    CHECK(compared == 50);
}

// The irradiance on a surface at the origin that faces up.
void check_irradiance(const std::string& name, const Lamp& lamp, double expected, Measure measure,
                      const Vec3f& from = Vec3f(0.f))
{
    constexpr std::size_t tests = 15; // calls of this function
    const auto estimate = [&](std::uint64_t samples, std::uint64_t seed) {
        TestRandom random(seed);
        MeanAndVariance irradiance;
        for (std::uint64_t i = 0; i < samples; ++i) {
            const double u_select = random.next_double();
            const Vec2f u = random.next_2d();
            const auto s = lamp.emitter().sample({from}, u_select, u, measure);
            const double cosine = s ? std::max(s->wi.y, 0.f) : 0.0;
            irradiance.add(s ? static_cast<double>(s->radiance.r) * cosine / static_cast<double>(s->pdf)
                             : 0.0);
        }
        return irradiance;
    };
    check_mean(name, expected, estimate, 20000, sidak_level(significance, tests), 1, 1e-5);
}

// [1]: the part of the hemisphere's cosine-weighted directions that a rectangle of a x b covers, parallel to the
// element at distance c, one corner above it.
double corner_factor(double a, double b, double c)
{
    const double x = a / c;
    const double y = b / c;
    const double p = std::sqrt(1.0 + x * x);
    const double q = std::sqrt(1.0 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2.0 * pi_d);
}

} // namespace

TEST_CASE("directions to area lights follow their density", "[statistical][emitter]")
{
    check_sphere_directions("sphere by solid angle", Vec3f(1, 3, 0), 0.5, Measure::solid_angle);
    check_sphere_directions("sphere from nearby", Vec3f(0, 1.01f, 0), 1.0, Measure::best);
    check_sphere_directions("sphere by area", Vec3f(1, 3, 0), 0.5, Measure::area);

    const Vec3f normal = normalize(Vec3f(0.3f, -1, 0));
    const Vec3d width = normalize(Vec3d(1, 0, 0) - Vec3d(normal) * static_cast<double>(normal.x));
    const Vec3d height = cross(Vec3d(normal), width);
    const Vec3f center(0.5f, 2, 0);
    const Lamp tilted = white(panel(center, 2.0, 1.0, normal));
    check_flat_directions("rectangle", tilted, Vec3d(center), width * 2.0, height, Vec3f(0.f));
    check_flat_directions("rectangle from the side", tilted, Vec3d(center), width * 2.0, height,
                          Vec3f(-1, 0.5f, 2));
    const Lamp textured(panel(Vec3f(0, 1.5f, 0), 1.0, 2.0, Vec3f(0, -1, 0)), two_tone);
    check_flat_directions("textured rectangle", textured, Vec3d(0, 1.5, 0), Vec3d(1, 0, 0), Vec3d(0, 0, 2),
                          Vec3f(0.1f, 0, 0.2f));
    check_flat_directions("rectangle from nearby", tilted, Vec3d(center), width * 2.0, height,
                          center + normal * 0.05f + Vec3f(width) * 0.3f);
    check_flat_directions("rectangle from beside it", tilted, Vec3d(center), width * 2.0, height,
                          center + normal * 0.1f + Vec3f(width) * 1.1f);
    check_flat_directions("rectangle from afar", tilted, Vec3d(center), width * 2.0, height,
                          Vec3f(0.5f, -1, 0));
    check_flat_directions("rectangle of triangles", white(mesh(even_sheet)), Vec3d(0, 2, 0), Vec3d(2, 0, 0),
                          Vec3d(0, 0, 2), Vec3f(0.3f, 1.5f, -0.9f));
    check_flat_directions("mesh", white(mesh(uneven_sheet)), Vec3d(0, 2, 0.5), Vec3d(2, 0, 0), Vec3d(0, 0, 2),
                          Vec3f(0.f));
}

TEST_CASE("samples of area lights are what a ray in their direction sees", "[unit][emitter]")
{
    const Lamp far_ball = white(ball(Vec3f(1, 3, 0), 0.5));
    check_samples("sphere by solid angle", far_ball, Vec3f(0.f), Measure::solid_angle);
    check_samples("sphere by area", far_ball, Vec3f(0.f), Measure::area);
    const Lamp near_ball = white(ball(Vec3f(0, 1.01f, 0), 1.0));
    check_samples("sphere from nearby by solid angle", near_ball, Vec3f(0.f), Measure::best);
    check_samples("sphere from nearby by area", near_ball, Vec3f(0.f), Measure::area);
    const Lamp tilted(panel(Vec3f(0.5f, 2, 0), 2.0, 1.0, Vec3f(0.3f, -1, 0)), two_tone);
    check_samples("rectangle", tilted, Vec3f(0.f), Measure::area);
    check_samples("rectangle where a solid angle was asked for", tilted, Vec3f(0.f), Measure::solid_angle);
    check_samples("rectangle from nearby", tilted, Vec3f(0.5f, 1.5f, 0.2f), Measure::best);
    check_samples("rectangle of triangles", white(mesh(even_sheet)), Vec3f(0.3f, 1.5f, -0.9f), Measure::best);
    check_samples("mesh", white(mesh(bent_sheet)), Vec3f(0.f), Measure::best);
}

TEST_CASE("light of area emitters arrives in its closed form", "[statistical][emitter]")
{
    // [1]: a sphere wholly above the horizon, E = pi L sin^2(half angle) cos(angle of its centre).
    const double tilted = pi_d * 2.0 * (0.25 / 10.0) * (3.0 / std::sqrt(10.0));
    const Lamp far_ball = white(ball(Vec3f(1, 3, 0), 0.5));
    check_irradiance("sphere by solid angle", far_ball, tilted, Measure::solid_angle);
    check_irradiance("sphere by area", far_ball, tilted, Measure::area);
    const Lamp tiny = white(ball(Vec3f(0, 3, 0), 1e-4));
    check_irradiance("tiny sphere", tiny, pi_d * 2.0 * (1e-8 / 9.0), Measure::best);
    const Lamp near_ball = white(ball(Vec3f(0, 1.0001f, 0), 1.0));
    const double gap = static_cast<double>(1.0001f);
    check_irradiance("sphere from nearby", near_ball, pi_d * 2.0 / (gap * gap), Measure::best);

    const double four = corner_factor(1, 0.5, 2) + corner_factor(1, 1.5, 2);
    const double sheet = pi_d * 2.0 * 2.0 * four;
    check_irradiance("rectangle", white(panel(Vec3f(0, 2, 0.5f), 2.0, 2.0, Vec3f(0, -1, 0))), sheet,
                     Measure::best);
    check_irradiance("mesh", white(mesh(uneven_sheet)), sheet, Measure::area);
    const double near_sheet = pi_d * 2.0 * 4.0 * corner_factor(1, 1, 0.01);
    check_irradiance("rectangle from nearby", white(panel(Vec3f(0, 0.01f, 0), 2.0, 2.0, Vec3f(0, -1, 0))),
                     near_sheet, Measure::best);
    check_irradiance("rectangle of triangles from nearby", white(mesh(even_sheet)), near_sheet, Measure::best,
                     Vec3f(0, 1.99f, 0));
    const double bent = polygon_irradiance({{-1, 2, -1}, {1, 2, -1}, {1, 2.5, 1}}, 2.0) +
                        polygon_irradiance({{-1, 2, -1}, {1, 2.5, 1}, {-0.5, 1.5, 1.5}}, 2.0);
    check_irradiance("bent mesh", white(mesh(bent_sheet)), bent, Measure::best);
    check_irradiance("rectangle from behind", white(panel(Vec3f(0, 2, 0.5f), 2.0, 2.0, Vec3f(0, 1, 0))), 0.0,
                     Measure::best);
    check_irradiance("sphere from inside", white(ball(Vec3f(0, 0.2f, 0), 1.0)), 0.0, Measure::best);

    // The half with u < 1/2 has radiance 3, the other 15.
    const Lamp halves(panel(Vec3f(0, 2, 0), 2.0, 2.0, Vec3f(0, -1, 0)), two_tone);
    check_irradiance("textured rectangle", halves, pi_d * (3.0 + 15.0) * 2.0 * corner_factor(1, 1, 2),
                     Measure::best);
    // A mesh with the same halves, [-1, 1] and [1, 3] along x.
    const Lamp wide(mesh("v -1 2 -1\nv 3 2 -1\nv 3 2 1\nv -1 2 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                         "f 1/1 2/2 3/3 4/4\n"),
                    two_tone);
    const double dim = 4.0 * corner_factor(1, 1, 2);
    const double bright = 2.0 * (corner_factor(3, 1, 2) - corner_factor(1, 1, 2));
    check_irradiance("textured mesh", wide, pi_d * (3.0 * dim + 15.0 * bright), Measure::best);
    // A sphere above, turned so that u = 1/2 is the border between left and right: half of each is seen.
    const Lamp turned(ParamsBuilder("shape", "sphere")
                          .number("radius", 0.5)
                          .transform("toWorld", Transform::translate(Vec3d(0, 3, 0)) *
                                                    Transform::rotate(Vec3d(0, 0, 1), 90.0))
                          .build<Sphere, Shape>(),
                      two_tone);
    const Vec3f right = normalize(Vec3f(0.05f, 1, 0)), left = normalize(Vec3f(-0.05f, 1, 0));
    CHECK(turned.look(Vec3f(0.f), right, Measure::best).radiance.r == Approx(3.0));
    CHECK(turned.look(Vec3f(0.f), left, Measure::best).radiance.r == Approx(15.0));
    const double both = pi_d * (3.0 + 15.0) / 2.0 * (0.25 / 9.0);
    check_irradiance("textured sphere by solid angle", turned, both, Measure::solid_angle);
    check_irradiance("textured sphere by area", turned, both, Measure::area);
}

} // namespace plumb::test
