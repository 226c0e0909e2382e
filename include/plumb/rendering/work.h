// SPDX-License-Identifier: MIT
#pragma once

// Parts and checkpoints on disk, and their sum.

#include "plumb/render/evidence.h"
#include "plumb/render/state_file.h"
#include "plumb/settings/render_settings.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace plumb {

// A part that was merged.
struct WorkPart {
    std::filesystem::path file;
    SampleSet samples;
};

struct Work {
    StateFile file;
    RenderSettings settings;
    std::vector<WorkPart> parts;
    std::vector<std::string> names;      // plumb:workPart of each
    std::uint64_t samples_per_pixel = 0; // of the whole image

    SampleSet wanted() const;
    SampleSet missing() const;
};

struct MergeOptions {
    // Whether parts may be of processors of different vendors, whose Embree rounds some hits differently: the bits are then
    // those of no single machine. The header names all vendors: "AuthenticAMD, GenuineIntel".
    bool mixed_processors = false;
};

// In any order; one at least. Throws Error: which two files are not parts of one image, or have samples in common, and why.
Work merge_parts(std::span<const std::filesystem::path> files, const MergeOptions& options = {});

// "5.12 k of 10.2 k samples are missing (part 3/8 by tiles), the first of them at ..."; empty: none is.
std::string missing_text(const Work& work);

Evidence evidence_of(const Work& work);
// That of a rendering in one piece, bit for bit, if nothing is missing.
Image image_of(const Work& work, const Evidence& evidence);
inline Image image_of(const Work& work)
{
    return image_of(work, evidence_of(work));
}

// As a part that can be merged with others or resumed. Throws Error; keeps the file that is there as the generation before.
void save_work(const Work& work, const std::filesystem::path& file);

} // namespace plumb
