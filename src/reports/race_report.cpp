// SPDX-License-Identifier: MIT
#include "plumb/reports/race_report.h"

#include "base/visible_text.h"
#include "reports/pairs_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {

namespace {

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

// Whom it is about: a part of a sentence.
std::string parties(const Agreement& means)
{
    std::vector<std::string> odd; // in all pairs that do not agree
    for (std::size_t i = 0; i < means.estimates.size(); ++i)
        if (std::all_of(means.pairs.begin(), means.pairs.end(), [i](const MethodPair& pair) {
                return pair.comparison.verdict == Verdict::passes || pair.a == i || pair.b == i;
            }))
            odd.push_back(means.estimates[i].name);
    if (odd.size() == 2) return fmt::format("{} and {} have no common scene, so their", odd[0], odd[1]);
    if (odd.size() == 1) return fmt::format("{} has no common scene with the others, so the", odd[0]);
    return "they have no common scene, so the";
}

// One sentence; empty: as far as the test can tell, they render the same. What estimators leave out is their nature: if they
// leave out different light, more samples do not help.
std::string no_common_scene(const RaceResult& race)
{
    const bool has_one_bias = std::all_of(race.ranking.begin(), race.ranking.end(), [&](const RaceRow& row) {
        return row.bias == race.ranking.front().bias;
    });
    const Verdict verdict = race.means.verdict;
    if (verdict == Verdict::passes || (verdict == Verdict::undecided && has_one_bias)) return {};
    std::vector<std::string> reasons;
    for (const Estimate& estimate : race.means.estimates) { // in the order in which they were asked for
        const auto row = std::ranges::find(race.ranking, estimate.name, &RaceRow::name);
        if (!row->bias.empty()) reasons.push_back(fmt::format("{}: {}", row->name, row->bias));
    }
    std::string text = parties(race.means) + " efficiencies are not comparable";
    if (!reasons.empty()) text += fmt::format(" ({})", fmt::join(reasons, "; "));
    return text;
}

void write_curve(JsonWriter& json, const RaceRow& row)
{
    if (row.curve.empty()) return;
    json.begin_array("curve");
    for (const CurvePoint& point : row.curve) {
        json.begin_object();
        json.integer("spp", point.samples);
        json.number("seconds", point.seconds);
        if (point.rmse) {
            json.number("rmse", point.rmse->value);
            json.number("rmse_low", point.rmse->low);
            json.number("rmse_high", point.rmse->high);
        } else {
            json.null("rmse");
        }
        json.end_object();
    }
    json.end_array();
}

} // namespace

std::string race_text(const std::string& scene, const RaceResult& race)
{
    return fmt::format("{}: {} rounds of {} samples per pixel\n", visible_text(scene), race.rounds,
                       race.samples_per_pixel) +
           table_text(race) + pairs_text(race.means) + std::string(verdict_of(race.means.verdict)) +
           (no_common_scene(race).empty() ? "\n" + advice(race.means) : ": " + no_common_scene(race) + "\n");
}

std::string race_json(const std::string& scene, const RaceResult& race, const CompareSettings& how)
{
    JsonWriter json;
    begin_document(json, "race");
    write_verdict(json, scene, race.means, how);
    json.integer("rounds", race.rounds);
    json.integer("spp", race.samples_per_pixel);
    write_text_or_null(json, "no_common_scene", no_common_scene(race));
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
        write_curve(json, row);
        json.end_object();
    }
    json.end_array();
    write_pairs(json, race.means);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
