// SPDX-License-Identifier: MIT

#include "integrators/caustic_guide.h"

#include "plumb/math/frame.h"
#include "plumb/sampling/sampling.h"

namespace plumb {
void GuideCell::add(const Kernel& kernel)
{
    x_[count_] = kernel.source.x;
    y_[count_] = kernel.source.y;
    z_[count_] = kernel.source.z;
    sine_squared_[count_] = kernel.sine_squared;
    ++count_;
}

void GuideCell::complete(float strength)
{
    strength_ = strength;
    for (std::uint32_t i = 0; i < count_; ++i)
        density_[i] = uniform_cone_pdf(one_minus_cos_of(sine_squared_[i])) / static_cast<float>(count_);
}

std::optional<GuidedDirection> GuideCell::sample(const Vec3f& from, float u_choice, const Vec2f& u) const
{
    const auto chosen = static_cast<std::size_t>(u_choice * static_cast<float>(count_));
    const Vec3f towards = Vec3f(x_[chosen], y_[chosen], z_[chosen]) - from;
    const float size = length(towards);
    if (!(size > 0.f)) return std::nullopt;
    const float one_minus_cos = one_minus_cos_of(sine_squared_[chosen]);
    const Vec3f direction =
        normalize(Frame(towards / size).to_world(square_to_uniform_cone(u, one_minus_cos)));
    const float density = pdf(from, direction);
    if (!(density > 0.f)) return std::nullopt;
    return GuidedDirection{direction, density};
}

float GuideCell::pdf(const Vec3f& from, const Vec3f& direction) const
{
    // Inside a cone is where the cross product of direction and axis is short: exact where cones are narrow.
    using Lanes [[gnu::vector_size(32), gnu::may_alias]] = float;
    constexpr std::size_t blocks = most_photons / (sizeof(Lanes) / sizeof(float));
    const auto* const x = reinterpret_cast<const Lanes*>(x_.data()); // aligned
    const auto* const y = reinterpret_cast<const Lanes*>(y_.data());
    const auto* const z = reinterpret_cast<const Lanes*>(z_.data());
    const auto* const sine_squared = reinterpret_cast<const Lanes*>(sine_squared_.data());
    const auto* const density = reinterpret_cast<const Lanes*>(density_.data());
    Lanes sums{};
    for (std::size_t k = 0; k < blocks; ++k) {
        const Lanes vx = x[k] - from.x;
        const Lanes vy = y[k] - from.y;
        const Lanes vz = z[k] - from.z;
        const Lanes cx = direction.y * vz - direction.z * vy;
        const Lanes cy = direction.z * vx - direction.x * vz;
        const Lanes cz = direction.x * vy - direction.y * vx;
        const Lanes cosine = direction.x * vx + direction.y * vy + direction.z * vz;
        const Lanes cross2 = cx * cx + cy * cy + cz * cz;
        const Lanes size2 = vx * vx + vy * vy + vz * vz;
        const auto inside = (cosine > 0.f) & (cross2 <= sine_squared[k] * size2);
        sums += inside ? density[k] : Lanes{};
    }
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

const GuideCell* CausticGuide::cell_at(const Vec3f& position) const
{
    const Leaf& leaf = leaves_[tree_.leaf_at(position)];
    return leaf.cell && leaf.reach.intersects(position) ? leaf.cell : nullptr;
}

} // namespace plumb
