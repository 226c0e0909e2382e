// SPDX-License-Identifier: MIT
#include "plumb/settings/render_settings.h"

#include "plumb/base/error.h"
#include "plumb/image/development.h"
#include "plumb/render/aovs.h"
#include "plumb/render/film.h"
#include "settings/parse_value.h"
#include "settings/setting_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

using S = RenderSettings;
using Name = std::string_view;
using Text = std::string_view;

std::vector<std::string_view> dialect_words()
{
    std::vector<std::string_view> words = {"auto"};
    for (const DialectName dialect : all_dialects) words.push_back(to_string(dialect));
    return words;
}

void define(S& s, Name name, Text text)
{
    const auto [variable, value] = parse_definition(name, text);
    if (!s.scene.definitions.emplace(variable, value).second)
        throw Error(fmt::format("{} {} is given twice", name, variable));
}

Texts definitions_text(const S& s)
{
    Texts all;
    for (const auto& [name, value] : s.scene.definitions) all.push_back(name + "=" + value);
    return all;
}

Texts size_text(const S& s)
{
    const auto& size = s.view.size;
    return size ? Texts{fmt::format("{}x{}", size->x, size->y)} : Texts();
}

Texts crop_text(const S& s)
{
    const auto& crop = s.view.crop;
    return crop ? Texts{fmt::format("{},{},{},{}", crop->x, crop->y, crop->width, crop->height)} : Texts();
}

Texts dialect_text(const S& s)
{
    return s.scene.dialect ? Texts{std::string(to_string(*s.scene.dialect))} : Texts();
}

void set_tonemap(S& s, Name name, Text text)
{
    const auto names = tone_curve_names();
    const std::string word = parse_word(name, text, {names.begin(), names.end()});
    s.output.development.curve =
        static_cast<ToneCurve>(std::find(names.begin(), names.end(), word) - names.begin());
}

Texts tonemap_text(const S& s)
{
    const ToneCurve curve = s.output.development.curve;
    return curve == ToneCurve::none ? Texts() : Texts{std::string(to_string(curve))};
}

void set_aovs(S& s, Name name, Text text)
{
    std::vector<std::string> aovs = parse_list(name, text);
    try {
        layers_of(aovs);
    } catch (const Error& problem) {
        throw Error(fmt::format("{}: {}", name, problem.what()));
    }
    s.view.aovs = std::move(aovs);
}

Texts aovs_text(const S& s)
{
    const auto& aovs = s.view.aovs;
    return aovs.empty() ? Texts() : Texts{fmt::format("{}", fmt::join(aovs, ","))};
}

void set_splits(S& s, Name name, Text text)
{
    try {
        s.view.splits = light_splits_from_text(parse_list(name, text));
    } catch (const Error& problem) {
        throw Error(fmt::format("{}: {}", name, problem.what()));
    }
}

Texts splits_text(const S& s)
{
    const auto& splits = s.view.splits;
    return splits.empty() ? Texts() : Texts{fmt::format("{}", fmt::join(to_texts(splits), ","))};
}

// "Embree instruction set: sse2, sse4.2, avx, avx2 or avx512 (default avx2)", on the processors that have these.
std::string isa_help()
{
    std::string words = "Embree instruction set:\n";
    const std::vector<std::string_view> names = instruction_set_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) words += i + 1 < names.size() ? ", " : " or ";
        words += names[i];
    }
    return fmt::format("{} (default {})", words, default_instruction_set().name);
}

} // namespace

