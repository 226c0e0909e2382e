// SPDX-License-Identifier: MIT
#include "cli/option_rows.h"

#include "cli/values.h"
#include "cli/verbs.h"
#include "plumb/render/aovs.h"
#include "plumb/scene/instruction_set.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

constexpr unsigned verb_bit(Verb verb)
{
    return 1u << static_cast<unsigned>(verb);
}

constexpr unsigned render_only = verb_bit(Verb::render);
constexpr unsigned replay_only = verb_bit(Verb::replay);
constexpr unsigned rerun_only = verb_bit(Verb::rerun);
constexpr unsigned rendering = render_only | rerun_only;
constexpr unsigned both = render_only | replay_only;
constexpr unsigned merge_only = verb_bit(Verb::merge);
constexpr unsigned test_only = verb_bit(Verb::test);
constexpr unsigned compare_only = verb_bit(Verb::compare);
constexpr unsigned race_only = verb_bit(Verb::race);
constexpr unsigned agree_or_race = verb_bit(Verb::agree) | race_only;
constexpr unsigned check_only = verb_bit(Verb::check);
constexpr unsigned batch_only = verb_bit(Verb::batch);
constexpr unsigned loads_scene = both | agree_or_race | check_only;
constexpr unsigned loads = loads_scene | test_only; // with the options of load_scene()
constexpr unsigned every_verb = ~0u;

using Name = std::string_view;
using Text = const std::string&;

std::vector<std::string_view> dialect_words()
{
    std::vector<std::string_view> words = {"auto"};
    for (const DialectName dialect : all_dialects) words.push_back(to_string(dialect));
    return words;
}

void define(Options& options, Name name, Text text)
{
    const auto [variable, value] = parse_definition(name, text);
    if (!options.load.definitions.emplace(variable, value).second)
        throw UsageError(fmt::format("{} {} is given twice", name, variable));
}

// "rmse=0.01,flip=0.05", added to the limits there are.
void add_limits(Options& options, Name name, Text text)
{
    for (const std::string& part : parse_list(name, text)) {
        const auto [metric, value] = parse_definition(name, part);
        parse_word(name, metric, {"mse", "rmse", "relmse", "mae", "max", "psnr", "flip"});
        const double limit = parse_double(fmt::format("{} {}", name, metric), value, -1e30, 1e30);
        for (const Threshold& other : options.compare.how.thresholds)
            if (other.metric == metric) throw UsageError(fmt::format("{} {} is given twice", name, metric));
        options.compare.how.thresholds.push_back({metric, limit});
    }
}

void check_aovs(Name name, const std::vector<std::string>& aovs)
{
    try {
        layers_of(aovs);
    } catch (const Error& problem) {
        throw UsageError(fmt::format("{}: {}", name, problem.what()));
    }
}

// "Embree instruction set: sse2, sse4.2, avx, avx2 or avx512 (default avx2)", on the processors that have these.
std::string words_of_isa()
{
    std::string words = "Embree instruction set:\n";
    const std::vector<std::string_view> names = instruction_set_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) words += i + 1 < names.size() ? ", " : " or ";
        words += names[i];
    }
    return fmt::format("{} (default {})", words, default_instruction_set().name);
}
const std::string isa_help = words_of_isa();

