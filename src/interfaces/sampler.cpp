// SPDX-License-Identifier: MIT

#include "plumb/sampler.h"

namespace plumb {

std::uint32_t Sampler::next_word_across_blocks()
{
    if (used_ == block_.size()) {
        fill_block();
        used_ = 0;
    }
    return block_[used_++];
}

} // namespace plumb
