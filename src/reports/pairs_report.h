// SPDX-License-Identifier: MIT
#pragma once

// What the reports of agree and race say of pairs of estimators.

#include "plumb/experiments/agree.h"
#include "reports/json_document.h"

#include <string>
#include <string_view>

namespace plumb {

std::string_view verdict_of(Verdict verdict); // agree, differ, undecided
std::string pairs_text(const Agreement& agreement);
// What may decide it if they are undecided: a line. An estimator that all undecided pairs share, and others do not, is the
// one that rarely finds some of the light.
std::string advice(const Agreement& agreement);

// The scene and what was found about it.
void write_verdict(JsonWriter& json, const std::string& scene, const Agreement& agreement,
                   const CompareSettings& how);
void write_pairs(JsonWriter& json, const Agreement& agreement);

} // namespace plumb
