// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"

#include "base/lower_case.h"
#include "base/visible_text.h"
#include "plumb/reports/comparison_report.h"
#include "rendering/output_files.h"

namespace plumb {

namespace {

// b is the reference.
struct Options : VerbOptions {
    CompareSettings settings;
    std::string difference; // the picture of it to write; empty: none
    bool difference_is_flip = false;
    std::string json;

    const std::string& a() const { return subjects[0]; }
    const std::string& b() const { return subjects[1]; }
};

// Made for screens: no values above 1.
bool is_low_dynamic_range(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
           extension == ".tga" || extension == ".gif" || extension == ".ppm";
}

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}, {"--diff", options.difference}});
}

int run(const Options& options)
{
    std::vector<std::string> images;
    if (!options.difference.empty()) images.push_back(options.difference);
    check_outputs(images, options.json);
    KeptFiles({options.a(), options.b()})
        .refuse(with_json(images, options.json), "it is one of the images to compare");
    const Image a = read_image(options.a(), true);
    const Image b = read_image(options.b(), true);

    CompareSettings how = options.settings;
    if (!how.flip && !how.layer.empty())
        how.flip = FlipMode::none; // numbers, no colours
    else if (!how.flip)
        how.flip = is_low_dynamic_range(options.a()) && is_low_dynamic_range(options.b()) ? FlipMode::ldr
                                                                                          : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    if (!options.difference.empty())
        write_image(options.difference,
                    options.difference_is_flip ? flip_image(comparison) : difference_image(a, b, how.layer));
    if (!options.json.empty())
        write_json(options.json, comparison_json(comparison, how, options.a(), options.b()));
    if (!options.quiet && options.json != "-")
        print_output("A " + visible_text(options.a()) + "\nB " + visible_text(options.b()) + "\n" +
                     comparison_text(comparison, how));
    return exit_code_of(comparison.outcome);
}

constexpr std::string_view manual =
    R"(Tests whether A and the reference B are equal except for their noise.
Exit code: 0 passes, 1 cannot be compared, 2 wrong usage, 3 differs,
4 undecided.
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
    return join<Options>({json_option<Options>(), difference, difference_of, quiet_option<Options>(),
                          setting_options<Options>(Topic::verdict, &Options::settings,
                                                   {"significance", "layer", "exact", "no-verdict",
                                                    "fail-percent", "max", "flip"}),
                          help_option<Options>()});
}

} // namespace

struct CompareVerb {
    static Verb make()
    {
        return make_verb<Options>({"compare", "A B [options]", "are two images equal except for noise?",
                                   "image", 2, 2, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<CompareVerb>();

} // namespace plumb
