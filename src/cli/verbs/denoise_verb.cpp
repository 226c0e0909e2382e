// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/development_options.h"
#include "cli/outputs.h"
#include "rendering/output_files.h"
#include "reports/exit_codes.h"

#include "base/lower_case.h"
#include "base/text.h"
#include "plumb/denoise/denoise.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    std::vector<std::string> outputs;
    DevelopmentOptions development;
    int threads = 0;
};

void settle(Options& options)
{
    if (options.outputs.empty()) throw UsageError("denoise needs -o,--output FILE");
    check_output_names(options.outputs, {});
    const auto is_exr = [](const std::string& file) {
        return lower_case(std::filesystem::path(file).extension().string()) == ".exr";
    };
    for (const std::string& file : options.outputs)
        if (!is_exr(file) && !is_for_screens(file))
            throw UsageError(fmt::format(
                "'{}' must end in .exr, .png or .jpg: other files cannot say that they were denoised", file));
    if (options.development.any() &&
        std::none_of(options.outputs.begin(), options.outputs.end(),
                     [](const std::string& file) { return is_for_screens(file); }))
        throw UsageError("--exposure and --tonemap change .png and .jpg files, and none is written");
}

int run(const Options& options)
{
    const std::string& file = options.subject();
    check_outputs(options.outputs, {});
    KeptFiles({file}).refuse(options.outputs, "it is the image to denoise");
    check_denoiser();
    const Image image = denoised(read_image(file, true), options.threads);
    write_images(options.outputs, image, {.development = development_of(image.metadata, options.development)},
                 Packing::small, {});
    if (!options.quiet)
        print_log(
            fmt::format("{}: denoised by {}", list_text(options.outputs), denoised_text(image.metadata)));
    return exit_code::done;
}

constexpr std::string_view manual =
    R"(Denoises an image with Open Image Denoise 2, which tools/install-denoiser
installs. The layers albedo_behind and normal_behind (of --aov), or albedo and
normal, guide it where the image has them. The result is biased, and its error
is unknown: it has no error bars, and compare and batch refuse it as a reference.
)";

OptionTable<Options> table()
{
    return join<Options>(
        {{{{Topic::output, "-o,--output", "FILE", "write this image: .exr, .png or .jpg; may be repeated",
            true, false},
           [](Options& o, std::string_view, const std::string& t) { o.outputs.push_back(t); }}},
         development_options(&Options::development),
         threads_option<Options>(),
         quiet_option<Options>(),
         help_option<Options>()});
}

} // namespace

struct DenoiseVerb {
    static Verb make()
    {
        return make_verb<Options>({"denoise", "IMAGE -o IMAGE [options]",
                                   "remove noise from an image, for looking at", "image", 1, 1,
                                   std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<DenoiseVerb>();

} // namespace plumb
