// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_expand.h"

#include "base/named_file.h"
#include "scene_file/mitsuba_refs.h"
#include "scene_file/property_values.h"
#include "scene_file/spectrum_file.h"

#include <algorithm>
#include <set>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_levels = 15; // of files that include each other, as in Mitsuba

bool is_there(const fs::path& path)
{
    std::error_code status;
    return fs::exists(path, status);
}

class MitsubaExpander {
public:
    MitsubaExpander(const Definitions& definitions, Diagnostics& diagnostics, const ExpansionLimits& limits)
        : definitions_(definitions), values_(definitions), diagnostics_(diagnostics), limits_(limits)
    {}

    Expansion expand(Element root)
    {
        files_.push_back(root.file);
        directories_.push_back(root.file->directory());
        text_size_ = root.file->text().size();
        parts_ = root.count_parts();
        substitute(root);
        gather_children(root);
        for (const auto& [name, value] : definitions_)
            if (!used_.contains(name))
                diagnostics_.error(
                    {}, fmt::format("-D {}={}: no file of this scene uses ${}", name, value, name));
        check_ids(root);
        resolve_aliases(root);
        if (parts_ < limits_.parts) place_copies(root, limits_.parts - parts_, diagnostics_);
        return {std::move(root), std::move(files_)};
    }

private:
    // Recursion ends: parse_document(), most_levels.
    void gather_children(Element& element)
    {
        std::vector<Element> children;
        children.reserve(element.children.size());
        for (Element& child : element.children) gather(std::move(child), children);
        element.children = std::move(children);
    }

    void gather(Element child, std::vector<Element>& children)
    {
        substitute(child);
        if (child.tag == "default") return define(child);
        if (child.tag == "include") return include(child, children);
        if (child.tag == "path") return add_path(child);
        if (child.tag == "alias") return add_alias(child);
        if (child.tag == "string" && child.value("name") == "filename") find_file(child);
        if (child.tag == "spectrum" && child.attribute("filename") && !read_spectrum(child)) return;
        gather_children(child);
        children.push_back(std::move(child));
    }

    // --- Variables ---

    void define(const Element& element)
    {
        if (!check_attributes(element, {"name", "value"}, {}, diagnostics_)) return;
        const std::string name = element.value("name");
        if (name.empty()) {
            diagnostics_.error(element.value_place(*element.attribute("name")), "a <default> needs a name");
            return;
        }
        values_.emplace(name, element.value("value")); // what is there already wins
    }

    void substitute(Element& element)
    {
        for (Attribute& attribute : element.attributes)
            if (attribute.value.find('$') != std::string::npos) substitute(element, attribute);
    }

