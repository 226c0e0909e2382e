// SPDX-License-Identifier: MIT
#include "plumb/experiments/suite_run.h"

#include "base/shell_words.h"
#include "experiments/foreign_command.h"
#include "settings/options_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// --define is <define>. An image is named after its sample count: no rule may change that.
bool is_of_suites(const SettingRow<RenderSettings>& row)
{
    return row.effect != Effect::stop && row.name != "define";
}

// called: what the attribute is.
template <class Settings>
void set(Settings& settings, const SettingRow<Settings>& row, const std::string& called,
         const SuiteSetting& attribute, Diagnostics& diagnostics)
{
    try {
        row.set(settings, called, attribute.value);
    } catch (const Error& problem) {
        diagnostics.error(attribute.at, problem.what());
    }
}

SuiteJob make_job(SuiteEntry entry, Diagnostics& diagnostics)
{
    SuiteJob job;
    job.image.scene.definitions = job.reference.scene.definitions = entry.definitions;
    for (const auto& [name, attribute] : entry.settings) {
        if (const auto* row = find_setting<CompareSettings>(name)) {
            set(job.compare, *row, name, attribute, diagnostics);
            continue;
        }
        const auto& row = *find_setting<RenderSettings>(name);
        set(job.image, row, name, attribute, diagnostics);
        // A target error without a number of samples takes as many as it needs.
        const bool is_replaced = name == "spp" && entry.reference_settings.contains("target-error");
        if (!is_replaced && !entry.reference_settings.contains(name))
            set(job.reference, row, name, attribute, diagnostics);
    }
    for (const auto& [name, attribute] : entry.reference_settings)
        set(job.reference, *find_setting<RenderSettings>(name), "reference-" + name, attribute, diagnostics);
    job.entry = std::move(entry);
    if (job.entry.foreign) {
        if (const std::string problem = foreign_problem(request_of(job)); !problem.empty())
            diagnostics.error(job.entry.foreign->at, problem);
        job.compare.samples = job.image.samples.per_pixel;
    }
    return job;
}

} // namespace

std::vector<std::string_view> suite_settings()
{
    std::vector<std::string_view> names;
    for (const auto& row : setting_rows<RenderSettings>())
        if (is_of_suites(row)) names.push_back(row.name);
    for (const auto& row : setting_rows<CompareSettings>()) names.push_back(row.name);
    return names;
}

std::string command_text(const std::filesystem::path& scene, const RenderSettings& settings)
{
    // A scene that is called like an option or a verb is none.
    const std::string file = scene.has_parent_path() ? scene.string() : "./" + scene.string();
    return "renderer " + shell_quote(file) + options_text(settings);
}

std::vector<SuiteJob> plan_suite(const std::filesystem::path& suite,
                                 const std::map<std::string, std::string>& definitions)
{
    Suite loaded = load_suite(suite, definitions, suite_settings());
    Diagnostics diagnostics;
    std::vector<SuiteJob> jobs;
    for (SuiteEntry& entry : loaded.entries) jobs.push_back(make_job(std::move(entry), diagnostics));
    if (!diagnostics.has_errors()) return jobs;
    std::vector<Diagnostic> errors = diagnostics.all();
    std::stable_sort(errors.begin(), errors.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::pair(a.location.line, a.location.column) < std::pair(b.location.line, b.location.column);
    });
    throw SceneError(std::move(errors));
}

} // namespace plumb
