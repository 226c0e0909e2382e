// SPDX-License-Identifier: MIT
#include "reports/comparison_json.h"

#include "reports/json_document.h"

#include <algorithm>

namespace plumb {

namespace {

std::string_view finding_word(std::optional<Verdict> verdict)
{
    if (!verdict) return "not asked";
    switch (*verdict) {
    case Verdict::passes: return "same";
    case Verdict::differs: return "different";
    case Verdict::undecided: return "undecided";
    }
    return "";
}

void write_place(JsonWriter& json, std::string_view key, const PixelRect& place)
{
    json.begin_array(key);
    for (const int number : {place.x, place.y, place.width, place.height}) json.number({}, number);
    json.end_array();
}

void write_metrics(JsonWriter& json, const Comparison& c)
{
    const Metrics& m = c.metrics;
    json.begin_object("metrics");
    json.number("mse", m.mse);
    json.number("rmse", m.rmse);
    json.number("relmse", m.relative_mse);
    json.number("mae", m.mae);
    json.number("psnr", m.psnr); // null: infinite
    json.number("max", m.max);
    json.begin_array("max_pixel");
    json.number({}, m.max_pixel.x);
    json.number({}, m.max_pixel.y);
    json.end_array();
    json.text("max_channel", c.channels[static_cast<std::size_t>(m.max_channel)]);
    json.number("mean_luminance_a", m.mean_a);
    json.number("mean_luminance_b", m.mean_b);
    if (m.flip) {
        json.number("flip", *m.flip);
        json.text("flip_mode", c.flip_mode == FlipMode::ldr ? "ldr" : "hdr");
    } else {
        json.null("flip");
    }
    json.end_object();
}

void write_corrected(JsonWriter& json, const Comparison& c)
{
    if (!c.corrected) return json.null("without_noise");
    json.begin_object("without_noise");
    json.number("mse", c.corrected->squared_error);
    json.number("low", c.corrected->low);
    json.number("high", c.corrected->high);
    if (c.corrected->root)
        json.number("rmse", *c.corrected->root);
    else
        json.null("rmse");
    json.integer("pixels", c.corrected->pixels);
    json.end_object();
}

void write_non_finite(JsonWriter& json, const NonFinite& n)
{
    json.begin_object("not_finite");
    json.integer("only_a", n.only_a);
    json.integer("only_b", n.only_b);
    json.integer("both", n.both);
    if (n.first) {
        json.begin_array("first");
        json.number({}, n.first->x);
        json.number({}, n.first->y);
        json.end_array();
    } else {
        json.null("first");
    }
    json.end_object();
}

void write_scale(JsonWriter& json, const Comparison& c, const ScaleTest& scale)
{
    json.begin_object();
    json.integer("size", static_cast<std::uint64_t>(scale.size));
    json.integer("squares", scale.units);
    json.integer("tested", scale.tested);
    json.integer("differ", scale.rejected);
    json.integer("smallest_for_pixels", scale.smallest_pixels);
    if (scale.largest) {
        const UnitTest& test = *scale.largest;
        json.begin_object("largest");
        write_place(json, "place", test.place);
        json.text("channel", c.channels[static_cast<std::size_t>(test.channel)]);
        json.number("mean_a", test.mean_a);
        json.number("mean_b", test.mean_b);
        json.number("t", test.t);
        json.number("degrees_of_freedom", test.freedom);
        json.number("p", p_number(test.p));
        json.end_object();
    } else {
        json.null("largest");
    }
    json.end_object();
}

void write_difference_noise(JsonWriter& json, const Comparison& c)
{
    const Significance& s = c.significance;
    if (!s.difference_noise) return;
    const DifferenceNoise& noise = *s.difference_noise;
    json.begin_object("difference_noise");
    json.number("inflation", noise.inflation);
    if (noise.reach)
        json.number("correlated_pixels", *noise.reach);
    else
        json.null("correlated_pixels"); // farther than 10
    if (noise.ratio)
        json.number("ratio", *noise.ratio);
    else
        json.null("ratio");
    if (noise.own)
        json.number("own", *noise.own);
    else
        json.null("own");
    json.boolean("hidden", noise.is_hidden);
    json.end_object();
    json.begin_array("sums_of_squares");
    for (const SpreadTest& test : s.spread) {
        json.begin_object();
        json.integer("size", static_cast<std::uint64_t>(test.size));
        json.boolean("tested", test.is_tested);
        if (test.is_tested) {
            json.text("channel", c.channels[static_cast<std::size_t>(test.channel)]);
            json.number("ratio", test.ratio);
            json.number("p", p_number(test.p));
        }
        json.end_object();
    }
    json.end_array();
}

void write_alignment(JsonWriter& json, std::string_view key, const std::optional<Alignment>& alignment)
{
    if (!alignment) return json.null(key);
    json.begin_object(key);
    json.text("change_of_a", alignment->change);
    json.number("p", p_number(alignment->p));
    json.integer("tried", static_cast<std::uint64_t>(alignment->tried));
    json.end_object();
}

void write_significance(JsonWriter& json, const Comparison& c, const CompareSettings& options)
{
    const Significance& s = c.significance;
    json.begin_object("noise");
    json.text("finding", finding_word(s.verdict));
    if (!s.reason.empty()) json.text("reason", s.reason);
    json.number("significance", options.significance);
    json.text("error_bars_a", c.noise_a);
    json.text("error_bars_b", c.noise_b);
    if (!s.scales.empty()) {
        json.number("p", p_number(s.p));
        json.integer("pixels", s.pixels);
        json.integer("differing", s.differing);
        json.integer("untested", s.untested);
        if (s.detectable_bias)
            json.number("detectable_bias", *s.detectable_bias);
        else
            json.null("detectable_bias");
        json.begin_array("scales");
        for (const ScaleTest& scale : s.scales) write_scale(json, c, scale);
        json.end_array();
        write_difference_noise(json, c);
        if (s.difference_noise) write_alignment(json, "shift", s.shift);
    }
    json.end_object();
}

void write_limits(JsonWriter& json, const Comparison& c, const CompareSettings& options)
{
    json.begin_array("limits");
    for (const Threshold& limit : options.thresholds) {
        const auto is_this = [&limit](const Threshold& t) { return t.metric == limit.metric; };
        json.begin_object();
        json.text("metric", limit.metric);
        json.number("limit", limit.limit);
        json.number("value", metric_value(c.metrics, limit.metric));
        json.boolean("exceeded", std::any_of(c.exceeded.begin(), c.exceeded.end(), is_this));
        json.end_object();
    }
    json.end_array();
}

} // namespace

void write_comparison(JsonWriter& json, const Comparison& comparison, const CompareSettings& options)
{
    json.text("outcome", verdict_word(comparison.verdict));
    json.boolean("identical", comparison.identical);
    json.begin_array("resolution");
    json.number({}, comparison.width);
    json.number({}, comparison.height);
    json.end_array();
    write_metrics(json, comparison);
    write_corrected(json, comparison);
    write_non_finite(json, comparison.non_finite);
    write_significance(json, comparison, options);
    write_alignment(json, "alignment", comparison.alignment);
    write_limits(json, comparison, options);
}

std::string comparison_json(const Comparison& comparison, const CompareSettings& options,
                            const std::vector<std::string>& a, const std::vector<std::string>& b)
{
    JsonWriter json;
    begin_document(json, "compare");
    // One name, or those of the replicas.
    const auto write_names = [&json](std::string_view key, const std::vector<std::string>& names) {
        if (names.size() == 1) return json.text(key, names.front());
        json.begin_array(key);
        for (const std::string& name : names) json.text({}, name);
        json.end_array();
    };
    write_names("a", a);
    write_names("b", b);
    write_comparison(json, comparison, options);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
