// SPDX-License-Identifier: MIT
#include "scene_file/objects.h"

#include "plumb/scene_file.h"
#include "scene_file/manual.h"
#include "scene_file/values.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

namespace plumb {

namespace {

// "a bsdf", "an emitter".
std::string with_article(std::string_view noun)
{
    const bool vowel = std::string_view("aeio").find(noun.empty() ? 'x' : noun[0]) != std::string_view::npos;
    return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

std::vector<std::string_view> all_tags()
{
    std::vector<std::string_view> tags = {"include", "default", "mesh",   "boolean", "integer",  "float",
                                          "string",  "point",   "vector", "color",   "transform"};
    for (const TypeInfo& type : known_types())
        if (std::find(tags.begin(), tags.end(), type.kind) == tags.end()) tags.push_back(type.kind);
    return tags;
}

} // namespace

void LoadContext::add_file(const std::filesystem::path& file)
{
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

std::string_view kind_of(const Element& element)
{
    return kind_of_tag(element.tag);
}

void reject_child(const Element& parent, const Element& child, Diagnostics& diagnostics)
{
    const std::vector<std::string_view> tags = all_tags();
    const bool known = std::find(tags.begin(), tags.end(), child.tag) != tags.end();
    if (const auto instead = unsupported(child.tag, ""))
        diagnostics.error(child.place(), fmt::format("<{}> is not supported; {}", child.tag, *instead));
    else if (child.tag == "include" || child.tag == "default")
        diagnostics.error(child.place(), fmt::format("<{}> must stand directly inside <scene>", child.tag));
    else if (is_transform_operation(child.tag))
        diagnostics.error(child.place(), fmt::format("<{}> must stand inside a <transform>", child.tag));
    else if (known || child.tag == "scene" || child.tag == "test")
        diagnostics.error(child.place(), cannot_contain(parent, child));
    else
        diagnostics.error(child.place(),
                          fmt::format("unknown tag <{}>{}", child.tag, way_out(child.tag, tags)));
}

ObjectReader::ObjectReader(const Element& element, LoadContext& context,
                           std::initializer_list<std::string_view> child_tags)
    : element_(element),
      context_(context),
      type_(element.value("type")),
      params_(element.tag, type_, element.place(), context.diagnostics, context.dialect,
              element.file->folder())
{
    params_.set_lenient(context.lenient);
    if (element.tag == "texture")
        check_attributes(element, {"type", "name"}, {"id"}, context.diagnostics);
    else if (element.tag == "test")
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
        else if (child.tag == "texture" && kind_of(element_) != "shape")
            add_texture(child);
        else if (std::find(child_tags.begin(), child_tags.end(), child.tag) == child_tags.end())
            reject_child(element_, child, context_.diagnostics);
    }
}

bool ObjectReader::is_first(const Element& child, std::string_view name)
{
    const auto [first, is_new] = given_.emplace(name, child.place());
    if (is_new) return true;
    const bool same_file = first->second.file == child.file->path().string();
    context_.diagnostics.error(child.value_place(*child.attribute("name")),
                               fmt::format("'{}' is given twice; first given at {} {}", name,
                                           same_file ? "line" : first->second.file, first->second.line));
    return false;
}

void ObjectReader::add_property(const Element& child)
{
    auto property = read_property(child, context_.diagnostics);
    if (!property) return;
    const std::string name = child.value("name");
    if (is_first(child, name)) params_.add(name, *std::move(property));
}

void ObjectReader::add_texture(const Element& child)
{
    ObjectReader reader(child, context_);
    std::shared_ptr<const Texture> texture = reader.build(texture_types());
    if (texture) context_.texture_bytes += texture->memory_bytes();
    const std::string name = child.value("name");
    // One that could not be made still stands here, so that a wrong name is found, too.
    if (child.attribute("name") && is_first(child, name))
        params_.add_texture({name, std::move(texture), child.value_place(*child.attribute("name"))});
}

void ObjectReader::fail_unknown_type(const std::vector<std::string_view>& names) const
{
    const std::string_view kind = kind_of(element_);
    const SourceLocation at = element_.value_place(*element_.attribute("type"));
    if (const auto instead = unsupported(kind, type_))
        context_.diagnostics.error(at, fmt::format("{} '{}' is not supported; {}", kind, type_, *instead));
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
        context_.diagnostics.note(file_place(),
                                  fmt::format("the file is read by {} '{}'", element_.tag, type_));
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
        params_.ignore(
            name, ignored->instead.empty()
                      ? std::string()
                      : fmt::format("'{}' is not read, neither here nor in the course's own code: {} is {}",
                                    name, ignored->instead, used));
    }
    params_.reject_unused();
}

} // namespace plumb
