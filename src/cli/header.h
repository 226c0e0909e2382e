// SPDX-License-Identifier: MIT
#pragma once

// What an image's header says about how it was made: enough to make it again, and nothing that differs between two
// identical runs or tells about the machine (no time, no host, no folder).
//
//     Software                "Plumb 0.1.0"
//     plumb:scene             the scene file's name, without its folder
//     plumb:inputHash         of every byte that was read: scene files, meshes, images
//     plumb:definitions       -D, in the order of the names; only if given
//     plumb:integrator, plumb:sampler   type names
//     plumb:samplesPerPixel
//     plumb:seed              a string, for it has 64 bits
//     plumb:dialect, plumb:dialectReason
//     plumb:emitters          "scatter" or "absorb"
//     plumb:mirror            "on" or "off"
//     plumb:point             the unit of point lights: "radiance" or "power"
//     plumb:envmapFlipped     "on" or "off"
//     plumb:envmapScale
//     plumb:instructionSet, plumb:embree
//     plumb:leftOut           how many samples were left out: a string
//     plumb:leftOutFirst      which was the first, and why; only if there is one
//     worldToCamera           as OpenEXR wants it: for row vectors, so that elements 12 to 14 are the translation.
//                             In camera space +z looks forward, +y is up and +x is left.

#include "cli/options.h"

namespace plumb {

Metadata image_header(const Options& options, const LoadedScene& scene, const LeftOut& left_out);

std::string left_out_text(const LeftOut::Sample& sample); // "sample 17 of pixel 3,4 (not finite: nan 1 1)"

} // namespace plumb
