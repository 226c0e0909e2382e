// SPDX-License-Identifier: MIT
#include "plumb/math/math.h"
#include "scene_file/catalog.h"
#include "scene_file/folded_name.h"
#include "scene_file/fork_words.h"
#include "scene_file/property_values.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

namespace plumb {

namespace {

// What a texture that no BSDF of its own stands around is for.
enum class MapKind { none, normal, height };

bool says(const Element& texture, std::string_view word)
{
    return folded(texture.written_type()).find(word) != std::string::npos ||
           folded(texture.value("name")).find(word) != std::string::npos;
}

MapKind map_kind(const Element& child)
{
    if (child.tag != "texture") return MapKind::none;
    if (says(child, "normal")) return MapKind::normal;
    return says(child, "bump") || says(child, "height") ? MapKind::height : MapKind::none;
}

// The first child that is a map, which goes.
std::optional<Element> take_map(Element& element)
{
    const auto map = std::find_if(element.children.begin(), element.children.end(),
                                  [](const Element& child) { return map_kind(child) != MapKind::none; });
    if (map == element.children.end()) return {};
    Element taken = std::move(*map);
    element.children.erase(map);
    return taken;
}

// The BSDF with the map around it, which has its id.
Element mapped(Element bsdf, Element map)
{
    const bool is_normal = map_kind(map) == MapKind::normal;
    Element outer = made_object(bsdf, "bsdf", is_normal ? "normalmap" : "bumpmap");
    if (bsdf.tag == "bsdf")
        for (Attribute& attribute : bsdf.attributes)
            if (attribute.name == "id") outer.attributes.push_back(attribute);
    if (bsdf.tag == "bsdf")
        std::erase_if(bsdf.attributes, [](const Attribute& attribute) { return attribute.name == "id"; });
    set_attribute(map, "name", is_normal ? "normal" : "height");
    const std::string type = map.value("type");
    if ((type == "bitmap" || type == "imagetexture_color3f") && !map.child_named("raw"))
        map.children.push_back(made_parameter(map, "boolean", "raw", "true"));
    outer.children.push_back(std::move(map));
    outer.children.push_back(std::move(bsdf));
    return outer;
}

class ForkOrder {
public:
    explicit ForkOrder(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // Recursion ends: parse_document().
    void visit(Element& element)
    {
        for (Element& child : element.children) visit(child);
        const std::string_view kind = kind_of_tag(element.tag);
        const std::string type = element.value("type");
        if (kind == "texture") merge_uv(element);
        if (kind == "bsdf") order_bsdf(element, type);
        if (kind == "shape") order_shape(element);
        if (kind == "emitter" && type == "environment") order_environment(element);
        if (kind == "emitter" && type == "spot") order_spot(element);
        if (kind == "camera") order_camera(element);
    }

    // What surrounds all is said to stand in a sphere around all.
    void take_environments_out(Element& root)
    {
        std::vector<Element> kept;
        kept.reserve(root.children.size());
        for (Element& child : root.children) {
            const auto is_environment = [](const Element& inner) {
                return inner.tag == "emitter" && inner.value("type") == "environment";
            };
            const auto found = std::find_if(child.children.begin(), child.children.end(), is_environment);
            if (kind_of_tag(child.tag) != "shape" || found == child.children.end()) {
                kept.push_back(std::move(child));
                continue;
            }
            diagnostics_.warning(child.place(),
                                 fmt::format("the {} around an environment is left out: the light of an "
                                             "environment comes from infinitely far away",
                                             child.written_type()));
            Element emitter = std::move(*found);
            kept.push_back(std::move(emitter));
        }
        root.children = std::move(kept);
    }

private:
    // First all scales, then all shifts.
    static void merge_uv(Element& texture)
    {
        const auto is_map = [](const Element& child) {
            return child.tag == "transform" && child.value("name") == "toUv";
        };
        if (std::count_if(texture.children.begin(), texture.children.end(), is_map) < 2) return;
        const auto rest = std::stable_partition(texture.children.begin(), texture.children.end(),
                                                [&](const Element& child) { return !is_map(child); });
        std::vector<Element> operations;
        for (auto map = rest; map != texture.children.end(); ++map)
            std::move(map->children.begin(), map->children.end(), std::back_inserter(operations));
        std::stable_partition(operations.begin(), operations.end(),
                              [](const Element& operation) { return operation.tag != "translate"; });
        rest->children = std::move(operations);
        texture.children.erase(rest + 1, texture.children.end());
    }

    void order_bsdf(Element& bsdf, const std::string& type)
    {
        drop_values_under_images(bsdf);
        if (type == "principled" && bsdf.written_type() != type) // a fork's name for it
            for (Element& child : bsdf.children)
                if (child.tag == "texture" && !child.attribute("name") && map_kind(child) == MapKind::none)
                    set_attribute(child, "name", "baseColor");
        if (type == "normalmap" || type == "bumpmap") return;
        if (std::optional<Element> map = take_map(bsdf)) bsdf = mapped(std::move(bsdf), *std::move(map));
    }

    // An image given by its name alone stands in for the value that is given as well.
    static void drop_values_under_images(Element& bsdf)
    {
        std::vector<std::string> names;
        for (const Element& child : bsdf.children)
            if (child.tag == "texture" && child.written_tag() == "string")
                names.push_back(child.value("name"));
        if (names.empty()) return;
        std::erase_if(bsdf.children, [&](const Element& child) {
            return is_property_tag(child.tag) &&
                   std::find(names.begin(), names.end(), child.value("name")) != names.end();
        });
    }

    void order_shape(Element& shape)
    {
        if (folded(shape.written_type()) == "parallelogram") order_parallelogram(shape);
        std::optional<Element> map = take_map(shape);
        if (!map) return;
        const auto bsdf =
            std::find_if(shape.children.begin(), shape.children.end(),
                         [](const Element& child) { return child.tag == "bsdf" || child.tag == "ref"; });
        if (bsdf == shape.children.end())
            shape.children.push_back(mapped(made_object(shape, "bsdf", "diffuse"), *std::move(map)));
        else
            *bsdf = mapped(std::move(*bsdf), *std::move(map));
    }

    // A rectangle of width and height 1 around 0, with +z in front, goes to origin + s u + t v.
    void order_parallelogram(Element& shape)
    {
        const auto origin = take_vector(shape, "origin"), u = take_vector(shape, "u"),
                   v = take_vector(shape, "v");
        if (!origin || !u || !v) return;
        const Vec3d normal = cross(*u, *v);
        if (!(length_squared(normal) > 0.0)) {
            diagnostics_.error(shape.place(), "u and v of a parallelogram must not be parallel");
            return;
        }
        const Vec3d n = normalize(normal);
        const Vec3d center = *origin + 0.5 * *u + 0.5 * *v;
        Element matrix = made_object(shape, "matrix", "");
        set_attribute(matrix, "value",
                      fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} 0 0 0 1", u->x, v->x, n.x, center.x,
                                  u->y, v->y, n.y, center.y, u->z, v->z, n.z, center.z));
        if (Element* given = shape.child_named("toWorld"); given && given->tag == "transform") {
            given->children.insert(given->children.begin(), std::move(matrix));
            return;
        }
        Element transform = made_object(shape, "transform", "");
        set_attribute(transform, "name", "toWorld");
        transform.children.push_back(std::move(matrix));
        shape.children.push_back(std::move(transform));
    }

