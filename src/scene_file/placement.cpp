// SPDX-License-Identifier: MIT
#include "scene_file/placement.h"

#include "scene_file/catalog.h"
#include "scene_file/foreign_names.h"
#include "scene_file/property_values.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

using Tags = std::initializer_list<std::string_view>;

struct Place {
    std::string_view tag;
    std::vector<std::string_view> parents;
};

// The grammar, but for parameters and for what stands in a <test>, which is the root of a file of its own kind.
const std::vector<Place>& places()
{
    const Tags scene = {"scene"}, transform = {"transform"};
    const Tags suite = {"suite", "group"}, whole = {"scene", "suite", "group"};
    static const std::vector<Place> places = {
        {"include", whole},
        {"default", whole},
        {"mesh", scene}, // and in a shape that is a group
        {"shape", scene},
        {"camera", scene},
        {"sampler", scene},
        {"integrator", scene},
        {"emitter", {"scene", "mesh", "shape"}},
        {"bsdf", {"scene", "mesh", "shape", "bsdf"}},
        {"texture", {"scene", "bsdf", "emitter"}},
        {"ref", {"mesh", "shape", "bsdf", "emitter"}},
        {"rfilter", {"camera"}},
        {"translate", transform},
        {"scale", transform},
        {"rotate", transform},
        {"lookat", transform},
        {"matrix", transform},
        {"render", suite},
        {"group", suite},
        {"define", {"suite", "group", "render"}},
    };
    return places;
}

constexpr std::string_view roots[] = {"scene", "test", "suite"};
constexpr std::string_view suite_tags[] = {"suite", "group", "render", "define"};

template <class Range>
bool is_in(const Range& tags, std::string_view tag)
{
    return std::find(std::begin(tags), std::end(tags), tag) != std::end(tags);
}

// In a file of the same kind as the one that holds `parent`.
std::vector<std::string_view> parents_near(std::string_view tag, std::string_view parent)
{
    std::vector<std::string_view> parents = parents_of(tag);
    if (parents.size() < 2) return parents;
    const bool in_suite = is_in(suite_tags, parent);
    const auto is_elsewhere = [&](std::string_view one) { return is_in(suite_tags, one) != in_suite; };
    if (std::all_of(parents.begin(), parents.end(), is_elsewhere)) return parents;
    parents.erase(std::remove_if(parents.begin(), parents.end(), is_elsewhere), parents.end());
    return parents;
}

std::vector<std::string_view> children_of(std::string_view parent)
{
    std::vector<std::string_view> tags;
    if (parent == "test") tags = {"scene", "bsdf", "emitter"};
    for (const Place& place : places())
        if (is_in(place.parents, parent)) tags.push_back(place.tag);
    if (parent == "test" || !kind_of_tag(parent).empty())
        tags.insert(tags.end(), property_tags().begin(), property_tags().end());
    return tags;
}

std::string in_brackets(const std::vector<std::string_view>& tags)
{
    std::string text;
    for (std::size_t i = 0; i < tags.size(); ++i)
        text += fmt::format("{}<{}>", i == 0 ? "" : i + 1 == tags.size() ? " or " : ", ", tags[i]);
    return text;
}

std::string where_it_belongs(std::string_view tag, std::string_view parent)
{
    if (is_in(roots, tag)) return fmt::format("a <{}> is the root of a file", tag);
    if (is_property_tag(tag)) return "it belongs in the object whose parameter it is";
    return fmt::format("it belongs in {}", in_brackets(parents_near(tag, parent)));
}

} // namespace

std::vector<std::string_view> all_tags()
{
    std::vector<std::string_view> tags;
    for (const Place& place : places()) tags.push_back(place.tag);
    for (const std::string_view tag : property_tags()) tags.push_back(tag);
    return tags;
}

std::vector<std::string_view> parents_of(std::string_view tag)
{
    for (const Place& place : places())
        if (place.tag == tag) return place.parents;
    return {};
}

std::string with_article(std::string_view noun)
{
    const std::size_t letter = noun.find_first_not_of('<');
    const bool vowel =
        letter != noun.npos && std::string_view("aeio").find(noun[letter]) != std::string_view::npos;
    return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

std::string rejection(const Element& parent, const Element& child)
{
    const std::vector<std::string_view> tags = all_tags();
    const std::string misplaced = fmt::format("{} cannot contain {}", with_article("<" + parent.tag + ">"),
                                              with_article("<" + child.tag + ">"));
    if (is_in(tags, child.tag) || is_in(roots, child.tag))
        return fmt::format("{}; {}", misplaced, where_it_belongs(child.tag, parent.tag));
    if (const auto instead = foreign_tag(child.tag)) return *instead;
    const std::vector<std::string_view> known = children_of(parent.tag);
    if (const std::string_view near = closest_name(child.tag, tags); !near.empty())
        return fmt::format("unknown tag <{}>; did you mean '{}'?", child.tag, near);
    return known.empty() ? misplaced
                         : fmt::format("unknown tag <{}>{}", child.tag, way_out(child.tag, known));
}

} // namespace plumb
