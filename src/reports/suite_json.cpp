// SPDX-License-Identifier: MIT
#include "reports/suite_json.h"

#include "reports/comparison_json.h"

namespace plumb {

namespace {

void write_text_or_null(JsonWriter& json, std::string_view key, const std::string& text)
{
    if (text.empty())
        json.null(key);
    else
        json.text(key, text);
}

} // namespace

void write_result(JsonWriter& json, const SuiteResult& result)
{
    json.text("name", result.title);
    json.text("verdict", result_word(result));
    json.text("reason", reason_text(result));
    json.text("scene", result.scene);
    json.text("command", result.command);
    write_text_or_null(json, "image", result.image);
    write_text_or_null(json, "reference", result.reference);
    write_text_or_null(json, "difference", result.difference);
    json.boolean("up_to_date", result.up_to_date);
    json.number("seconds", result.seconds);
    write_text_or_null(json, "problem", result.problem);
    json.begin_array("warnings");
    for (const std::string& warning : result.warnings) json.text({}, warning);
    json.end_array();
    if (result.noise)
        json.number("noise", *result.noise);
    else
        json.null("noise");
    write_text_or_null(json, "biases", result.biases);
    json.integer("left_out", result.left_out);
    if (result.comparison) {
        json.begin_object("comparison");
        write_comparison(json, *result.comparison, result.how);
        json.end_object();
    } else {
        json.null("comparison");
    }
}

void write_summary(JsonWriter& json, const SuiteRun& run)
{
    json.text("software", "Plumb " PLUMB_VERSION);
    json.text("suite", run.suite);
    json.text("summary", summary_text(run));
    json.integer("exit_code", static_cast<std::uint64_t>(exit_code_of(run)));
    json.number("seconds", run.seconds);
    json.begin_object("counts");
    json.integer("passes", run.count(Verdict::passes));
    json.integer("rendered", run.count(JobState::rendered));
    json.integer("differs", run.count(Verdict::differs));
    json.integer("undecided", run.count(Verdict::undecided));
    json.integer("error", run.count(JobState::failed));
    json.integer("not run", run.count(JobState::not_run));
    json.end_object();
}

std::string suite_json(const SuiteRun& run)
{
    JsonWriter json;
    json.begin_object();
    write_summary(json, run);
    json.begin_array("images");
    for (const SuiteResult& result : run.results) {
        json.begin_object();
        write_result(json, result);
        json.end_object();
    }
    json.end_array();
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
