// SPDX-License-Identifier: MIT
#pragma once

// For targets that read state files as text (image_text.h): a mutator of libFuzzer's that gives most of what it makes the
// hash that belongs to it.

#include <string>
#include <string_view>

namespace plumb::fuzz {

// The same images, each with the hash that read_state() wants of it.
std::string with_right_hashes(std::string_view images);

} // namespace plumb::fuzz
