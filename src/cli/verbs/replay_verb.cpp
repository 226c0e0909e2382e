// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"
#include "reports/facts_json.h"

#include "render/sample_text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

struct Options : VerbOptions {
    RenderSettings settings;
    Vec2i pixel;
    std::uint64_t sample = 0;
    std::string json;
};

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}});
}

int run(const Options& options)
{
    const Vec2i pixel = options.pixel;
    RenderSettings one_pixel = options.settings; // no more of the image must fit into memory
    one_pixel.view.crop = PixelRect{pixel.x, pixel.y, 1, 1};
    check_outputs({}, options.json);
    auto file = open_scene(options.subject(), options.settings.scene);
    const RenderTask task = make_task(*file, one_pixel);
    file.reset(); // its tree takes memory
    const LoadedScene& scene = task.scene;
    if (!options.quiet) log_scene(task, options.verbose);
    const ReplayedSample sample = replay(scene.job, task.options, pixel, options.sample);

    write_json(options.json, replay_json(task, {pixel, options.sample}, sample));
    if (options.json == "-") return exit_code::done;
    print_output(fmt::format("sample {} of pixel {},{}, seed {}, integrator {}\n", options.sample, pixel.x,
                             pixel.y, options.settings.samples.seed, scene.integrator));
    print_output(fmt::format("raster position {} {}\n\n", sample.raster.x, sample.raster.y));
    for (const PathEvent& event : sample.log)
        print_output(fmt::format("{:<9} {}\n", event_word(event.kind), event.text));
    print_output(fmt::format("\nvalue     {}\nweight    {}\nverdict   {}\n", color_text(sample.value),
                             sample.weight, status_text(sample.status)));
    return exit_code::done;
}

OptionTable<Options> table()
{
    const OptionTable<Options> place = {
        {{Topic::path, "--pixel", "X,Y", "the pixel, counted from the upper left corner", false, true},
         [](Options& o, std::string_view n, const std::string& t) { o.pixel = parse_pixel(n, t); }},
        {{Topic::path, "--sample", "I", "the index of the sample, counted from 0", false, true},
         [](Options& o, std::string_view n, const std::string& t) {
             o.sample = parse_integer(n, t, 0, UINT64_MAX);
         }}};
    return join<Options>({json_option<Options>(),
                          setting_options<Options>(Topic::image, &Options::settings,
                                                   {"spp", "seed", "size", "integrator", "sampler"}),
                          scene_options<Options>(),
                          setting_options<Options>(Topic::running, &Options::settings, {"isa"}),
                          quiet_option<Options>(), verbose_option<Options>(), place, help_option<Options>()});
}

} // namespace

struct ReplayVerb {
    static Verb make()
    {
        return make_verb<Options>({"replay", "SCENE --pixel X,Y --sample I [options]",
                                   "print the path of one sample", "scene file", 1, 1},
                                  table(), run, settle);
    }
};
template const Verb& verb<ReplayVerb>();

} // namespace plumb
