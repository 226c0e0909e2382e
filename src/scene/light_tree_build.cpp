// SPDX-License-Identifier: MIT

// Building a light tree: groups of lights that are near each other and shine the same way.

#include "plumb/math/direction_cone.h"
#include "plumb/math/elementary.h"
#include "plumb/scene/light_tree.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

struct Light {
    LightBounds bounds;
    Vec3d center{0.0};
    std::uint32_t emitter = 0;
};
using Lights = std::span<Light>;

LightBounds bounds_of(std::span<const Light> lights)
{
    LightBounds all;
    for (const Light& light : lights) all = merged(all, light.bounds);
    return all;
}

double squared_diagonal(const LightBounds& bounds)
{
    return bounds.box.isEmpty() ? 0.0 : length_squared(Vec3d(bounds.box.max) - Vec3d(bounds.box.min));
}

// [1], equation 1, where light leaves within theta_e = pi/2 of a normal: the directions that receive some, weighted
// with the cosine beyond the cone.
double orientation_measure(double theta_o)
{
    const double theta_w = std::min(theta_o + 0.5 * pi_d, pi_d);
    const double cos_o = sin_cos(theta_o).cos;
    const double sin_o = sin_cos(theta_o).sin;
    return 2.0 * pi_d * (1.0 - cos_o) +
           0.5 * pi_d *
               (2.0 * theta_w * sin_o - sin_cos(theta_o - 2.0 * theta_w).cos - 2.0 * theta_o * sin_o + cos_o);
}

// [1], equation 2, with the square of the diagonal for the area of the box, which rows of lamps have not.
double cost(const LightBounds& bounds)
{
    return bounds.power * orientation_measure(bounds.normals.angle) * squared_diagonal(bounds);
}

double on_axis(const Vec3d& v, std::size_t axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// So many finite emitters are found by uniform choice, each often enough.
constexpr double uniform_choices = 12.0;

// The slice of [low, high] that x lies in.
constexpr std::size_t slices = 12;
std::size_t slice_of(double x, double low, double high)
{
    return std::min(static_cast<std::size_t>((x - low) / (high - low) * slices), slices - 1);
}

// Reorders the lights; returns how many of them, at least one and not all, go to the first of two groups. The cheapest
// of the splits between slices along an axis; the middle where all centres are at one place.
std::size_t split(Lights lights)
{
    Imath::Box<Vec3d> centers;
    for (const Light& light : lights) centers.extendBy(light.center);
    const Vec3d size = centers.size();
    const double longest = std::max({size.x, size.y, size.z});
    double best_cost = std::numeric_limits<double>::infinity();
    std::size_t best_axis = 0;
    std::size_t best_slice = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = on_axis(centers.min, axis);
        const double high = on_axis(centers.max, axis);
        if (!(high > low)) continue;
        std::array<LightBounds, slices> bounds;
        for (const Light& light : lights) {
            LightBounds& slice = bounds[slice_of(on_axis(light.center, axis), low, high)];
            slice = merged(slice, light.bounds);
        }
        std::array<double, slices> cost_after{};
        LightBounds after;
        for (std::size_t i = slices; i-- > 1;) {
            after = merged(after, bounds[i]);
            cost_after[i] = cost(after);
        }
        LightBounds before;
        for (std::size_t i = 0; i + 1 < slices; ++i) {
            before = merged(before, bounds[i]);
            // Thin slices of a long box are what it is to be cut into: [1], section 4.4.
            const double both = (cost(before) + cost_after[i + 1]) * (longest / (high - low));
            if (both < best_cost) {
                best_cost = both;
                best_axis = axis;
                best_slice = i;
            }
        }
    }
    if (!std::isfinite(best_cost)) return lights.size() / 2;
    const double low = on_axis(centers.min, best_axis);
    const double high = on_axis(centers.max, best_axis);
    const auto second = std::stable_partition(lights.begin(), lights.end(), [&](const Light& light) {
        return slice_of(on_axis(light.center, best_axis), low, high) <= best_slice;
    });
    return static_cast<std::size_t>(second - lights.begin());
}

} // namespace

class LightTree::Builder {
public:
    Builder(LightTree& tree, double largest_power) : tree_(tree), largest_power_(largest_power) {}

