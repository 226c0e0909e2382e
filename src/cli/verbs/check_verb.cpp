// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"
#include "reports/facts_json.h"

#include "base/memory.h"
#include "base/visible_text.h"

#include "plumb/check/check.h"

#include <fmt/format.h>

namespace plumb {

namespace {

struct Options : VerbOptions {
    RenderSettings settings;
    std::string json;
};

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}});
}

constexpr double megabyte = 1e6;

// What the scene has taken so far, and what film and image will.
MemoryNeeds memory_needs(const RenderTask& task)
{
    const auto now = static_cast<double>(peak_memory());
    const Vec2i size = task.scene.job.camera->resolution();
    const ChannelSet layers = render_layers(task.scene.job, task.options);
    std::size_t channels = 7; // of colour and its evidence
    for (const Layer& layer : layers) channels += layer.components.size();
    const double later = static_cast<double>(size.x) * static_cast<double>(size.y) *
                         static_cast<double>(Film::bytes_per_pixel(layers) + channels * sizeof(float));
    return {now, later};
}

int run(const Options& options)
{
    check_outputs({}, options.json);
    auto file = open_scene(options.subject(), options.settings.scene);
    const RenderTask task = make_task(*file, options.settings);
    file.reset(); // its tree takes memory
    const LoadedScene& scene = task.scene;
    if (!options.quiet) log_scene(task, options.verbose);
    ImageLibrary::hash(); // is loaded, since rendering takes its memory, too
    const MemoryNeeds memory = memory_needs(task);
    const std::vector<Doubt> doubts = find_doubts(scene.job);
    const bool is_clean = doubts.empty() && scene.warnings.empty();
    write_json(options.json, check_json(task, doubts, memory));
    if (options.json == "-") return is_clean ? exit_code::done : exit_code::differs;
    for (const Doubt& doubt : doubts)
        print_output(fmt::format("{}{}{}\n", visible_text(doubt.object), doubt.object.empty() ? "" : ": ",
                                 visible_text(doubt.text)));
    if (!options.quiet) {
        print_output(
            fmt::format("memory: {:.0f} MB for the scene and the program, {:.0f} MB for film and image{}\n",
                        memory.scene / megabyte, memory.image / megabyte,
                        task.options.aovs.empty() ? " without AOVs" : ""));
        if (is_clean) print_output("no mistakes found\n");
    }
    return is_clean ? exit_code::done : exit_code::differs;
}

constexpr std::string_view manual =
    R"(Checks a scene for mistakes without rendering it. Reports
  - all errors and warnings of loading (triangles without area, albedos above
    1, images with values that are not finite, ...);
  - glass that is not closed or is turned inside out;
  - emitters that are black, face a wall or shine into themselves;
  - BSDFs that scatter more light than they receive;
  - a camera inside an object;
  - a scene without light, or with light that no path from the camera finds;
  - a scene so far from the origin that floats are too coarse for it;
  - surfaces that coincide;
  - how much memory rendering takes.
Exit code: 0 no mistakes found, 1 errors, 2 wrong usage, 3 likely mistakes.
)";

OptionTable<Options> table()
{
    return join<Options>(
        {json_option<Options>(),
         setting_options<Options>(Topic::image, &Options::settings, {"size", "aov", "split", "integrator"}),
         scene_options<Options>(), setting_options<Options>(Topic::running, &Options::settings, {"isa"}),
         quiet_option<Options>(), verbose_option<Options>(), help_option<Options>()});
}

} // namespace

struct CheckVerb {
    static Verb make()
    {
        return make_verb<Options>({"check", "SCENE [options]", "check a scene for likely mistakes",
                                   "scene file", 1, 1, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<CheckVerb>();

} // namespace plumb
