// SPDX-License-Identifier: MIT

#include "plumb/model/sampler.h"

namespace plumb {

std::uint32_t Sampler::next_word_across_blocks(Cursor& from)
{
    if (from.next == from.end) {
        fill_block();
        ++block_number_;
        if (order_ == Order::as_drawn)
            cursors_ = {{{0, block_.size()}, {}}};
        else
            cursors_ = {{{0, words_of_a_kind}, {words_of_a_kind, 2 * words_of_a_kind}}};
    }
    return block_[from.next++];
}

} // namespace plumb
