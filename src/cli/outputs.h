// SPDX-License-Identifier: MIT
#pragma once

// The files that a command writes: found out about before the work begins.

#include "plumb/render/evidence.h"

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// Throws Error if one of the images or the JSON report cannot be written, UsageError if two are one file, under whatever
// names. json: as --json has it; empty: none; "-": standard output.
void check_outputs(const std::vector<std::string>& images, const std::string& json);

// Files that nothing may be written to, under whatever names.
class KeptFiles {
public:
    explicit KeptFiles(const std::vector<std::filesystem::path>& files);
    bool contains(const std::filesystem::path& file) const;

private:
    std::set<std::filesystem::path> identities_;
};

// Throws Error, "cannot write 'X': " and the reason, if an output is one of the inputs.
void refuse_overwriting_inputs(const KeptFiles& inputs, const std::vector<std::string>& images,
                               const std::string& json, std::string_view reason);

// An interrupted picture is written fast: somebody waits, and it will be replaced.
Packing packing_of(const Evidence& evidence);

// Writes the picture to all of these, at the same time. One that cannot be written does not keep the others from being tried; if its directory
// is gone, it is written into `refuge` instead, or into the current directory. Throws Error, with where it is then, if any was not
// written where it was to be.
void write_pictures(const std::vector<std::string>& outputs, const Image& image, float exposure,
                    Packing packing, const std::filesystem::path& refuge);

// Where --json says, if anywhere.
void write_json(const std::string& json, std::string_view text);

} // namespace plumb
