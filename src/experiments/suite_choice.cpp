// SPDX-License-Identifier: MIT

// Which images or references of a suite are made, and which files are not.

#include "experiments/suite_choice.h"

#include "experiments/foreign_command.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace plumb {

namespace {

namespace fs = std::filesystem;

bool is_chosen(const std::string& title, const std::string& filter)
{
    if (filter.find_first_of("*?") != filter.npos) return matches_pattern(title, filter);
    return title.find(filter) != title.npos;
}

// Whether the reference would be another image.
bool makes_another(const SuiteJob& a, const SuiteJob& b)
{
    return a.entry.scene != b.entry.scene || a.reference != b.reference;
}

// One job for each reference of the chosen ones: the first in the suite that names it.
std::vector<SuiteJob> reference_makers(const std::vector<SuiteJob>& jobs, const std::vector<SuiteJob>& chosen)
{
    std::vector<SuiteJob> makers;
    Diagnostics diagnostics;
    const auto with = [](const fs::path& reference) {
        return [&reference](const SuiteJob& job) { return job.entry.reference == reference; };
    };
    for (const SuiteJob& job : chosen) {
        const fs::path& reference = job.entry.reference;
        if (reference.empty() || std::any_of(makers.begin(), makers.end(), with(reference))) continue;
        const auto can_make = [&reference](const SuiteJob& one) {
            return one.entry.reference == reference && !one.entry.scene.empty();
        };
        const auto found = std::find_if(jobs.begin(), jobs.end(), can_make);
        if (found == jobs.end()) continue; // no scene: it comes from elsewhere
        const SuiteJob& maker = *found;
        makers.push_back(maker);
        if (maker.entry.reference_settings.contains("spp") ||
            maker.entry.reference_settings.contains("target-error"))
            continue;
        for (const SuiteJob& other : jobs)
            if (can_make(other) && makes_another(other, maker))
                diagnostics.error(
                    maker.entry.reference_at,
                    fmt::format("several entries share '{}'; say how the first of them, '{}', makes it: "
                                R"(reference-spp="...")",
                                reference.string(), maker.entry.title()));
    }
    if (diagnostics.has_errors()) throw SceneError(diagnostics.all());
    if (makers.empty()) throw Error("no entry has a reference to make");
    return makers;
}

// Whether the user's name means the reference, by its file or by an image that is compared with it.
bool is_named(const SuiteJob& maker, const std::vector<SuiteJob>& jobs, const std::string& name)
{
    const fs::path& reference = maker.entry.reference;
    for (const std::string& one :
         {reference.string(), reference.filename().string(), reference.stem().string()})
        if (matches_pattern(one, name)) return true;
    return std::any_of(jobs.begin(), jobs.end(), [&](const SuiteJob& job) {
        return job.entry.reference == reference &&
               (matches_pattern(job.entry.title(), name) || matches_pattern(job.entry.name, name));
    });
}

std::vector<SuiteJob> references_to_update(const std::vector<SuiteJob>& jobs, std::vector<SuiteJob> makers,
                                           const std::string& which)
{
    if (which == "all") return makers;
    const std::string first = makers.front().entry.reference.string();
    std::error_code ignored;
    std::erase_if(makers, [&](const SuiteJob& maker) {
        return which == "missing" ? fs::exists(maker.entry.reference, ignored)
                                  : !is_named(maker, jobs, which);
    });
    if (makers.empty() && which != "missing")
        throw Error(fmt::format("no reference is called '{}'; the first one is '{}'", which, first));
    return makers;
}

} // namespace

std::vector<fs::path> files_to_keep(const fs::path& suite, const std::vector<SuiteJob>& jobs, bool update)
{
    std::set<fs::path> files = {suite};
    for (const SuiteJob& job : jobs) {
        const SuiteEntry& entry = job.entry;
        if (!entry.scene.empty()) files.insert(entry.scene);
        if (!update && !entry.reference.empty()) files.insert(entry.reference);
        if (!entry.foreign) continue;
        files.insert(entry.foreign->inputs.begin(), entry.foreign->inputs.end());
        if (!entry.foreign->command.empty()) continue;
        const std::vector<fs::path> images = given_images(request_of(job));
        files.insert(images.begin(), images.end());
    }
    return {files.begin(), files.end()};
}

std::vector<SuiteJob> chosen_jobs(const fs::path& suite, const std::vector<SuiteJob>& jobs,
                                  const SuiteOptions& options)
{
    std::vector<SuiteJob> chosen;
    for (const SuiteJob& job : jobs)
        if (is_chosen(job.entry.title(), options.filter)) chosen.push_back(job);
    if (chosen.empty())
        throw Error(fmt::format("no image of '{}' matches '{}'; the first image is {}", suite.string(),
                                options.filter, jobs.front().entry.title()));
    if (!options.is_about_references()) return chosen;
    std::vector<SuiteJob> makers = reference_makers(jobs, chosen);
    return options.update ? references_to_update(jobs, std::move(makers), *options.update) : makers;
}

} // namespace plumb
