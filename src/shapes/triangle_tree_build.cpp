// SPDX-License-Identifier: MIT

// Building a tree of triangles: triangles that are near each other and face the same way become neighbours.

#include "base/parallel.h"
#include "shapes/triangle_lanes.h"
#include "shapes/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace plumb {
namespace {

// Where a triangle is, over the size of the mesh, and where it faces. Normals count a quarter: those of a ball are then as
// far apart as its places.
constexpr float weight_of_normals = 0.25f;
struct Item {
    std::array<float, 6> key;
    std::uint32_t triangle;
};
using Items = std::span<Item>;

// Puts what is smaller on some axis into the first `count` places.
void split(Items items, std::size_t count)
{
    std::array<float, 6> low = items[0].key;
    std::array<float, 6> high = low;
    for (const Item& item : items)
        for (std::size_t i = 0; i < low.size(); ++i) {
            low[i] = std::min(low[i], item.key[i]);
            high[i] = std::max(high[i], item.key[i]);
        }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < low.size(); ++i)
        if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
    // A strict order, so that the halves are the same with every standard library.
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(count), items.end(),
                     [axis](const Item& a, const Item& b) {
                         return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis]
                                                           : a.triangle < b.triangle;
                     });
}

} // namespace

class TriangleTree::Builder {
public:
    explicit Builder(TriangleTree& tree) : tree_(tree), bounds_(tree.clusters_)
    {
        const std::size_t count = tree.order_.size();
        items_.resize(count);
        in_chunks(count, [&](std::size_t i) { items_[i] = item(static_cast<std::uint32_t>(i)); });
        arrange(all());
        in_chunks(tree.clusters_, [&](std::size_t cluster) { settle(static_cast<std::uint32_t>(cluster)); });
        if (tree.clusters_ > 1) add_node(all());
    }

private:
    template <class Action>
    static void in_chunks(std::size_t count, const Action& action)
    {
        constexpr std::size_t chunk = 4096;
        parallel_for((count + chunk - 1) / chunk, 0, [&](std::size_t k) {
            const std::size_t end = std::min(count, (k + 1) * chunk);
            for (std::size_t i = k * chunk; i < end; ++i) action(i);
        });
    }

    Clusters all() const { return {0, tree_.clusters_}; }

    Item item(std::uint32_t triangle) const
    {
        const Facet facet = facet_of(tree_.mesh_, triangle);
        const auto& [a, b, c] = facet.corners;
        const Vec3f center((Vec3d(a) + Vec3d(b) + Vec3d(c)) * (1.0 / 3.0));
        const Vec3f at((Vec3d(center) - tree_.space_.origin) * tree_.space_.scale);
        const Vec3f facing = facet.normal * weight_of_normals;
        return {{at.x, at.y, at.z, facing.x, facing.y, facing.z}, triangle};
    }

    // Moves the triangles of a node to those of its parts where they belong, and so on.
    void arrange(const Clusters& here)
    {
        const std::uint32_t parts = here.parts();
        divide(here, 0, parts);
        if (here.count == parts) return; // of one cluster each
        const auto below = [&](std::size_t k) { arrange(here.part(static_cast<std::uint32_t>(k))); };
        if (here.count == tree_.clusters_ && here.count > width * width)
            parallel_for(parts, 0, below);
        else
            for (std::uint32_t k = 0; k < parts; ++k) below(k);
    }

    void divide(const Clusters& here, std::uint32_t first, std::uint32_t last)
    {
        if (last - first < 2) return;
        const std::uint32_t middle = first + (last - first) / 2;
        const auto place = [&](std::uint32_t part) { // where part(part) begins
            const Clusters before = here.part(part - 1);
            return std::size_t{tree_.first_place(before.first + before.count)};
        };
        const std::size_t begin = first == 0 ? tree_.first_place(here.first) : place(first);
        split(Items(items_).subspan(begin, place(last) - begin), place(middle) - begin);
        divide(here, first, middle);
        divide(here, middle, last);
    }

    // Gives the triangles of a cluster their places.
    void settle(std::uint32_t cluster)
    {
        const std::uint32_t first = tree_.first_place(cluster);
        const std::uint32_t count = tree_.first_place(cluster + 1) - first;
        const Items items = Items(items_).subspan(first, count);
        std::sort(items.begin(), items.end(),
                  [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
        Vec3d axis(0.0);
        LightBounds& bounds = bounds_[cluster];
        std::array<Facet, width> facets;
        for (std::uint32_t i = 0; i < count; ++i) {
            tree_.order_[first + i] = items[i].triangle;
            tree_.place_[items[i].triangle] = first + i;
            facets[i] = facet_of(tree_.mesh_, items[i].triangle);
            for (const Vec3f& corner : facets[i].corners) bounds.box.extendBy(corner);
            axis += Vec3d(facets[i].normal) * facets[i].area;
            bounds.power += facets[i].area;
        }
        double cosine = 1.0;
        const double size = length(axis);
        for (std::uint32_t i = 0; i < count; ++i)
            if (facets[i].area > 0.0) cosine = std::min(cosine, dot(Vec3d(facets[i].normal), axis) / size);
        bounds.normals = size > 1e-6 * bounds.power ? cone_about(axis, cosine) : DirectionCone{};
    }

    struct Child {
        std::uint32_t node;
        LightBounds bounds;
    };
    Child add_node(const Clusters& here)
    {
        if (here.count == 1) return {0, bounds_[here.first]};
        const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        LightBounds bounds;
        for (std::uint32_t k = 0; k < here.parts(); ++k) {
            const Child child = add_node(here.part(k));
            tree_.nodes_[index].lights.set(k, child.bounds, tree_.space_, tree_.area_);
            tree_.nodes_[index].child[k] = child.node;
            bounds = merged(bounds, child.bounds);
        }
        return {index, bounds};
    }

    TriangleTree& tree_;
    std::vector<Item> items_;
    std::vector<LightBounds> bounds_; // of clusters
};

TriangleTree::TriangleTree(const MeshData& mesh)
    : mesh_(mesh),
      order_(mesh.triangles.size()),
      place_(mesh.triangles.size()),
      clusters_(static_cast<std::uint32_t>((mesh.triangles.size() + width - 1) / width))
{
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    Box3f box;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Facet facet = facet_of(mesh, i);
        for (const Vec3f& corner : facet.corners) box.extendBy(corner);
        area_ += facet.area;
    }
    space_.origin = (Vec3d(box.min) + Vec3d(box.max)) * 0.5;
    const double size = length(Vec3d(box.max) - Vec3d(box.min));
    int exponent = 0;
    std::frexp(size, &exponent);
    space_.scale = std::ldexp(1.0, -exponent);

    Builder build(*this);
    nodes_.shrink_to_fit();
    if (clusters_ <= most_kept) {
        kept_.reserve(clusters_);
        for (std::uint32_t cluster = 0; cluster < clusters_; ++cluster)
            kept_.push_back(triangles_of(cluster));
    }
    std::vector<double> areas;
    areas.reserve(count);
    for (const std::uint32_t triangle : order_) areas.push_back(facet_of(mesh, triangle).area);
    by_area_ = DiscreteDistribution(areas);
}

} // namespace plumb
