// SPDX-License-Identifier: MIT

// What every shape of the catalog promises (plumb/model/shape.h), for each sample of its doc block as it is, and mirrored and
// sheared by toWorld; and inside an instance whose map does that.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/samples.h"
#include "support/statistics.h"

namespace plumb {
class Diffuse;
}

using namespace plumb;
using namespace plumb::test;

namespace {

// A shape alone in a scene.
class Alone {
public:
    explicit Alone(std::unique_ptr<Shape> shape) : Alone(std::move(shape), nullptr, std::nullopt) {}
    // Inside an instance. twin: the same surface without instance, if there can be one.
    Alone(std::unique_ptr<Shape> shape, std::unique_ptr<Shape> twin, const std::optional<Transform>& map)
        : scene_(scene_of(std::move(shape), map)), twin_(std::move(twin))
    {
        if (twin_) twin_->prepare_sampling();
        const Box3f box = scene_.bounds();
        center_ = box.center();
        radius_ = 0.5f * length(box.size()) * 1.001f;
    }

    const Scene& scene() const { return scene_; }
    bool in_instance() const { return !scene_.instances().empty(); }
    bool has_shape() const { return twin_ || !in_instance(); }
    // In the world.
    const Shape& shape() const { return twin_ ? *twin_ : *scene_.objects()[0].shape; }
    const Vec3f& center() const { return center_; }
    float radius() const { return radius_; }

    // A chord of the sphere around it between two points that are uniform on it: these are uniform among all lines.
    Ray random_line(TestRandom& random) const
    {
        const Vec3f from = center_ + random.direction() * radius_,
                    to = center_ + random.direction() * radius_;
        return {from, to - from, 0.f, 1.f};
    }

private:
    static Scene scene_of(std::unique_ptr<Shape> shape, const std::optional<Transform>& map)
    {
        shape->prepare_sampling();
        std::vector<SceneObject> objects;
        objects.push_back(
            {std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "shape"});
        if (!map) return Scene(std::move(objects), {});
        std::vector<Instance> instances;
        instances.push_back({*InstanceMap::from(*map),
                             std::make_shared<const Group>(std::move(objects), "group"), "instance"});
        return Scene({}, {}, {}, std::move(instances));
    }

    Scene scene_;
    std::unique_ptr<Shape> twin_;
    Vec3f center_;
    float radius_ = 0.f;
};

struct Case {
    std::string name;
    Alone alone;
};

bool is_mesh_file(const Case& test)
{
    return test.name.find("\"filename\"") != std::string::npos;
}

// The sample with another toWorld.
std::string with_transform(std::string xml, const std::string& operations)
{
    const std::string begin = "<transform name=\"toWorld\">", end = "</transform>";
    if (const std::size_t at = xml.find(begin); at != xml.npos)
        xml.erase(at, xml.find(end, at) + end.size() - at);
    return xml.insert(xml.rfind("</"), begin + operations + end);
}

// The same maps as below.
Transform turned(const std::optional<Transform>& first)
{
    return Transform::translate({3, -2, 1}) * Transform::rotate({1, 2, -1}, 50) * *first;
}

Transform sheared_mirror()
{
    return turned(
        Transform::from_rows({{{-1.5, 0.6, 0, 0}, {0, 0.8, 0.3, 0}, {0.2, 0, 1.2, 0}, {0, 0, 0, 1}}}));
}

Transform even_mirror()
{
    return turned(Transform::scale({-1.5, 1.5, 1.5}));
}

// A mirror that shears; or, of shapes that cannot be sheared, one that keeps angles.
struct Transformed {
    std::unique_ptr<Shape> shape;
    bool is_sheared;
};

Transformed transformed(const std::string& xml)
{
    const std::string turn = "<rotate axis=\"1,2,-1\" angle=\"50\"/><translate value=\"3,-2,1\"/>";
    try {
        const Sample sheared(with_transform(
            xml, "<matrix value=\"-1.5 0.6 0 0  0 0.8 0.3 0  0.2 0 1.2 0  0 0 0 1\"/>" + turn));
        return {sheared.build(shape_types()), true};
    } catch (const std::runtime_error&) {
        auto shape =
            Sample(with_transform(xml, "<scale value=\"-1.5,1.5,1.5\"/>" + turn)).build(shape_types());
        // Sheared, it would be none, and the cross-section of a cylinder no circle.
        CHECK((shape->as_ball() || xml.find("type=\"cylinder\"") != xml.npos));
        return {std::move(shape), false};
    }
}

std::vector<Case> cases()
{
    std::vector<Case> result;
    for (const auto& sample : samples_of(shape_types())) {
        result.push_back({sample->text(), Alone(sample->build(shape_types()))});
        result.push_back({"transformed " + sample->text(), Alone(transformed(sample->text()).shape)});
        auto [twin, is_sheared] = transformed(sample->text());
        const Sample plain(with_transform(sample->text(), "<translate value=\"0,0,0\"/>"));
        result.push_back(
            {"in an instance: " + sample->text(), Alone(plain.build(shape_types()), std::move(twin),
                                                        is_sheared ? sheared_mirror() : even_mirror())});
        if (!is_sheared)
            result.push_back({"sheared in an instance: " + sample->text(),
                              Alone(plain.build(shape_types()), nullptr, sheared_mirror())});
    }
    return result;
}

// |dp_du du + dp_dv dv - dp| / |dp| between two points.
double tangent_error(const Tangents& tangents, const SurfacePoint& a, const SurfacePoint& b)
{
    const Vec2f uv = b.uv - a.uv;
    const Vec3d moved = Vec3d(b.position) - Vec3d(a.position);
    const Vec3d said =
        Vec3d(tangents.dp_du) * static_cast<double>(uv.x) + Vec3d(tangents.dp_dv) * static_cast<double>(uv.y);
    return length(said - moved) / length(moved);
}

// Quantities of a point whose means are compared.
std::array<double, 6> quantities(const Vec3f& p, const Vec2f& uv)
{
    return {p.x, p.y, p.z, sqr<double>(p.x), uv.x, uv.y};
}

} // namespace

