// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/manuals.h"
#include "cli/text_file.h"

#include "plumb/compare.h"
#include "plumb/error.h"

#include <algorithm>

namespace plumb {

namespace {

constexpr int differs = 3;
constexpr int undecided = 4;

// Made for screens: no values above 1.
bool is_low_dynamic_range(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
           extension == ".tga" || extension == ".gif" || extension == ".ppm";
}

void write_reports(const Options& options, const Comparison& comparison, const Image& a, const Image& b)
{
    if (!options.compare.difference.empty())
        write_image(options.compare.difference,
                    options.compare.difference_is_flip ? flip_image(comparison) : difference_image(a, b));
    if (options.json.empty()) return;
    const std::string json =
        comparison_json(comparison, options.compare.how, options.subject, options.subjects[1]);
    if (options.json == "-")
        print_output(json);
    else
        write_text_file(options.json, json);
}

} // namespace

std::string_view compare_manual()
{
    return "Could A and B, the reference, be pictures of the same thing, but for their noise?\n"
           "Exit code: 0 passes, 1 cannot be compared, 2 wrong usage, 3 differs, 4 undecided.\n";
}

int compare_command(const Options& options)
{
    if (!options.compare.difference.empty()) check_image_path(options.compare.difference);
    if (!options.json.empty() && options.json != "-") check_text_path(options.json);
    const Image a = read_image(options.subject, true);
    const Image b = read_image(options.subjects[1], true);

    CompareOptions how = options.compare.how;
    if (options.compare.choose_flip)
        how.flip = is_low_dynamic_range(options.subject) && is_low_dynamic_range(options.subjects[1])
                       ? FlipMode::ldr
                       : FlipMode::hdr;
    const Comparison comparison = compare(a, b, how);
    write_reports(options, comparison, a, b);
    if (!options.quiet && options.json != "-")
        print_output("A " + options.subject + "\nB " + options.subjects[1] + "\n" +
                     comparison_text(comparison, how));
    switch (comparison.outcome) {
    case CompareOutcome::passes: return 0;
    case CompareOutcome::differs: return differs;
    case CompareOutcome::undecided: return undecided;
    }
    return undecided;
}

} // namespace plumb
