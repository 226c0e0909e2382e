// SPDX-License-Identifier: MIT
#include "cli/checkpoint.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/header.h"
#include "cli/json.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/provenance.h"
#include "cli/text.h"

#include "plumb/settings/settings_header.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// The parts that were merged so far.
struct Merged {
    StateFile file;
    std::vector<std::pair<std::string, SampleSet>> parts; // file names and what they have
    std::vector<std::string> names;                       // plumb:workPart of each
};

std::uint64_t wanted_samples(const StateFile& file, const std::string& name)
{
    if (const auto samples = header_samples(file.header, "plumb:workWanted", name)) return *samples;
    return file.state.taken.samples_per_pixel(file.state.film.window()).most;
}

// Throws Error if the part's scene might mean something else today: its header does not say what is in it.
void check_language(const StateFile& part, const std::string& name)
{
    if (const int was = language_of(part.header); was != language_version)
        throw Error(fmt::format("'{}' was made with version {} of the scene language, and this program reads "
                                "version {}, in which directional lights and checkerboards may have a "
                                "different meaning; merge it with the version of Plumb that rendered it",
                                name, was, language_version));
}

// Throws Error if the part is not one of the same picture, or has samples that are there already.
void check_part(const Merged& merged, const StateFile& part, const std::string& name)
{
    const std::string& first = merged.parts.front().first;
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("'{}' and '{}' are not parts of one image: {}", first, name, why));
    };
    if (const auto changes = sample_changes(merged.file.header, part.header); !changes.empty())
        refuse(list_text(changes));
    if (part.resolution != merged.file.resolution ||
        part.state.film.window() != merged.file.state.film.window())
        refuse(fmt::format("one has the pixels {}, the other {}",
                           rectangle_text(merged.file.state.film.window()),
                           rectangle_text(part.state.film.window())));
    if (part.state.film.layers() != merged.file.state.film.layers())
        refuse(fmt::format("one has the layers {}, the other {}",
                           layer_names(merged.file.state.film.layers()),
                           layer_names(part.state.film.layers())));
    const std::uint64_t here = wanted_samples(merged.file, first);
    if (const std::uint64_t there = wanted_samples(part, name); there != here)
        refuse(fmt::format("one has {} samples per pixel, the other {}", here, there));
    for (const auto& [other, samples] : merged.parts)
        if (const SampleSet both = samples & part.state.taken; !both.empty())
            throw Error(fmt::format("'{}' and '{}' both contain {} samples, the first of them at {}", other,
                                    name, count_text(both.count()), SampleSet(both.blocks().front()).text()));
}

// Of headers that differ in nothing that changes a sample: the same one whatever the order of the parts.
std::string rank(const Metadata& header)
{
    return header_text(header, "plumb:scene") + "\n" + options_text(settings_of_header(header)) + "\n" +
           header_text(header, "plumb:dialectReason");
}

// In the entries of this program, whichever had written them.
void renew_settings(Metadata& header, const RenderSettings& settings)
{
    std::erase_if(header, [](const auto& entry) { return is_settings_entry(entry.first); });
    const Metadata entries = settings_header(settings);
    header.insert(header.end(), entries.begin(), entries.end());
}

Merged merge_parts(const std::vector<std::string>& names)
{
    std::optional<Merged> merged;
    for (const std::string& name : names) {
        StateFile part = read_state(name);
        check_language(part, name);
        // What is wrong with a header is said before many other parts are read.
        wanted_samples(part, name);
        renew_settings(part.header, header_settings(part.header, name));
        const SampleSet samples = part.state.taken;
        const std::string label = header_text(part.header, "plumb:workPart");
        if (!merged) {
            merged.emplace(Merged{std::move(part), {}, {}});
        } else {
            check_part(*merged, part, name);
            merged->file.state += part.state;
            if (rank(part.header) < rank(merged->file.header)) merged->file.header = std::move(part.header);
        }
        merged->parts.emplace_back(name, samples);
        for (const std::string& one : lines_of(label)) merged->names.push_back(one);
    }
    return std::move(*merged);
}

// " (part 3/8 by tiles and part 5/8 by tiles)": those of the scheme of which no file is there.
std::string missing_parts(const std::vector<std::string>& names)
{
    if (names.empty()) return {};
    const auto split = [](const std::string& name) { return name.find('/'); };
    const std::string scheme = names.front().substr(std::min(split(names.front()), names.front().size()));
    const std::uint64_t count =
        std::strtoull(scheme.c_str() + std::min<std::size_t>(1, scheme.size()), nullptr, 10);
    std::vector<std::string> missing;
    for (std::uint64_t i = 1; i <= count && missing.size() < 20; ++i)
        if (const std::string name = fmt::format("{}{}", i, scheme);
            std::find(names.begin(), names.end(), name) == names.end())
            missing.push_back("part " + name);
    return missing.empty() ? std::string() : fmt::format(" ({})", list_text(missing));
}

