// SPDX-License-Identifier: MIT
#include "plumb/reports/work_report.h"

#include "reports/json_document.h"

namespace plumb {

std::string work_json(const Work& work, const std::vector<std::string>& outputs,
                      const std::string& checkpoint)
{
    const SampleSet missing = work.missing();
    JsonWriter json;
    begin_document(json, "merge");
    json.begin_array("parts");
    for (const WorkPart& part : work.parts) {
        json.begin_object();
        json.text("file", part.file.string());
        json.integer("samples", part.samples.count());
        json.end_object();
    }
    json.end_array();
    json.integer("samples", work.file.state.samples());
    json.integer("missing", missing.count());
    json.boolean("complete", missing.empty());
    json.number("render_seconds", work.file.state.seconds);
    json.begin_array("outputs");
    for (const std::string& output : outputs) json.text({}, output);
    json.end_array();
    json.text("checkpoint", checkpoint);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
