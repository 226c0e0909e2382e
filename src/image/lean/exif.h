// SPDX-License-Identifier: MIT
#pragma once

// What JPEG files say of an image: the texts of Exif that Plumb or a photographer may have written.
//
// [1] CIPA DC-008, "Exchangeable image file format for digital still cameras: Exif Version 2.32", section 4.6.4

#include "image/bytes.h"

#include "plumb/image/image.h"

#include <vector>

namespace plumb::lean {

// Of a marker APP1. What it says wrongly is left out.
void read_exif(Bytes marker, Metadata& metadata);

// A marker for what it can hold of the metadata; empty: nothing.
std::vector<unsigned char> exif_of(const Metadata& metadata);

} // namespace plumb::lean
