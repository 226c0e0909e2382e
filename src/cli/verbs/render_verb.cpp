// SPDX-License-Identifier: MIT
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/render_flow.h"
#include "cli/verb_file.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    RenderSettings settings;
    std::vector<std::string> outputs;
    LiveOptions live;
    std::string json;
    std::string checkpoint;
    double checkpoint_seconds = 60.0;
    bool resume = false;
    std::optional<PartSettings> part;
    std::optional<PartBy> part_by; // as given; settled in part
    int threads = 0;
};

// Settings of files for screens need one. A part hands them on to `renderer merge`.
void check_screen_settings(const Options& options)
{
    const OutputSettings& output = options.settings.output;
    const bool has_some = output.development != Development() || output.denoise;
    if (!has_some || options.part || options.outputs.empty() ||
        std::any_of(options.outputs.begin(), options.outputs.end(),
                    [](const std::string& file) { return is_for_screens(file); }))
        return;
    if (output.denoise)
        throw UsageError(
            "--denoise changes .png and .jpg files, and none is written; add -o FILE.png, or use "
            "'renderer denoise' later");
    throw UsageError("--exposure and --tonemap change .png and .jpg files, and none is written; add -o "
                     "FILE.png, or develop the image later with 'renderer view'");
}

// A part is no image yet: its output is the state file. What goes with what.
void settle(Options& options)
{
    if (options.part_by && !options.part) throw UsageError("--part-by needs --part K/N");
    if (options.part) {
        options.part->by = options.part_by.value_or(PartBy::tiles);
        if (!options.checkpoint.empty())
            throw UsageError(
                "--part and --checkpoint cannot be used together: the output of a part is its checkpoint");
        if (options.outputs.size() != 1) throw UsageError("--part needs one -o,--output FILE.exr");
        if (options.settings.stop != StopSettings())
            throw UsageError(
                "a part is a fixed set of samples: use --part with --spp, not with --time or --target-error");
        if (options.part->by == PartBy::samples && options.settings.samples.adaptive)
            throw UsageError(
                "--part-by samples and --adaptive cannot be used together: each part would take the "
                "pilot of every pixel again; use --part-by tiles");
        options.checkpoint = options.outputs.front();
    }
    if (options.settings.samples.adaptive && options.settings.stop != StopSettings())
        throw UsageError(
            "--adaptive decides the number of samples of each pixel: give the maximum with --spp, not "
            "with --time or --target-error");
    check_screen_settings(options);
    if (options.resume && options.checkpoint.empty()) throw UsageError("--resume needs --checkpoint FILE");
    if (!options.checkpoint.empty() && !options.checkpoint.ends_with(".exr"))
        throw UsageError(
            fmt::format("'{}' must end in .exr: checkpoints and parts are .exr files", options.checkpoint));
    check_output_names(options.outputs,
                       {{"--json", options.json}, {"--checkpoint", options.part ? "" : options.checkpoint}});
}

int run(const Options& options)
{
    const RenderFlow flow{{.threads = options.threads,
                           .checkpoint = {options.checkpoint, options.checkpoint_seconds},
                           .part = options.part},
                          options.outputs,
                          options.json,
                          options.resume,
                          options.quiet,
                          options.live,
                          options.typed};
    check_flow(flow);
    auto file = open_scene(options.subject(), options.settings.scene);
    const RenderTask task = make_task(*file, options.settings);
    file.reset(); // its tree takes memory
    if (!options.quiet) log_scene(task, options.verbose);
    return run_flow(task, flow);
}

OptionTable<Options> state_options()
{
    OptionTable<Options> table = checkpoint_option<Options>();
    table.push_back({{Topic::state, "--checkpoint-every", "T",
                      "checkpoint interval: 90, 90s, 10m or 2h (default 60s)", false, false},
                     [](Options& o, std::string_view n, const std::string& t) {
                         o.checkpoint_seconds = parse_duration(n, t);
                     }});
    table.push_back({{Topic::state, "--resume", "", "resume from the checkpoint, if it exists", false, false},
                     [](Options& o, std::string_view, const std::string&) { o.resume = true; }});
    table.push_back({{Topic::state, "--part", "K/N",
                      "render part K of N only, K from 1 to N; -o is then a\n"
                      "file for 'renderer merge', and the checkpoint",
                      false, false},
                     [](Options& o, std::string_view n, const std::string& t) {
                         const auto [index, count] = parse_part(n, t);
                         o.part = PartSettings{index - 1, count, PartBy::tiles};
                     }});
    table.push_back(
        {{Topic::state, "--part-by", "WHAT", "split by tiles or samples (default tiles)", false, false},
         [](Options& o, std::string_view n, const std::string& t) {
             o.part_by = parse_word(n, t, {"tiles", "samples"}) == "tiles" ? PartBy::tiles : PartBy::samples;
         }});
    return table;
}

OptionTable<Options> table()
{
    return join<Options>(
        {outputs_option<Options>(),
         setting_options<Options>(Topic::output, &Options::settings,
                                  {"exposure", "tonemap", "denoise", "no-variance"}),
         live_options(&Options::live), json_option<Options>(), state_options(),
         setting_options<Options>(Topic::image, &Options::settings,
                                  {"spp", "adaptive", "seed", "size", "crop", "aov", "split", "integrator",
                                   "sampler", "time", "target-error"}),
         scene_options<Options>(), threads_option<Options>(),
         setting_options<Options>(Topic::running, &Options::settings, {"isa"}), quiet_option<Options>(),
         verbose_option<Options>(),
         switch_option<Options>(Topic::about, "-V,--version", "print the version", &Options::version),
         help_option<Options>()});
}

} // namespace

struct RenderVerb {
    static Verb make()
    {
        return make_verb<Options>(
            {"", "SCENE [-o IMAGE]... [options]", "render an image", "scene file", 1, 1}, table(), run,
            settle);
    }
};
template const Verb& verb<RenderVerb>();

} // namespace plumb
