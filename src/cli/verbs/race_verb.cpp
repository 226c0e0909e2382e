// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/methods.h"
#include "cli/outputs.h"
#include "cli/progress.h"

#include "base/text_file.h"
#include "base/visible_text.h"
#include "plumb/compare/compare.h"
#include "plumb/reports/comparison_report.h"
#include "plumb/reports/race_report.h"
#include "reports/exit_codes.h"
#include "suite_file/command_line.h"

#include <algorithm>

namespace plumb {

namespace {

bool is_plain_name(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

// NAME=WORDS; without a name it is that of the program.
RaceCommand command_from(const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals != text.npos && is_plain_name(std::string_view(text).substr(0, equals)))
        return {text.substr(0, equals), text.substr(equals + 1)};
    const std::vector<std::string> words = command_words(text);
    std::string name = words.empty() ? "" : std::filesystem::path(words.front()).stem().string();
    if (!is_plain_name(name)) name = "command";
    return {std::move(name), text};
}

std::vector<RaceCommand> commands_of(const MethodsOptions& options)
{
    std::vector<RaceCommand> commands = options.commands;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        commands[i].timeout = options.timeout;
        check_race_command(commands[i], options.subject());
        const auto is_same = [&](const RaceCommand& other) { return other.name == commands[i].name; };
        if (std::any_of(commands.begin(), commands.begin() + static_cast<std::ptrdiff_t>(i), is_same))
            throw UsageError(fmt::format("two commands are called '{0}'; name them: --command 'NAME={0} ...'",
                                         commands[i].name));
    }
    return commands;
}

void settle(MethodsOptions& options)
{
    settle_methods(options);
    if (options.commands.empty()) return;
    if (!options.allow_commands)
        throw UsageError(fmt::format("--command runs another program, which needs --allow-commands: {}",
                                     visible_text(options.commands.front().command)));
    if (options.settings.stop.seconds)
        throw UsageError("--time and --command cannot be used together; give --spp");
    if (options.directory.empty()) throw UsageError("--command needs --out DIR, where the program works");
}

std::vector<std::string> names_of(const MethodsOptions& options, const std::vector<MethodSettings>& methods)
{
    std::vector<std::string> names;
    for (const MethodSettings& method : methods) names.push_back(method_name(method));
    for (const RaceCommand& command : options.commands) names.push_back(command.name);
    return names;
}

int run(const MethodsOptions& options)
{
    const std::vector<MethodSettings> methods = methods_of(options, "race");
    RaceSettings settings{{options.settings, methods, options.how}, options.rounds, commands_of(options)};
    const auto file = open_for(options, methods);
    settings.details = !options.directory.empty();
    settings.directory = options.directory;
    if (!options.reference.empty()) settings.reference = read_to_compare(options.reference);
    if (settings.details) {
        make_directory(settings.directory);
        for (const std::string& name : race_files(settings.directory, names_of(options, methods)))
            check_text_path(name);
    }
    check_outputs({}, options.json);
    RaceResult result;
    try {
        ProgressDisplay display(options.quiet);
        const InterruptGuard guard(Interruption::by_hand);
        result = race(*file, settings, options.threads,
                      {.progress = [&](const Progress& progress) { display.show(progress); },
                       .stop = &InterruptGuard::flag()});
    } catch (const Error&) {
        if (InterruptGuard::signal() == 0) throw;
        return exit_code::signal + InterruptGuard::signal();
    }
    if (settings.details) write_race_details(settings.directory, options.subject(), result);
    if (!options.quiet && options.json != "-") {
        print_output(race_text(options.subject(), result));
        if (settings.details)
            print_output(
                fmt::format("curves: {}\n", visible_text((settings.directory / "convergence.svg").string())));
    }
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

Other programs race with --command, without a shell, with the placeholders of
`renderer batch`; {image}, {seed} and {spp} are required:
    renderer race s.xml --integrators path_mis --spp 64 --out race \
        --allow-commands --command "mine=myrt {scene} -o {image} \
        --seed {seed} --spp {spp}"
Their time is that of the whole process, start and loading included. Their
images must have the resolution of the scene.

--out DIR writes convergence.csv and convergence.svg: the RMSE of images of 1,
2, 4, ... samples, against samples and against time, with 95 % intervals. It is
that of the noise, from the spread between the rounds; with --reference IMAGE
that of noise and bias. efficiency_NAME.exr and .png are maps of 1 / (variance x
seconds) of each pixel (docs/comparing.md).
Exit code: 0 they agree, 1 the scene is wrong, 2 wrong usage, 3 they differ,
4 undecided.
)";

OptionTable<MethodsOptions> of_race()
{
    using Options = MethodsOptions;
    return join<Options>(
        {{{{Topic::image, "--rounds", "N",
            "images per estimator, of --spp samples each\n"
            "(default 16)",
            false, false},
           [](Options& o, std::string_view n, const std::string& t) {
               o.rounds = parse_integer(n, t, 3, 10000);
           }}},
         {{{Topic::image, "--command", "NAME=WORDS", "another program as an estimator; may be repeated", true,
            false},
           [](Options& o, std::string_view, const std::string& t) {
               o.commands.push_back(command_from(t));
           }}},
         switch_option<Options>(Topic::image, "--allow-commands", "run the programs of --command",
                                &Options::allow_commands),
         {{{Topic::image, "--timeout", "T", "of each run of a program: 90, 90s, 10m (default) or\n2h", false,
            false},
           [](Options& o, std::string_view n, const std::string& t) { o.timeout = parse_duration(n, t); }}},
         text_option<Options>(Topic::output, "--out", "DIR",
                              "write curves of convergence and maps of efficiency", &Options::directory,
                              "directory"),
         text_option<Options>(Topic::image, "--reference", "IMAGE",
                              "measure the errors of the curves against this image", &Options::reference)});
}

} // namespace

struct RaceVerb {
    static Verb make()
    {
        return make_verb<MethodsOptions>({"race", "SCENE [options]", "which estimator is the most efficient?",
                                          "scene file", 1, 1, std::string(manual)},
                                         methods_options(of_race()), run, settle);
    }
};
template const Verb& verb<RaceVerb>();

} // namespace plumb
