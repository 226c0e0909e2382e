// SPDX-License-Identifier: MIT

#include "emitters/sky_cells.h"

#include <algorithm>
#include <cmath>

namespace plumb {

void SkyCells::add_row(std::span<const double> cells, double factor)
{
    columns_of_row_.emplace_back(cells);
    row_weights_.push_back(columns_of_row_.back().sum() * factor);
}

void SkyCells::complete()
{
    row_choice_ = DiscreteDistribution(row_weights_);
    if (!can_sample()) return;
    groups_ = std::min(columns(), most_groups);
    sums_.assign((groups_ + 1) * (rows() + 1), 0.0);
    for (std::size_t group = 0; group <= groups_; ++group) {
        double* const sums = sums_.data() + group * (rows() + 1);
        for (std::size_t row = 0; row < rows(); ++row)
            sums[row + 1] =
                sums[row] + row_weights_[row] / sum() * columns_of_row_[row].begin_of(group_begin(group));
    }
}

SkyCells::Choice SkyCells::sample(double across, double down) const
{
    const DiscreteDistribution::Choice row = row_choice_.sample(down);
    const DiscreteDistribution::Choice column = columns_of_row_[row.index].sample(across);
    return {column.index, row.index, column.u, row.u};
}

SkyView SkyCells::view(const SkyRectangle& rectangle) const
{
    const auto width = static_cast<float>(columns());
    const auto height = static_cast<float>(rows());
    const auto whole = [](float x) {
        return x > 0.f ? static_cast<std::size_t>(x) : std::size_t{0};
    }; // 0 of a NaN
    const std::size_t first = std::min(whole(rectangle.left * width), columns() - 1);
    const std::size_t left = first * groups_ / columns(); // which begins at the column or before
    // The first that begins at the column or behind; beyond the map's border as many as before it.
    const auto group_from = [&](std::size_t column) {
        return (column * groups_ + columns() - 1) / columns();
    };
    const std::size_t end = whole(std::ceil((rectangle.left + rectangle.width) * width));
    const std::size_t last = end > columns() ? groups_ + group_from(end - columns()) : group_from(end);
    const std::size_t right = std::clamp(last, left + 1, left + groups_);
    const std::size_t top = std::min(whole(rectangle.top * height), rows() - 1);
    const std::size_t bottom = std::clamp(whole(std::ceil(rectangle.bottom * height)), top + 1, rows());
    SkyView view{static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(right),
                 static_cast<std::uint32_t>(top), static_cast<std::uint32_t>(bottom), 0.0};
    view.share = before(view, bottom) - before(view, top);
    return view.share > 0.0 ? view : SkyView{};
}

bool SkyCells::shows(const SkyView& view, std::size_t column, std::size_t row) const
{
    if (row < view.top || row >= view.bottom) return false;
    const bool goes_on = view.right > groups_;
    if (column >= group_begin(view.left)) return goes_on || column < group_begin(view.right);
    return goes_on && column < group_begin(view.right - groups_);
}

SkyCells::Choice SkyCells::sample(const SkyView& view, double across, double down) const
{
    constexpr double largest_below_one = 0x1.fffffffffffffp-1;
    // Below the end, however it is rounded. The last row that begins at or before it has light.
    const double target =
        std::min(before(view, view.top) + down * view.share, std::nextafter(before(view, view.bottom), 0.0));
    std::size_t row = view.top;
    std::size_t end = view.bottom;
    while (end - row > 1) {
        const std::size_t middle = row + (end - row) / 2;
        (before(view, middle) <= target ? row : end) = middle;
    }
    const double begin = before(view, row);
    const double rest = std::clamp((target - begin) / (before(view, end) - begin), 0.0, largest_below_one);

    const DiscreteDistribution& columns = columns_of_row_[row];
    const auto begin_of = [&](std::size_t group) { return columns.begin_of(group_begin(group)); };
    // To the right border of the map and then, perhaps, on from the left one. Ends are multiples of 2^-53, as are numbers.
    const bool goes_on = view.right > groups_;
    const double left = begin_of(view.left);
    const double right = goes_on ? 1.0 : begin_of(view.right);
    const double beyond = goes_on ? begin_of(view.right - groups_) : 0.0;
    double u = left + across * (right - left + beyond);
    if (goes_on && u >= right)
        u = std::min(u - right, beyond - 0x1p-53);
    else
        u = std::min(u, right - 0x1p-53);
    const DiscreteDistribution::Choice column = columns.sample(u);
    return {column.index, static_cast<std::uint32_t>(row), column.u, rest};
}

} // namespace plumb
