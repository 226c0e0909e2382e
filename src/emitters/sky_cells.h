// SPDX-License-Identifier: MIT
#pragma once

// The cells of a map of all directions, chosen in proportion to their light: among all, or in a rectangle of them.
//
// Sums over rectangles are differences of sums from the corner (Crow 1984, "Summed-Area Tables for Texture Mapping"), of whole rows
// and of columns in groups, so that the table stays small.

#include "plumb/model/sky_view.h"
#include "plumb/sampling/distribution.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

class SkyCells {
public:
    struct Choice {
        std::uint32_t column;
        std::uint32_t row;
        double across; // where in the cell, from 0 to 1
        double down;
    };

    // Row by row from the top: the light of each of its cells, and a factor for all of them.
    void add_row(std::span<const double> cells, double factor);
    void complete();

    std::size_t columns() const { return columns_of_row_.empty() ? 0 : columns_of_row_[0].size(); }
    std::size_t rows() const { return columns_of_row_.size(); }
    double sum() const { return row_choice_.sum(); }
    bool can_sample() const { return row_choice_.can_sample(); }

    // across and down in [0, 1): what the choice depends on. Needs can_sample().
    Choice sample(double across, double down) const;
    // Of choosing a cell.
    float probability(std::size_t column, std::size_t row) const
    {
        return row_choice_.probability(row) * columns_of_row_[row].probability(column);
    }

    // Views are of groups of columns and of rows; samples of them are not spread everywhere.
    SkyView view(const SkyRectangle& rectangle) const;
    Choice sample(const SkyView& view, double across, double down) const;
    bool shows(const SkyView& view, std::size_t column, std::size_t row) const;

private:
    static constexpr std::size_t most_groups = 256;

    std::size_t group_begin(std::size_t group) const { return group * columns() / groups_; }
    // What the rows before `row` have in the groups of the view.
    double before(const SkyView& view, std::size_t row) const
    {
        const auto at = [&](std::size_t group) { return sums_[group * (rows() + 1) + row]; };
        if (view.right <= groups_) return at(view.right) - at(view.left);
        return at(groups_) - at(view.left) + at(view.right - groups_);
    }

    DiscreteDistribution row_choice_;
    std::vector<DiscreteDistribution> columns_of_row_;
    std::vector<double> row_weights_;
    std::size_t groups_ = 0;
    std::vector<double>
        sums_; // from the corner, of all light: rows() + 1 of each of groups_ + 1 ends of groups
};

} // namespace plumb
