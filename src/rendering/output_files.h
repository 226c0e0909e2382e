// SPDX-License-Identifier: MIT
#pragma once

// The files that a rendering writes.

#include "plumb/render/evidence.h"
#include "plumb/settings/render_settings.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// The first name of a file that another name before it is of, too; nothing: all are different files.
std::optional<std::string> listed_twice(const std::vector<std::string>& files);

// Files that nothing may be written to, under whatever names.
class KeptFiles {
public:
    explicit KeptFiles(const std::vector<std::filesystem::path>& files);
    bool contains(const std::filesystem::path& file) const;
    // Throws Error, "cannot write 'X': " and the reason, if an output is one of them.
    void refuse(const std::vector<std::string>& outputs, std::string_view reason) const;

private:
    std::set<std::filesystem::path> identities_;
};

// An interrupted image is written fast: somebody waits, and it will be replaced.
Packing packing_of(const Evidence& evidence);

// Before anything is rendered: throws Error if files for screens are to be denoised and that cannot be done.
void check_denoising(const std::vector<std::string>& outputs, const OutputSettings& output);

// Writes the image to all of these, at the same time. One that cannot be written does not keep the others from being
// tried; if its directory is gone, it is written into `refuge` instead, or into the current directory. Throws Error, with
// where it is then, if any was not written where it was to be.
void write_images(const std::vector<std::string>& outputs, const Image& image, const OutputSettings& output,
                  Packing packing, const std::filesystem::path& refuge);

} // namespace plumb
