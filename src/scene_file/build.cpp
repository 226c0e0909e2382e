// SPDX-License-Identifier: MIT
#include "scene_file/build.h"

#include "core/memory.h"
#include "scene_file/values.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

Property integer_property(std::uint64_t value)
{
    Property property;
    property.tag = "integer";
    property.text = std::to_string(value);
    property.value = static_cast<std::int64_t>(value);
    return property;
}

// An element that no file contains, with the place of another one.
Element synthetic_element(const Element& at, std::string tag, const std::string& type)
{
    Element element;
    element.tag = std::move(tag);
    element.file = at.file;
    element.tag_offset = at.tag_offset;
    element.attributes.push_back({.name = "type", .value = type, .verbatim = false});
    return element;
}

// Bytes for a picture: the film, the picture that it becomes, and a copy for writing.
double picture_bytes(double pixels)
{
    return pixels * static_cast<double>(film_bytes_per_pixel + 2 * 3 * sizeof(float));
}

class SceneBuilder {
public:
    SceneBuilder(const Element& root, const LoadOptions& options, LoadContext& context)
        : root_(root), options_(options), context_(context), diagnostics_(context.diagnostics)
    {}

    SceneParts build()
    {
        check_attributes(root_, {}, {"dialect", "name", "id"}, diagnostics_);
        for (const Element& child : root_.children) {
            const std::string_view kind = kind_of(child);
            if (kind == "shape")
                build_shape(child);
            else if (kind == "emitter")
                build_light(child);
            else if (kind == "camera")
                keep_only(camera_, child);
            else if (kind == "integrator")
                keep_only(integrator_, child);
            else if (kind == "sampler")
                keep_only(sampler_, child);
            else if (is_property_tag(child.tag))
                check_property(child);
            else
                reject_child(root_, child, diagnostics_);
        }
        build_camera();
        build_integrator();
        build_sampler();
        return std::move(parts_);
    }

private:
    // The one child of its kind; the next one is an error.
    void keep_only(const Element*& kept, const Element& child)
    {
        if (!kept) {
            kept = &child;
            return;
        }
        const SourceLocation first = kept->place(), second = child.place();
        const bool environment = child.tag == "emitter" && child.value("type") == "environment";
        diagnostics_.error(second,
                           fmt::format("a second {}; there can be only one, and the first is at {} {}",
                                       environment ? "'environment'" : fmt::format("<{}>", child.tag),
                                       first.file == second.file ? "line" : first.file, first.line));
    }

    void check_property(const Element& child)
    {
        const auto property = read_property(child, diagnostics_);
        if (!property) return;
        const std::string name = child.value("name");
        if (find_ignored("scene", "", name)) return;
        diagnostics_.add(context_.lenient ? Severity::warning : Severity::error, property->name_at,
                         fmt::format("unknown parameter '{}' for <scene>; it takes none", name));
    }

    // --- Shapes and lights ---

    void build_shape(const Element& element)
    {
        const Element* bsdf = nullptr;
        const Element* emitter = nullptr;
        for (const Element& child : element.children) {
            if (child.tag == "bsdf") keep_only(bsdf, child);
            if (child.tag == "emitter") keep_only(emitter, child);
        }
        SceneObject object;
        ObjectReader reader(element, context_, {"bsdf", "emitter"});
        object.shape = reader.build(shape_types());
        object.bsdf = bsdf ? ObjectReader(*bsdf, context_).build(bsdf_types()) : default_bsdf(element);
        if (emitter) object.emitter = build_area_light(*emitter, object.shape.get());
        const SourceLocation at = element.place();
        object.name = fmt::format("{} '{}' ({}:{})", element.tag, reader.type(),
                                  std::filesystem::path(at.file).filename().string(), at.line);
        parts_.objects.push_back(std::move(object));
    }

    std::unique_ptr<Bsdf> default_bsdf(const Element& shape)
    {
        return ObjectReader(synthetic_element(shape, "bsdf", "diffuse"), context_).build(bsdf_types());
    }

    // shape: null where it could not be built.
    std::unique_ptr<Emitter> build_area_light(const Element& element, const Shape* shape)
    {
        ObjectReader reader(element, context_);
        if (is_known_emitter(reader.type()) && reader.type() != "area")
            diagnostics_.error(element.value_place(*element.attribute("type")),
                               fmt::format("emitter '{}' has no shape; it must stand directly inside <scene>",
                                           reader.type()));
        else if (shape) {
            reader.params().set_parent_shape(shape);
            return reader.build(emitter_types());
        }
        reader.check(emitter_types());
        return nullptr;
    }

    void build_light(const Element& element)
    {
        ObjectReader reader(element, context_);
        if (reader.type() == "environment") keep_only(environment_, element);
        if (reader.type() != "area") {
            parts_.lights.push_back(reader.build(emitter_types()));
            return;
        }
        diagnostics_.error(element.value_place(*element.attribute("type")),
                           "emitter 'area' must stand inside the <mesh> or <shape> that emits");
        reader.check(emitter_types());
    }

    static bool is_known_emitter(std::string_view type)
    {
        return std::any_of(emitter_types().begin(), emitter_types().end(),
                           [&](const Entry<Emitter>& entry) { return entry.name == type; });
    }

    // --- Camera ---

