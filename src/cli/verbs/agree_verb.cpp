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
    const std::vector<MethodSettings> methods = methods_of(options, "agree");
    check_outputs({}, options.json);
    const auto file = open_for(options, methods);
    Agreement agreement;
    {
        ProgressDisplay display(options.quiet);
        agreement = agree(*file, {options.settings, methods, options.how}, options.threads,
                          {.progress = [&](const Progress& progress) { display.show(progress); }});
    }
    if (!options.quiet && options.json != "-") print_output(agreement_text(options.subject(), agreement));
    if (!options.json.empty())
        write_json(options.json, agreement_json(options.subject(), agreement, options.how));
    return exit_code_of(agreement.verdict);
}

constexpr std::string_view manual =
    R"(Renders the scene with each estimator, and compares all pairs as
`renderer compare` does. Each estimator has random numbers of its own and no
depth limit. The significance is that of all pairs together. An error that all
estimators share (in a BSDF, the camera, a mesh) cannot be detected.
The result is undecided if so few samples of an estimator find some of the
light that their spread says nothing. Take more samples, or omit that
estimator: naive paths rarely meet small emitters, and light samples on large
emitters rarely suit surfaces that are nearly smooth.
Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ,
4 undecided.
)";

} // namespace

struct AgreeVerb {
    static Verb make()
    {
        return make_verb<MethodsOptions>({"agree", "SCENE [options]", "do the estimators agree on a scene?",
                                          "scene file", 1, 1, std::string(manual)},
                                         methods_options({}), run, settle_methods);
    }
};
template const Verb& verb<AgreeVerb>();

} // namespace plumb
