// SPDX-License-Identifier: MIT
#include "scene_file/groups.h"

#include "model/composite.h"
#include "scene_file/build_child.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"
#include "scene_file/shared_objects.h"
#include "scene_file/vocabulary.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view group_type = "group";
constexpr std::string_view instance_type = "instance";

std::string place_text(const Element& element)
{
    const SourceLocation at = element.place();
    return fmt::format("{}:{}", std::filesystem::path(at.file).filename().string(), at.line);
}

const Element* child_of(const Element& element, std::string_view tag)
{
    const auto found = std::find_if(element.children.begin(), element.children.end(),
                                    [&](const Element& child) { return child.tag == tag; });
    return found == element.children.end() ? nullptr : &*found;
}

// What only surfaces have.
void reject_surface_parts(const Element& composite, std::string_view noun, Diagnostics& diagnostics)
{
    for (const std::string_view tag : {"bsdf", "ref"})
        if (const Element* bsdf = noun == "a group" || tag == "bsdf" ? child_of(composite, tag) : nullptr)
            diagnostics.error(
                bsdf->place(),
                fmt::format("{} has no BSDF of its own; give one to each shape in the group", noun));
    if (const Element* emitter = child_of(composite, "emitter"))
        diagnostics.error(
            emitter->place(),
            fmt::format("{} cannot emit light; put a shape with this emitter directly into <scene>", noun));
}

// The surfaces of a group. What cannot be one is reported.
std::vector<const Element*> members_of(const Element& group, Diagnostics& diagnostics)
{
    std::vector<const Element*> members;
    for (const Element& child : group.children) {
        if (kind_of(child) != "shape") continue;
        if (Groups::takes(child))
            diagnostics.error(
                child.place(),
                fmt::format("a group cannot contain {}; put the shapes themselves into it",
                            child.value("type") == group_type ? "another group" : "an instance"));
        else
            members.push_back(&child);
        if (const Element* emitter = child_of(child, "emitter"))
            diagnostics.error(emitter->place(), "a shape in a group cannot emit light; put a shape with this "
                                                "emitter directly into <scene>");
    }
    if (members.empty() && !diagnostics.has_errors())
        diagnostics.error(group.place(), "a group needs at least one <shape> or <mesh> inside it");
    return members;
}

} // namespace

bool Groups::takes(const Element& shape)
{
    const std::string type = shape.value("type");
    return type == group_type || type == instance_type;
}

void Groups::add(const Element& shape)
{
    (shape.value("type") == group_type ? groups_ : instances_).push_back(&shape);
}

std::vector<Instance> Groups::build(LoadContext& context)
{
    build_groups(context);
    std::vector<Instance> instances;
    instances.reserve(instances_.size());
    for (const Element* element : instances_)
        if (std::optional<Instance> one = instance(*element, context)) instances.push_back(*std::move(one));
    for (const auto& [id, known] : by_id_)
        if (!known.used)
            context.diagnostics.warning(known.element->place(),
                                        fmt::format("no <shape type=\"instance\"> names the group '{}', so "
                                                    "it is invisible",
                                                    id));
    return instances;
}

void Groups::build_groups(LoadContext& context)
{
    for (const Element* element : groups_) {
        ObjectReader(*element, context, {"shape", "mesh", "bsdf", "ref", "emitter"}).build(composite_types());
        reject_surface_parts(*element, "a group", context.diagnostics);
        const std::string id = element->value("id");
        if (id.empty())
            context.diagnostics.error(element->place(),
                                      "a group needs an id, for the <ref> of an instance to "
                                      "name: <shape type=\"group\" id=\"...\">");
        Diagnostics of_group;
        const std::vector<const Element*> members = members_of(*element, of_group);
        std::vector<SceneObject> objects;
        build_children(members, context,
                       [&](std::size_t, BuiltChild& child) { objects.push_back(std::move(child.object)); });
        context.diagnostics.add(of_group);
        if (id.empty()) continue;
        const auto [known, is_new] = by_id_.try_emplace(id, Known{element, nullptr});
        if (!is_new) {
            const SourceLocation first = known->second.element->place(), second = element->id_place();
            context.diagnostics.error(second, fmt::format("the id '{}' is given twice; first given at {} {}",
                                                          id, first.file == second.file ? "line" : first.file,
                                                          first.line));
        } else if (!context.diagnostics.has_errors()) {
            known->second.group = std::make_shared<const Group>(
                std::move(objects), fmt::format("group '{}' ({})", id, place_text(*element)));
        }
    }
}

std::optional<Instance> Groups::instance(const Element& element, LoadContext& context)
{
    const auto composite =
        ObjectReader(element, context, {"ref", "bsdf", "emitter"}).build(composite_types());
    reject_surface_parts(element, "an instance", context.diagnostics);
    const Element* ref = only_ref(element, context);
    Known* known = ref ? named(*ref, context) : nullptr;
    if (!known || !composite) return std::nullopt;
    known->used = true;
    const std::optional<InstanceMap> map = InstanceMap::from(composite->to_world);
    const bool fits = map && known->group && [&] {
        const Box3f box = map->to_world(known->group->bounds());
        return is_finite(box.min) && is_finite(box.max);
    }();
    if (fits)
        return Instance{*map, known->group,
                        fmt::format("instance of '{}' ({})", ref->value("id"), place_text(element))};
    if (!map)
        context.diagnostics.error(element.place(),
                                  "toWorld, rounded to 32-bit floats, is singular, or it scales by a factor "
                                  "that is not in [1e-9, 1e9]; scale the shapes of the group instead");
    else if (known->group)
        context.diagnostics.error(element.place(),
                                  "toWorld moves the group farther than a 32-bit float can represent");
    return std::nullopt;
}

const Element* Groups::only_ref(const Element& instance, LoadContext& context) const
{
    const Element* ref = nullptr;
    for (const Element& child : instance.children)
        if (child.tag == "ref") keep_only(ref, child, context.diagnostics);
    if (!ref)
        context.diagnostics.error(instance.place(),
                                  "an instance needs a <ref> to the group that it shows: <ref id=\"...\"/>");
    return ref;
}

Groups::Known* Groups::named(const Element& ref, LoadContext& context)
{
    for (const Element& child : ref.children) context.diagnostics.error(child.place(), rejection(ref, child));
    if (!check_attributes(ref, {"id"}, {"name"}, context.diagnostics)) return nullptr;
    const std::string id = ref.value("id");
    if (const auto found = by_id_.find(id); found != by_id_.end()) return &found->second;
    if (const Element* other = context.shared->named(id)) {
        context.diagnostics.error(ref.id_place(),
                                  fmt::format("'{}' is a <{}>, not a group of shapes", id, other->tag));
        return nullptr;
    }
    std::vector<std::string_view> known;
    for (const auto& [name, group] : by_id_) known.push_back(name);
    const bool is_mitsuba = context.vocabulary && context.vocabulary->complete;
    context.diagnostics.error(ref.id_place(), fmt::format("no <shape type=\"{}\"> has the id '{}'{}",
                                                          is_mitsuba ? "shapegroup" : "group", id,
                                                          known.empty() ? "" : way_out(id, known)));
    return nullptr;
}

} // namespace plumb
