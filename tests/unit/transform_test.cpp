// SPDX-License-Identifier: MIT

#include "plumb/math/transform.h"

#include "support/catch.h"
#include "support/random.h"

#include <vector>

using namespace plumb;
using plumb::test::TestRandom;

namespace {

void check_near(const Vec3f& a, const Vec3f& b, double margin = 1e-6)
{
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(length(Vec3d(a) - Vec3d(b)) <= margin);
}

// The largest entry of a * b - 1.
double distance_from_identity(const Transform& a, const Transform& b)
{
    const Transform product = a * b;
    const Transform identity;
    double largest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            largest = std::max(largest, std::abs(product.rows()[i][j] - identity.rows()[i][j]));
    return largest;
}

Transform::Rows random_rows(TestRandom& random)
{
    Transform::Rows rows{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) rows[i][j] = random.between(-2, 2);
    rows[3] = {0, 0, 0, 1};
    return rows;
}

} // namespace

TEST_CASE("points, vectors and normals follow three rules", "[unit][transform]")
{
    const Transform moved = Transform::translate(Vec3d(1, 2, 3));
    CHECK(moved.point(Vec3f(1, 1, 1)) == Vec3f(2, 3, 4));
    CHECK(moved.vector(Vec3f(1, 1, 1)) == Vec3f(1, 1, 1));
    CHECK(moved.normal(Vec3f(1, 1, 1)) == Vec3f(1, 1, 1));

    // A plane x + y = 0 squeezed along x: its normal leans towards x.
    const Transform squeezed = *Transform::scale(Vec3d(0.5, 1, 1));
    CHECK(squeezed.point(Vec3f(2, 2, 2)) == Vec3f(1, 2, 2));
    CHECK(squeezed.normal(Vec3f(1, 1, 0)) == Vec3f(2, 1, 0));

    TestRandom random;
    for (int i = 0; i < 100; ++i) {
        const auto transform = Transform::from_rows(random_rows(random));
        if (!transform) continue;
        const Vec3f tangent = random.direction();
        const Vec3f normal = normalize(cross(tangent, random.direction()));
        const Vec3f new_tangent = transform->vector(tangent);
        const Vec3f new_normal = transform->normal(normal);
        CHECK(dot(new_tangent, new_normal) ==
              Approx(0.0).margin(1e-5 * length(new_tangent) * length(new_normal)));
    }
}

TEST_CASE("matrices act on columns, and a * b applies b first", "[unit][transform]")
{
    const auto shear = Transform::from_rows({{{1, 2, 0, 5}, {0, 1, 0, 6}, {0, 0, 1, 7}, {0, 0, 0, 1}}});
    REQUIRE(shear);
    CHECK(shear->point(Vec3f(1, 1, 1)) == Vec3f(8, 7, 8));

    const Transform scale = *Transform::scale(Vec3d(2));
    const Transform move = Transform::translate(Vec3d(1, 0, 0));
    CHECK((move * scale).point(Vec3f(1, 1, 1)) == Vec3f(3, 2, 2));
    CHECK((scale * move).point(Vec3f(1, 1, 1)) == Vec3f(4, 2, 2));
    CHECK(Vec3f((scale * move).point(Vec3d(1, 1, 1))) == Vec3f(4, 2, 2));
}

TEST_CASE("rotations are counter-clockwise about the axis", "[unit][transform]")
{
    check_near(Transform::rotate(Vec3d(0, 0, 1), 30).vector(Vec3f(1, 0, 0)), Vec3f(0.8660254f, 0.5f, 0));
    check_near(Transform::rotate(Vec3d(0, 5, 0), 30).vector(Vec3f(0, 0, 1)), Vec3f(0.5f, 0, 0.8660254f));
    check_near(Transform::rotate(Vec3d(3, 0, 0), -30).vector(Vec3f(0, 1, 0)), Vec3f(0, 0.8660254f, -0.5f));
    // A third of a turn about the diagonal permutes the axes.
    check_near(Transform::rotate(Vec3d(1, 1, 1), 120).vector(Vec3f(1, 2, 3)), Vec3f(3, 1, 2));
    // What lies on the axis stays there.
    check_near(Transform::rotate(Vec3d(1, -2, 2), 77).vector(Vec3f(1, -2, 2)), Vec3f(1, -2, 2));
}

