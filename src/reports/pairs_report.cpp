// SPDX-License-Identifier: MIT
#include "reports/pairs_report.h"

#include "plumb/reports/comparison_report.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

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
static std::string pair_text(const Agreement& agreement, const MethodPair& pair)
{
    const Significance& found = pair.comparison.significance;
    std::string text = fmt::format(
        "  {} and {}: {}, p {}", agreement.estimates[pair.a].name, agreement.estimates[pair.b].name,
        pair.comparison.verdict == Verdict::passes ? "agree" : verdict_word(pair.comparison.verdict),
        p_text(found.p, 3));
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

} // namespace plumb