TEST_CASE("tangents are the derivatives of the position by uv", "[statistical][shape]")
{
    for (const Case& test : cases()) {
        CAPTURE(test.name);
        const Scene& scene = test.alone.scene();
        const float step = 4e-3f * test.alone.radius();
        TestRandom random(3);
        int compared = 0, wrong = 0;
        for (int i = 0; i < 4000; ++i) {
            const Ray ray = test.alone.random_line(random);
            const Vec3f aside = random.direction();
            const auto at = scene.intersect(ray);
            const auto near = scene.intersect({ray.origin + aside * (step * 0.25f), ray.direction});
            const auto far = scene.intersect({ray.origin + aside * step, ray.direction});
            if (!at || !near || !far || at->primitive != near->primitive || at->primitive != far->primitive)
                continue;
            if (length(far->position - at->position) > 10.f * step ||
                length(near->position - at->position) < 0.05f * step)
                continue;                                     // grazing, another part, or along the ray
            if ((far->uv - at->uv).length() > 0.5f) continue; // across the seam of an angle
            ++compared;
            const Tangents tangents = tangents_at(*at);
            const double error = tangent_error(tangents, *at, *near);
            // Small, or what curvature leaves, which shrinks with the step.
            wrong += error < 0.005 || error < 0.5 * tangent_error(tangents, *at, *far) ? 0 : 1;
        }
        CHECK(compared > 300);
        CHECK(wrong == 0);
    }
}

