// SPDX-License-Identifier: MIT
#include "scene_file/build_child.h"

#include "base/parallel.h"
#include "plumb/model/shape.h"
#include "scene_file/face_bsdfs.h"
#include "scene_file/shared_objects.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

class ChildBuilder {
public:
    ChildBuilder(const Element& element, const LoadContext& scene)
        : element_(element),
          context_{built_.diagnostics, scene.dialect, scene.lenient, {}, 0, scene.shared, 0, scene.vocabulary}
    {}

    BuiltChild build()
    {
        if (kind_of(element_) == "shape")
            build_shape();
        else
            build_light();
        built_.files = std::move(context_.files);
        built_.texture_bytes = context_.texture_bytes;
        return std::move(built_);
    }

private:
    void build_shape()
    {
        const Element* emitter = nullptr;
        for (const Element& child : element_.children)
            if (child.tag == "emitter") keep_only(emitter, child, context_.diagnostics);
        SceneObject& object = built_.object;
        ObjectReader reader(element_, context_, {"bsdf", "ref", "emitter"});
        object.shape = reader.build(shape_types());
        ShapeBsdf bsdf = build_shape_bsdf(
            element_, object.shape ? object.shape->take_face_materials() : FaceMaterials{}, context_);
        object.bsdf = std::move(bsdf.bsdf);
        if (emitter) object.emitter = build_area_light(*emitter, object.shape.get());
        object.name = place_name(element_);
        object.material = std::move(bsdf.name);
    }

    // shape: null where it could not be built; then another one stands in, so that all mistakes are found.
    std::unique_ptr<Emitter> build_area_light(const Element& element, const Shape* shape)
    {
        ObjectReader reader(element, context_);
        if (is_known_emitter(reader.type()) && reader.type() != "area") {
            context_.diagnostics.error(
                element.value_place(*element.attribute("type")),
                fmt::format("emitter '{}' has no shape; it must stand directly inside <scene>",
                            reader.type()));
            reader.check(emitter_types());
            return nullptr;
        }
        std::unique_ptr<Shape> other;
        if (!shape)
            other =
                ObjectReader(synthetic_element(element_, "shape", "sphere"), context_).build(shape_types());
        reader.params().set_parent_shape(shape ? shape : other.get());
        std::unique_ptr<Emitter> light = reader.build(emitter_types());
        return shape ? std::move(light) : nullptr;
    }

    void build_light()
    {
        ObjectReader reader(element_, context_);
        if (reader.type() != "area") {
            built_.light = reader.build(emitter_types());
            return;
        }
        context_.diagnostics.error(element_.value_place(*element_.attribute("type")),
                                   "emitter 'area' must stand inside the <mesh> or <shape> that emits");
        reader.check(emitter_types());
    }

    static bool is_known_emitter(std::string_view type)
    {
        return std::any_of(emitter_types().begin(), emitter_types().end(),
                           [&](const Entry<Emitter>& entry) { return entry.name == type; });
    }

    const Element& element_;
    BuiltChild built_;
    LoadContext context_;
};

} // namespace

BuiltChild build_child(const Element& element, const LoadContext& scene)
{
    return ChildBuilder(element, scene).build();
}

void build_children(std::span<const Element* const> elements, LoadContext& context,
                    const std::function<void(std::size_t, BuiltChild&)>& take)
{
    // Some at a time: each may have a thousand messages, most of which are not kept here.
    constexpr std::size_t most = 1024;
    for (std::size_t begin = 0; begin < elements.size(); begin += most) {
        std::vector<BuiltChild> built(std::min(most, elements.size() - begin));
        parallel_for(built.size(), 0,
                     [&](std::size_t i) { built[i] = build_child(*elements[begin + i], context); });
        for (std::size_t i = 0; i < built.size(); ++i) {
            BuiltChild& child = built[i];
            context.diagnostics.add(child.diagnostics);
            for (const std::filesystem::path& file : child.files) context.add_file(file);
            context.texture_bytes += child.texture_bytes;
            take(begin + i, child);
        }
    }
}

void keep_only(const Element*& kept, const Element& child, Diagnostics& diagnostics)
{
    if (!kept) {
        kept = &child;
        return;
    }
    const SourceLocation first = kept->place(), second = child.place();
    const bool environment = child.tag == "emitter" && child.value("type") == "environment";
    const std::string what = !environment ? fmt::format("<{}>", child.written_tag())
                             : child.written_type() == "environment"
                                 ? "'environment'"
                                 : fmt::format("environment, '{}'", child.written_type());
    diagnostics.error(second, fmt::format("a second {}; there can be only one, and the first is at {} {}",
                                          what, first.file == second.file ? "line" : first.file, first.line));
}

Element synthetic_element(const Element& at, std::string tag, const std::string& type)
{
    Element element;
    element.tag = std::move(tag);
    element.file = at.file;
    element.tag_offset = at.tag_offset;
    element.attributes.push_back({.name = "type", .value = type, .verbatim = false});
    return element;
}

} // namespace plumb
