// SPDX-License-Identifier: MIT
#pragma once

// What the cells of an environment's map show of its image: the exact means of what bilinear lookups in them give.
//
// A cell is a texel wide and, but where rows are at the poles, a texel high; what `flipped` and `rowsAtPoles` mean is in
// environment.cpp.

#include "textures/bitmap.h"

#include <vector>

namespace plumb {

class SkyTexels {
public:
    // The bitmap must live as long.
    SkyTexels(const Bitmap& bitmap, bool flipped, bool rows_at_poles);

    int rows() const { return rows_; } // of cells
    // The mean luminance in each cell of a row, per unit solid angle.
    std::vector<double> row(int row) const;

private:
    // The texels that lookups in a cell read, along one axis, and their mean weights over the cell.
    struct Taps {
        int texel[3];
        double weight[3];
    };
    Taps taps(int cell, int size, bool repeat, double first, double second, double share) const;
    Taps row_taps(int row) const;

    const Bitmap& bitmap_;
    bool flipped_;
    bool rows_at_poles_;
    int rows_;
    std::vector<Taps> columns_;
};

} // namespace plumb
