// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/rendering/work.h"

#include <string>
#include <vector>

namespace plumb {

// What was merged, as JSON. outputs: the images that were made of it; checkpoint: its state file, or empty.
std::string work_json(const Work& work, const std::vector<std::string>& outputs,
                      const std::string& checkpoint);

} // namespace plumb
