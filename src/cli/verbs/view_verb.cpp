// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/development_options.h"
#include "cli/outputs.h"
#include "rendering/output_files.h"
#include "reports/exit_codes.h"

#include "plumb/display/layer_view.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    std::string output;
    ViewOptions view;
    DevelopmentOptions development;
};

void settle(Options& options)
{
    if (options.output.empty()) throw UsageError("view needs -o,--output FILE.png");
    if (!is_for_screens(options.output))
        throw UsageError(
            fmt::format("'{}' must end in .png or .jpg: view makes images for screens", options.output));
    if (options.view.false_color && options.development.any())
        throw UsageError("--false-color has no use for --exposure and --tonemap; choose the colours' range "
                         "with --range");
}

int run(const Options& options)
{
    const std::string& file = options.subject();
    check_outputs({options.output}, {});
    KeptFiles({file}).refuse({options.output}, "it is the image to read");
    const Image image = read_image(file, true);
    ViewOptions how = options.view;
    how.development = development_of(image.metadata, options.development);
    const ImageView view = view_layer(image, how);
    write_image(options.output, view.image, view.development);
    if (options.quiet) return exit_code::done;
    for (const std::string& line : view.legend) print_output(line + "\n");
    return exit_code::done;
}

constexpr std::string_view manual =
    R"(Develops an image for screens: its colours, or any layer or channel of it.
Colours have the exposure and the tone curve of the image's header, or those
that are given. Numbers go from black to white, or with --false-color from dark
purple to light yellow; vectors are red, green and blue; ids have colours of
their own. The printed legend says which value is which colour.
)";

OptionTable<Options> layer_options()
{
    return {{{Topic::image, "--layer", "NAME",
              "show this layer (normal) or channel (depth.Z)\ninstead of the colours", false, false},
             [](Options& o, std::string_view n, const std::string& t) {
                 if (t.empty()) throw UsageError(fmt::format("{} needs a name", n));
                 o.view.layer = t;
             }},
            {{Topic::image, "--false-color", "",
              "show numbers, the luminance of colours or the length\nof vectors "
              "in false colours",
              false, false},
             [](Options& o, std::string_view, const std::string&) { o.view.false_color = true; }},
            {{Topic::image, "--range", "LOW,HIGH",
              "values at both ends of the colours (default: the\nsmallest and the largest)", false, false},
             [](Options& o, std::string_view n, const std::string& t) {
                 const std::vector<std::string> ends = parse_list(n, t);
                 if (ends.size() != 2) throw UsageError(fmt::format("{} must be LOW,HIGH, not '{}'", n, t));
                 const double low = parse_double(n, ends[0], -1e30, 1e30);
                 const double high = parse_double(n, ends[1], -1e30, 1e30);
                 if (!(low < high))
                     throw UsageError(fmt::format("{} must begin below its end, not '{}'", n, t));
                 o.view.range = NumberRange{low, high};
             }},
            {{Topic::image, "--log", "", "logarithmic scale of numbers", false, false},
             [](Options& o, std::string_view, const std::string&) { o.view.logarithmic = true; }}};
}

OptionTable<Options> table()
{
    return join<Options>({text_option<Options>(Topic::output, "-o,--output", "FILE",
                                               "write this image: .png or .jpg", &Options::output),
                          quiet_option<Options>(), layer_options(),
                          development_options(&Options::development), help_option<Options>()});
}

} // namespace

struct ViewVerb {
    static Verb make()
    {
        return make_verb<Options>({"view", "IMAGE -o IMAGE [options]", "develop an image, or a layer of it",
                                   "image", 1, 1, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<ViewVerb>();

} // namespace plumb
