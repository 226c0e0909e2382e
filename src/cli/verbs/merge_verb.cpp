// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"

#include "base/text.h"
#include "plumb/reports/work_report.h"
#include "rendering/checkpoint.h"
#include "rendering/output_files.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    std::vector<std::string> outputs; // images
    std::string json;
    std::string checkpoint;     // the sum as a part; empty: none
    bool allow_missing = false; // make the image although samples are missing
    bool mixed = false;         // parts of Intel's and AMD's processors
};

void settle(Options& options)
{
    if (options.outputs.empty() && options.checkpoint.empty())
        throw UsageError(
            "merge needs -o,--output IMAGE, or --checkpoint FILE to merge the result with more parts");
    check_output_names(options.outputs, {{"--json", options.json}, {"--checkpoint", options.checkpoint}});
}

int run(const Options& options)
{
    const std::string& checkpoint = options.checkpoint;
    const std::vector<std::filesystem::path> parts(options.subjects.begin(), options.subjects.end());
    std::vector<std::string> outputs = options.outputs;
    if (!checkpoint.empty()) outputs.push_back(checkpoint);
    std::vector<std::string> written = outputs;
    if (!checkpoint.empty()) written.push_back(previous_generation(checkpoint).string());
    check_outputs(written, options.json);
    KeptFiles(parts).refuse(with_json(written, options.json), "it is a part to be merged");

    const Work work = merge_parts(parts, {.mixed_processors = options.mixed});
    check_denoising(options.outputs, work.settings.output);
    const std::string complaint = missing_text(work);
    if (!complaint.empty() && !options.outputs.empty() && !options.allow_missing)
        throw Error(complaint + "; pass --allow-missing to merge without them");
    if (!checkpoint.empty()) save_work(work, checkpoint);
    if (!options.outputs.empty()) {
        const Evidence evidence = evidence_of(work);
        write_images(options.outputs, image_of(work, evidence), work.settings.output, packing_of(evidence),
                     parts.front().parent_path());
    }
    write_json(options.json, work_json(work, options.outputs, checkpoint));
    if (options.quiet) return exit_code::done;
    print_log(fmt::format("{}: {} samples of {} part{}", list_text(outputs),
                          count_text(work.file.state.samples()), parts.size(), parts.size() == 1 ? "" : "s"));
    if (!complaint.empty()) print_log("warning: " + complaint);
    return exit_code::done;
}

constexpr std::string_view manual =
    R"(Merges the files that `renderer SCENE --part K/N -o PART.exr` rendered, in any
order. The image is that of a rendering in one piece, bit for bit. With
--checkpoint the result is a part again: you can merge it with others or, once
it is complete, resume it. The checkpoint of an unfinished rendering is a part
as well.
Parts of different scenes, settings, programs (rebuilt ones, too) or
instruction sets are errors; so are duplicate samples, and missing samples
without --allow-missing. Parts of processors of different vendors are merged
with --mixed only: Embree rounds some hits differently there, so the bits are
those of no single machine. The header names all vendors.
)";

OptionTable<Options> table()
{
    return join<Options>(
        {outputs_option<Options>(), json_option<Options>(), checkpoint_option<Options>(),
         switch_option<Options>(Topic::state, "--allow-missing", "merge even if samples are missing",
                                &Options::allow_missing),
         switch_option<Options>(
             Topic::state, "--mixed",
             "merge parts of Intel's and AMD's processors, without\nthe promise of equal bits",
             &Options::mixed),
         quiet_option<Options>(), help_option<Options>()});
}

} // namespace

struct MergeVerb {
    static Verb make()
    {
        return make_verb<Options>({"merge", "PART... [-o IMAGE]... [--checkpoint FILE]",
                                   "merge parts of an image", "part", 1, any_number, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<MergeVerb>();

} // namespace plumb