// Every option, in the order of --help.
using OptionTable = OptionRow[]; // clang-format gets lost in the declaration without it
const OptionTable rows = {
    {Topic::output, Effect::run, rendering | merge_only, "-o,--output", "FILE",
     "write this image: .exr, .hdr, .tif, .png or .jpg;\n"
     "may be repeated (default SCENE_SPP.exr and .png)",
     [](Options& o, Name, Text t) { o.outputs.push_back(t); }, true},
    {Topic::output, Effect::picture, render_only, "--exposure", "EV",
     "multiply .png and .jpg by 2^EV (default 0)",
     [](Options& o, Name n, Text t) { o.exposure = parse_number(n, t, -100.f, 100.f); }},
    {Topic::output, Effect::picture, render_only, "--no-variance", "",
     "omit the error bars from .exr files: variance.R,\n"
     "variance.G, variance.B and contributing",
     [](Options& o, Name, Text) { o.variance = false; }},
    {Topic::output, Effect::run, rendering | merge_only | test_only | compare_only | agree_or_race, "--json",
     "FILE", "write a report of the run; - is standard output", [](Options& o, Name, Text t) { o.json = t; }},
    {Topic::output, Effect::run, batch_only, "--out", "DIR",
     "directory for images and reports\n"
     "(default batch/SUITE)",
     [](Options& o, Name n, Text t) {
         if (t.empty()) throw UsageError(fmt::format("{} needs a directory", n));
         o.batch.directory = t;
     }},
    {Topic::output, Effect::run, batch_only, "--update", "",
     "make the references instead of comparing with them",
     [](Options& o, Name, Text) { o.batch.update = true; }},
    {Topic::output, Effect::run, compare_only, "--diff", "FILE",
     "write the difference in false colours, with a scale",
     [](Options& o, Name, Text t) { o.compare.difference = t; }},
    {Topic::output, Effect::run, compare_only, "--diff-of", "WHAT",
     "error: the largest |A - B| of the channels (default);\nor flip",
     [](Options& o, Name n, Text t) {
         o.compare.difference_is_flip = parse_word(n, t, {"error", "flip"}) == "flip";
     }},

    {Topic::state, Effect::run, render_only | merge_only, "--checkpoint", "FILE",
     "write checkpoints to this .exr file, to resume from",
     [](Options& o, Name n, Text t) {
         if (t.empty()) throw UsageError(fmt::format("{} needs a file name", n));
         o.checkpoint.file = t;
     }},
    {Topic::state, Effect::run, render_only, "--checkpoint-every", "T",
     "checkpoint interval: 90, 90s, 10m or 2h (default 60s)",
     [](Options& o, Name n, Text t) { o.checkpoint.every_seconds = parse_duration(n, t); }},
    {Topic::state, Effect::run, render_only, "--resume", "", "resume from the checkpoint, if it exists",
     [](Options& o, Name, Text) { o.checkpoint.resume = true; }},
    {Topic::state, Effect::run, render_only, "--part", "K/N",
     "render part K of N only, K from 1 to N; -o is then a\n"
     "file for 'renderer merge', and the checkpoint",
     [](Options& o, Name n, Text t) {
         const auto [index, count] = parse_part(n, t);
         if (!o.part) o.part.emplace();
         o.part->index = index - 1;
         o.part->count = count;
     }},
    {Topic::state, Effect::run, render_only, "--part-by", "WHAT", "split by tiles or samples (default tiles)",
     [](Options& o, Name n, Text t) {
         o.part_by = parse_word(n, t, {"tiles", "samples"}) == "tiles" ? PartBy::tiles : PartBy::samples;
     }},
    {Topic::state, Effect::run, merge_only, "--allow-missing", "", "merge even if samples are missing",
     [](Options& o, Name, Text) { o.allow_missing = true; }},

    {Topic::picture, Effect::samples, both | agree_or_race, "--spp", "N",
     "samples per pixel (default: the scene's)",
     [](Options& o, Name n, Text t) { o.load.samples_per_pixel = parse_integer(n, t, 1, film_max_samples); }},
    {Topic::picture, Effect::samples, both | test_only | agree_or_race, "--seed", "N",
     "seed of the random numbers, 64 bits (default 0)",
     [](Options& o, Name n, Text t) { o.render.seed = parse_integer(n, t, 0, UINT64_MAX); }},
    {Topic::picture, Effect::samples, loads_scene, "--size", "WxH", "resolution (default: the scene's)",
     [](Options& o, Name n, Text t) { o.load.resolution = parse_size(n, t); }},
    {Topic::picture, Effect::picture, render_only, "--crop", "X,Y,W,H",
     "render this window only; same bits as in the full\n"
     "image",
     [](Options& o, Name n, Text t) { o.render.crop = parse_rectangle(n, t); }},
    {Topic::picture, Effect::picture, render_only, "--aov", "NAME,...",
     "add layers to .exr files: albedo, normal, depth and\nothers (docs/aovs.md)",
     [](Options& o, Name n, Text t) {
         o.render.aovs = parse_list(n, t);
         check_aovs(n, o.render.aovs);
     }},
    {Topic::picture, Effect::samples, both | check_only, "--integrator", "TYPE",
     "use this integrator instead of the scene's, with\n"
     "default parameters",
     [](Options& o, Name, Text t) { o.load.integrator = t; }},
    {Topic::picture, Effect::samples, both, "--sampler", "TYPE", "use this sampler instead of the scene's",
     [](Options& o, Name, Text t) { o.load.sampler = t; }},
    {Topic::picture, Effect::run, agree_or_race, "--integrators", "TYPE,...",
     "estimators (default path,path_nee,path_mis)",
     [](Options& o, Name n, Text t) { o.estimators.integrators = parse_list(n, t); }},
    {Topic::picture, Effect::run, agree_or_race, "--samplers", "TYPE,...",
     "use each estimator with each of these samplers\n"
     "(default: the scene's)",
     [](Options& o, Name n, Text t) { o.estimators.samplers = parse_list(n, t); }},
    {Topic::picture, Effect::run, race_only, "--rounds", "N",
     "images per estimator, of --spp samples each\n"
     "(default 16)",
     [](Options& o, Name n, Text t) { o.race.rounds = parse_integer(n, t, 3, 10000); }},
    {Topic::picture, Effect::picture, render_only | agree_or_race, "--time", "T",
     "time limit in all: 90, 90s, 10m or 2h; rendering\n"
     "takes at most --spp samples",
     [](Options& o, Name n, Text t) { o.stop.seconds = parse_duration(n, t); }},
    {Topic::picture, Effect::picture, render_only, "--target-error", "E",
     "stop when the expected RMSE is below E times the mean\n"
     "of the image (upper end of the 95 % interval)",
     [](Options& o, Name n, Text t) { o.stop.relative_error = parse_double(n, t, 1e-9, 1e3); }},

    {Topic::scene, Effect::samples, loads | batch_only, "-D,--define", "NAME=VALUE",
     "value of $NAME in the file; may be repeated", define, true},
    {Topic::scene, Effect::samples, loads, "--dialect", "NAME",
     "dialect of the scene: auto, plumb, epfl, eth,\nzaragoza or mcgill (default auto)",
     [](Options& o, Name n, Text t) {
         o.load.dialect = dialect_from_string(parse_word(n, t, dialect_words()));
     }},
    {Topic::scene, Effect::samples, loads, "--emitters", "WHAT", "emitters scatter or absorb incident light",
     [](Options& o, Name n, Text t) {
         o.load.emitters_absorb = parse_word(n, t, {"scatter", "absorb"}) == "absorb";
     }},
    {Topic::scene, Effect::samples, loads_scene, "--mirror", "on|off", "mirror the image left to right",
     [](Options& o, Name n, Text t) {
         o.load.mirrored_view = parse_word(n, t, {"on", "off"}) == "on";
     }},
    {Topic::scene, Effect::samples, loads, "--envmap-scale", "X", "multiply environment images by X",
     [](Options& o, Name n, Text t) { o.load.environment_scale = parse_number(n, t, 0.f, 1e30f); }},
    {Topic::scene, Effect::samples, loads, "--lenient", "", "unknown parameters are warnings, not errors",
     [](Options& o, Name, Text) { o.load.lenient = true; }},

    {Topic::scene, Effect::run, rerun_only, "--scene", "FILE", "the path of the scene file",
     [](Options& o, Name n, Text t) {
         if (t.empty()) throw UsageError(fmt::format("{} needs a file name", n));
         o.scene = t;
     }},

    {Topic::running, Effect::run, batch_only, "--filter", "TEXT",
     "only images whose names contain this, or match it if\n"
     "it has * or ?",
     [](Options& o, Name n, Text t) {
         if (t.empty()) throw UsageError(fmt::format("{} needs a text", n));
         o.batch.filter = t;
     }},
    {Topic::running, Effect::run, batch_only, "--fail-fast", "", "stop at the first image that does not pass",
     [](Options& o, Name, Text) { o.batch.fail_fast = true; }},
    {Topic::running, Effect::run, batch_only, "--force", "", "also render what is up to date",
     [](Options& o, Name, Text) { o.batch.force = true; }},
    {Topic::running, Effect::run, rendering | test_only | agree_or_race | batch_only, "-t,--threads", "N",
     "number of threads (default: all)",
     [](Options& o, Name n, Text t) { o.render.threads = static_cast<int>(parse_integer(n, t, 1, 1024)); }},
    {Topic::running, Effect::samples, loads, "--isa", "NAME", isa_help.c_str(),
     [](Options& o, Name n, Text t) { o.load.instruction_set = parse_word(n, t, instruction_set_names()); }},
    {Topic::running, Effect::run, loads | rerun_only | merge_only | compare_only | batch_only, "--quiet", "",
     "print errors only", [](Options& o, Name, Text) { o.quiet = true; }},
    {Topic::running, Effect::run, loads_scene | rerun_only, "--verbose", "", "print facts about the scene",
     [](Options& o, Name, Text) { o.verbose = true; }},

    {Topic::path, Effect::run, replay_only, "--pixel", "X,Y", "the pixel, counted from the upper left corner",
     [](Options& o, Name n, Text t) { o.pixel = parse_pixel(n, t); }},
    {Topic::path, Effect::run, replay_only, "--sample", "I", "the index of the sample, counted from 0",
     [](Options& o, Name n, Text t) { o.sample = parse_integer(n, t, 0, UINT64_MAX); }},

    {Topic::verdict, Effect::run, compare_only | agree_or_race, "--significance", "P",
     "probability of a false difference (default 0.01)",
     [](Options& o, Name n, Text t) { o.compare.how.significance = parse_double(n, t, 1e-9, 0.5); }},
    {Topic::verdict, Effect::run, compare_only, "--layer", "NAME",
     "compare the channels NAME.* instead of the colours",
     [](Options& o, Name n, Text t) {
         if (t.empty()) throw UsageError(fmt::format("{} needs a name", n));
         o.compare.how.layer = t;
     }},
    {Topic::verdict, Effect::run, compare_only, "--exact", "A|B", "this image has no noise",
     [](Options& o, Name n, Text t) {
         o.compare.how.exact = parse_word(n, t, {"A", "B"}) == "A" ? Side::a : Side::b;
     }},
    {Topic::verdict, Effect::run, compare_only, "--no-verdict", "",
     "ignore the noise: the limits of --max decide",
     [](Options& o, Name, Text) { o.compare.how.verdict = false; }},
    {Topic::verdict, Effect::run, compare_only | agree_or_race, "--fail-percent", "P",
     "allow P % of the pixels to differ or stay undecided\n"
     "(default 0)",
     [](Options& o, Name n, Text t) { o.compare.how.fail_percent = parse_double(n, t, 0.0, 100.0); }},
    {Topic::verdict, Effect::run, compare_only, "--max", "METRIC=X,...",
     "fail above these: mse, rmse, relmse, mae, max, flip;\n"
     "or below: psnr",
     add_limits, true},
    {Topic::verdict, Effect::run, compare_only, "--flip", "MODE",
     "ldr, hdr or none (default: ldr for .png and the like)",
     [](Options& o, Name n, Text t) {
         const std::string mode = parse_word(n, t, {"ldr", "hdr", "none"});
         o.compare.choose_flip = false;
         o.compare.how.flip = mode == "ldr" ? FlipMode::ldr : mode == "hdr" ? FlipMode::hdr : FlipMode::none;
     }},

    {Topic::about, Effect::run, render_only, "-V,--version", "", "print the version",
     [](Options& o, Name, Text) { o.version = true; }},
    {Topic::about, Effect::run, every_verb, "-h,--help", "", "print this",
     [](Options& o, Name, Text) { o.help = true; }},
};

} // namespace

