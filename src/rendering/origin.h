// SPDX-License-Identifier: MIT
#pragma once

// What an image's header says about how it was made: enough to make it again, and nothing that differs between two
// identical runs or tells about the machine (no time, no host).
//
//     Software                "Plumb 0.2.0"
//     plumb:scene             the scene file: its path as given, or its name if that was an absolute path
//     plumb:settings, plumb:set.NAME   the settings: settings_header.h
//     plumb:inputs            a line for each file that was read: the hash of its bytes, a space, its path from the scene
//                             file's directory (or its name, if it lies elsewhere)
//     plumb:inputHash         of all these, and of what the command line and the dialect make of them
//     plumb:definitions       -D, in the order of the names; only if given
//     plumb:integrator, plumb:sampler   type names
//     plumb:samplerTotal      how many samples the sampler spreads over a pixel; only if its points depend on that
//     plumb:errorBars         "upper bounds": of a sampler whose samples are not independent; else they are estimates
//     plumb:samplesPerPixel   the smallest number that a pixel has
//     plumb:samplesTaken      which samples the pixels have (SampleSet::text); only if not all have the same number. With
//                             plumb:adaptive those that are settled: a pixel has the ones that its plan has
//     plumb:adaptive          the target error of pixels that decide how many samples they get; only then
//     plumb:mostSamplesPerPixel   the largest number that a pixel has; only with plumb:adaptive
//     plumb:stop              what ended the rendering before the number of samples that was asked for; only if so
//     plumb:seed              a string, for it has 64 bits
//     plumb:language          the version of the scene language (language_version); absent: 1
//     plumb:dialect, plumb:dialectReason
//     plumb:emitters          "scatter" or "absorb"
//     plumb:mirror            "on" or "off"
//     plumb:point             the unit of point lights: "radiance" or "power"
//     plumb:envmapFlipped     "on" or "off"
//     plumb:envmapScale
//     plumb:instructionSet, plumb:embree
//     plumb:processor         who made it: "GenuineIntel". Its estimates of reciprocals are not those of another maker's
//     plumb:jpegDecoder       what decoded the inputs that are JPEG files, "jpeg-turbo 2.1.5"; only if there are any
//     plumb:biased            0 if the image's expectation is that of the light which its model sends; else 1
//     plumb:biases            what makes it differ; only if biased
//     plumb:model             choices of model; only if there are any
//     plumb:rmse, plumb:rmseInterval   the root mean squared error that its own noise makes expect, with a 95 %
//                             interval (evidence.h); only if there are 2 samples for each pixel
//     plumb:leftOut           how many samples were left out: a string
//     plumb:leftOutFirst      which was the first, and why; only if there is one
//     worldToCamera           as OpenEXR wants it: for row vectors, so that elements 12 to 14 are the translation.
//                             In camera space +z looks forward, +y is up and +x is left.

//
// The header of a state file (state_file.h) has the first part of this, and
//
//     plumb:workBiases, plumb:workModel   what the ledger had before the first sample, a line each
//     plumb:workWanted        samples per pixel of the whole image; only for a part
//     plumb:workPart          "3/8 by tiles"; only for a part
//     plumb:workProgram       hash_of_program(): whoever goes on must be the same
//     plumb:workStop          plumb:stop, when the rendering had ended

#include "plumb/rendering/session.h"

namespace plumb {

Metadata scene_header(const RenderTask& task);      // what does not depend on the samples
Metadata evidence_header(const Evidence& evidence); // what does
// scene_header(), and of plumb:work what a scene says.
Metadata work_header(const RenderTask& task, const std::optional<PartSettings>& part);
Metadata with_program(Metadata header); // loads the image library
inline constexpr std::string_view work_prefix = "plumb:work";

// The image with its whole header.
Image image_of(const Film& film, Metadata header, const Evidence& evidence, const OutputSettings& output);

// The path of an input as plumb:inputs has it.
std::string input_name(const std::filesystem::path& input, const std::filesystem::path& scene_file);

} // namespace plumb