TEST_CASE("rotations by multiples of 90 degrees are exact", "[unit][transform]")
{
    struct Case {
        Vec3d axis;
        double degrees;
        Vec3f expected; // of (1, 2, 3)
    };
    const std::vector<Case> cases = {
        {{1, 0, 0}, 90, {1, -3, 2}},  {{1, 0, 0}, 180, {1, -2, -3}},  {{0, 1, 0}, 90, {3, 2, -1}},
        {{0, 1, 0}, -90, {-3, 2, 1}}, {{0, 0, 1}, 90, {-2, 1, 3}},    {{0, 0, 2}, 270, {2, -1, 3}},
        {{0, 0, 1}, 450, {-2, 1, 3}}, {{0, -1, 0}, 360, {1, 2, 3}},   {{1, 0, 0}, -630, {1, -3, 2}},
        {{0, 0, 1}, 0, {1, 2, 3}},    {{0, 0, 1}, -36090, {2, -1, 3}}};
    for (const Case& c : cases) {
        CAPTURE(c.degrees, c.axis.x, c.axis.y, c.axis.z);
        const Transform rotation = Transform::rotate(c.axis, c.degrees);
        CHECK(rotation.vector(Vec3f(1, 2, 3)) == c.expected);
        for (const auto& row : rotation.rows())
            for (const double x : row) CHECK((x == 0.0 || x == 1.0 || x == -1.0));
    }
}

TEST_CASE("look_at maps +z to the target, +y up and +x to the left", "[unit][transform]")
{
    const auto view = Transform::look_at(Vec3d(0, 0, 5), Vec3d(0, 0, 0), Vec3d(0, 2, 0));
    REQUIRE(view);
    CHECK(view->point(Vec3f(0, 0, 0)) == Vec3f(0, 0, 5));
    CHECK(view->vector(Vec3f(0, 0, 1)) == Vec3f(0, 0, -1));
    CHECK(view->vector(Vec3f(0, 1, 0)) == Vec3f(0, 1, 0));
    CHECK(view->vector(Vec3f(1, 0, 0)) == Vec3f(-1, 0, 0)); // the viewer looks along -z: its left is -x
    CHECK(view->determinant() == Approx(1.0));

    // An up vector that is not perpendicular to the direction is straightened.
    const auto tilted = Transform::look_at(Vec3d(1, 2, 3), Vec3d(4, -2, 8), Vec3d(0, 1, 0));
    REQUIRE(tilted);
    check_near(tilted->vector(Vec3f(0, 0, 1)), normalize(Vec3f(3, -4, 5)));
    CHECK(tilted->vector(Vec3f(0, 1, 0)).y > 0.f);
    CHECK(tilted->vector(Vec3f(1, 0, 0)).y == 0.f);
    CHECK(distance_from_identity(*tilted, tilted->inverse()) < 1e-14);

    CHECK_FALSE(Transform::look_at(Vec3d(1, 2, 3), Vec3d(1, 2, 3), Vec3d(0, 1, 0)));
    CHECK_FALSE(Transform::look_at(Vec3d(0, 0, 0), Vec3d(0, 3, 0), Vec3d(0, -1, 0)));
    CHECK_FALSE(Transform::look_at(Vec3d(0, 0, 0), Vec3d(0, 3, 1), Vec3d(0, 0, 0)));
    CHECK(Transform::look_at(Vec3d(0, 0, 0), Vec3d(0, 1e-30, 0), Vec3d(1e30, 0, 0)));
}

