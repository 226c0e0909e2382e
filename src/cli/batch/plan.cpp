// SPDX-License-Identifier: MIT
#include "cli/batch/plan.h"

#include "cli/option_rows.h"
#include "cli/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

bool renders(const OptionRow& row)
{
    // --define is <define>. A picture is named after its sample count: no rule may change that.
    constexpr std::string_view others[] = {"--define", "--time", "--target-error"};
    return row.changes_picture() && std::ranges::find(others, row.long_name()) == std::end(others);
}

bool compares(const OptionRow& row)
{
    return row.goes_with(Verb::compare) && row.topic == Topic::verdict;
}

const OptionRow& row_of_setting(const std::string& name)
{
    const auto rows = option_rows();
    return *std::find_if(rows.begin(), rows.end(), [&](const OptionRow& row) {
        return (renders(row) || compares(row)) && row.long_name().substr(2) == name;
    });
}

// Turns settings into words, and collects what is wrong with their values.
class Words {
public:
    explicit Words(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    void add(std::vector<std::string>& words, const OptionRow& row, const std::string& name,
             const SuiteSetting& setting)
    {
        if (!row.takes_value()) {
            if (setting.value != "true" && setting.value != "false")
                diagnostics_.error(setting.at,
                                   fmt::format("{} must be true or false, not '{}'", name, setting.value));
            if (setting.value == "true") words.emplace_back(row.long_name());
            return;
        }
        try {
            Options scratch;
            row.apply(scratch, name, setting.value);
        } catch (const UsageError& problem) {
            diagnostics_.error(setting.at, problem.what());
        }
        words.emplace_back(row.long_name());
        words.push_back(setting.value);
    }

private:
    Diagnostics& diagnostics_;
};

BatchJob make_job(SuiteEntry entry, Diagnostics& diagnostics)
{
    BatchJob job;
    Words words(diagnostics);
    // A scene that is called like an option or a verb is none.
    const std::string scene =
        entry.scene.has_parent_path() ? entry.scene.string() : "./" + entry.scene.string();
    job.render_words = job.reference_words = {scene};
    for (const auto& [name, value] : entry.definitions)
        for (auto* list : {&job.render_words, &job.reference_words}) {
            list->emplace_back("--define");
            list->push_back(name + "=" + value);
        }
    for (const auto& [name, setting] : entry.settings) {
        const OptionRow& row = row_of_setting(name);
        if (renders(row)) {
            words.add(job.render_words, row, name, setting);
            if (!entry.reference_settings.contains(name)) words.add(job.reference_words, row, name, setting);
        } else {
            words.add(job.compare_words, row, name, setting);
        }
    }
    for (const auto& [name, setting] : entry.reference_settings)
        words.add(job.reference_words, row_of_setting(name), "reference-" + name, setting);
    job.entry = std::move(entry);
    return job;
}

} // namespace

std::vector<std::string_view> suite_settings()
{
    std::vector<std::string_view> names;
    for (const OptionRow& row : option_rows())
        if (renders(row) || compares(row)) names.push_back(row.long_name().substr(2));
    return names;
}

std::string command_text(const std::vector<std::string>& words)
{
    std::string text = "renderer";
    for (const std::string& word : words) text += " " + shell_quote(word);
    return text;
}

std::vector<BatchJob> plan_batch(const std::string& suite,
                                 const std::map<std::string, std::string>& definitions)
{
    Suite loaded = load_suite(suite, definitions, suite_settings());
    Diagnostics diagnostics;
    std::vector<BatchJob> jobs;
    for (SuiteEntry& entry : loaded.entries) jobs.push_back(make_job(std::move(entry), diagnostics));
    if (!diagnostics.has_errors()) return jobs;
    std::vector<Diagnostic> errors = diagnostics.all();
    std::stable_sort(errors.begin(), errors.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::pair(a.location.line, a.location.column) < std::pair(b.location.line, b.location.column);
    });
    throw SceneError(std::move(errors));
}

} // namespace plumb