    void substitute(const Element& element, Attribute& attribute)
    {
        const std::string text = attribute.value;
        std::string result;
        for (std::size_t i = 0; i < text.size();) {
            if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '$') {
                result += '$';
                i += 2;
                continue;
            }
            if (text[i] != '$') {
                result += text[i++];
                continue;
            }
            const auto* variable = longest_name(std::string_view(text).substr(i + 1));
            if (!variable) {
                fail_undefined(element, attribute, i);
                attribute.broken = true;
                return;
            }
            used_.insert(variable->first);
            result += variable->second;
            i += 1 + variable->first.size();
            if (result.size() > limits_.value_size) {
                diagnostics_.error(element.value_place(attribute),
                                   fmt::format("with ${} replaced, this value is longer than {} bytes",
                                               variable->first, limits_.value_size));
                attribute.broken = true;
                return;
            }
        }
        replaced_size_ += result.size();
        if (replaced_size_ > limits_.replaced_size) {
            diagnostics_.error(
                element.value_place(attribute),
                fmt::format("with all $names replaced, the values of this scene are longer than {} bytes "
                            "together",
                            limits_.replaced_size));
            attribute.broken = true;
            return;
        }
        attribute.value = std::move(result);
        attribute.verbatim = false;
    }

    // Of the known names, the longest one that `text` begins with; or null.
    const Definitions::value_type* longest_name(std::string_view text) const
    {
        const Definitions::value_type* longest = nullptr;
        for (const auto& value : values_)
            if (!value.first.empty() && text.starts_with(value.first) &&
                (!longest || value.first.size() > longest->first.size()))
                longest = &value;
        return longest;
    }

    void fail_undefined(const Element& element, const Attribute& attribute, std::size_t dollar)
    {
        const std::string_view rest = std::string_view(attribute.value).substr(dollar + 1);
        const std::size_t end = std::min(rest.find_first_of(" ,/\\$.\"'"), rest.size());
        const std::string name(rest.substr(0, end));
        std::vector<std::string_view> known;
        for (const auto& [known_name, value] : values_) known.push_back(known_name);
        const std::string_view near = closest_name(name, known);
        const std::string help =
            !near.empty() ? fmt::format("did you mean '${}'?", near)
            : name.starts_with("{")
                ? "write $name, without braces"
                : fmt::format(
                      "give it one with -D {0}=..., or with <default name=\"{0}\" value=\"...\"/> before it",
                      name);
        diagnostics_.error(element.part_place(attribute, dollar, end + 1),
                           fmt::format("${} has no value here; {}", name, help));
    }

    // --- Files ---

    void add_path(const Element& element)
    {
        if (!check_attributes(element, {"value"}, {}, diagnostics_) || element.attribute("value")->broken)
            return;
        const fs::path path(element.value("value"));
        directories_.insert(directories_.begin(),
                            path.is_absolute() ? path : element.file->directory() / path);
    }

    // Where the file is that is not beside the file that names it; empty: nowhere.
    fs::path elsewhere(const Element& element, const std::string& name) const
    {
        if (fs::path(name).is_absolute() || is_there(element.file->directory() / name)) return {};
        for (const fs::path& directory : directories_)
            if (is_there(directory / name)) return directory / name;
        return {};
    }

    void find_file(Element& element)
    {
        Attribute* value = nullptr;
        for (Attribute& attribute : element.attributes)
            if (attribute.name == "value") value = &attribute;
        if (!value || value->broken || value->value.empty()) return;
        const fs::path found = elsewhere(element, value->value);
        if (found.empty()) return;
        std::error_code status;
        const fs::path absolute = fs::absolute(found, status);
        value->value = (status ? found : absolute).string();
        value->verbatim = false;
    }

    // The file's pairs become the value. false: it has been reported.
    bool read_spectrum(Element& element)
    {
        const Attribute filename = *element.attribute("filename");
        if (filename.broken) return false;
        const fs::path other = elsewhere(element, filename.value);
        try {
            Attribute value = filename;
            value.name = "value";
            value.value =
                read_spectrum_file(other.empty() ? element.file->directory() / filename.value : other);
            value.verbatim = false;
            text_size_ += value.value.size();
            if (text_size_ > limits_.text_size) throw Error("the files of this scene are too large together");
            std::erase_if(element.attributes, [](const Attribute& a) { return a.name == "filename"; });
            element.attributes.push_back(std::move(value));
            return true;
        } catch (const Error& error) {
            diagnostics_.error(element.value_place(filename), error.what());
            return false;
        }
    }

    void include(const Element& element, std::vector<Element>& children)
    {
        if (!check_attributes(element, {"filename"}, {"name"}, diagnostics_)) return;
        const Attribute& filename = *element.attribute("filename");
        if (filename.broken) return;
        const SourceLocation at = element.value_place(filename);
        const auto fail = [&](std::string message) { diagnostics_.error(at, std::move(message)); };
        if (level_ == most_levels)
            return fail(fmt::format("files include each other more than {} levels deep", most_levels));
        if (files_.size() >= limits_.files)
            return fail(fmt::format("more than {} files are included", limits_.files));
        if (text_size_ > limits_.text_size || parts_ > limits_.parts) return; // has been reported
        const fs::path other = elsewhere(element, filename.value);
        const auto [path, way_out, notice] = other.empty()
                                                 ? find_named_file(element.file->directory(), filename.value)
                                                 : NamedFile{other, {}, {}};
        if (!notice.empty()) diagnostics_.warning(at, notice);
        std::optional<Element> root;
        try {
            std::string text = read_text(path);
            text_size_ += text.size();
            if (text_size_ > limits_.text_size)
                return fail(
                    fmt::format("with '{}', the files of this scene are larger than {} bytes together",
                                path.string(), limits_.text_size));
            root = parse_document(path, std::move(text), diagnostics_, true);
        } catch (const Error& error) {
            return fail(error.what() + way_out);
        }
        if (!root) return;
        if (root->tag != "scene" && root->attributes.empty() && root->children.empty())
            return fail(
                fmt::format("'{}' begins with <{}>; a scene can include a <scene> or one of its objects",
                            path.string(), root->tag));
        files_.push_back(root->file);
        parts_ += root->count_parts();
        if (parts_ > limits_.parts)
            return fail(fmt::format("with '{}', this scene has more than {} elements and attributes",
                                    path.string(), limits_.parts));
        ++level_;
        if (root->tag == "scene") {
            substitute(*root);
            check_attributes(*root, {}, {"version"}, diagnostics_);
            for (Element& child : root->children) gather(std::move(child), children);
        } else {
            std::erase_if(root->attributes, [](const Attribute& a) { return a.name == "version"; });
            if (const Attribute* name = element.attribute("name")) {
                std::erase_if(root->attributes, [](const Attribute& a) { return a.name == "name"; });
                Attribute copy = *name;
                copy.verbatim = false;
                root->attributes.push_back(std::move(copy));
            }
            gather(*std::move(root), children);
        }
        --level_;
    }

    // --- Ids ---

    void add_alias(const Element& element)
    {
        if (!check_attributes(element, {"id", "as"}, {}, diagnostics_)) return;
        if (!aliases_.emplace(element.value("as"), element.value("id")).second)
            diagnostics_.error(element.value_place(*element.attribute("as")),
                               fmt::format("the id '{}' is given twice", element.value("as")));
    }

    // Recursion ends: parse_document().
    void check_ids(const Element& element)
    {
        if (const Attribute* id = element.tag == "ref" ? nullptr : element.attribute("id");
            id && !id->broken) {
            const auto [first, is_new] = ids_.emplace(id->value, &element);
            if (!is_new) {
                const SourceLocation place = first->second->place(), at = element.value_place(*id);
                diagnostics_.error(at,
                                   fmt::format("the id '{}' is given twice; first given at {} {}", id->value,
                                               place.file == at.file ? "line" : place.file, place.line));
            }
        }
        for (const Element& child : element.children) check_ids(child);
    }

    void resolve_aliases(Element& element)
    {
        if (aliases_.empty()) return;
        for (Attribute& attribute : element.attributes) {
            if (element.tag != "ref" || attribute.name != "id") continue;
            for (std::size_t steps = 0; steps <= aliases_.size(); ++steps) {
                const auto alias = aliases_.find(attribute.value);
                if (alias == aliases_.end()) break;
                attribute.value = alias->second;
                attribute.verbatim = false;
            }
        }
        for (Element& child : element.children) resolve_aliases(child);
    }

    const Definitions& definitions_;
    Definitions values_;
    Diagnostics& diagnostics_;
    const ExpansionLimits& limits_;
    std::vector<std::shared_ptr<const TextFile>> files_;
    std::vector<fs::path> directories_; // where files are looked for, after that of the file that names them
    std::size_t level_ = 0;             // of <include>
    std::size_t text_size_ = 0;         // of all files
    std::size_t parts_ = 0;             // elements and attributes of all files
    std::size_t replaced_size_ = 0;     // of all values in which variables were replaced
    std::set<std::string> used_;        // as $name
    std::map<std::string, const Element*> ids_;
    std::map<std::string, std::string> aliases_; // to what they stand for
};

} // namespace

Expansion expand_mitsuba(Element root, const Definitions& definitions, Diagnostics& diagnostics,
                         const ExpansionLimits& limits)
{
    return MitsubaExpander(definitions, diagnostics, limits).expand(std::move(root));
}

} // namespace plumb
