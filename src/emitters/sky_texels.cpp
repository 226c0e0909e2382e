// SPDX-License-Identifier: MIT

#include "emitters/sky_texels.h"

#include "plumb/math/elementary.h"

#include <algorithm>

namespace plumb {

SkyTexels::SkyTexels(const Bitmap& bitmap, bool flipped, bool rows_at_poles)
    : bitmap_(bitmap),
      flipped_(flipped),
      rows_at_poles_(rows_at_poles),
      // Between the rows of the image if these are at the poles, else around them.
      rows_(rows_at_poles ? std::max(bitmap.height() - 1, 1) : bitmap.height())
{
    for (int i = 0; i < bitmap.width(); ++i)
        columns_.push_back(taps(i, bitmap.width(), true, 0.25, 0.75, 0.5));
}

// `first` and `second`: where the halves of the cell have their centres of mass, from 0 to 1/2 and from 1/2 to 1;
// `share`: the part of the mass that is in the first half.
SkyTexels::Taps SkyTexels::taps(int cell, int size, bool repeat, double first, double second,
                                double share) const
{
    const auto wrap = [&](int t) { return repeat ? (t + size) % size : std::clamp(t, 0, size - 1); };
    if (flipped_) { // linear from one texel at the cell's beginning to the other at its end
        const double mean = share * first + (1.0 - share) * second;
        return {{wrap(size - cell), wrap(size - 1 - cell), 0}, {1.0 - mean, mean, 0.0}};
    }
    // Linear in each half: from midway between the texel before and the cell's own to that one, and on.
    const double before = share * (0.5 - first);
    const double after = (1.0 - share) * (second - 0.5);
    return {{wrap(cell - 1), cell, wrap(cell + 1)}, {before, 1.0 - before - after, after}};
}

// As much of a row is at theta as its ring is long: sin(theta).
SkyTexels::Taps SkyTexels::row_taps(int row) const
{
    const double height = rows_;
    const auto theta = [&](double y) { return pi_d * y / height; };
    const auto mass = [&](double y) { return -sin_cos(theta(y)).cos; };
    const auto moment = [&](double y) { return sin_cos(theta(y)).sin - theta(y) * sin_cos(theta(y)).cos; };
    const auto center = [&](double begin, double end) {
        const double mean = (moment(end) - moment(begin)) / (mass(end) - mass(begin)); // of theta
        return std::clamp(mean * height / pi_d, begin, end) - row;
    };
    if (rows_at_poles_) { // linear from one row to the next
        const double mean = center(row, row + 1.0);
        return {{row, std::min(row + 1, bitmap_.height() - 1), 0}, {1.0 - mean, mean, 0.0}};
    }
    const double share = (mass(row + 0.5) - mass(row)) / (mass(row + 1.0) - mass(row));
    return taps(row, bitmap_.height(), flipped_, center(row, row + 0.5), center(row + 0.5, row + 1.0), share);
}

std::vector<double> SkyTexels::row(int row) const
{
    // A row of the bitmap averaged over the height of cells, then over their widths.
    std::vector<double> high(columns_.size());
    const Taps above = row_taps(row);
    for (int x = 0; x < bitmap_.width(); ++x)
        for (int t = 0; t < 3; ++t)
            high[static_cast<std::size_t>(x)] +=
                above.weight[t] * luminance(bitmap_.texel(x, above.texel[t]));
    std::vector<double> cells(columns_.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (int t = 0; t < 3; ++t)
            cells[i] += columns_[i].weight[t] * high[static_cast<std::size_t>(columns_[i].texel[t])];
    return cells;
}

} // namespace plumb
