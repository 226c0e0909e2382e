// SPDX-License-Identifier: MIT
#pragma once

// Through which openings surfaces see an environment: learnt from paths, so that it is not looked for behind walls.
//
// An environment chooses directions in proportion to the light that they show. In a room nearly all of them end at a wall. Here
// space is cut into cells, for each of six orientations of surfaces, and each cell knows a rectangle of the environment's map in
// which light has come from the environment. The rectangle moves with the place that asks, as a window does.
//
// Bitterli, Novak and Jarosz 2015, "Portal-Masked Environment Map Sampling", Computer Graphics Forum 34(4), have such
// rectangles from portals that the scene's author has drawn. Within the rectangle, as there, choices go by light: the estimate stays
// smooth in the random numbers, and evenly spread samples keep what they are good for. (Densities in bins, as are usual for guiding,
// lose more by that than they gain: docs/performance.md.)

#include "integrators/cell_tree.h"
#include "plumb/model/camera.h"
#include "plumb/model/sky_view.h"
#include "plumb/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

class SkyGuide {
public:
    // A pure function of the scene and the camera.
    static SkyGuide learn(const Scene& scene, const Camera& camera, int threads);

    bool is_on() const { return !windows_.empty(); }
    std::size_t windows() const { return windows_.size(); }
    std::uint64_t paths() const { return paths_; } // that were followed to learn them
    double seconds() const { return seconds_; }

    // For a receiver of light (light_receiver.h). The whole sky where nothing was learnt that helps.
    SkyView view_at(const Vec3f& position, const Vec3f& normal) const
    {
        const Side& side = sides_[side_of(normal)];
        if (side.window_of_node.empty()) return {};
        const std::uint32_t window = side.window_of_node[side.cells.leaf_at(position)];
        return window == none ? SkyView{} : map_->view(windows_[window].seen_from(position));
    }

    // A rectangle of the map that moves.
    struct Window {
        Vec3f center{0.f}; // from where it is seen as `view`
        SkyRectangle view;
        Vec3f slope_x{0.f}; // how it moves, per unit of way
        Vec3f slope_y{0.f};

        SkyRectangle seen_from(const Vec3f& position) const;
    };

private:
    friend class SkyLesson;
    static constexpr std::size_t sides = 7; // along which axis normals point, and those of length zero
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    static std::size_t side_of(const Vec3f& normal)
    {
        const Vec3f size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
        if (size == Vec3f(0.f)) return sides - 1;
        const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        return 2 * axis + (normal[static_cast<int>(axis)] < 0.f ? 1 : 0);
    }

    struct Side {
        CellTree cells;
        std::vector<std::uint32_t> window_of_node; // none where there is none, or no leaf
    };
    const SkyMap* map_ = nullptr;
    std::array<Side, sides> sides_;
    std::vector<Window> windows_;
    std::uint64_t paths_ = 0;
    double seconds_ = 0.0;
};

} // namespace plumb
