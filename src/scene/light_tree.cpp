// SPDX-License-Identifier: MIT

#include "plumb/scene/light_tree.h"

#include <cmath>

namespace plumb {
namespace {

// What rounding may take from the cosine between a light's normal and the receiver; and the same at the receiver, where
// surfaces that are not diffuse send on more of the light that grazes them than the cosine says.
constexpr float emission_margin = 1e-3f;
constexpr float reception_margin = 0.02f;

// The cosine of the angle that is left of a by b: cos(max(a - b, 0)).
inline float cosine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a > cos_b ? 1.f : cos_a * cos_b + sin_a * sin_b;
}

// And its sine.
inline float sine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a > cos_b ? 0.f : sin_a * cos_b - cos_a * sin_b;
}

inline float sine_of(float cosine)
{
    return std::sqrt(std::max((1.f - cosine) * (1.f + cosine), 0.f));
}

} // namespace

// A receiver in the tree's scale.
struct LightTree::Receiver {
    Receiver(const LightReceiver& receiver, float scale)
        : position(receiver.position * scale),
          normal(receiver.normal),
          any_side(receiver.normal == Vec3f(0.f) ? 1.f : 0.f)
    {}

    Vec3f position;
    Vec3f normal;
    float any_side; // 1 where light from all around counts, else 0
};

// The running sums of the importance of what can be chosen at a node: its children and, at the root, the infinite
// emitters.
struct LightTree::Shares {
    static constexpr std::size_t infinite = width;
    std::array<double, width + 2> ends;

    double total() const { return ends[width + 1]; }
    double before(std::size_t k) const { return ends[k]; }
    double of(std::size_t k) const { return ends[k + 1] - ends[k]; }
};

LightTree::Shares LightTree::shares(std::uint32_t index, const Receiver& receiver) const
{
    constexpr float nearest = 1e-24f; // squared distance: its inverse is far from overflowing
    const Node& node = nodes_[index];
    Node::Lanes importance;
    for (std::size_t k = 0; k < width; ++k) {
        const float dx = node.x[k] - receiver.position.x;
        const float dy = node.y[k] - receiver.position.y;
        const float dz = node.z[k] - receiver.position.z;
        const float distance2 = std::max(dx * dx + dy * dy + dz * dz, nearest);
        const float radius2 = node.radius[k] * node.radius[k];
        const float inverse = 1.f / std::sqrt(distance2);

        // The sphere is seen within an angle b of its centre.
        const float sin_b = std::min(node.radius[k] * inverse, 1.f);
        const float cos_b = sine_of(sin_b);

        // [2], equation 12.32: no light leaves at less than the angle w - o - b to a normal, where w is the angle
        // between the axis and the receiver and o that of the cone.
        const float cos_w = -(node.axis_x[k] * dx + node.axis_y[k] * dy + node.axis_z[k] * dz) * inverse;
        const float sin_w = sine_of(cos_w);
        const float cos_x = cosine_of_rest(cos_w, sin_w, node.cosine[k], node.sine[k]);
        const float sin_x = sine_of_rest(cos_w, sin_w, node.cosine[k], node.sine[k]);
        const float emission = cosine_of_rest(cos_x, sin_x, cos_b, sin_b);

        // Nor does it arrive at less than the angle i - b to the receiver's normal.
        const float cos_i =
            (receiver.normal.x * dx + receiver.normal.y * dy + receiver.normal.z * dz) * inverse +
            receiver.any_side;
        const float reception = cosine_of_rest(cos_i, sine_of(cos_i), cos_b, sin_b);

        const bool inside = distance2 <= radius2;
        const float cosines =
            inside ? 1.f
                   : std::max(emission + emission_margin, 0.f) * std::max(reception + reception_margin, 0.f);
        // Inside, the light is no nearer than it would be from the sphere's surface.
        importance[k] = node.intensity[k] * cosines / std::max(distance2, radius2);
    }
    Shares shares;
    shares.ends[0] = 0.0;
    for (std::size_t k = 0; k < width; ++k)
        shares.ends[k + 1] = shares.ends[k] + static_cast<double>(importance[k]);
    const double finite = shares.ends[width];
    shares.ends[width + 1] =
        index == 0 ? finite + std::max(infinite_irradiance_, least_infinite_ * finite) : finite;
    return shares;
}

std::optional<LightTree::Choice> LightTree::choose_at_glossy(const LightReceiver& receiver, double u) const
{
    std::optional<Choice> choice;
    if (u < uniform_share_)
        choice = uniform_.sample(std::min(u / uniform_share_, largest_below_one));
    else
        choice = choose_among_several(receiver, (u - uniform_share_) / (1.0 - uniform_share_));
    if (choice) choice->probability = probability_at_glossy(receiver, choice->index);
    return choice;
}

float LightTree::probability_at_glossy(const LightReceiver& receiver, std::size_t index) const
{
    const double of_tree = static_cast<double>(probability_among_several(receiver, index));
    if (!(uniform_share_ > 0.0)) return static_cast<float>(of_tree);
    return static_cast<float>(uniform_share_ * static_cast<double>(uniform_.probability(index)) +
                              (1.0 - uniform_share_) * of_tree);
}

std::optional<LightTree::Choice> LightTree::choose_among_several(const LightReceiver& at, double u) const
{
    const Receiver receiver(at, scale_);
    u = std::min(u, largest_below_one);
    if (nodes_.empty()) {
        const Choice choice = infinite_.sample(u);
        return Choice{infinite_emitters_[choice.index], choice.probability, choice.u};
    }
    double probability = 1.0;
    std::uint32_t node = 0;
    for (;;) {
        const Shares here = shares(node, receiver);
        if (!(here.total() > 0.0)) return std::nullopt;
        const double target = u * here.total(); // below the total, however it is rounded
        std::size_t child = 0;
        for (std::size_t k = 1; k <= Shares::infinite; ++k) child += here.before(k) <= target ? 1 : 0;
        u = std::min((target - here.before(child)) / here.of(child), largest_below_one);
        probability *= here.of(child) / here.total();
        if (child == Shares::infinite) {
            const Choice choice = infinite_.sample(u);
            return Choice{infinite_emitters_[choice.index],
                          static_cast<float>(probability * static_cast<double>(choice.probability)),
                          choice.u};
        }
        node = nodes_[node].child[child];
        if (node & emitter_bit) return Choice{node & ~emitter_bit, static_cast<float>(probability), u};
    }
}

float LightTree::probability_among_several(const LightReceiver& at, std::size_t index) const
{
    const Place& place = places_[index];
    if (place.kind == Place::Kind::nowhere) return 0.f;
    if (place.kind == Place::Kind::infinite && nodes_.empty()) return infinite_.probability(place.path);

    const Receiver receiver(at, scale_);
    double probability = 1.0;
    std::uint64_t path = place.path;
    std::uint32_t node = 0;
    for (;;) {
        const Shares here = shares(node, receiver);
        if (!(here.total() > 0.0)) return 0.f;
        if (place.kind == Place::Kind::infinite) {
            probability *= here.of(Shares::infinite) / here.total();
            return static_cast<float>(probability * static_cast<double>(infinite_.probability(place.path)));
        }
        const std::size_t child = path % width;
        path >>= bits_per_level;
        probability *= here.of(child) / here.total();
        node = nodes_[node].child[child];
        if (node & emitter_bit) return static_cast<float>(probability);
    }
}

} // namespace plumb