// Whoever adds a row decides by its effect who obeys a header that has it: resume and merge want samples and coverage
// to be the same, and rerun takes them all.
template <>
std::span<const SettingRow<RenderSettings>> setting_rows<RenderSettings>()
{
    static const std::string help_of_isa = isa_help();
    static const SettingRow<RenderSettings> rows[] = {
        {"exposure", "STOPS", "multiply .png and .jpg by 2^STOPS (default 0)", "the exposure", Effect::file,
         [](const S& s) { return text_unless(s.output.development.exposure, 0.f); },
         [](S& s, Name n, Text t) { s.output.development.exposure = parse_number(n, t, -100.f, 100.f); }},
        {"tonemap", "CURVE",
         "tone curve of .png and .jpg: none, filmic, aces or\n"
         "agx (default none: values above white are clipped)",
         "the tone curve", Effect::file, tonemap_text, set_tonemap},
        {"denoise", "",
         "denoise .png and .jpg with Open Image Denoise; adds\n"
         "the layers albedo_behind and normal_behind",
         "denoising", Effect::file, [](const S& s) { return switch_text(s.output.denoise); },
         [](S& s, Name n, Text t) { s.output.denoise = parse_switch(n, t); }},
        {"no-variance", "",
         "omit the error bars from .exr files: variance.R,\n"
         "variance.G, variance.B and contributing",
         "the absence of error bars", Effect::file,
         [](const S& s) { return switch_text(!s.output.error_bars); },
         [](S& s, Name n, Text t) { s.output.error_bars = !parse_switch(n, t); }},

        {"spp", "N", "samples per pixel (default: the scene's)", "the number of samples per pixel",
         Effect::coverage, [](const S& s) { return optional_text(s.samples.per_pixel); },
         [](S& s, Name n, Text t) { s.samples.per_pixel = parse_integer(n, t, 1, film_max_samples); }},
        {"adaptive", "E",
         "each pixel decides how many of the --spp samples it\n"
         "gets, by its own error and this target",
         "the adaptive target error", Effect::coverage,
         [](const S& s) { return optional_text(s.samples.adaptive); },
         [](S& s, Name n, Text t) { s.samples.adaptive = parse_double(n, t, 1e-4, 1.0); }},
        {"seed", "N", "seed of the random numbers, 64 bits (default 0)", "the seed", Effect::samples,
         [](const S& s) { return text_unless(s.samples.seed, std::uint64_t{0}); },
         [](S& s, Name n, Text t) { s.samples.seed = parse_integer(n, t, 0, UINT64_MAX); }},
        {"size", "WxH", "resolution (default: the scene's)", "the resolution", Effect::samples, size_text,
         [](S& s, Name n, Text t) { s.view.size = parse_size(n, t); }},
        {"crop", "X,Y,W,H", "render this window only; same bits as in the full\nimage", "the crop",
         Effect::coverage, crop_text, [](S& s, Name n, Text t) { s.view.crop = parse_rectangle(n, t); }},
        {"aov", "NAME,...", "add layers to .exr files: albedo, normal, depth and\nothers (docs/aovs.md)",
         "the list of layers", Effect::coverage, aovs_text, set_aovs},
        {"split", "WHAT,...",
         "add layers to .exr files that add up to the image:\n"
         "by depth, technique or light (docs/aovs.md)",
         "the split of the light", Effect::coverage, splits_text, set_splits},
        {"integrator", "TYPE",
         "use this integrator instead of the scene's, with\n"
         "default parameters",
         "the integrator", Effect::samples, [](const S& s) { return optional_text(s.method.integrator); },
         [](S& s, Name, Text t) { s.method.integrator = std::string(t); }},
        {"sampler", "TYPE", "use this sampler instead of the scene's", "the sampler", Effect::samples,
         [](const S& s) { return optional_text(s.method.sampler); },
         [](S& s, Name, Text t) { s.method.sampler = std::string(t); }},
        {"time", "T",
         "time limit in all: 90, 90s, 10m or 2h; rendering\n"
         "takes at most --spp samples",
         "the time limit", Effect::stop, [](const S& s) { return optional_text(s.stop.seconds); },
         [](S& s, Name n, Text t) { s.stop.seconds = parse_duration(n, t); }},
        {"target-error", "E",
         "stop when the expected RMSE is below E times the mean\n"
         "of the image (upper end of the 95 % interval)",
         "the target error", Effect::stop, [](const S& s) { return optional_text(s.stop.relative_error); },
         [](S& s, Name n, Text t) { s.stop.relative_error = parse_double(n, t, 1e-9, 1e3); }},

        {"define", "NAME=VALUE", "value of $NAME in the file; may be repeated", "what --define says",
         Effect::samples, definitions_text, define, "D", true},
        {"dialect", "NAME",
         "dialect of the scene: auto, plumb, epfl, eth,\n"
         "zaragoza or mcgill (default auto)",
         "the dialect", Effect::samples, dialect_text,
         [](S& s, Name n, Text t) {
             s.scene.dialect = dialect_from_string(parse_word(n, t, dialect_words()));
         }},
        {"emitters", "WHAT", "emitters scatter or absorb incident light", "what emitters do", Effect::samples,
         [](const S& s) { return word_text(s.scene.emitters_absorb, true, "absorb", "scatter"); },
         [](S& s, Name n, Text t) {
             s.scene.emitters_absorb = parse_word(n, t, {"scatter", "absorb"}) == "absorb";
         }},
        {"mirror", "on|off", "mirror the image left to right", "the mirrored view", Effect::samples,
         [](const S& s) { return word_text(s.scene.mirrored_view, true, "on", "off"); },
         [](S& s, Name n, Text t) {
             s.scene.mirrored_view = parse_word(n, t, {"on", "off"}) == "on";
         }},
        {"envmap-scale", "X", "multiply environment images by X", "the scale of environment images",
         Effect::samples, [](const S& s) { return optional_text(s.scene.environment_scale); },
         [](S& s, Name n, Text t) { s.scene.environment_scale = parse_number(n, t, 0.f, 1e30f); }},
        {"lenient", "", "unknown parameters are warnings, not errors", "leniency", Effect::samples,
         [](const S& s) { return switch_text(s.scene.lenient); },
         [](S& s, Name n, Text t) { s.scene.lenient = parse_switch(n, t); }},
        {"isa", "NAME", help_of_isa, "the instruction set", Effect::samples,
         [](const S& s) {
             return text_unless(s.method.instruction_set, std::string(default_instruction_set().name));
         },
         [](S& s, Name n, Text t) { s.method.instruction_set = parse_word(n, t, instruction_set_names()); }},
    };
    return rows;
}

} // namespace plumb
