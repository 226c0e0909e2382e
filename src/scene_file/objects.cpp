// SPDX-License-Identifier: MIT
#include "scene_file/objects.h"

#include "plumb/scene_file/scene_file.h"
#include "scene_file/foreign_names.h"
#include "scene_file/manual.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"
#include "scene_file/shared_objects.h"
#include "scene_file/vocabulary.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

namespace plumb {

void LoadContext::add_file(const std::filesystem::path& file)
{
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

std::string_view kind_of(const Element& element)
{
    return kind_of_tag(element.tag);
}

namespace {

bool takes_textures(const Element& element)
{
    const std::vector<std::string_view> parents = parents_of("texture");
    return std::find(parents.begin(), parents.end(), element.tag) != parents.end();
}

} // namespace

ObjectReader::ObjectReader(const Element& element, LoadContext& context,
                           std::initializer_list<std::string_view> child_tags)
    : element_(element),
      context_(context),
      type_(element.value("type")),
      params_(element.tag, type_, element.place(), context.diagnostics, element.file->directory())
{
    params_.set_lenient(context.lenient);
    if (context.vocabulary)
        params_.set_wording(
            {element.written_tag(), element.written_type(),
             [words = context.vocabulary, kind = kind_of(element), type = element.written_type(),
              this](std::string_view name) -> std::string_view {
                 for (const Element& child : element_.children)
                     if (child.written && !child.written->name.empty() && child.value("name") == name)
                         return child.written->name;
                 return written_parameter(*words, kind, type, name);
             }});
    if (element.tag == "test")
        check_attributes(element, {"type"}, {"dialect", "name", "id"}, context.diagnostics);
    else
        check_attributes(element, {"type"}, {"name", "id"}, context.diagnostics);
    read_children(child_tags);
}

void ObjectReader::read_children(std::initializer_list<std::string_view> child_tags)
{
    for (const Element& child : element_.children) {
        if (is_property_tag(child.tag))
            add_property(child);
        else if (child.tag == "texture" && takes_textures(element_))
            add_texture(child);
        else if (child.tag == "bsdf" && element_.tag == "bsdf")
            add_bsdf(child);
        else if (child.tag == "ref" && takes_textures(element_))
            add_ref(child);
        else if (std::find(child_tags.begin(), child_tags.end(), child.tag) == child_tags.end())
            context_.diagnostics.error(child.place(), rejection(element_, child));
    }
}

bool ObjectReader::is_first(const Element& child, std::string_view name, const SourceLocation& at)
{
    const auto [first, is_new] = given_.emplace(name, child.place());
    if (is_new) return true;
    const bool same_file = first->second.file == child.file->path().string();
    context_.diagnostics.error(at, fmt::format("'{}' is given twice; first given at {} {}",
                                               params_.as_written(name),
                                               same_file ? "line" : first->second.file, first->second.line));
    return false;
}

void ObjectReader::add_property(const Element& child)
{
    auto property = read_property(child, context_.diagnostics);
    if (!property) return;
    const std::string name = child.value("name");
    if (is_first(child, name, property->name_at)) params_.add(name, *std::move(property));
}

void ObjectReader::add_texture(const Element& child)
{
    add_texture(child, context_.shared->texture(child, child.place(), context_));
}

// child: the <texture>, or the <ref> to it.
void ObjectReader::add_texture(const Element& child, std::shared_ptr<const Texture> texture)
{
    const std::optional<std::string> name = texture_name(child);
    if (!name) return;
    const Attribute* attribute = child.attribute("name");
    const SourceLocation at = attribute ? child.value_place(*attribute) : child.place();
    // One that could not be made still stands here, so that a wrong name is found, too.
    if (is_first(child, *name, at)) params_.add_texture({*name, std::move(texture), at});
}

void ObjectReader::add_bsdf(const Element& child)
{
    params_.add_bsdf({context_.shared->bsdf(child, child.place(), context_), child.place()});
}

void ObjectReader::add_ref(const Element& child)
{
    const Element* target = context_.shared->find(child, context_);
    if (!target) {
        // It stands for what is missing, so that nothing is reported twice.
        if (element_.tag == "bsdf") params_.add_bsdf({nullptr, child.place(), true});
    } else if (target->tag == "texture") {
        add_texture(child, context_.shared->texture(*target, child.place(), context_));
    } else if (element_.tag == "bsdf") {
        params_.add_bsdf({context_.shared->bsdf(*target, child.place(), context_), child.place()});
    } else {
        context_.diagnostics.error(
            child.place(), fmt::format("{}, which '{}' is", rejection(element_, *target), child.value("id")));
    }
}

// The parameter that a texture is for: of objects that take one texture, that one, if it has no name.
std::optional<std::string> ObjectReader::texture_name(const Element& child)
{
    if (child.attribute("name")) return child.value("name");
    const std::vector<std::string_view> names = texture_parameters_of(kind_of(element_), type_);
    if (names.size() == 1) return std::string(names.front());
    std::string choice;
    for (std::size_t i = 0; i < names.size(); ++i)
        choice += fmt::format("{}name=\"{}\"",
                              i == 0                  ? ""
                              : i + 1 == names.size() ? " or "
                                                      : ", ",
                              params_.as_written(names[i]));
    if (!choice.empty())
        context_.diagnostics.error(
            child.place(), fmt::format("<{}> needs an attribute 'name', for {} '{}' takes several: {}",
                                       child.tag, element_.written_tag(), element_.written_type(), choice));
    else if (kind_of_type(type_) == kind_of(element_))
        context_.diagnostics.error(
            child.place(),
            fmt::format("{} '{}' takes no texture", element_.written_tag(), element_.written_type()));
    return {};
}

void ObjectReader::fail_unknown_type() const
{
    const std::string_view kind = kind_of(element_);
    std::vector<std::string_view> names;
    for (const TypeInfo& type : known_types())
        if (type.kind == kind) names.push_back(type.name);
    const SourceLocation at = element_.value_place(*element_.attribute("type"));
    if (const auto instead = foreign_type(kind, type_))
        context_.diagnostics.error(at, *instead);
    else if (const std::string_view other = kind_of_type(type_); !other.empty())
        context_.diagnostics.error(
            at, fmt::format("'{}' is {}, not {}", type_, with_article(other), with_article(kind)));
    else
        context_.diagnostics.error(at, fmt::format("unknown {} '{}'{}", kind, type_, way_out(type_, names)));
}

// Where a file is named, if one is: that is what errors of reading it are about.
SourceLocation ObjectReader::file_place() const
{
    for (const Element& child : element_.children)
        if (child.tag == "string" && child.value("name").starts_with("file"))
            if (const Attribute* value = child.attribute("value")) return child.value_place(*value);
    return element_.place();
}

void ObjectReader::run(std::string_view class_name, const std::function<void()>& construct)
{
    bool done = false;
    try {
        construct();
        done = true;
    } catch (const FileError& error) {
        context_.diagnostics.error(error.location(), error.what());
        context_.diagnostics.note(file_place(), fmt::format("the file is read by {} '{}'",
                                                            element_.written_tag(), element_.written_type()));
    } catch (const Error& error) {
        if (!params_.missing_file()) context_.diagnostics.error(file_place(), error.what());
    } catch (const std::bad_alloc&) {
        context_.diagnostics.error(file_place(), "not enough memory");
    }
    for (const std::filesystem::path& file : params_.files()) context_.add_file(file);
    if (done)
        finish();
    else
        check_against_manual(class_name); // the constructor may not have come to ask for everything
}

void ObjectReader::check_against_manual(std::string_view class_name)
{
    for (const std::string_view name : parameters_in(plugin_source_manual(class_name))) params_.has(name);
    finish();
}

void ObjectReader::finish()
{
    for (const auto& [name, at] : given_) {
        const IgnoredParameter* ignored = find_ignored(kind_of(element_), type_, name);
        if (!ignored || !params_.is_unused(name)) continue;
        std::string used(ignored->instead_default);
        for (const Element& child : element_.children)
            if (child.value("name") == ignored->instead) used = child.value("value");
        params_.ignore(name,
                       ignored->instead.empty()
                           ? std::string()
                           : fmt::format("'{}' is read neither here nor in the course's own code: {} is {}",
                                         name, ignored->instead, used));
    }
    params_.reject_unused();
}

} // namespace plumb
