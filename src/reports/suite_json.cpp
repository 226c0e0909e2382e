// SPDX-License-Identifier: MIT
#include "reports/suite_json.h"

#include "reports/comparison_json.h"
#include "reports/json_document.h"

namespace plumb {

namespace {

void write_texts(JsonWriter& json, std::string_view key, const std::vector<std::string>& texts)
{
    json.begin_array(key);
    for (const std::string& text : texts) json.text({}, text);
    json.end_array();
}

void write_program(JsonWriter& json, const std::optional<ProgramRun>& program)
{
    if (!program) return json.null("program");
    json.begin_object("program");
    json.number("exit_code", program->exit_code);
    json.number("seconds", program->seconds);
    json.integer("peak_memory", program->peak_memory);
    json.text("output", program->output);
    json.end_object();
}

} // namespace

void write_result(JsonWriter& json, const SuiteResult& result)
{
    json.text("name", result.title);
    json.text("verdict", result_word(result));
    json.text("reason", reason_text(result));
    write_text_or_null(json, "scene", result.scene);
    write_text_or_null(json, "command", result.command);
    write_text_or_null(json, "compare_command", result.compare_command);
    write_text_or_null(json, "accept_command", result.accept_command);
    write_text_or_null(json, "image", result.image);
    write_texts(json, "replicas", result.replicas);
    write_text_or_null(json, "reference", result.reference);
    write_text_or_null(json, "difference", result.difference);
    write_text_or_null(json, "significant", result.significant);
    write_text_or_null(json, "replaced", result.replaced);
    write_texts(json, "stale", result.stale);
    write_program(json, result.program);
    json.boolean("up_to_date", result.up_to_date);
    json.number("seconds", result.seconds);
    write_text_or_null(json, "problem", result.problem);
    write_diagnostics(json, "errors", result.errors);
    write_texts(json, "warnings", result.warnings);
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
    begin_document(json, "batch");
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
