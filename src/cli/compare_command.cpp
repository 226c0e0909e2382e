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

void write_reports(const CompareRequest& request, const Comparison& comparison, const Image& a,
                   const Image& b)
{
    if (!request.difference.empty())
        write_image(request.difference, request.difference_is_flip
                                            ? flip_image(comparison)
                                            : difference_image(a, b, request.how.layer));
    if (!request.json.empty())
        write_json(request.json, comparison_json(comparison, request.how, request.a, request.b));
}

} // namespace

std::string_view compare_manual()
{
    return R"(Tests whether A and the reference B are equal except for their noise.
Exit code: 0 passes, 1 cannot be compared, 2 wrong usage, 3 differs,
4 undecided.
)";
}

int compare_command(const CompareRequest& request)
{
    std::vector<std::string> images;
    if (!request.difference.empty()) images.push_back(request.difference);
    check_outputs(images, request.json);
    refuse_overwriting_inputs(KeptFiles({request.a, request.b}), images, request.json,
                              "it is one of the images to compare");
    const Image a = read_image(request.a, true);
    const Image b = read_image(request.b, true);

    CompareSettings how = request.how;
    if (!how.flip && !how.layer.empty())
        how.flip = FlipMode::none; // numbers, no colours
    else if (!how.flip)
        how.flip = is_low_dynamic_range(request.a) && is_low_dynamic_range(request.b) ? FlipMode::ldr
                                                                                      : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    write_reports(request, comparison, a, b);
    if (!request.quiet && request.json != "-")
        print_output("A " + visible_text(request.a) + "\nB " + visible_text(request.b) + "\n" +
                     comparison_text(comparison, how));
    return exit_code_of(comparison.outcome);
}

} // namespace plumb
