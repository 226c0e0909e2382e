// SPDX-License-Identifier: MIT
#include "plumb/settings/compare_settings.h"

#include "plumb/base/error.h"
#include "settings/parse_value.h"
#include "settings/setting_text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

using C = CompareSettings;
using Name = std::string_view;
using Text = std::string_view;

// "rmse=0.01,flip=0.05", added to the limits there are.
void add_limits(C& c, Name name, Text text)
{
    for (const std::string& part : parse_list(name, text)) {
        const auto [metric, value] = parse_definition(name, part);
        parse_word(name, metric, {"mse", "rmse", "relmse", "mae", "max", "psnr", "flip"});
        const double limit = parse_double(fmt::format("{} {}", name, metric), value, -1e30, 1e30);
        for (const Threshold& other : c.thresholds)
            if (other.metric == metric) throw Error(fmt::format("{} {} is given twice", name, metric));
        c.thresholds.push_back({metric, limit});
    }
}

Texts limits_text(const C& c)
{
    std::string all;
    for (const Threshold& limit : c.thresholds)
        all += fmt::format("{}{}={}", all.empty() ? "" : ",", limit.metric, limit.limit);
    return all.empty() ? Texts() : Texts{all};
}

void set_flip(C& c, Name name, Text text)
{
    const std::string mode = parse_word(name, text, {"ldr", "hdr", "none"});
    c.flip = mode == "ldr" ? FlipMode::ldr : mode == "hdr" ? FlipMode::hdr : FlipMode::none;
}

Texts flip_text(const C& c)
{
    if (!c.flip) return {};
    return {*c.flip == FlipMode::ldr ? "ldr" : *c.flip == FlipMode::hdr ? "hdr" : "none"};
}

} // namespace

template <>
std::span<const SettingRow<CompareSettings>> setting_rows<CompareSettings>()
{
    static const SettingRow<CompareSettings> rows[] = {
        {"significance", "P", "probability of a false difference (default 0.01)", "the significance",
         Effect::verdict, [](const C& c) { return text_unless(c.significance, C().significance); },
         [](C& c, Name n, Text t) { c.significance = parse_double(n, t, 1e-9, 0.5); }},
        {"layer", "NAME", "compare the channels NAME.* instead of the colours", "the layer", Effect::verdict,
         [](const C& c) { return text_unless(c.layer, std::string()); },
         [](C& c, Name n, Text t) {
             if (t.empty()) throw Error(fmt::format("{} needs a name", n));
             c.layer = t;
         }},
        {"exact", "A|B", "this image has no noise", "the exact image", Effect::verdict,
         [](const C& c) { return word_text(c.exact, Side::a, "A", "B"); },
         [](C& c, Name n, Text t) {
             c.exact = parse_word(n, t, {"A", "B"}) == "A" ? Side::a : Side::b;
         }},
        {"variance-of", "WHAT",
         "what the variance channels of other renderers are\nof: sample or mean (default: by their names)",
         "the meaning of variance channels", Effect::verdict,
         [](const C& c) { return word_text(c.variance_of, VarianceOf::sample, "sample", "mean"); },
         [](C& c, Name n, Text t) {
             c.variance_of =
                 parse_word(n, t, {"sample", "mean"}) == "sample" ? VarianceOf::sample : VarianceOf::mean;
         }},
        {"no-verdict", "", "ignore the noise: the limits of --max decide", "the use of the noise",
         Effect::verdict, [](const C& c) { return switch_text(!c.verdict); },
         [](C& c, Name n, Text t) { c.verdict = !parse_switch(n, t); }},
        {"fail-percent", "P",
         "allow P % of the pixels to differ or stay undecided\n"
         "(default 0)",
         "the tolerated part of the pixels", Effect::verdict,
         [](const C& c) { return text_unless(c.fail_percent, C().fail_percent); },
         [](C& c, Name n, Text t) { c.fail_percent = parse_double(n, t, 0.0, 100.0); }},
        {"max",
         "METRIC=X,...",
         "fail above these: mse, rmse, relmse, mae, max, flip;\n"
         "or below: psnr",
         "the limits",
         Effect::verdict,
         limits_text,
         add_limits,
         {},
         true},
        {"flip", "MODE", "ldr, hdr or none (default: ldr for .png and the like)", "the kind of FLIP",
         Effect::verdict, flip_text, set_flip},
    };
    return rows;
}

} // namespace plumb
