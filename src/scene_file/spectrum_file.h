// SPDX-License-Identifier: MIT
#pragma once

// Spectra in files (.spd): a wavelength in nm and a value on each line; '#' begins a comment.

#include <filesystem>
#include <string>

namespace plumb {

// "400:0.1, 500:0.2", as the value of a <spectrum>. Throws Error, which shows nothing of the file: whoever wrote the scene
// may have no right to see it.
std::string read_spectrum_file(const std::filesystem::path& path);

} // namespace plumb