    std::uint32_t add_node(Lights lights, std::uint64_t path, unsigned level)
    {
        const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        const std::vector<Group> groups = divided(lights, level);
        for (std::size_t k = 0; k < groups.size(); ++k) {
            const Group& group = groups[k];
            tree_.nodes_[index].lights.set(k, group.bounds, {Vec3d(0.0), tree_.scale_}, largest_power_);
            const std::uint64_t child_path = path | std::uint64_t{k} << (bits_per_level * level);
            std::uint32_t child = 0;
            if (group.lights.size() == 1) {
                child = group.lights[0].emitter | emitter_bit;
                tree_.places_[group.lights[0].emitter] = {Place::Kind::tree, child_path};
            } else {
                child = add_node(group.lights, child_path, level + 1);
            }
            tree_.nodes_[index].child[k] = child;
        }
        return index;
    }

private:
    struct Group {
        explicit Group(Lights l) : lights(l), bounds(bounds_of(l)), cost(plumb::cost(bounds)) {}
        Lights lights;
        LightBounds bounds;
        double cost;
    };

    // Up to eight groups: the costliest is split again and again. From some level on the largest is split in the
    // middle, so that the numbers of lanes on the way to any of 2^31 emitters fit into 63 bits.
    static std::vector<Group> divided(Lights lights, unsigned level)
    {
        constexpr unsigned first_balanced_level = 10;
        const bool balanced = level >= first_balanced_level;
        std::vector<Group> groups{Group(lights)};
        while (groups.size() < width) {
            const auto next =
                std::max_element(groups.begin(), groups.end(), [&](const Group& a, const Group& b) {
                    if (a.lights.size() == 1 || b.lights.size() == 1 || balanced || a.cost == b.cost)
                        return a.lights.size() < b.lights.size();
                    return a.cost < b.cost;
                });
            const Lights whole = next->lights;
            if (whole.size() == 1) break;
            const std::size_t first = balanced ? whole.size() / 2 : split(whole);
            *next = Group(whole.first(first));
            groups.insert(next + 1, Group(whole.subspan(first)));
        }
        return groups;
    }

    LightTree& tree_;
    double largest_power_;
};

LightTree::LightTree(std::span<const Emitter* const> emitters, Among among, const SceneSphere& sphere)
    : places_(emitters.size())
{
    std::vector<Light> lights;
    std::vector<double> infinite_powers;
    double finite_power = 0.0;
    double largest_power = 0.0;
    for (std::uint32_t i = 0; i < emitters.size(); ++i) {
        if (among == Among::delta && !emitters[i]->is_delta()) continue;
        const double power = emitters[i]->power();
        if (!(power > 0.0)) continue;
        if (const std::optional<LightBounds> bounds = emitters[i]->bounds()) {
            const Vec3d center = (Vec3d(bounds->box.min) + Vec3d(bounds->box.max)) * 0.5;
            lights.push_back({*bounds, center, i});
            finite_power += power;
            largest_power = std::max(largest_power, power);
        } else {
            places_[i] = {Place::Kind::infinite, infinite_emitters_.size()};
            infinite_emitters_.push_back(i);
            infinite_powers.push_back(power);
        }
    }
    infinite_ = DiscreteDistribution(infinite_powers);
    if (lights.size() + infinite_emitters_.size() == 1)
        only_ = lights.empty() ? infinite_emitters_[0] : lights[0].emitter;
    if (lights.empty() || only_ != none) return;

    const double radius = sphere.radius > 0.f ? sphere.radius : 1.0;
    int exponent = 0;
    std::frexp(radius, &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    scale_ = static_cast<float>(scale);
    Builder(*this, largest_power).add_node(lights, 0, 0);

    // Importance is irradiance times pi / largest_power / scale^2. The power of an infinite emitter is what enters a
    // sphere around the scene: a surface in it receives, in the mean over its orientations, power / (4 pi radius^2).
    const double irradiance = infinite_.sum() / (4.0 * pi_d * radius * radius);
    infinite_irradiance_ = irradiance * pi_d / largest_power / (scale * scale);
    least_infinite_ = std::min(infinite_.sum() / finite_power, 1.0);

    std::vector<double> weights(emitters.size(), 0.0);
    for (const Light& light : lights) weights[light.emitter] = 1.0 / static_cast<double>(lights.size());
    for (std::size_t i = 0; i < infinite_emitters_.size(); ++i)
        weights[infinite_emitters_[i]] = least_infinite_ * static_cast<double>(infinite_.probability(i));
    uniform_ = DiscreteDistribution(weights);
    uniform_share_ = std::min(0.75, uniform_choices / static_cast<double>(lights.size()));
}

} // namespace plumb
