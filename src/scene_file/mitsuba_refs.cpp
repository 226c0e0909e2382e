// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_refs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace plumb {

namespace {

bool is_copied(const Element& element)
{
    constexpr std::string_view tags[] = {"emitter",    "film",     "rfilter", "sampler",
                                         "integrator", "spectrum", "rgb",     "sensor"};
    return std::find(std::begin(tags), std::end(tags), element.tag) != std::end(tags);
}

class Placer {
public:
    Placer(const Element& root, std::size_t most_parts, Diagnostics& diagnostics)
        : left_(most_parts), diagnostics_(diagnostics)
    {
        collect(root);
    }

    // Recursion ends: parse_document(), and a copy inside itself is an error.
    void place(Element& element)
    {
        for (Element& child : element.children) {
            if (child.tag == "ref")
                place_copy(child); // and what is in it
            else
                place(child);
        }
    }

    // Emitters that light the scene by themselves stay, and so does what nothing refers to.
    void remove_named(Element& root) const
    {
        std::erase_if(root.children, [&](const Element& child) {
            return is_copied(child) && child.tag != "sensor" && copied_.contains(child.value("id"));
        });
    }

private:
    void collect(const Element& element)
    {
        const Attribute* id = element.tag == "ref" ? nullptr : element.attribute("id");
        if (id && !id->broken && (is_copied(element) || element.tag == "shape"))
            by_id_.emplace(id->value, element.tag == "shape" ? std::nullopt : std::optional(element));
        for (const Element& child : element.children) collect(child);
    }

    void place_copy(Element& ref)
    {
        const std::string id = ref.value("id");
        const auto found = by_id_.find(id);
        if (found == by_id_.end()) return; // of our own kinds, or reported elsewhere
        if (!found->second) {
            std::erase_if(ref.attributes, [](const Attribute& a) { return a.name == "name"; });
            return;
        }
        const std::size_t parts = found->second->count_parts();
        if (open_.contains(id) || parts > left_) {
            diagnostics_.error(ref.place(),
                               open_.contains(id)
                                   ? fmt::format("'{}' contains itself", id)
                                   : "the objects that <ref> names have too many elements together");
            return;
        }
        left_ -= parts;
        copied_.insert(id);
        Element copy = *found->second;
        std::erase_if(copy.attributes, [](const Attribute& a) { return a.name == "id" || a.name == "name"; });
        if (const Attribute* name = ref.attribute("name"); name && copy.tag != "emitter")
            copy.attributes.push_back(*name);
        open_.insert(id);
        place(copy);
        open_.erase(id);
        ref = std::move(copy);
    }

    std::map<std::string, std::optional<Element>> by_id_; // copies, for the tree changes; nothing: a shape
    std::set<std::string> copied_, open_;
    std::size_t left_;
    Diagnostics& diagnostics_;
};

} // namespace

void place_copies(Element& root, std::size_t most_parts, Diagnostics& diagnostics)
{
    Placer placer(root, most_parts, diagnostics);
    placer.place(root);
    placer.remove_named(root);
}

} // namespace plumb