    std::optional<Vec3d> take_vector(Element& shape, std::string_view name)
    {
        Element* child = shape.child_named(name);
        const Attribute* value = child ? child->attribute("value") : nullptr;
        if (!value) {
            diagnostics_.error(shape.place(),
                               fmt::format("a parallelogram needs a parameter '{0}': <{1} name=\"{0}\" "
                                           "value=\"0 0 0\"/>",
                                           name, name == "origin" ? "point" : "vector"));
            return {};
        }
        const auto numbers = read_numbers(*child, *value, {3}, diagnostics_);
        shape.children.erase(shape.children.begin() + (child - shape.children.data()));
        if (!numbers) return {};
        return Vec3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    }

    // The image or the colour of a texture inside an environment is the environment's.
    static void order_environment(Element& emitter)
    {
        const auto texture = std::find_if(emitter.children.begin(), emitter.children.end(),
                                          [](const Element& child) { return child.tag == "texture"; });
        if (texture == emitter.children.end()) return;
        for (const char* name : {"filename", "filepath", "value"}) {
            Element* given = texture->child_named(name);
            if (!given || (given->tag != "string" && given->tag != "color")) continue;
            Element moved = std::move(*given);
            emitter.children.erase(texture);
            rename_attribute_value(moved, "name", moved.tag == "color" ? "radiance" : "filename");
            emitter.children.push_back(std::move(moved));
            return;
        }
    }

    // A switch of the lens.
    void order_camera(Element& camera)
    {
        constexpr std::string_view names[] = {"dof", "usedof", "enabledof", "depthoffield"};
        const auto is_switch = [&](const Element& child) {
            return child.tag == "boolean" && std::find(std::begin(names), std::end(names),
                                                       folded(child.value("name"))) != std::end(names);
        };
        const auto found = std::find_if(camera.children.begin(), camera.children.end(), is_switch);
        const Attribute* value = found == camera.children.end() ? nullptr : found->attribute("value");
        if (!value) return;
        const bool is_on = read_boolean(*found, *value, diagnostics_).value_or(true);
        std::erase_if(camera.children, [&](const Element& child) {
            return is_switch(child) || (!is_on && child.value("name") == "lensRadius");
        });
    }

    // Who says where the fall-off starts means pbrt's. Where it does not, there is none.
    void order_spot(Element& emitter)
    {
        Element* start = emitter.child_named("falloff");
        if (start && start->tag == "float" && angle_of_cosine(*start, diagnostics_))
            rename_attribute_value(*start, "name", "beamWidth");
        limit_beam(emitter);
        const Element* beam = emitter.child_named("beamWidth");
        if (beam && folded(beam->written_name()).find("falloff") != std::string::npos &&
            !emitter.child_named("falloff"))
            emitter.children.push_back(made_parameter(emitter, "string", "falloff", "quartic"));
    }

    // Forks say 50 degrees for the start of a fall-off that ends at 30.
    void limit_beam(Element& emitter)
    {
        Element* beam = emitter.child_named("beamWidth");
        const Element* cutoff = emitter.child_named("cutoffAngle");
        if (!beam || !cutoff || beam->written_name() == beam->value("name")) return;
        const Attribute *from = beam->attribute("value"), *to = cutoff->attribute("value");
        if (!from || !to) return;
        Diagnostics ignored; // whoever builds it reports it
        const auto begin = read_number(*beam, *from, ignored), end = read_number(*cutoff, *to, ignored);
        if (!begin || !end || *begin <= *end) return;
        diagnostics_.warning(
            beam->value_place(*from),
            fmt::format("the light would fall off from {} degrees on, but ends at {}; it does "
                        "not fall off",
                        *begin, *end));
        set_attribute(*beam, "value", fmt::format("{}", *end));
    }

    Diagnostics& diagnostics_;
};

} // namespace

void order_forks(Element& root, Diagnostics& diagnostics)
{
    ForkOrder order(diagnostics);
    order.visit(root);
    order.take_environments_out(root);
}

} // namespace plumb
