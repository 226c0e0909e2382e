// SPDX-License-Identifier: MIT
#include "base/lower_case.h"
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/manuals.h"
#include "cli/outputs.h"

#include "base/visible_text.h"
#include "plumb/base/error.h"
#include "plumb/compare/compare.h"

#include <algorithm>

namespace plumb {

namespace {

// Made for screens: no values above 1.
bool is_low_dynamic_range(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
           extension == ".tga" || extension == ".gif" || extension == ".ppm";
}

void write_reports(const Options& options, const Comparison& comparison, const Image& a, const Image& b)
{
    if (!options.compare.difference.empty())
        write_image(options.compare.difference, options.compare.difference_is_flip
                                                    ? flip_image(comparison)
                                                    : difference_image(a, b, options.compare.how.layer));
    if (!options.json.empty())
        write_json(options.json,
                   comparison_json(comparison, options.compare.how, options.subject, options.subjects[1]));
}

} // namespace

std::string_view compare_manual()
{
    return R"(Tests whether A and the reference B are equal except for their noise.
Exit code: 0 passes, 1 cannot be compared, 2 wrong usage, 3 differs,
4 undecided.
)";
}

int compare_command(const Options& options)
{
    std::vector<std::string> images;
    if (!options.compare.difference.empty()) images.push_back(options.compare.difference);
    check_outputs(images, options.json);
    refuse_overwriting_inputs(KeptFiles({options.subject, options.subjects[1]}), images, options.json,
                              "it is one of the images to compare");
    const Image a = read_image(options.subject, true);
    const Image b = read_image(options.subjects[1], true);

    CompareOptions how = options.compare.how;
    if (options.compare.choose_flip && !how.layer.empty())
        how.flip = FlipMode::none; // numbers, no colours
    else if (options.compare.choose_flip)
        how.flip = is_low_dynamic_range(options.subject) && is_low_dynamic_range(options.subjects[1])
                       ? FlipMode::ldr
                       : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    write_reports(options, comparison, a, b);
    if (!options.quiet && options.json != "-")
        print_output("A " + visible_text(options.subject) + "\nB " + visible_text(options.subjects[1]) +
                     "\n" + comparison_text(comparison, how));
    return exit_code_of(comparison.outcome);
}

} // namespace plumb
