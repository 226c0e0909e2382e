// SPDX-License-Identifier: MIT
#pragma once

// What a suite's entries are as settings.

#include "plumb/settings/compare_settings.h"
#include "plumb/settings/render_settings.h"
#include "plumb/suite_file/suite.h"

namespace plumb {

struct BatchJob {
    SuiteEntry entry;
    RenderSettings picture;
    CompareSettings compare;
    RenderSettings reference; // to make the reference with
};

// The suite with everything checked that can be without opening a scene. Throws SceneError, or Error.
std::vector<BatchJob> plan_batch(const std::string& suite,
                                 const std::map<std::string, std::string>& definitions);

// The attributes of a suite that are settings of `renderer` and `renderer compare`, in the order of --help.
std::vector<std::string_view> suite_settings();

// "renderer scene.xml --spp 64", quoted for a shell, to do it again by hand.
std::string command_text(const std::filesystem::path& scene, const RenderSettings& settings);

} // namespace plumb
