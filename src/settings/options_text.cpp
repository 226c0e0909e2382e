// SPDX-License-Identifier: MIT
#include "settings/options_text.h"

#include "base/shell_words.h"

#include <fmt/format.h>

namespace plumb {

namespace {

template <class Settings>
std::string option_text(const SettingRow<Settings>& row, const Settings& settings)
{
    std::string text;
    for (const std::string& value : row.get(settings)) {
        text += fmt::format(" --{}", row.name);
        if (!row.is_switch()) text += " " + shell_quote(value);
    }
    return text;
}

} // namespace

std::string options_text(const RenderSettings& settings)
{
    std::string text;
    for (const auto& row : setting_rows<RenderSettings>()) text += option_text(row, settings);
    return text;
}

std::string options_text(const CompareSettings& settings)
{
    std::string text;
    for (const auto& row : setting_rows<CompareSettings>()) text += option_text(row, settings);
    if (settings.samples) text += fmt::format(" --spp {}", *settings.samples);
    return text;
}

std::string replay_options_text(const RenderSettings& settings)
{
    std::string text;
    for (const auto& row : setting_rows<RenderSettings>())
        // The samples of some samplers depend on how many there are.
        if (row.effect == Effect::samples || row.name == "spp") text += option_text(row, settings);
    return text;
}

} // namespace plumb