void replace(Metadata& header, const std::string& name, const std::string& text)
{
    std::erase_if(header, [&](const auto& entry) { return entry.first == name; });
    if (!text.empty()) header.emplace_back(name, text);
}

// What the whole picture's header has of it.
Metadata picture_header(const StateFile& file, const Evidence& evidence)
{
    Metadata header = file.header;
    std::erase_if(header, [](const auto& entry) { return entry.first.starts_with(work_prefix); });
    const Metadata rest = evidence_header(evidence);
    header.insert(header.end(), rest.begin(), rest.end());
    return header;
}

std::string merge_json(const MergeRequest& request, const Merged& merged, const SampleSet& missing,
                       const std::vector<std::string>& outputs)
{
    JsonWriter json;
    json.begin_object();
    json.begin_array("parts");
    for (const auto& [name, samples] : merged.parts) {
        json.begin_object();
        json.text("file", name);
        json.integer("samples", samples.count());
        json.end_object();
    }
    json.end_array();
    json.integer("samples", merged.file.state.taken.count());
    json.integer("missing", missing.count());
    json.boolean("complete", missing.empty());
    json.number("render_seconds", merged.file.state.seconds);
    json.begin_array("outputs");
    for (const std::string& output : outputs) json.text({}, output);
    json.end_array();
    json.text("checkpoint", request.checkpoint);
    json.end_object();
    return std::move(json).finish();
}

void write_picture_of(const Merged& merged, const MergeRequest& request)
{
    const StateFile& file = merged.file;
    const BiasReport ledger{lines_of(header_text(file.header, "plumb:workBiases")),
                            lines_of(header_text(file.header, "plumb:workModel"))};
    const Evidence evidence = make_evidence(ledger, file.state, header_text(file.header, "plumb:workStop"));
    const OutputSettings output = settings_of_header(file.header).output;
    Image image = file.state.film.develop(output.error_bars ? Channels::color_and_evidence : Channels::color);
    image.metadata = picture_header(file, evidence);
    write_pictures(request.outputs, image, output.exposure, packing_of(evidence),
                   std::filesystem::path(request.parts.front()).parent_path());
}

} // namespace

std::string_view merge_manual()
{
    return R"(Merges the files that `renderer SCENE --part K/N -o PART.exr` rendered, in any
order. The image is that of a rendering in one piece, bit for bit. With
--checkpoint the result is a part again: you can merge it with others or, once
it is complete, resume it. The checkpoint of an unfinished rendering is a part
as well.
Parts of different scenes, settings, programs (rebuilt ones, too) or
instruction sets are errors; so are duplicate samples, and missing samples
without --allow-missing.
)";
}

int merge_command(const MergeRequest& request)
{
    const std::string& checkpoint = request.checkpoint;
    std::vector<std::string> outputs = request.outputs;
    if (!checkpoint.empty()) outputs.push_back(checkpoint);
    std::vector<std::string> written = outputs;
    if (!checkpoint.empty()) written.push_back(previous_generation(checkpoint).string());
    check_outputs(written, request.json);
    refuse_overwriting_inputs(KeptFiles({request.parts.begin(), request.parts.end()}), written, request.json,
                              "it is a part to be merged");

    Merged merged = merge_parts(request.parts);
    StateFile& file = merged.file;
    const SampleSet wanted(
        SampleBlock{file.state.film.window(), 0, wanted_samples(file, merged.parts.front().first)});
    const SampleSet missing = wanted - file.state.taken;
    const std::string complaint =
        missing.empty()
            ? std::string()
            : fmt::format("{} of {} samples are missing{}, the first of them at {}",
                          count_text(missing.count()), count_text(wanted.count()),
                          missing_parts(merged.names), SampleSet(missing.blocks().front()).text());
    if (!missing.empty() && !request.outputs.empty() && !request.allow_missing)
        throw Error(complaint + "; pass --allow-missing to merge without them");

    std::sort(merged.names.begin(), merged.names.end());
    replace(file.header, "plumb:workPart", lines_text(merged.names));
    if (!checkpoint.empty()) {
        keep_previous(checkpoint, file.header);
        save_checkpoint(checkpoint, file.state, file.resolution, file.header);
    }
    if (!request.outputs.empty()) write_picture_of(merged, request);
    write_json(request.json, merge_json(request, merged, missing, request.outputs));
    if (request.quiet) return exit_code::done;
    print_log(fmt::format("{}: {} samples of {} part{}", list_text(outputs),
                          count_text(file.state.taken.count()), merged.parts.size(),
                          merged.parts.size() == 1 ? "" : "s"));
    if (!missing.empty()) print_log("warning: " + complaint);
    return exit_code::done;
}

} // namespace plumb