TEST_CASE("lines meet a shape as often as its area says, and everywhere alike", "[statistical][shape]")
{
    // Crofton: a line that meets the sphere meets a surface area / (2 pi radius^2) times on average, uniformly over the
    // surface. Each crossing starts at the one before, so that a surface which is met twice would count twice.
    const std::vector<Case> all = cases();
    const double level = sidak_level(significance, all.size() * 7);
    for (const Case& test : all) {
        if (!test.alone.has_shape()) continue;
        const Shape& shape = test.alone.shape();
        const double expected = shape.area() / (2.0 * pi_d * sqr<double>(test.alone.radius()));
        const auto along_lines = [&](std::uint64_t n, std::uint64_t seed, const auto& quantity) {
            const FlushDenormals mode;
            TestRandom random(seed);
            MeanAndVariance result;
            for (std::uint64_t i = 0; i < n; ++i) {
                const Ray line = test.alone.random_line(random);
                const Vec3f end = line.origin + line.direction;
                double sum = 0.0;
                int crossings = 0;
                for (auto hit = test.alone.scene().intersect(line); hit && crossings < 1000; ++crossings) {
                    sum += quantity(hit->position, hit->uv);
                    Ray rest = hit->spawn_ray(line.direction);
                    rest.t_max = dot(end - rest.origin, line.direction) / dot(line.direction, line.direction);
                    if (!(rest.t_max > 0.f)) break;
                    hit = test.alone.scene().intersect(rest);
                }
                result.add(sum);
            }
            return result;
        };
        check_mean(
            "area of " + test.name, expected,
            [&](std::uint64_t n, std::uint64_t seed) {
                return along_lines(n, seed, [](const Vec3f&, const Vec2f&) { return 1.0; });
            },
            40'000, level, 5, 1e-5);

        for (std::size_t k = 0; k < 6; ++k)
            check_statistic(
                "quantity " + std::to_string(k) + " on " + test.name,
                [&](std::uint64_t n, std::uint64_t seed) {
                    TestRandom random(seed + 77);
                    MeanAndVariance sampled;
                    for (std::uint64_t i = 0; i < n; ++i) {
                        const double u_select = random.next_double();
                        const ShapeSample sample = shape.sample_area(u_select, random.next_2d());
                        sampled.add(quantities(sample.position, sample.uv)[k] * expected);
                    }
                    return same_mean_outcome(
                        sampled,
                        along_lines(n, seed,
                                    [&](const Vec3f& p, const Vec2f& uv) { return quantities(p, uv)[k]; }),
                        1e-4);
                },
                20'000, level, 6);
    }
}

TEST_CASE("samples of a shape are where a ray meets it, inside its bounds", "[statistical][shape]")
{
    for (const Case& test : cases()) {
        if (!test.alone.has_shape()) continue;
        CAPTURE(test.name);
        const FlushDenormals mode;
        const Shape& shape = test.alone.shape();
        const float size = test.alone.radius();
        const Box3f box = shape.bounds();
        const DirectionCone cone = shape.normals();
        TestRandom random(7);
        int compared = 0;
        for (int i = 0; i < 2000; ++i) {
            const double u_select = random.next_double();
            const ShapeSample sample = shape.sample_area(u_select, random.next_2d());
            CHECK(static_cast<double>(sample.pdf) == Approx(1.0 / shape.area()));
            CHECK(std::abs(length(sample.normal) - 1.f) < 1e-5f);
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(sample.position[axis] >= box.min[axis] - 1e-6f * size);
                CHECK(sample.position[axis] <= box.max[axis] + 1e-6f * size);
            }
            CHECK(dot(Vec3d(sample.normal), Vec3d(cone.axis)) >= std::cos(cone.angle) - 1e-5);
            const auto hit = test.alone.scene().intersect(
                {sample.position + sample.normal * (1e-3f * size), -sample.normal});
            if (!hit || length(hit->position - sample.position) > 1e-5f * size) continue; // another part
            ++compared;
            // A mirrored toWorld turns the mesh of a file without normals; an instance does not.
            const float side = test.alone.in_instance() && is_mesh_file(test) ? -1.f : 1.f;
            CHECK(length(hit->geometric_normal - sample.normal * side) < 1e-4f);
            CHECK(length(hit->position - sample.position) < 1e-5f * size);
            if ((hit->uv - sample.uv).length() < 0.5f) // not across the seam of an angle
                CHECK((hit->uv - sample.uv).length() < 1e-2f);
        }
        CHECK(compared > 1900);
    }
}

TEST_CASE("rays that leave a shape do not find the same place again",
          "[statistical][shape][self_intersection]")
{
    for (const Case& test : cases()) {
        CAPTURE(test.name);
        const FlushDenormals mode;
        const float size = test.alone.radius();
        TestRandom random(8);
        int rays = 0, wrong = 0;
        for (int i = 0; i < 20'000; ++i) {
            const auto at = test.alone.scene().intersect(test.alone.random_line(random));
            if (!at) continue;
            const Vec3f direction = random.direction();
            if (std::abs(dot(direction, at->geometric_normal)) < 1e-2f) continue;
            ++rays;
            const auto again = test.alone.scene().intersect(at->spawn_ray(direction));
            wrong += again && again->primitive == at->primitive &&
                             length(again->position - at->position) < 1e-3f * size
                         ? 1
                         : 0;
        }
        CHECK(rays > 2000);
        CHECK(wrong == 0);
    }
}

TEST_CASE("the solid angle of a shape is that of its area seen from there", "[statistical][shape]")
{
    const std::vector<Case> all = cases();
    const double level = sidak_level(significance, all.size() * 5);
    for (const Case& test : all) {
        if (test.alone.in_instance()) continue; // nothing is sampled there
        const Shape& shape = test.alone.shape();
        TestRandom places(9);
        int compared = 0;
        for (int i = 0; i < 400 && compared < 5; ++i) {
            const Vec3f from =
                test.alone.center() + places.direction() * (test.alone.radius() * (1.5f + places.next_1d()));
            const Vec2f u = places.next_2d();
            const auto pdf = shape.solid_angle_pdf(from);
            const auto one = shape.sample_solid_angle(from, u);
            REQUIRE(pdf.has_value() == one.has_value());
            if (!pdf) continue;
            REQUIRE(shape.has_solid_angle());
            CHECK(one->pdf == *pdf);
            ++compared;
            check_mean(
                "solid angle of " + test.name, 1.0 / static_cast<double>(*pdf),
                [&](std::uint64_t n, std::uint64_t seed) {
                    TestRandom random(seed);
                    MeanAndVariance result;
                    for (std::uint64_t k = 0; k < n; ++k) {
                        const double u_select = random.next_double();
                        const ShapeSample sample = shape.sample_area(u_select, random.next_2d());
                        const Vec3d towards = Vec3d(from) - Vec3d(sample.position);
                        const double cosine = dot(Vec3d(sample.normal), towards) / length(towards);
                        result.add(std::max(cosine, 0.0) / length_squared(towards) * shape.area());
                    }
                    return result;
                },
                20'000, level, 10, 1e-5);
        }
        CHECK(compared == (shape.has_solid_angle() ? 5 : 0));
    }
}

TEST_CASE("a shape inside an instance is the shape that toWorld makes", "[statistical][shape][instance]")
{
    for (const Case& test : cases()) {
        if (!test.alone.in_instance() || !test.alone.has_shape()) continue;
        CAPTURE(test.name);
        const FlushDenormals mode;
        const Shape& twin = test.alone.shape();
        const float size = test.alone.radius();
        TestRandom random(11);
        int compared = 0, wrong = 0;
        for (int i = 0; i < 4000; ++i) {
            const Ray ray = test.alone.random_line(random);
            const auto at = test.alone.scene().intersect(ray);
            if (!at) continue;
            const SurfacePoint expected = twin.surface_at(ray, at->primitive);
            const float cosine =
                std::abs(dot(expected.geometric_normal, ray.direction)) / length(ray.direction);
            if (cosine < 0.05f || (at->uv - expected.uv).length() > 0.5f) continue; // grazing; across a seam
            ++compared;
            // The front of a mesh without normals is where its corners run counter-clockwise: toWorld turns it by a mirror,
            // an instance does not.
            const float side = is_mesh_file(test) ? -1.f : 1.f;
            // Normals that are made of the angles of the triangles depend on the space where they are made.
            const bool is_smooth = test.name.find("\"smooth\"") != std::string::npos;
            const Tangents a = tangents_at(*at), b = twin.tangents(expected);
            const float unit = length(b.dp_du) + length(b.dp_dv);
            wrong += length(at->position - expected.position) < 2e-5f * size &&
                             length(at->geometric_normal - expected.geometric_normal * side) < 1e-4f &&
                             (is_smooth || length(at->shading.n - expected.shading.n * side) < 1e-4f) &&
                             (at->uv - expected.uv).length() < 1e-3f &&
                             length(a.dp_du - b.dp_du) < 5e-3f * unit &&
                             length(a.dp_dv - b.dp_dv) < 5e-3f * unit
                         ? 0
                         : 1;
        }
        CHECK(compared > 300);
        CHECK(wrong == 0);
    }
}
