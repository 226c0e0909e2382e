// SPDX-License-Identifier: MIT
#pragma once

// Both image modules, and what must be the same of them.

#include "image/image_module.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <filesystem>
#include <string>

namespace plumb::test {

const ImageModule& with_openimageio();
const ImageModule& lean();

// What decoding gives, as far as Plumb looks at it: integers as they are, the bits of floats, and the metadata in any order.
struct Decoded {
    std::string error; // then nothing else is there
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> channels;
    std::size_t integer_levels = 0;
    int alpha_channel = -1;
    std::vector<std::uint32_t> values;
    std::vector<std::string> metadata; // "name: value", sorted

    const std::string* find(const std::string& name) const;
};
Decoded decode(const ImageModule& module, const std::filesystem::path& file);

enum class Compare { pixels, all };

// Reads the file with both modules: a test case fails if not all, or all but the metadata, is the same, also as bytes. Returns it.
Decoded check_same(const std::filesystem::path& file, Compare what = Compare::all);

// 32 random bits, the same ones on every run.
std::uint32_t random_bits();

} // namespace plumb::test
