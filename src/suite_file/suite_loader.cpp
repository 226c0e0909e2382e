// SPDX-License-Identifier: MIT
#include "plumb/suite_file/suite.h"

#include "scene_file/expand.h"
#include "scene_file/file_order.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"
#include "suite_file/foreign_attributes.h"
#include "suite_file/suite_names.h"
#include "suite_file/written_files.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

// Each image has a copy of all that holds for it, so that a small file can ask for very much.
constexpr std::size_t max_entries = 10'000;
constexpr std::size_t max_definitions = 1000;                     // of one image
constexpr std::size_t max_settings_size = std::size_t{256} << 20; // of all images, in bytes

// What a <suite> or <group> says of all that is in it.
struct Inherited {
    std::string directory; // "hw4/"
    std::map<std::string, SuiteSetting> settings;
    std::map<std::string, SuiteSetting> reference_settings;
    std::map<std::string, std::string> definitions;
    SuiteSetting reference; // with the suite's directory in front
    ForeignAttributes foreign;
};

constexpr std::string_view reference_prefix = "reference-";
constexpr std::string_view reference_names[] = {"reference", "reference-spp", "reference-seed",
                                                "reference-target-error"};

std::size_t size_of_settings(const SuiteEntry& entry)
{
    std::size_t size = 0;
    for (const auto* const settings : {&entry.settings, &entry.reference_settings})
        for (const auto& [name, setting] : *settings)
            size += sizeof setting + setting.value.size() + setting.at.line_text.size();
    for (const auto& [name, value] : entry.definitions) size += name.size() + value.size();
    if (entry.foreign) {
        size += entry.foreign->command.size() + entry.foreign->at.line_text.size();
        for (const fs::path& input : entry.foreign->inputs) size += sizeof input + input.native().size();
    }
    return size;
}

class SuiteBuilder {
public:
    SuiteBuilder(std::span<const std::string_view> known_settings, Diagnostics& diagnostics)
        : settings_(known_settings), diagnostics_(diagnostics)
    {}

    std::vector<SuiteEntry> build(const Element& root)
    {
        read_group(root, {});
        if (entries_.empty() && !diagnostics_.has_errors())
            diagnostics_.error(root.place(), R"(the suite is empty; it needs a <render scene="..."/>)");
        check_written_files(entries_, diagnostics_);
        return std::move(entries_);
    }

private:
    // Recursion ends: parse_document().
    void read_group(const Element& group, Inherited inherited)
    {
        const bool is_root = group.tag == "suite";
        read_attributes(group, inherited,
                        is_root ? std::vector<std::string_view>{} : std::vector<std::string_view>{"name"});
        if (const Attribute* name = is_root ? nullptr : group.attribute("name"))
            if (check_name(group, *name)) inherited.directory += name->value + "/";
        read_definitions(group, inherited, true);
        for (const Element& child : group.children) {
            if (child.tag == "group")
                read_group(child, inherited);
            else if (child.tag == "render")
                read_render(child, inherited);
        }
    }

