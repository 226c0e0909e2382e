// SPDX-License-Identifier: MIT
#include "plumb/rendering/work.h"

#include "base/text.h"
#include "render/sample_text.h"
#include "rendering/checkpoint.h"
#include "rendering/origin.h"
#include "rendering/provenance.h"
#include "settings/options_text.h"

#include "plumb/settings/settings_header.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

void replace(Metadata& header, const std::string& name, const std::string& text)
{
    std::erase_if(header, [&](const auto& entry) { return entry.first == name; });
    if (!text.empty()) header.emplace_back(name, text);
}

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

// All vendors in one entry, whichever part comes first.
void unite_processors(Metadata& a, Metadata& b)
{
    std::vector<std::string> vendors = list_items(header_text(a, processor_entry));
    const std::vector<std::string> others = list_items(header_text(b, processor_entry));
    vendors.insert(vendors.end(), others.begin(), others.end());
    std::sort(vendors.begin(), vendors.end());
    vendors.erase(std::unique(vendors.begin(), vendors.end()), vendors.end());
    const std::string all = fmt::format("{}", fmt::join(vendors, ", "));
    replace(a, processor_entry, all);
    replace(b, processor_entry, all);
}

// Throws Error if the part is not one of the same image, or has samples that are there already.
void check_part(const Work& work, const StateFile& part, const std::string& name)
{
    const std::string first = work.parts.front().file.string();
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("'{}' and '{}' are not parts of one image: {}", first, name, why));
    };
    if (const auto changes = sample_changes(work.file.header, part.header); !changes.empty()) {
        const bool vendor_only = changes == std::vector{vendor_change(work.file.header, part.header)};
        refuse(list_text(changes) +
               (vendor_only ? "; pass --mixed to merge them without the promise of equal bits" : ""));
    }
    if (part.resolution != work.file.resolution || part.state.film.window() != work.file.state.film.window())
        refuse(fmt::format("one has the pixels {}, the other {}",
                           rectangle_text(work.file.state.film.window()),
                           rectangle_text(part.state.film.window())));
    if (part.state.film.layers() != work.file.state.film.layers())
        refuse(fmt::format("one has the layers {}, the other {}", layer_names(work.file.state.film.layers()),
                           layer_names(part.state.film.layers())));
    const std::uint64_t here = wanted_samples(work.file, first);
    if (const std::uint64_t there = wanted_samples(part, name); there != here)
        refuse(fmt::format("one has {} samples per pixel, the other {}", here, there));
    for (const auto& [other, samples] : work.parts)
        if (const SampleSet both = samples & part.state.taken; !both.empty())
            throw Error(fmt::format("'{}' and '{}' both contain {} samples, the first of them at {}",
                                    other.string(), name, count_text(both.count()),
                                    SampleSet(both.blocks().front()).text()));
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

} // namespace

SampleSet Work::wanted() const
{
    return SampleSet(SampleBlock{file.state.film.window(), 0, samples_per_pixel});
}

SampleSet Work::missing() const
{
    return wanted() - file.state.taken;
}

Work merge_parts(std::span<const std::filesystem::path> files, const MergeOptions& options)
{
    std::optional<Work> work;
    for (const std::filesystem::path& path : files) {
        const std::string name = path.string();
        StateFile part = read_state(path, "merge");
        check_language(part, name);
        // What is wrong with a header is said before many other parts are read.
        const std::uint64_t samples_per_pixel = wanted_samples(part, name);
        const RenderSettings settings = header_settings(part.header, name);
        renew_settings(part.header, settings);
        const SampleSet samples = part.state.taken;
        const std::string label = header_text(part.header, "plumb:workPart");
        if (!work) {
            work.emplace(Work{std::move(part), settings, {}, {}, samples_per_pixel});
        } else {
            if (options.mixed_processors) unite_processors(work->file.header, part.header);
            check_part(*work, part, name);
            work->file.state += part.state;
            if (rank(part.header) < rank(work->file.header)) {
                work->file.header = std::move(part.header);
                work->settings = settings;
            }
        }
        work->parts.push_back({path, samples});
        for (const std::string& one : lines_of(label)) work->names.push_back(one);
    }
    if (!work) throw Error("there are no parts to merge");
    // As it was: a checkpoint's number of samples is what is in the sum.
    work->samples_per_pixel = wanted_samples(work->file, work->parts.front().file.string());
    std::sort(work->names.begin(), work->names.end());
    replace(work->file.header, "plumb:workPart", lines_text(work->names));
    return std::move(*work);
}

std::string missing_text(const Work& work)
{
    const SampleSet missing = work.missing();
    if (missing.empty()) return {};
    return fmt::format("{} of {} samples are missing{}, the first of them at {}", count_text(missing.count()),
                       count_text(work.wanted().count()), missing_parts(work.names),
                       SampleSet(missing.blocks().front()).text());
}

Evidence evidence_of(const Work& work)
{
    const Metadata& header = work.file.header;
    const BiasReport ledger{lines_of(header_text(header, "plumb:workBiases")),
                            lines_of(header_text(header, "plumb:workModel"))};
    return make_evidence(ledger, work.file.state, header_text(header, "plumb:workStop"));
}

Image image_of(const Work& work, const Evidence& evidence)
{
    Metadata header = work.file.header;
    std::erase_if(header, [](const auto& entry) { return entry.first.starts_with(work_prefix); });
    return image_of(work.file.state.film, std::move(header), evidence, work.settings.output);
}

void save_work(const Work& work, const std::filesystem::path& file)
{
    keep_previous(file, work.file.header);
    save_checkpoint(file, work.file.state, work.file.resolution, work.file.header);
}

} // namespace plumb