std::string_view OptionRow::long_name() const
{
    const std::string_view all = names;
    return all.substr(all.rfind(',') + 1); // npos + 1 is 0
}

bool OptionRow::goes_with(Verb verb) const
{
    return (verbs & verb_bit(verb)) != 0;
}

std::span<const OptionRow> option_rows()
{
    return rows;
}

std::string help_text(Verb verb)
{
    const VerbRow& asked = row_of(verb);
    std::string text;
    if (verb == Verb::render) {
        for (const VerbRow& row : verb_rows())
            text +=
                fmt::format("{} {:<47} {}\n", text.empty() ? "usage:" : "      ", row.command(), row.summary);
        text += "If a scene file has the name of a verb, write it as ./types.\n";
    } else {
        text = fmt::format("usage: {}\n", asked.command());
        if (asked.manual) text += asked.manual();
    }
    const OptionRow* last = nullptr;
    for (const OptionRow& row : rows) {
        if (!row.goes_with(verb)) continue;
        if (!last || row.topic != last->topic) text += "\n";
        last = &row;
        std::string names = row.names;
        names = names.starts_with("--") ? "    " + names : names.replace(2, 1, ", ");
        std::string_view help = row.help;
        text += fmt::format("  {:<24} {}\n", names + " " + row.value, help.substr(0, help.find('\n')));
        while (help.find('\n') != std::string_view::npos) {
            help.remove_prefix(help.find('\n') + 1);
            text += fmt::format("  {:<24} {}\n", "", help.substr(0, help.find('\n')));
        }
    }
    return text;
}

} // namespace plumb
