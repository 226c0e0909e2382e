// SPDX-License-Identifier: MIT
#include "cli/methods.h"

#include "cli/load.h"
#include "cli/outputs.h"

namespace plumb {

std::vector<MethodSettings> methods_of(const MethodsOptions& options, std::string_view verb)
{
    std::vector<MethodSettings> methods;
    MethodSettings method = options.settings.method;
    for (const std::string& integrator : options.integrators) {
        method.integrator = integrator;
        if (options.samplers.empty()) methods.push_back(method);
        for (const std::string& sampler : options.samplers) {
            methods.push_back(method);
            methods.back().sampler = sampler;
        }
    }
    if (methods.size() + options.commands.size() < 2)
        throw UsageError(fmt::format("{} needs two estimators or more; name them with --integrators", verb));
    if (options.settings.stop.seconds && options.settings.samples.per_pixel)
        throw UsageError("--time and --spp cannot be used together");
    return methods;
}

std::unique_ptr<SceneFile> open_for(const MethodsOptions& options, const std::vector<MethodSettings>& methods)
{
    auto file = open_scene(options.subject(), options.settings.scene);
    RenderSettings first = options.settings;
    first.method = methods.front();
    const RenderTask task = make_task(*file, first);
    if (!options.quiet) log_scene(task, options.verbose);
    return file;
}

void settle_methods(MethodsOptions& options)
{
    check_output_names({}, {{"--json", options.json}});
}

OptionTable<MethodsOptions> methods_options(const OptionTable<MethodsOptions>& of_race)
{
    using Options = MethodsOptions;
    const OptionTable<Options> methods = {
        {{Topic::image, "--integrators", "TYPE,...", "estimators (default path,path_nee,path_mis)", false,
          false},
         [](Options& o, std::string_view n, const std::string& t) { o.integrators = parse_list(n, t); }},
        {{Topic::image, "--samplers", "TYPE,...",
          "use each estimator with each of these samplers\n"
          "(default: the scene's)",
          false, false},
         [](Options& o, std::string_view n, const std::string& t) { o.samplers = parse_list(n, t); }}};
    return join<Options>(
        {json_option<Options>(),
         setting_options<Options>(Topic::image, &Options::settings, {"spp", "seed", "size"}), methods,
         of_race, setting_options<Options>(Topic::image, &Options::settings, {"time"}),
         scene_options<Options>(), threads_option<Options>(),
         setting_options<Options>(Topic::running, &Options::settings, {"isa"}), quiet_option<Options>(),
         verbose_option<Options>(),
         setting_options<Options>(Topic::verdict, &Options::how, {"significance", "fail-percent"}),
         help_option<Options>()});
}

} // namespace plumb
