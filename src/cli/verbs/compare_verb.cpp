// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"

#include "base/visible_text.h"
#include "plumb/reports/comparison_report.h"
#include "rendering/output_files.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// b is the reference. Several files of one side are replicas: they differ in their seeds.
struct Options : VerbOptions {
    CompareSettings settings;
    std::string difference; // the image of it to write; empty: none
    bool difference_is_flip = false;
    std::string json;
    std::vector<std::string> a, b;
};

// One image, or the mean of several.
Image read_side(const std::vector<std::string>& paths, Side side)
{
    if (paths.size() == 1) return read_to_compare(paths.front());
    std::vector<Image> replicas;
    for (const std::string& path : paths) replicas.push_back(read_to_compare(path));
    return mean_of_replicas(replicas, side);
}

std::string title(const char* side, const std::vector<std::string>& paths)
{
    std::string text = side;
    for (const std::string& path : paths) text += " " + visible_text(path);
    return text + "\n";
}

void settle(Options& options)
{
    options.a = options.subjects;
    if (options.b.empty()) {
        if (options.a.size() > 2)
            throw UsageError(
                fmt::format("{} images are given; pass the reference with --against FILE, the others "
                            "are then replicas of A",
                            options.a.size()));
        if (options.a.size() < 2)
            throw UsageError("compare needs two images; 'renderer compare --help' shows how");
        options.b = {options.a.back()};
        options.a.pop_back();
    }
    check_output_names({}, {{"--json", options.json}, {"--diff", options.difference}});
}

int run(const Options& options)
{
    std::vector<std::string> images;
    if (!options.difference.empty()) images.push_back(options.difference);
    check_outputs(images, options.json);
    std::vector<std::string> inputs = options.a;
    inputs.insert(inputs.end(), options.b.begin(), options.b.end());
    KeptFiles({inputs.begin(), inputs.end()})
        .refuse(with_json(images, options.json), "it is one of the images to compare");
    const Image a = read_side(options.a, Side::a);
    const Image b = read_side(options.b, Side::b);

    CompareSettings how = options.settings;
    if (!how.flip && !how.layer.empty())
        how.flip = FlipMode::none; // numbers, no colours
    else if (!how.flip)
        how.flip = is_low_dynamic_range(options.a.front()) && is_low_dynamic_range(options.b.front())
                       ? FlipMode::ldr
                       : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    if (!options.difference.empty())
        write_image(options.difference,
                    options.difference_is_flip ? flip_image(comparison) : difference_image(a, b, how.layer));
    if (!options.json.empty())
        write_json(options.json, comparison_json(comparison, how, options.a, options.b));
    if (!options.quiet && options.json != "-")
        print_output(title("A", options.a) + title("B", options.b) + comparison_text(comparison, how));
    return exit_code_of(comparison.verdict);
}

constexpr std::string_view manual =
    R"(Tests whether A and the reference B are equal except for their noise.
Exit code: 0 passes, 1 cannot be compared, 2 wrong usage, 3 differs,
4 undecided.

Error bars are the images' variance channels: variance.R (of the mean), pbrt's
Variance.R (of a sample), the moments of Mitsuba's integrator moment. Without
them, pass several images of other seeds and the reference with --against, or
the noise is taken from the differences of A and B.
)";

OptionTable<Options> table()
{
    const OptionTable<Options> difference_of = {
        {{Topic::output, "--diff-of", "WHAT",
          "error: the largest |A - B| of the channels (default);\nor flip", false, false},
         [](Options& o, std::string_view n, const std::string& t) {
             o.difference_is_flip = parse_word(n, t, {"error", "flip"}) == "flip";
         }}};
    const OptionTable<Options> difference = {
        {{Topic::output, "--diff", "FILE", "write the difference in false colours, with a scale", false,
          false},
         [](Options& o, std::string_view, const std::string& t) { o.difference = t; }}};
    const OptionTable<Options> against = {{{Topic::verdict, "--against", "FILE",
                                            "the reference; all other images are replicas of A,\nwhich "
                                            "differ in their seeds; may be repeated for\n"
                                            "replicas of B",
                                            true, false},
                                           [](Options& o, std::string_view n, const std::string& t) {
                                               if (t.empty())
                                                   throw UsageError(fmt::format("{} needs a file name", n));
                                               o.b.push_back(t);
                                           }}};
    const OptionTable<Options> samples = {
        {{Topic::verdict, "--spp", "COUNT", "samples per pixel of images whose headers do not say", false,
          false},
         [](Options& o, std::string_view n, const std::string& t) {
             o.settings.samples = parse_double(n, t, 1.0, 1e15);
         }}};
    const auto settings = [](std::initializer_list<std::string_view> names) {
        return setting_options<Options>(Topic::verdict, &Options::settings, names);
    };
    return join<Options>({json_option<Options>(), difference, difference_of, quiet_option<Options>(),
                          settings({"significance", "layer"}), against, settings({"exact", "variance-of"}),
                          samples, settings({"no-verdict", "fail-percent", "max", "flip"}),
                          help_option<Options>()});
}

} // namespace

struct CompareVerb {
    static Verb make()
    {
        return make_verb<Options>({"compare", "A B [options]", "are two images equal except for noise?",
                                   "image", 1, any_number, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<CompareVerb>();

} // namespace plumb