TEST_CASE("inverses undo every kind of transform", "[unit][transform]")
{
    TestRandom random(3);
    for (int i = 0; i < 200; ++i) {
        const auto transform = Transform::from_rows(random_rows(random));
        REQUIRE(transform);
        CHECK(distance_from_identity(*transform, transform->inverse()) < 1e-9);
    }
    const auto chain_with = [](const Vec3d& factors) {
        return Transform::translate(Vec3d(1, 2, 3)) * Transform::rotate(Vec3d(1, 2, 3), 33) *
               *Transform::scale(factors);
    };
    const Transform uneven = chain_with(Vec3d(1e-4, 3, -1e5));
    CHECK(distance_from_identity(uneven, uneven.inverse()) < 1e-9);
    const Transform chain = chain_with(Vec3d(0.5, 3, -20));
    CHECK(distance_from_identity(chain.inverse(), chain) < 1e-12);
    CHECK(chain.inverse().inverse().rows() == chain.rows());
}

TEST_CASE("singular and projective matrices are refused at any scale", "[unit][transform]")
{
    const auto scaled = [](double factor, double last) {
        // The third row is the sum of the first two, but for `last`.
        Transform::Rows rows = {{{1, 2, 3, 0}, {4, 5, 6, 0}, {5, 7, 9 + last, 0}, {0, 0, 0, 1}}};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) rows[i][j] *= factor;
        return Transform::from_rows(rows);
    };
    for (const double factor : {1e-100, 1e-6, 1.0, 1e6, 1e100}) {
        CAPTURE(factor);
        CHECK_FALSE(scaled(factor, 0.0));
        CHECK_FALSE(scaled(factor, 1e-14));
        CHECK(scaled(factor, 0.01));
    }
    CHECK_FALSE(Transform::from_rows({{{0, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}));
    CHECK_FALSE(Transform::from_rows({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0.1, 1}}}));
    CHECK_FALSE(Transform::from_rows({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 2}}}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(Transform::from_rows({{{1, 0, 0, nan}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}));

    // Very uneven scales are legal.
    CHECK(Transform::from_rows({{{1e-9, 0, 0, 0}, {0, 1e9, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}));
    CHECK(Transform::scale(Vec3d(1e-9, 1, 1)));
    CHECK_FALSE(Transform::scale(Vec3d(1, 0, 1)));
}

TEST_CASE("determinant, identity and uniform scale", "[unit][transform]")
{
    CHECK(Transform().is_identity());
    CHECK((Transform::translate(Vec3d(1, 0, 0)) * Transform::translate(Vec3d(-1, 0, 0))).is_identity());
    CHECK_FALSE(Transform::translate(Vec3d(1, 0, 0)).is_identity());
    CHECK(Transform::scale(Vec3d(2, 3, -4))->determinant() == -24.0);

    CHECK(Transform().uniform_scale() == 1.0);
    CHECK(Transform::scale(Vec3d(2))->uniform_scale() == 2.0);
    CHECK(Transform::scale(Vec3d(-2, 2, 2))->uniform_scale() == 2.0);
    CHECK_FALSE(Transform::scale(Vec3d(1, 1, 1.001))->uniform_scale());
    CHECK(Transform::scale(Vec3d(1, 1, 1.000001))->uniform_scale());
    const Transform turned = Transform::rotate(Vec3d(1, 2, 3), 40);
    REQUIRE((turned * *Transform::scale(Vec3d(1e-4))).uniform_scale());
    CHECK(*(turned * *Transform::scale(Vec3d(1e-4))).uniform_scale() == Approx(1e-4).epsilon(1e-12));
    CHECK_FALSE((turned * *Transform::scale(Vec3d(1, 2, 1)) * turned).uniform_scale());
    // Columns of equal length that are not perpendicular.
    CHECK_FALSE(Transform::from_rows({{{1, 0.6, 0, 0}, {0, 0.8, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}})
                    ->uniform_scale());
}
