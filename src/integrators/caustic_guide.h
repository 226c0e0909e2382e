// SPDX-License-Identifier: MIT
#pragma once

// Where light may come from that reaches a surface through mirrors, glass and what is nearly as smooth: densities of directions, learnt from photons.
//
// [1] Jensen 1995, "Importance Driven Path Tracing using the Photon Map"
// [2] Herholz et al. 2016, "Product Importance Sampling for Light Transport Path Guiding", for what guiding is
//
// Space is cut into cells of few photons. The density in a cell is the mean of its photons' kernels: each is uniform in a
// cone about the direction from the point that asks to a point from which the photon seemed to come. So a kernel knows parallax: a
// neighbour sees the lamp's image in another direction. How far the image is and how wide the cone must be is what
// the photons of the cell say of each other.

#include "integrators/cell_tree.h"
#include "plumb/model/guide.h"
#include "plumb/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

// A direction that was chosen, and its density per unit solid angle.
struct GuidedDirection {
    Vec3f direction;
    float pdf;
};

// The photons of a part of space.
class GuideCell {
public:
    static constexpr std::size_t most_photons = 32;
    static constexpr float most_directions = 8.f; // of a vertex

    // From a point, in world space. u_choice chooses the kernel, u the direction in it. Nothing where rounding has lost it.
    std::optional<GuidedDirection> sample(const Vec3f& from, float u_choice, const Vec2f& u) const;
    // How many guided directions of a path that has lost nothing are worth their rays, as an expected number, most_directions at most:
    // more where more light arrives.
    float strength() const { return strength_; }
    // The density of sample(from), of a unit vector.
    float pdf(const Vec3f& from, const Vec3f& direction) const;

    struct Kernel {
        Vec3f source;       // where the light seems to come from
        float sine_squared; // of half the cone's angle, which is below 90 degrees
    };
    void add(const Kernel& kernel); // most_photons at most
    // When all are added. strength: as strength() says.
    void complete(float strength = 1.f);

private:
    alignas(32) std::array<float, most_photons> x_{}, y_{}, z_{}; // of the sources
    alignas(32) std::array<float, most_photons> sine_squared_{};
    alignas(32) std::array<float, most_photons> density_{}; // in the cone, of all kernels' mean
    std::uint32_t count_ = 0;
    float strength_ = 1.f;
};

class CausticGuide {
public:
    CausticGuide() = default;
    CausticGuide(CausticGuide&&) = default; // the leaves point to its cells, so there are no copies
    CausticGuide& operator=(CausticGuide&&) = default;
    // A pure function of the scene and of how many photons it is learnt from: as many as an image has pixels take about as long as
    // one or two samples of each. Fewer than fewest_emitted teach too little, and more than most_emitted hardly more.
    static constexpr std::size_t fewest_emitted = 65'536;
    static constexpr std::size_t most_emitted = 131'072;
    static CausticGuide learn(const Scene& scene, std::size_t photons, int threads);

    bool is_on() const { return facts_.cells > 0; }
    const GuideFacts& facts() const { return facts_; }
    // Null where nothing was learnt that helps.
    const GuideCell* cell_at(const Vec3f& position) const;

private:
    friend class GuideBuilder;
    struct Leaf {
        Box3f reach; // where it may be asked
        const GuideCell* cell = nullptr;
    };
    CellTree tree_;
    std::vector<Leaf> leaves_;     // of its nodes
    std::vector<GuideCell> cells_; // which stay where they are
    GuideFacts facts_;
};

} // namespace plumb
