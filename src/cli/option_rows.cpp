// SPDX-License-Identifier: MIT
#include "cli/option_rows.h"

#include "cli/verbs.h"
#include "settings/parse_value.h"

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

// The option of a setting.
template <class Settings>
OptionRow setting(Topic topic, unsigned verbs, std::string_view name, Settings& (*of)(Options&))
{
    const SettingRow<Settings>& row = *find_setting<Settings>(name);
    const std::string short_name = row.short_name.empty() ? "" : fmt::format("-{},", row.short_name);
    return {topic,
            verbs,
            fmt::format("{}--{}", short_name, row.name),
            std::string(row.value),
            std::string(row.help),
            [&row, of](Options& o, Name n, Text t) { row.set(of(o), n, t); },
            row.repeatable};
}

OptionRow of_picture(Topic topic, unsigned verbs, std::string_view name)
{
    return setting<RenderSettings>(topic, verbs, name,
                                   [](Options& o) -> RenderSettings& { return o.settings; });
}

OptionRow of_comparison(unsigned verbs, std::string_view name)
{
    return setting<CompareSettings>(Topic::verdict, verbs, name,
                                    [](Options& o) -> CompareSettings& { return o.compare.how; });
}

// Every option, in the order of --help.
std::vector<OptionRow> make_rows()
{
    return {
        {Topic::output, rendering | merge_only, "-o,--output", "FILE",
         "write this image: .exr, .hdr, .tif, .png or .jpg;\n"
         "may be repeated (default SCENE_SPP.exr and .png)",
         [](Options& o, Name, Text t) { o.outputs.push_back(t); }, true},
        of_picture(Topic::output, render_only, "exposure"),
        of_picture(Topic::output, render_only, "no-variance"),
        {Topic::output, rendering | merge_only | test_only | compare_only | agree_or_race, "--json", "FILE",
         "write a report of the run; - is standard output", [](Options& o, Name, Text t) { o.json = t; }},
        {Topic::output, batch_only, "--out", "DIR", "directory for images and reports\n(default batch/SUITE)",
         [](Options& o, Name n, Text t) {
             if (t.empty()) throw UsageError(fmt::format("{} needs a directory", n));
             o.batch.directory = t;
         }},
        {Topic::output, batch_only, "--update", "", "make the references instead of comparing with them",
         [](Options& o, Name, Text) { o.batch.update = true; }},
        {Topic::output, compare_only, "--diff", "FILE", "write the difference in false colours, with a scale",
         [](Options& o, Name, Text t) { o.compare.difference = t; }},
        {Topic::output, compare_only, "--diff-of", "WHAT",
         "error: the largest |A - B| of the channels (default);\nor flip",
         [](Options& o, Name n, Text t) {
             o.compare.difference_is_flip = parse_word(n, t, {"error", "flip"}) == "flip";
         }},

        {Topic::state, render_only | merge_only, "--checkpoint", "FILE",
         "write checkpoints to this .exr file, to resume from",
         [](Options& o, Name n, Text t) {
             if (t.empty()) throw UsageError(fmt::format("{} needs a file name", n));
             o.checkpoint.file = t;
         }},
        {Topic::state, render_only, "--checkpoint-every", "T",
         "checkpoint interval: 90, 90s, 10m or 2h (default 60s)",
         [](Options& o, Name n, Text t) { o.checkpoint.every_seconds = parse_duration(n, t); }},
        {Topic::state, render_only, "--resume", "", "resume from the checkpoint, if it exists",
         [](Options& o, Name, Text) { o.checkpoint.resume = true; }},
        {Topic::state, render_only, "--part", "K/N",
         "render part K of N only, K from 1 to N; -o is then a\n"
         "file for 'renderer merge', and the checkpoint",
         [](Options& o, Name n, Text t) {
             const auto [index, count] = parse_part(n, t);
             if (!o.part) o.part.emplace();
             o.part->index = index - 1;
             o.part->count = count;
         }},
        {Topic::state, render_only, "--part-by", "WHAT", "split by tiles or samples (default tiles)",
         [](Options& o, Name n, Text t) {
             o.part_by = parse_word(n, t, {"tiles", "samples"}) == "tiles" ? PartBy::tiles : PartBy::samples;
         }},
        {Topic::state, merge_only, "--allow-missing", "", "merge even if samples are missing",
         [](Options& o, Name, Text) { o.merge.allow_missing = true; }},

        of_picture(Topic::picture, both | agree_or_race, "spp"),
        of_picture(Topic::picture, both | test_only | agree_or_race, "seed"),
        of_picture(Topic::picture, loads_scene, "size"),
        of_picture(Topic::picture, render_only, "crop"),
        of_picture(Topic::picture, render_only, "aov"),
        of_picture(Topic::picture, both | check_only, "integrator"),
        of_picture(Topic::picture, both, "sampler"),
        {Topic::picture, agree_or_race, "--integrators", "TYPE,...",
         "estimators (default path,path_nee,path_mis)",
         [](Options& o, Name n, Text t) { o.race.integrators = parse_list(n, t); }},
        {Topic::picture, agree_or_race, "--samplers", "TYPE,...",
         "use each estimator with each of these samplers\n"
         "(default: the scene's)",
         [](Options& o, Name n, Text t) { o.race.samplers = parse_list(n, t); }},
        {Topic::picture, race_only, "--rounds", "N",
         "images per estimator, of --spp samples each\n"
         "(default 16)",
         [](Options& o, Name n, Text t) { o.race.rounds = parse_integer(n, t, 3, 10000); }},
        of_picture(Topic::picture, render_only | agree_or_race, "time"),
        of_picture(Topic::picture, render_only, "target-error"),

        of_picture(Topic::scene, loads | batch_only, "define"),
        of_picture(Topic::scene, loads, "dialect"),
        of_picture(Topic::scene, loads, "emitters"),
        of_picture(Topic::scene, loads_scene, "mirror"),
        of_picture(Topic::scene, loads, "envmap-scale"),
        of_picture(Topic::scene, loads, "lenient"),

        {Topic::scene, rerun_only, "--scene", "FILE", "the path of the scene file",
         [](Options& o, Name n, Text t) {
             if (t.empty()) throw UsageError(fmt::format("{} needs a file name", n));
             o.rerun.scene = t;
         }},

        {Topic::running, batch_only, "--filter", "TEXT",
         "only images whose names contain this, or match it if\n"
         "it has * or ?",
         [](Options& o, Name n, Text t) {
             if (t.empty()) throw UsageError(fmt::format("{} needs a text", n));
             o.batch.filter = t;
         }},
        {Topic::running, batch_only, "--fail-fast", "", "stop at the first image that does not pass",
         [](Options& o, Name, Text) { o.batch.fail_fast = true; }},
        {Topic::running, batch_only, "--force", "", "also render what is up to date",
         [](Options& o, Name, Text) { o.batch.force = true; }},
        {Topic::running, rendering | test_only | agree_or_race | batch_only, "-t,--threads", "N",
         "number of threads (default: all)",
         [](Options& o, Name n, Text t) { o.threads = static_cast<int>(parse_integer(n, t, 1, 1024)); }},
        of_picture(Topic::running, loads, "isa"),
        {Topic::running, loads | rerun_only | merge_only | compare_only | batch_only, "--quiet", "",
         "print errors only", [](Options& o, Name, Text) { o.quiet = true; }},
        {Topic::running, loads_scene | rerun_only, "--verbose", "", "print facts about the scene",
         [](Options& o, Name, Text) { o.verbose = true; }},

        {Topic::path, replay_only, "--pixel", "X,Y", "the pixel, counted from the upper left corner",
         [](Options& o, Name n, Text t) { o.replay.pixel = parse_pixel(n, t); }},
        {Topic::path, replay_only, "--sample", "I", "the index of the sample, counted from 0",
         [](Options& o, Name n, Text t) { o.replay.sample = parse_integer(n, t, 0, UINT64_MAX); }},

        of_comparison(compare_only | agree_or_race, "significance"),
        of_comparison(compare_only, "layer"),
        {Topic::verdict, compare_only, "--against", "FILE",
         "the reference; all other images are replicas of A,\n"
         "which differ in their seeds; may be repeated for\n"
         "replicas of B",
         [](Options& o, Name n, Text t) {
             if (t.empty()) throw UsageError(fmt::format("{} needs a file name", n));
             o.compare.b.push_back(std::string(t));
         },
         true},
        of_comparison(compare_only, "exact"),
        of_comparison(compare_only, "variance-of"),
        {Topic::verdict, compare_only, "--spp", "COUNT",
         "samples per pixel of images whose headers do not say",
         [](Options& o, Name n, Text t) { o.compare.how.samples = parse_double(n, t, 1.0, 1e15); }},
        of_comparison(compare_only, "no-verdict"),
        of_comparison(compare_only | agree_or_race, "fail-percent"),
        of_comparison(compare_only, "max"),
        of_comparison(compare_only, "flip"),

        {Topic::about, render_only, "-V,--version", "", "print the version",
         [](Options& o, Name, Text) { o.version = true; }},
        {Topic::about, every_verb, "-h,--help", "", "print this",
         [](Options& o, Name, Text) { o.help = true; }},
    };
}

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
    static const std::vector<OptionRow> rows = make_rows();
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
    for (const OptionRow& row : option_rows()) {
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