    void read_render(const Element& element, Inherited own)
    {
        read_attributes(element, own, {"scene", "name"});
        read_definitions(element, own, false);
        const Attribute* scene = element.attribute("scene");
        const Attribute* name = element.attribute("name");
        const bool is_foreign = own.foreign.is_given();
        if (!scene && !is_foreign) {
            diagnostics_.error(element.place(),
                               R"(<render> needs an attribute 'scene', or 'image' or 'command' for )"
                               R"(images of other programs: <render scene="..." .../>)");
            return;
        }
        if (!scene && !name) {
            diagnostics_.error(
                element.place(),
                R"(<render> needs an attribute 'name' where it has no scene: <render name="..." .../>)");
            return;
        }
        if ((scene && scene->broken) || (name && !check_name(element, *name))) return;
        SuiteEntry entry;
        entry.at = element.place();
        entry.settings = own.settings;
        entry.definitions = own.definitions;
        entry.reference_settings = own.reference_settings;
        if (is_foreign) {
            entry.foreign = own.foreign.read(diagnostics_);
            if (!entry.foreign) return;
        }
        if (!scene) {
            entry.name = own.directory + name->value;
            add_reference(entry, own.reference);
            add_counts(std::move(entry));
            return;
        }
        if (scene->value.empty()) {
            diagnostics_.error(element.value_place(*scene), "the name of the scene file is empty");
            return;
        }
        const NamedFile named = find_scene(element.file->directory(), scene->value);
        std::vector<fs::path> scenes = {named.path};
        if (is_pattern(scene->value)) {
            scenes = matching_files(scenes.front());
            if (scenes.empty())
                diagnostics_.error(element.value_place(*scene),
                                   fmt::format("no file matches '{}'", scene->value));
        }
        entry.scene_at = element.value_place(*scene);
        entry.scene_way_out = named.way_out;
        for (const fs::path& file : scenes) {
            SuiteEntry one = entry;
            one.name = own.directory + (name ? name->value : file.stem().string());
            // One name for all the files of a pattern makes a directory of them.
            if (name && is_pattern(scene->value)) one.name += "/" + file.stem().string();
            one.scene = file;
            add_reference(one, own.reference);
            add_counts(std::move(one));
        }
    }

    static void add_reference(SuiteEntry& entry, const SuiteSetting& reference)
    {
        if (reference.value.empty()) return;
        std::string path;
        for (const char c : reference.value) path += c == '*' ? entry.name : std::string(1, c);
        entry.reference = fs::path(path).lexically_normal();
        entry.reference_at = reference.at;
    }

    // One entry for each sample count.
    void add_counts(SuiteEntry entry)
    {
        const auto spp = entry.settings.find("spp");
        if (spp == entry.settings.end()) {
            add(std::move(entry));
            return;
        }
        const std::string counts = spp->second.value;
        const std::vector<std::string_view> words = words_of(counts);
        if (words.empty()) diagnostics_.error(spp->second.at, "spp needs a number of samples per pixel");
        for (const std::string_view count : words) {
            entry.settings["spp"].value = count;
            if (!add(entry)) return;
        }
    }

    // Whether there is room for more.
    bool add(SuiteEntry entry)
    {
        settings_size_ += size_of_settings(entry);
        if (entries_.size() >= max_entries || settings_size_ > max_settings_size) {
            diagnostics_.error(entry.at,
                               fmt::format("a suite has at most {} images, with at most {} MiB of settings",
                                           max_entries, max_settings_size >> 20));
            return false;
        }
        const std::string title = entry.title();
        const auto [same, is_new] = numbers_.emplace(title, entries_.size());
        if (is_new) {
            entries_.push_back(std::move(entry));
            return true;
        }
        diagnostics_.error(entry.at, fmt::format("two entries write '{}.exr'; give one of them another name: "
                                                 R"(<render name="..." .../>)",
                                                 title));
        diagnostics_.note(entries_[same->second].at, "the other one is here");
        return true;
    }

    bool check_name(const Element& element, const Attribute& name)
    {
        if (name.broken) return false;
        if (is_inner_name(name.value)) return true;
        diagnostics_.error(element.value_place(name),
                           fmt::format("'{}' cannot name an image; use the name of a file in the output "
                                       "directory without its extension, such as box or hw4/box",
                                       name.value));
        return false;
    }

    // An empty value takes away what was inherited.
    static void set(std::map<std::string, SuiteSetting>& settings, const std::string& name,
                    SuiteSetting setting)
    {
        if (setting.value.empty())
            settings.erase(name);
        else
            settings[name] = std::move(setting);
    }

