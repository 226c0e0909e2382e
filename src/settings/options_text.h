// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/settings/compare_settings.h"
#include "plumb/settings/render_settings.h"

#include <string>

namespace plumb {

// " --seed 7 --define 'a=b c'": the options that make these settings, quoted for a shell.
std::string options_text(const RenderSettings& settings);
std::string options_text(const CompareSettings& settings); // of `renderer compare`
// Those of them that `renderer replay` needs.
std::string replay_options_text(const RenderSettings& settings);

} // namespace plumb
