// SPDX-License-Identifier: MIT
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/render_flow.h"
#include "cli/verb_file.h"

#include "plumb/rendering/recipe.h"
#include "rendering/output_files.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    std::vector<std::string> outputs;
    LiveOptions live;
    std::string json;
    std::string scene; // where its scene file lies now; empty: where it was
    int threads = 0;
};

void settle(Options& options)
{
    if (options.outputs.empty()) throw UsageError("rerun needs -o,--output FILE; it has no default output");
    check_output_names(options.outputs, {{"--json", options.json}});
}

int run(const Options& options)
{
    const Recipe recipe = read_recipe(options.subject());
    KeptFiles({options.subject()})
        .refuse(with_json(options.outputs, options.json), "it is the image to render again");
    check_outputs(options.outputs, options.json);
    auto file = open_scene(options.scene.empty() ? find_scene(recipe).string() : options.scene,
                           recipe.settings.scene);
    const RenderTask task = make_task(recipe, *file);
    file.reset(); // its tree takes memory
    if (!options.quiet) log_scene(task, options.verbose);
    RenderFlow flow;
    flow.session.threads = options.threads;
    flow.session.again = samples_again(recipe, task);
    flow.outputs = options.outputs;
    flow.json = options.json;
    flow.quiet = options.quiet;
    flow.live = options.live;
    return run_flow(task, flow);
}

constexpr std::string_view manual =
    R"(Renders an image again from its header, to the same file, byte for byte.
The scene file is looked up relative to the current directory, and then to the
directory of the image. If the scene file, a mesh, an image or this program has
changed, the error names it.
)";

OptionTable<Options> table()
{
    return join<Options>(
        {outputs_option<Options>(), live_options(&Options::live), json_option<Options>(),
         text_option<Options>(Topic::scene, "--scene", "FILE", "the path of the scene file", &Options::scene),
         threads_option<Options>(), quiet_option<Options>(), verbose_option<Options>(),
         help_option<Options>()});
}

} // namespace

struct RerunVerb {
    static Verb make()
    {
        return make_verb<Options>({"rerun", "IMAGE -o IMAGE [options]",
                                   "render an image again from its header", "image", 1, 1,
                                   std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<RerunVerb>();

} // namespace plumb
