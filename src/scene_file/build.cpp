// SPDX-License-Identifier: MIT
#include "scene_file/build.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/text.h"
#include "plumb/render/aovs.h"
#include "scene_file/axis_camera.h"
#include "scene_file/build_child.h"
#include "scene_file/face_bsdfs.h"
#include "scene_file/foreign_names.h"
#include "scene_file/nori_words.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"

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

// Bytes for an image: the film, the image that it becomes, and a copy for writing.
double image_bytes(double pixels, const ChannelSet& layers)
{
    std::size_t channels = 3;
    for (const Layer& layer : layers) channels += layer.components.size();
    return pixels * static_cast<double>(Film::bytes_per_pixel(layers) + 2 * channels * sizeof(float));
}

// Of a type that the settings name, in the words of any course.
Element chosen_element(const Element& at, const std::string& tag, const std::string& type)
{
    Element element = synthetic_element(at, tag, type);
    const std::string_view ours = our_type(nori_vocabulary(DialectName::plumb), tag, type);
    if (ours != type) rename_attribute_value(element, "type", ours);
    return element;
}

} // namespace

SceneBuilder::SceneBuilder(const Element& root, LoadContext& context)
    : root_(root), context_(context), diagnostics_(context.diagnostics), shared_(root, context)
{
    check_attributes(root_, {}, {"dialect", "name", "id"}, diagnostics_);
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
}

SceneContents SceneBuilder::build_contents()
{
    SceneContents contents;
    build_children(children_, context_, [&](std::size_t i, BuiltChild& child) {
        if (kind_of(*children_[i]) == "shape") {
            contents.objects.push_back(std::move(child.object));
            return;
        }
        if (!child.light) return;
        contents.lights.push_back(std::move(child.light));
        contents.light_names.push_back(place_name(*children_[i]));
    });
    contents.instances = groups_.build(context_);
    return contents;
}

MethodAndView SceneBuilder::build_method_and_view(const MethodSettings& method, const ViewSettings& view)
{
    MethodAndView parts;
    build_camera(parts, view);
    build_integrator(parts, method);
    build_sampler(parts, method);
    return parts;
}

template <class Kind>
bool SceneBuilder::check_option(std::string_view option, std::string_view type,
                                std::span<const Entry<Kind>> entries)
{
    std::vector<std::string_view> names;
    for (const Entry<Kind>& entry : entries) names.push_back(entry.name);
    const Vocabulary& words = nori_vocabulary(DialectName::plumb);
    if (std::find(names.begin(), names.end(), our_type(words, option, type)) != names.end()) {
        const TypeName* row = find_type(words, option, type);
        if (row && !row->warning.empty())
            diagnostics_.warning({}, fmt::format("--{} {}: {}", option, type, row->warning));
        return true;
    }
    const auto foreign = foreign_type(option, type);
    diagnostics_.error(
        {}, fmt::format("--{} {}: {}", option, type,
                        foreign ? *foreign
                                : fmt::format("unknown {} '{}'{}", option, type, way_out(type, names))));
    return false;
}

void SceneBuilder::keep_only(const Element*& kept, const Element& child)
{
    plumb::keep_only(kept, child, diagnostics_);
}

void SceneBuilder::add_child(const Element& child)
{
    if (child.tag == "emitter" && child.value("type") == "environment") keep_only(environment_, child);
    if (kind_of(child) == "shape" && Groups::takes(child))
        groups_.add(child);
    else
        children_.push_back(&child);
}

void SceneBuilder::check_shared(const Element& child)
{
    if (!child.value("id").empty()) return;
    diagnostics_.error(child.place(),
                       fmt::format("a <{0}> that stands in <scene> needs an id, for a <ref> to name: <{0} "
                                   "id=\"...\" ...>",
                                   child.tag));
}

void SceneBuilder::check_property(const Element& child)
{
    const auto property = read_property(child, diagnostics_);
    if (!property) return;
    const std::string name = child.value("name");
    if (find_ignored("scene", "", name)) return;
    if (name == "aovs" && property->tag == "string") return read_aovs(*property);
    diagnostics_.unsupported(property->name_at,
                             fmt::format("unknown parameter '{}' for <scene>; it takes 'aovs' only", name),
                             context_.lenient);
}

// "albedo, dd.y:mean_depth".
void SceneBuilder::read_aovs(const Property& property)
{
    for (std::string& aov : list_items(property.text)) aovs_.push_back(std::move(aov));
    try {
        layers_of(aovs_);
    } catch (const Error& problem) {
        diagnostics_.error(property.value_at, problem.what());
        aovs_.clear();
    }
}

