// SPDX-License-Identifier: MIT
#pragma once

// What agree() found, for people and as JSON.

#include "plumb/experiments/agree.h"

#include <string>

namespace plumb {

// scene: its file, as it was given.
std::string agreement_text(const std::string& scene, const Agreement& agreement);
std::string agreement_json(const std::string& scene, const Agreement& agreement, const CompareSettings& how);

} // namespace plumb
