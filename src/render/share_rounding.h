// SPDX-License-Identifier: MIT
#pragma once

// Shares of an image as floats, which add up to the image bit by bit.

#include "plumb/render/channel_set.h"

#include <vector>

namespace plumb {

// Where the shares of a family are among the floats of all layers: of red, green and blue, share by share.
struct ShareFamily {
    std::vector<std::size_t> places[3];
};
std::vector<ShareFamily> share_families(const ChannelSet& layers);

// Changes the last bits of as few shares as possible, the largest first, until their sum in double precision rounds to the
// total. layers: the floats of all layers; beauty: red, green and blue.
void make_shares_add_up(const ShareFamily& family, float* layers, const float* beauty);

} // namespace plumb
