// SPDX-License-Identifier: MIT
#pragma once

#include "scene_file/document.h"

namespace plumb {

// Errors and warnings in the order of the files and their lines; a note stays behind what it belongs to.
std::vector<Diagnostic> in_file_order(const std::vector<Diagnostic>& diagnostics,
                                      const std::vector<std::shared_ptr<const TextFile>>& files);

} // namespace plumb