    void build_camera()
    {
        if (!camera_) {
            fail_missing("camera", "<camera type=\"perspective\"> ... </camera>");
            return;
        }
        const Element* filter = nullptr;
        for (const Element& child : camera_->children)
            if (child.tag == "rfilter") keep_only(filter, child);
        parts_.filter = filter ? ObjectReader(*filter, context_).build(filter_types())
                               : ObjectReader(synthetic_element(*camera_, "rfilter", "gaussian"), context_)
                                     .build(filter_types());

        ObjectReader reader(*camera_, context_, {"rfilter"});
        if (options_.resolution) {
            reader.params().add("width",
                                integer_property(static_cast<std::uint64_t>(options_.resolution->x)));
            reader.params().add("height",
                                integer_property(static_cast<std::uint64_t>(options_.resolution->y)));
        }
        parts_.camera = reader.build(camera_types());
        if (parts_.camera) check_memory(parts_.camera->resolution());
    }

    void check_memory(Vec2i resolution)
    {
        const double pixels = static_cast<double>(resolution.x) * static_cast<double>(resolution.y);
        const double needed =
            picture_bytes(options_.kept_pixels ? static_cast<double>(*options_.kept_pixels) : pixels);
        const auto available = available_memory();
        if (!available || needed <= static_cast<double>(*available)) return;
        SourceLocation at;
        if (!options_.resolution) {
            at = camera_->place();
            for (const Element& child : camera_->children)
                if (child.value("name") == "width" && child.attribute("value"))
                    at = child.value_place(*child.attribute("value"));
        }
        diagnostics_.error(
            at,
            fmt::format("a picture of {} x {} pixels needs {:.1f} GB of memory, and {:.1f} GB are "
                        "available; lower width and height",
                        resolution.x, resolution.y, needed * 1e-9, static_cast<double>(*available) * 1e-9));
    }

    // --- Integrator and sampler ---

    void build_integrator()
    {
        if (!options_.integrator && !integrator_) {
            fail_missing("integrator", "<integrator type=\"path_mis\"/>");
            return;
        }
        if (options_.integrator && !check_option("integrator", *options_.integrator, integrator_types()))
            return;
        const Element element =
            options_.integrator ? synthetic_element(root_, "integrator", *options_.integrator) : *integrator_;
        ObjectReader reader(element, context_);
        parts_.integrator = reader.build(integrator_types());
        parts_.integrator_type = reader.type();
        if (!options_.integrator) parts_.integrator_at = element.place();
    }

    // Without a sampler: independent, one sample. The command line's sampler takes as many samples as the file's.
    void build_sampler()
    {
        if (options_.sampler && !check_option("sampler", *options_.sampler, sampler_types())) return;
        Element element = sampler_ ? *sampler_ : synthetic_element(root_, "sampler", "independent");
        if (options_.sampler) {
            const auto is_count = [](const Element& child) { return child.value("name") == "sampleCount"; };
            const auto count = std::find_if(element.children.begin(), element.children.end(), is_count);
            Element chosen = synthetic_element(element, "sampler", *options_.sampler);
            if (count != element.children.end()) chosen.children.push_back(std::move(*count));
            element = std::move(chosen);
        }
        ObjectReader reader(element, context_);
        if (options_.samples_per_pixel)
            reader.params().add("sampleCount", integer_property(*options_.samples_per_pixel));
        parts_.sampler = reader.build(sampler_types());
        parts_.sampler_type = reader.type();
    }

    template <class Kind>
    bool check_option(std::string_view option, std::string_view type, std::span<const Entry<Kind>> entries)
    {
        std::vector<std::string_view> names;
        for (const Entry<Kind>& entry : entries) names.push_back(entry.name);
        if (std::find(names.begin(), names.end(), type) != names.end()) return true;
        const auto instead = unsupported(option, type);
        diagnostics_.error(
            {}, instead ? fmt::format("--{0} {1}: {0} '{1}' is not supported; {2}", option, type, *instead)
                        : fmt::format("--{0} {1}: unknown {0} '{1}'{2}", option, type, way_out(type, names)));
        return false;
    }

    void fail_missing(std::string_view tag, std::string_view sample)
    {
        diagnostics_.error(root_.place(), fmt::format("the scene has no <{}>; write {}", tag, sample));
    }

    const Element& root_;
    const LoadOptions& options_;
    LoadContext& context_;
    Diagnostics& diagnostics_;
    SceneParts parts_;
    const Element* camera_ = nullptr;
    const Element* integrator_ = nullptr;
    const Element* sampler_ = nullptr;
    const Element* environment_ = nullptr;
};

} // namespace

SceneParts build_scene(const Element& root, const LoadOptions& options, LoadContext& context)
{
    return SceneBuilder(root, options, context).build();
}

std::optional<RenderJob> assemble(SceneParts parts, const LoadOptions& options, LoadContext& context)
{
    Scene scene(std::move(parts.objects), std::move(parts.lights),
                {context.dialect.emitters_absorb, options.instruction_set});
    try {
        parts.integrator->prepare(scene);
    } catch (const Error& error) {
        context.diagnostics.error(parts.integrator_at, error.what());
        return std::nullopt;
    }
    return RenderJob{std::move(scene), std::move(parts.camera), std::move(parts.integrator),
                     std::move(parts.sampler), std::move(parts.filter)};
}

} // namespace plumb
