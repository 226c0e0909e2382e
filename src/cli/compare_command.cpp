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
bool is_low_dynamic_range(const std::vector<std::string>& paths)
{
    const std::string extension = lower_case(std::filesystem::path(paths.front()).extension().string());
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
           extension == ".tga" || extension == ".gif" || extension == ".ppm";
}

// One image, or the mean of several.
Image read_side(const std::vector<std::string>& paths, Side side)
{
    if (paths.size() == 1) {
        Image image = read_image(paths.front(), true);
        if (is_low_dynamic_range(paths)) mark_for_screens(image);
        return image;
    }
    std::vector<Image> replicas;
    for (const std::string& path : paths) replicas.push_back(read_image(path, true));
    return mean_of_replicas(replicas, side);
}

std::string title(const char* side, const std::vector<std::string>& paths)
{
    std::string text = side;
    for (const std::string& path : paths) text += " " + visible_text(path);
    return text + "\n";
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

Error bars are the images' variance channels: variance.R (of the mean), pbrt's
Variance.R (of a sample), the moments of Mitsuba's integrator moment. Without
them, pass several images of other seeds and the reference with --against, or
the noise is taken from the differences of A and B.
)";
}

int compare_command(const CompareRequest& request)
{
    std::vector<std::string> images;
    if (!request.difference.empty()) images.push_back(request.difference);
    check_outputs(images, request.json);
    std::vector<std::string> inputs = request.a;
    inputs.insert(inputs.end(), request.b.begin(), request.b.end());
    refuse_overwriting_inputs(KeptFiles({inputs.begin(), inputs.end()}), images, request.json,
                              "it is one of the images to compare");
    const Image a = read_side(request.a, Side::a);
    const Image b = read_side(request.b, Side::b);

    CompareSettings how = request.how;
    if (!how.flip && !how.layer.empty())
        how.flip = FlipMode::none; // numbers, no colours
    else if (!how.flip)
        how.flip = is_low_dynamic_range(request.a) && is_low_dynamic_range(request.b) ? FlipMode::ldr
                                                                                      : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    write_reports(request, comparison, a, b);
    if (!request.quiet && request.json != "-")
        print_output(title("A", request.a) + title("B", request.b) + comparison_text(comparison, how));
    return exit_code_of(comparison.outcome);
}

} // namespace plumb
