// SPDX-License-Identifier: MIT
#pragma once

// Renderings on disk, to resume from: checkpoints, and the parts that machines render for one image.
//
// A state file is an .exr that any viewer shows. R, G and B are the image as far as it is; the other channels are
// the film's words (film.h), 32-bit integers: sum.R.0 (the lowest) to squares.B.3, count and contributing, and large.R.0 to
// large.B.3 of the large squares; a channel that is 0 everywhere is left out. Its header has what the image's header will have of all that does
// not depend on the samples (the caller's `header`), and
//
//     plumb:state          the version of this format: 2
//     plumb:stateSamples   the samples taken (SampleSet::text)
//     plumb:stateRays      how many of the camera, bounce and shadow rays
//     plumb:stateSeconds   of rendering
//     plumb:stateLeftOut   how many samples were left out, and which was the first: column, row, index, why, and the bits
//                          of its value
//     plumb:statePlans     "adaptive": the channel `plan` has how many samples each pixel is to get (Film::plan); only of
//                          an adaptive rendering
//     plumb:stateHash      of this header, the channels' names and the hashes of the rows
//
// The hash tells whether all of it is as it was written.

#include "plumb/render/render.h"

#include <optional>
#include <string_view>

namespace plumb {

// What the file will hold. Throws Error, with the reason, if memory is short.
std::vector<unsigned char> encode_state(const RenderState& state, Vec2i resolution, const Metadata& header);

struct StateFile {
    RenderState state;
    Metadata header; // the caller's
    Vec2i resolution;
};

// Throws Error, "cannot PURPOSE 'PATH': " and the reason.
StateFile read_state(const std::filesystem::path& path, std::string_view purpose = "resume from");

// The caller's header of the file alone, unchecked; nothing if it is no state file.
std::optional<Metadata> read_state_header(const std::filesystem::path& path);

} // namespace plumb