// --- Camera ---

void SceneBuilder::build_camera(MethodAndView& parts, const ViewSettings& view)
{
    if (!camera_) {
        fail_missing("camera", "<camera type=\"perspective\"> ... </camera>");
        return;
    }
    const Element* filter = nullptr;
    for (const Element& child : camera_->children)
        if (child.tag == "rfilter") keep_only(filter, child);
    parts.filter = filter ? ObjectReader(*filter, context_).build(filter_types())
                          : ObjectReader(synthetic_element(*camera_, "rfilter", "gaussian"), context_)
                                .build(filter_types());

    const std::optional<Element> axis = axis_camera(*camera_, view.size, diagnostics_);
    ObjectReader reader(axis ? *axis : *camera_, context_, {"rfilter"});
    if (view.size) {
        reader.params().add("width", integer_property(static_cast<std::uint64_t>(view.size->x)));
        reader.params().add("height", integer_property(static_cast<std::uint64_t>(view.size->y)));
    }
    parts.camera = reader.build(camera_types());
    if (parts.camera) check_memory(parts.camera->resolution(), view);
}

void SceneBuilder::check_memory(Vec2i resolution, const ViewSettings& view)
{
    const double pixels = static_cast<double>(resolution.x) * static_cast<double>(resolution.y);
    std::vector<std::string> aovs = view.aovs;
    for (const std::string& aov : aovs_)
        if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) aovs.push_back(aov);
    const double needed = image_bytes(
        view.crop ? static_cast<double>(view.crop->width) * view.crop->height : pixels, layers_of(aovs));
    const auto available = available_memory();
    if (!available || needed <= static_cast<double>(*available)) return;
    SourceLocation at;
    if (!view.size) {
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

void SceneBuilder::build_integrator(MethodAndView& parts, const MethodSettings& method)
{
    if (!method.integrator && !integrator_) {
        fail_missing("integrator", "<integrator type=\"path_mis\"/>");
        return;
    }
    if (method.integrator && !check_option("integrator", *method.integrator, integrator_types())) return;
    const Element element =
        method.integrator ? chosen_element(root_, "integrator", *method.integrator) : *integrator_;
    ObjectReader reader(element, context_);
    parts.integrator = reader.build(integrator_types());
    parts.integrator_type = element.written_type();
    if (!method.integrator) parts.integrator_at = element.place();
}

// Without a sampler: independent, one sample. The sampler of the settings takes as many samples as the file's.
void SceneBuilder::build_sampler(MethodAndView& parts, const MethodSettings& method)
{
    if (method.sampler && !check_option("sampler", *method.sampler, sampler_types())) return;
    Element element = sampler_ ? *sampler_ : synthetic_element(root_, "sampler", "independent");
    if (method.sampler) {
        const auto is_count = [](const Element& child) { return child.value("name") == "sampleCount"; };
        const auto count = std::find_if(element.children.begin(), element.children.end(), is_count);
        Element chosen = synthetic_element(element, "sampler", *method.sampler);
        if (count != element.children.end()) chosen.children.push_back(std::move(*count));
        element = std::move(chosen);
    }
    ObjectReader reader(element, context_);
    parts.sampler = reader.build(sampler_types());
    parts.sampler_type = element.written_type();
}

void SceneBuilder::fail_missing(std::string_view tag, std::string_view sample)
{
    diagnostics_.error(root_.place(), fmt::format("the scene has no <{}>; write {}", tag, sample));
}

std::shared_ptr<const Scene> make_scene(SceneContents contents, const std::string& instruction_set,
                                        const Dialect& dialect)
{
    return std::make_shared<const Scene>(std::move(contents.objects), std::move(contents.lights),
                                         SceneOptions{dialect.emitters_absorb, instruction_set},
                                         std::move(contents.instances), std::move(contents.light_names));
}

std::optional<RenderJob> assemble(std::shared_ptr<const Scene> scene, MethodAndView parts,
                                  LoadContext& context)
{
    try {
        parts.integrator->prepare(*scene);
    } catch (const Error& error) {
        context.diagnostics.error(parts.integrator_at, error.what());
        return std::nullopt;
    }
    return RenderJob{std::move(scene), std::move(parts.camera), std::move(parts.integrator),
                     std::move(parts.sampler), std::move(parts.filter)};
}

} // namespace plumb
