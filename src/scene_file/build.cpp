// SPDX-License-Identifier: MIT
#include "scene_file/build.h"

#include "base/memory.h"
#include "scene_file/axis_camera.h"
#include "scene_file/build_child.h"
#include "scene_file/foreign_names.h"
#include "scene_file/groups.h"
#include "scene_file/nori_words.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"
#include "scene_file/shared_objects.h"

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

// Bytes for a picture of beauty alone: the film, the picture that it becomes, and a copy for writing.
double picture_bytes(double pixels)
{
    return pixels * static_cast<double>(Film::bytes_per_pixel() + 2 * 3 * sizeof(float));
}

class SceneBuilder {
public:
    SceneBuilder(const Element& root, const LoadOptions& options, LoadContext& context)
        : root_(root), options_(options), context_(context), diagnostics_(context.diagnostics)
    {}

    SceneParts build()
    {
        check_attributes(root_, {}, {"dialect", "name", "id"}, diagnostics_);
        SharedObjects shared(root_, context_);
        for (const Element& child : root_.children) {
            const std::string_view kind = kind_of(child);
            if (kind == "shape" || kind == "emitter")
                add_child(child);
            else if (kind == "camera")
                keep_only(camera_, child);
            else if (kind == "integrator")
                keep_only(integrator_, child);
            else if (kind == "sampler")
                keep_only(sampler_, child);
            else if (kind == "bsdf" || kind == "texture")
                check_shared(child);
            else if (is_property_tag(child.tag))
                check_property(child);
            else
                diagnostics_.error(child.place(), rejection(root_, child));
        }
        build_children();
        build_camera();
        build_integrator();
        build_sampler();
        context_.shared = nullptr;
        return std::move(parts_);
    }

private:
    void keep_only(const Element*& kept, const Element& child)
    {
        plumb::keep_only(kept, child, diagnostics_);
    }

    void add_child(const Element& child)
    {
        if (child.tag == "emitter" && child.value("type") == "environment") keep_only(environment_, child);
        if (kind_of(child) == "shape" && Groups::takes(child))
            groups_.add(child);
        else
            children_.push_back(&child);
    }

    void check_shared(const Element& child)
    {
        if (!child.value("id").empty()) return;
        diagnostics_.error(
            child.place(),
            fmt::format("a <{0}> that stands in <scene> needs an id, for a <ref> to name: <{0} "
                        "id=\"...\" ...>",
                        child.tag));
    }

    void build_children()
    {
        plumb::build_children(children_, context_, [&](std::size_t i, BuiltChild& child) {
            if (kind_of(*children_[i]) == "shape")
                parts_.objects.push_back(std::move(child.object));
            else if (child.light)
                parts_.lights.push_back(std::move(child.light));
        });
        parts_.instances = groups_.build(context_);
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

        const std::optional<Element> axis = axis_camera(*camera_, options_.resolution, diagnostics_);
        ObjectReader reader(axis ? *axis : *camera_, context_, {"rfilter"});
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
        diagnostics_.error(at, fmt::format("an image of {} x {} pixels needs {:.1f} GB of memory, but only "
                                           "{:.1f} GB are available; lower width and height",
                                           resolution.x, resolution.y, needed * 1e-9,
                                           static_cast<double>(*available) * 1e-9));
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
            options_.integrator ? chosen_element(root_, "integrator", *options_.integrator) : *integrator_;
        ObjectReader reader(element, context_);
        parts_.integrator = reader.build(integrator_types());
        parts_.integrator_type = element.written_type();
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
        parts_.sampler_type = element.written_type();
    }

    // Of a type that the command line names, in the words of any course.
    static Element chosen_element(const Element& at, const std::string& tag, const std::string& type)
    {
        Element element = synthetic_element(at, tag, type);
        const std::string_view ours = our_type(nori_vocabulary(DialectName::plumb), tag, type);
        if (ours != type) rename_attribute_value(element, "type", ours);
        return element;
    }

    template <class Kind>
    bool check_option(std::string_view option, std::string_view type, std::span<const Entry<Kind>> entries)
    {
        std::vector<std::string_view> names;
        for (const Entry<Kind>& entry : entries) names.push_back(entry.name);
        const std::string_view ours = our_type(nori_vocabulary(DialectName::plumb), option, type);
        if (std::find(names.begin(), names.end(), ours) != names.end()) return true;
        const auto foreign = foreign_type(option, type);
        diagnostics_.error(
            {}, fmt::format("--{} {}: {}", option, type,
                            foreign ? *foreign
                                    : fmt::format("unknown {} '{}'{}", option, type, way_out(type, names))));
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
    std::vector<const Element*> children_; // shapes and lights
    Groups groups_;
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
                {context.dialect.emitters_absorb, options.instruction_set}, std::move(parts.instances));
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
