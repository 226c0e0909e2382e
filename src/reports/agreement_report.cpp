// SPDX-License-Identifier: MIT
#include "plumb/reports/agreement_report.h"

#include "base/visible_text.h"
#include "reports/pairs_report.h"

#include <fmt/format.h>

namespace plumb {

std::string agreement_text(const std::string& scene, const Agreement& agreement)
{
    std::string text = visible_text(scene) + "\n";
    for (std::size_t i = 0; i < agreement.estimates.size(); ++i)
        text +=
            fmt::format("  {}: {} samples per pixel\n", agreement.estimates[i].name, agreement.samples_of[i]);
    return text + pairs_text(agreement) +
           fmt::format("{}; errors shared by all estimators cannot be detected\n",
                       verdict_of(agreement.verdict)) +
           advice(agreement);
}

std::string agreement_json(const std::string& scene, const Agreement& agreement, const CompareSettings& how)
{
    JsonWriter json;
    begin_document(json, "agree");
    write_verdict(json, scene, agreement, how);
    json.begin_array("estimates");
    for (std::size_t i = 0; i < agreement.estimates.size(); ++i) {
        json.begin_object();
        json.text("name", agreement.estimates[i].name);
        json.integer("spp", agreement.samples_of[i]);
        json.end_object();
    }
    json.end_array();
    write_pairs(json, agreement);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
