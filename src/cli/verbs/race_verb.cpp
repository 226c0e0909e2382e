// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/methods.h"
#include "cli/outputs.h"
#include "cli/progress.h"

#include "plumb/reports/agreement_report.h"
#include "plumb/reports/comparison_report.h"

namespace plumb {

namespace {

int run(const MethodsOptions& options)
{
    const std::vector<MethodSettings> methods = methods_of(options, "race");
    const auto file = open_for(options, methods);
    check_outputs({}, options.json);
    RaceResult result;
    {
        ProgressDisplay display(options.quiet);
        result = race(*file, {{options.settings, methods, options.how}, options.rounds}, options.threads,
                      {.progress = [&](const Progress& progress) { display.show(progress); }});
    }
    if (!options.quiet && options.json != "-") print_output(race_text(options.subject(), result));
    if (!options.json.empty()) write_json(options.json, race_json(options.subject(), result, options.how));
    return exit_code_of(result.means.verdict);
}

constexpr std::string_view manual =
    R"(Renders the scene with each estimator in turn, in rounds of images with equal
numbers of samples, each with a seed of its own. For each estimator it prints
  - the time of one sample of every pixel;
  - the variance of an image with that many samples: the mean over pixels and
    channels of the spread between the rounds, which is right for any sampler;
  - the efficiency 1 / (time x variance), relative to the best, with a 95 %
    interval. Twice the efficiency is the same noise in half the time.
Rare bright paths that no round has found are in no variance. The means of the
rounds are compared as `renderer agree` does: if they differ, the estimators do
not estimate the same, and their efficiencies are not comparable. The scene is
loaded once, and all images are kept in memory.
Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ,
4 undecided.
)";

OptionTable<MethodsOptions> rounds()
{
    return {{{Topic::image, "--rounds", "N",
              "images per estimator, of --spp samples each\n"
              "(default 16)",
              false, false},
             [](MethodsOptions& o, std::string_view n, const std::string& t) {
                 o.rounds = parse_integer(n, t, 3, 10000);
             }}};
}

} // namespace

struct RaceVerb {
    static Verb make()
    {
        return make_verb<MethodsOptions>({"race", "SCENE [options]", "which estimator is the most efficient?",
                                          "scene file", 1, 1, std::string(manual)},
                                         methods_options(rounds()), run, settle_methods);
    }
};
template const Verb& verb<RaceVerb>();

} // namespace plumb
