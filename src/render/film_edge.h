// SPDX-License-Identifier: MIT
#pragma once

// Where the samples of a pixel lie: spread by the filter, beyond the edge of the image too, or cut there.

#include "plumb/math/math.h"
#include "plumb/model/camera.h"
#include "plumb/model/filter.h"
#include "plumb/sampling/distribution.h"

#include <vector>

namespace plumb {

// A pixel near the edge of a camera that does not sample the border gets the filter restricted to the image, and that part
// counts as all of it. The edge is that of the camera's image, not of what is rendered of it.
class FilmEdge {
public:
    FilmEdge(const Filter& filter, const Camera& camera);

    FilterSample sample(Vec2i pixel, const Vec2f& u) const
    {
        const std::uint32_t x = axis(columns_, pixel.x), y = axis(rows_, pixel.y);
        if (x == whole && y == whole) [[likely]]
            return filter_.sample(u);
        const auto [offset_x, weight_x] = profiles_[x].sample(u.x);
        const auto [offset_y, weight_y] = profiles_[y].sample(u.y);
        return {{offset_x, offset_y}, weight_x * weight_y};
    }

private:
    static constexpr std::uint32_t whole = 0; // the profile that is not cut

    // The filter along one axis between two offsets, sampled from a table as in filters/tabulated.h.
    class Profile {
    public:
        Profile(const Filter& filter, double begin, double end);

        struct Draw {
            float offset;
            float weight;
        };
        Draw sample(float u) const;

    private:
        double begin_;
        double width_; // of a cell
        DiscreteDistribution distribution_;
        std::vector<bool> negative_;
        float weight_ = 1.f;
    };

    static std::uint32_t axis(const std::vector<std::uint32_t>& profiles, int i)
    {
        return profiles.empty() ? whole : profiles[static_cast<std::size_t>(i)];
    }
    std::vector<std::uint32_t> cut(int size);

    const Filter& filter_;
    std::vector<Profile> profiles_;
    std::vector<std::uint32_t> columns_; // the profile of each; empty: none is cut
    std::vector<std::uint32_t> rows_;
};

} // namespace plumb
