// SPDX-License-Identifier: MIT
#include "check/coincidence.h"

#include "base/parallel.h"
#include "check/box_pairs.h"
#include "check/surface_triangles.h"
#include "check/triangle_overlap.h"
#include "plumb/model/shape.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace plumb {

namespace {

constexpr std::size_t kept_places = 8;
constexpr float roundings = 16.f * unit_roundoff;
constexpr float of_size = 1e-6f;

// A triangle of the scene.
struct Member {
    std::uint32_t object;
    std::uint32_t primitive;
};

using Found = std::map<std::tuple<std::size_t, std::size_t, bool>, Coincidence>;

void add(Found& found, const Coincidence& one)
{
    const auto [entry, is_new] = found.try_emplace({one.first, one.second, one.faces_alike}, one);
    if (is_new) return;
    Coincidence& sum = entry->second;
    sum.count += one.count;
    sum.tolerance = std::max(sum.tolerance, one.tolerance);
    for (const CoincidentPlace& place : one.places)
        if (sum.places.size() < kept_places) sum.places.push_back(place);
}

Box3f box_of(const TriangleCorners& t)
{
    Box3f box(t.p0);
    box.extendBy(t.p1);
    box.extendBy(t.p2);
    return box;
}

// Triangles in such boxes that have more than this between them do not coincide.
float reach_of(const Box3f& box)
{
    return 2.f * roundings * std::max(max_component(abs(box.min)), max_component(abs(box.max))) +
           of_size * max_component(box.size());
}

Box3f enlarged(Box3f box)
{
    const float reach = reach_of(box);
    box.min -= Vec3f(reach);
    box.max += Vec3f(reach);
    return box;
}

// Whether a plane comes within `reach` of a box.
bool plane_reaches(const FlatTriangle& triangle, double reach, const Box3f& box)
{
    const Vec3d middle = 0.5 * (Vec3d(box.min) + Vec3d(box.max)), half = Vec3d(box.max) - middle;
    const Vec3d& n = triangle.normal;
    const double extent = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    return std::abs(dot(n, middle - triangle.corners[0])) <= extent + reach;
}

class LightStrategy {
public:
    explicit LightStrategy(const std::vector<SceneObject>& objects)
    {
        surfaces_.reserve(objects.size());
        for (const SceneObject& object : objects) surfaces_.emplace_back(*object.shape);
    }

    Coincidences find()
    {
        Coincidences result;
        result.is_complete = compare_triangles();
        compare_spheres();
        for (const auto& [key, coincidence] : found_) result.found.push_back(coincidence);
        return result;
    }

private:
    TriangleCorners corners(const Member& member) const
    {
        return surfaces_[member.object].corners(member.primitive);
    }

    // Whether none was left out.
    bool compare_triangles()
    {
        std::vector<Member> members;
        for (std::uint32_t object = 0; object < surfaces_.size(); ++object)
            for (std::uint32_t i = 0; i < surfaces_[object].size(); ++i) members.push_back({object, i});
        std::vector<Box3f> boxes(members.size());
        for (std::size_t i = 0; i < members.size(); ++i) boxes[i] = enlarged(box_of(corners(members[i])));

        const BoxPairs pairs(boxes);
        std::vector<Found> found(pairs.part_count());
        std::vector<char> is_complete(pairs.part_count(), 1);
        parallel_for(pairs.part_count(), 0, [&](std::size_t part) {
            const auto search = [&](std::size_t i) {
                return Search{*this, members, members[i], found[part]};
            };
            is_complete[part] = pairs.for_each(part, search) ? 1 : 0;
        });
        for (const Found& part : found)
            for (const auto& [key, coincidence] : part) add(found_, coincidence);
        return std::find(is_complete.begin(), is_complete.end(), 0) == is_complete.end();
    }

    // For what coincides with one triangle.
    struct Search {
        Search(const LightStrategy& in, const std::vector<Member>& members, const Member& of, Found& found)
            : strategy_(in),
              members_(members),
              own_(of),
              found_(found),
              triangle_(in.corners(of)),
              reach_(static_cast<double>(reach_of(box_of(in.corners(of)))))
        {}

        bool reaches(const Box3f& box) const
        {
            return triangle_.area > 0.0 && plane_reaches(triangle_, reach_, box);
        }

        void meet(std::size_t other) const
        {
            const FlatTriangle triangle(strategy_.corners(members_[other]));
            if (const auto tolerance = overlap_tolerance(triangle_, triangle))
                add(found_,
                    strategy_.coincidence(own_, members_[other],
                                          triangle_.area < triangle.area ? triangle_ : triangle, *tolerance));
        }

    private:
        const LightStrategy& strategy_;
        const std::vector<Member>& members_;
        const Member& own_;
        Found& found_;
        FlatTriangle triangle_;
        double reach_;
    };

    Coincidence coincidence(Member a, Member b, const FlatTriangle& small, double tolerance) const
    {
        if (b.object < a.object) std::swap(a, b);
        const Vec3d front = surfaces_[a.object].front(a.primitive);
        const bool faces_alike = dot(front, surfaces_[b.object].front(b.primitive)) > 0.0;
        const Vec3f middle((small.corners[0] + small.corners[1] + small.corners[2]) / 3.0);
        return {a.object, b.object, faces_alike, 1, tolerance, {{middle, Vec3f(front)}}};
    }

    // Along x; spheres that are not the same can only meet in circles.
    void compare_spheres()
    {
        struct ObjectBall {
            Ball shape;
            std::size_t object;
        };
        std::vector<ObjectBall> balls;
        for (std::size_t object = 0; object < surfaces_.size(); ++object)
            if (const auto& ball = surfaces_[object].ball()) balls.push_back({*ball, object});
        std::sort(balls.begin(), balls.end(), [](const ObjectBall& a, const ObjectBall& b) {
            return std::tie(a.shape.center.x, a.object) < std::tie(b.shape.center.x, b.object);
        });
        for (auto a = balls.begin(); a != balls.end(); ++a) {
            const float tolerance = roundings * (max_component(abs(a->shape.center)) + a->shape.radius) +
                                    of_size * a->shape.radius;
            for (auto b = a + 1; b != balls.end() && b->shape.center.x - a->shape.center.x <= tolerance;
                 ++b) {
                const float apart =
                    length(b->shape.center - a->shape.center) + std::abs(b->shape.radius - a->shape.radius);
                if (apart > tolerance) continue;
                const auto [first, second] = std::minmax(a->object, b->object);
                add(found_, {first,
                             second,
                             true,
                             1,
                             static_cast<double>(tolerance),
                             {{a->shape.center, Vec3f(0.f)}}});
            }
        }
    }

    std::vector<SurfaceTriangles> surfaces_;
    Found found_;
};

} // namespace

Coincidences find_coincidences(const std::vector<SceneObject>& objects)
{
    return LightStrategy(objects).find();
}

} // namespace plumb