    // own: names that only this tag has.
    void read_attributes(const Element& element, Inherited& inherited, std::vector<std::string_view> own)
    {
        const auto is_in = [](const auto& names, const std::string& name) {
            return std::find(std::begin(names), std::end(names), name) != std::end(names);
        };
        inherited.foreign.take(element, diagnostics_);
        for (const Attribute& attribute : element.attributes) {
            if (is_in(own, attribute.name) || is_in(foreign_names, attribute.name)) continue;
            SuiteSetting setting{attribute.value, element.value_place(attribute)};
            if (attribute.name == "reference") {
                if (!setting.value.empty())
                    setting.value = (element.file->directory() / setting.value).string();
                inherited.reference = std::move(setting);
            } else if (is_in(reference_names, attribute.name)) {
                set(inherited.reference_settings, attribute.name.substr(reference_prefix.size()),
                    std::move(setting));
            } else if (is_in(settings_, attribute.name)) {
                set(inherited.settings, attribute.name, std::move(setting));
            } else {
                own.insert(own.end(), std::begin(reference_names), std::end(reference_names));
                own.insert(own.end(), std::begin(foreign_names), std::end(foreign_names));
                own.insert(own.end(), settings_.begin(), settings_.end());
                const std::string_view closest = closest_name(attribute.name, own);
                diagnostics_.error(element.name_place(attribute),
                                   fmt::format("unknown attribute '{}' for <{}>; {}", attribute.name,
                                               element.tag,
                                               closest.empty() ? "'renderer batch --help' lists them"
                                                               : fmt::format("did you mean '{}'?", closest)));
            }
        }
    }

    void read_definitions(const Element& element, Inherited& inherited, bool is_group)
    {
        for (const Element& child : element.children) {
            if (child.tag == "define") {
                for (const Element& grandchild : child.children)
                    diagnostics_.error(grandchild.place(), rejection(child, grandchild));
                if (inherited.definitions.size() >= max_definitions)
                    diagnostics_.error(child.place(),
                                       fmt::format("an image has at most {} definitions", max_definitions));
                else if (check_attributes(child, {"name", "value"}, {}, diagnostics_))
                    inherited.definitions[child.value("name")] = child.value("value");
            } else if (!is_group || (child.tag != "render" && child.tag != "group")) {
                diagnostics_.error(child.place(), rejection(element, child));
            }
        }
    }

    std::span<const std::string_view> settings_;
    Diagnostics& diagnostics_;
    std::vector<SuiteEntry> entries_;
    std::unordered_map<std::string, std::size_t> numbers_; // of entries, by their titles
    std::size_t settings_size_ = 0;
};

bool check_root(const Element& root, Diagnostics& diagnostics)
{
    if (root.tag == "suite") return true;
    diagnostics.error(
        root.place(),
        root.tag == "scene"  ? std::string("a <scene> file is not a suite; 'renderer FILE' renders it")
        : root.tag == "test" ? std::string("a <test> file is not a suite; 'renderer test FILE' runs it")
                             : fmt::format("the root of a suite must be <suite>, not <{}>", root.tag));
    return false;
}

} // namespace

std::string SuiteEntry::title() const
{
    const auto spp = settings.find("spp");
    return spp == settings.end() ? name : name + "_" + spp->second.value;
}

Suite load_suite(const fs::path& path, const std::map<std::string, std::string>& definitions,
                 std::span<const std::string_view> known_settings)
{
    Diagnostics diagnostics;
    auto document = parse_document(path, read_text(path), diagnostics);
    if (!document || !check_root(*document, diagnostics)) throw SceneError(diagnostics.all());
    const Expansion expansion =
        expand(*std::move(document), {definitions.begin(), definitions.end()}, diagnostics);
    std::vector<SuiteEntry> entries = SuiteBuilder(known_settings, diagnostics).build(expansion.root);
    if (diagnostics.has_errors()) throw SceneError(in_file_order(diagnostics.all(), expansion.files));
    Suite suite{path, {}, std::move(entries)};
    for (const auto& file : expansion.files) suite.files.push_back(file->path());
    return suite;
}

} // namespace plumb
