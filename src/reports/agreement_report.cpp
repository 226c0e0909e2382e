// SPDX-License-Identifier: MIT
#include "plumb/reports/agreement_report.h"

#include "base/visible_text.h"
#include "plumb/reports/comparison_report.h"
#include "reports/json_document.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string_view verdict_of(Verdict verdict)
{
    switch (verdict) {
    case Verdict::passes: return "agree";
    case Verdict::differs: return "differ";
    case Verdict::undecided: return "undecided";
    }
    return "";
}

// A line.
std::string pair_text(const Agreement& agreement, const MethodPair& pair)
{
    const Significance& found = pair.comparison.significance;
    std::string text = fmt::format(
        "  {} and {}: {}, p {:.3g}", agreement.estimates[pair.a].name, agreement.estimates[pair.b].name,
        pair.comparison.verdict == Verdict::passes ? "agree" : verdict_word(pair.comparison.verdict),
        found.p);
    if (pair.comparison.verdict == Verdict::undecided && !found.reason.empty())
        text += fmt::format(" ({})", found.reason);
    if (pair.comparison.verdict == Verdict::passes && found.differing + found.untested > 0)
        text += fmt::format(" ({} of {} pixels differ, {} are undecided)", found.differing, found.pixels,
                            found.untested);
    if (found.detectable_bias)
        text += fmt::format("; a bias of {:.3g} % would have been found with 90 % probability",
                            *found.detectable_bias * 100.0);
    return text + "\n";
}

std::string pairs_text(const Agreement& agreement)
{
    std::string text;
    for (const MethodPair& pair : agreement.pairs) text += pair_text(agreement, pair);
    return text;
}

// What may decide it if they are undecided: a line. An estimator that all undecided pairs share, and others do not, is the
// one that rarely finds some of the light.
std::string advice(const Agreement& agreement)
{
    if (agreement.verdict != Verdict::undecided) return {};
    std::string names;
    for (std::size_t i = 0; i < agreement.estimates.size(); ++i) {
        const bool is_shared =
            std::all_of(agreement.pairs.begin(), agreement.pairs.end(), [&](const MethodPair& pair) {
                return pair.comparison.verdict != Verdict::undecided || pair.a == i || pair.b == i;
            });
        if (agreement.estimates.size() > 2 && is_shared)
            names += (names.empty() ? "" : " or ") + agreement.estimates[i].name;
    }
    std::string text = "more samples may decide it";
    if (!names.empty()) text += "; or omit " + names + ", which finds some of the light too rarely";
    return text + "\n";
}

// The scene and what was found about it.
void write_verdict(JsonWriter& json, const std::string& scene, const Agreement& agreement,
                   const CompareSettings& how)
{
    json.text("scene", scene);
    json.text("verdict", verdict_of(agreement.verdict));
    json.number("significance", how.significance);
}

void write_pairs(JsonWriter& json, const Agreement& agreement)
{
    json.begin_array("pairs");
    for (const MethodPair& pair : agreement.pairs) {
        const Significance& found = pair.comparison.significance;
        json.begin_object();
        json.text("a", agreement.estimates[pair.a].name);
        json.text("b", agreement.estimates[pair.b].name);
        json.text("outcome", verdict_word(pair.comparison.verdict));
        if (!found.reason.empty()) json.text("reason", found.reason);
        json.number("p", found.p);
        if (const auto& bias = found.detectable_bias)
            json.number("detectable_bias", *bias);
        else
            json.null("detectable_bias");
        json.end_object();
    }
    json.end_array();
}

std::string efficiency_text(const RaceRow& row, bool is_best)
{
    if (!row.efficiency) return "unknown: it found no noise";
    if (is_best) return "1";
    const auto& [value, low, high] = *row.efficiency;
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", value, low, high);
}

std::string table_text(const RaceResult& race)
{
    std::size_t width = 0;
    for (const RaceRow& row : race.ranking) width = std::max(width, row.name.size());
    std::string text = fmt::format("  {:<{}}  ms a sample  variance   efficiency\n", "", width);
    for (const RaceRow& row : race.ranking)
        text += fmt::format("  {:<{}}  {:<11.3g}  {:<9.3g}  {}\n", row.name, width,
                            row.rounds.mean_seconds() * 1e3 / static_cast<double>(race.samples_per_pixel),
                            row.rounds.variance(), efficiency_text(row, &row == &race.ranking.front()));
    return text;
}

} // namespace

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

std::string race_text(const std::string& scene, const RaceResult& race)
{
    return fmt::format("{}: {} rounds of {} samples per pixel\n", visible_text(scene), race.rounds,
                       race.samples_per_pixel) +
           table_text(race) + pairs_text(race.means) + fmt::format("{}\n", verdict_of(race.means.verdict)) +
           advice(race.means);
}

std::string race_json(const std::string& scene, const RaceResult& race, const CompareSettings& how)
{
    JsonWriter json;
    begin_document(json, "race");
    write_verdict(json, scene, race.means, how);
    json.integer("rounds", race.rounds);
    json.integer("spp", race.samples_per_pixel);
    json.begin_array("estimators");
    for (const RaceRow& row : race.ranking) {
        json.begin_object();
        json.text("name", row.name);
        json.number("seconds_per_sample",
                    row.rounds.mean_seconds() / static_cast<double>(race.samples_per_pixel));
        json.number("variance", row.rounds.variance());
        if (const auto& efficiency = row.efficiency) {
            json.number("efficiency", efficiency->value);
            json.number("efficiency_low", efficiency->low);
            json.number("efficiency_high", efficiency->high);
        } else {
            json.null("efficiency");
        }
        json.begin_array("seconds");
        for (const double seconds : row.rounds.seconds) json.number("", seconds);
        json.end_array();
        json.end_object();
    }
    json.end_array();
    write_pairs(json, race.means);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
