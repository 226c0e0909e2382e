// SPDX-License-Identifier: MIT
#include "scene_file/shared_objects.h"

#include "base/parallel.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/texture.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr int max_bsdf_depth = 64; // of BSDFs inside BSDFs

// "bsdf 'gold'".
std::string title(const Element& element)
{
    const std::string id = element.value("id");
    return fmt::format("{} '{}'", element.tag, id.empty() ? element.value("type") : id);
}

// Recursion ends: parse_document().
void find_textures(const Element& element, std::set<const Element*>& found)
{
    if (element.tag == "texture") {
        found.insert(&element);
        return;
    }
    for (const Element& child : element.children) find_textures(child, found);
}

} // namespace

SharedObjects::SharedObjects(const Element& root, LoadContext& context)
{
    context.shared = this;
    for (const Element& child : root.children)
        if (child.tag != "scene") collect(child); // a scene in a test has its own
    for (const Element* ref : refs_) {
        const auto named = by_id_.find(ref->value("id"));
        if (named != by_id_.end() && shared_.insert(named->second.front()).second)
            reject_second(named->first, context);
    }
    std::vector<const Element*> roots;
    if (root.tag == "scene")
        for (const Element& child : root.children)
            if (child.tag == "bsdf" || child.tag == "texture") {
                shared_.insert(&child);
                roots.push_back(&child);
            }
    for (const Element* ref : refs_)
        if (const auto named = by_id_.find(ref->value("id")); named != by_id_.end())
            roots.push_back(named->second.front());
    prepare_textures(roots, context);
    for (const Element* element : roots) object(*element, element->place(), context);
    prepared_.clear();
}

// Textures refer to nothing, so they can be built side by side: reading their images takes most of the time of loading.
void SharedObjects::prepare_textures(const std::vector<const Element*>& roots, const LoadContext& context)
{
    std::set<const Element*> found;
    for (const Element* element : roots) find_textures(*element, found);
    const std::vector<const Element*> textures(found.begin(), found.end());
    if (textures.size() < 2) return;
    std::vector<Prepared> built(textures.size());
    parallel_for(textures.size(), 0, [&](std::size_t i) {
        Prepared& one = built[i];
        LoadContext own{one.diagnostics,    context.dialect,   context.lenient, {}, 0, this,
                        context.bsdf_depth, context.vocabulary};
        one.texture = ObjectReader(*textures[i], own).build(texture_types());
        if (one.texture) one.texture_bytes = one.texture->memory_bytes();
        one.files = std::move(own.files);
    });
    for (std::size_t i = 0; i < textures.size(); ++i) prepared_.emplace(textures[i], std::move(built[i]));
}

std::shared_ptr<const Texture> SharedObjects::build_texture(const Element& element, LoadContext& context)
{
    if (const auto found = prepared_.find(&element); found != prepared_.end()) {
        Prepared& one = found->second;
        context.diagnostics.add(one.diagnostics);
        for (const std::filesystem::path& file : one.files) context.add_file(file);
        context.texture_bytes += one.texture_bytes;
        return one.texture;
    }
    std::shared_ptr<const Texture> texture = ObjectReader(element, context).build(texture_types());
    if (texture) context.texture_bytes += texture->memory_bytes();
    return texture;
}

void SharedObjects::collect(const Element& element)
{
    if (element.tag == "ref") refs_.push_back(&element);
    const std::string id = element.tag == "bsdf" || element.tag == "texture" ? element.value("id") : "";
    if (!id.empty()) by_id_[id].push_back(&element);
    for (const Element& child : element.children) collect(child);
}

void SharedObjects::reject_second(const std::string& id, LoadContext& context) const
{
    const std::vector<const Element*>& elements = by_id_.find(id)->second;
    if (elements.size() < 2) return;
    const SourceLocation first = elements[0]->place(), second = elements[1]->id_place();
    context.diagnostics.error(second,
                              fmt::format("the id '{}' is given twice; first given at {} {}", id,
                                          first.file == second.file ? "line" : first.file, first.line));
}

const Element* SharedObjects::find(const Element& ref, LoadContext& context) const
{
    for (const Element& child : ref.children) context.diagnostics.error(child.place(), rejection(ref, child));
    if (!check_attributes(ref, {"id"}, {"name"}, context.diagnostics)) return nullptr;
    const std::string id = ref.value("id");
    if (const Element* found = named(id)) return found;
    std::vector<std::string_view> known;
    for (const auto& [name, elements] : by_id_) known.push_back(name);
    context.diagnostics.error(ref.id_place(), fmt::format("no <bsdf> or <texture> has the id '{}'{}", id,
                                                          known.empty() ? "" : way_out(id, known)));
    return nullptr;
}

const Element* SharedObjects::named(std::string_view id) const
{
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? nullptr : found->second.front();
}

std::shared_ptr<const Bsdf> SharedObjects::bsdf(const Element& element, const SourceLocation& at,
                                                LoadContext& context)
{
    return object(element, at, context).bsdf;
}

std::shared_ptr<const Texture> SharedObjects::texture(const Element& element, const SourceLocation& at,
                                                      LoadContext& context)
{
    return object(element, at, context).texture;
}

SharedObjects::Object SharedObjects::object(const Element& element, const SourceLocation& at,
                                            LoadContext& context)
{
    const bool is_shared = shared_.contains(&element);
    if (is_shared) {
        if (const auto found = built_.find(&element); found != built_.end()) return found->second;
        if (std::find(open_.begin(), open_.end(), &element) != open_.end()) {
            fail_cycle(element, at, context);
            return {};
        }
    }
    if (context.bsdf_depth == max_bsdf_depth) {
        context.diagnostics.error(at,
                                  fmt::format("more than {} BSDFs are inside each other", max_bsdf_depth));
        return {};
    }

    ++context.bsdf_depth;
    if (is_shared) open_.push_back(&element);
    Object object;
    if (element.tag == "bsdf") {
        object.bsdf = ObjectReader(element, context).build(bsdf_types());
    } else {
        object.texture = build_texture(element, context);
    }
    --context.bsdf_depth;
    if (is_shared) {
        open_.pop_back();
        built_.emplace(&element, object);
    }
    return object;
}

void SharedObjects::fail_cycle(const Element& element, const SourceLocation& at, LoadContext& context) const
{
    context.diagnostics.error(at, fmt::format("{} contains itself", title(element)));
    const auto first = std::find(open_.begin(), open_.end(), &element);
    for (auto inner = first + 1; inner != open_.end(); ++inner)
        context.diagnostics.note((*inner)->place(), fmt::format("through {}", title(**inner)));
}

std::shared_ptr<const Bsdf> build_bsdf(const Element& element, LoadContext& context)
{
    const Element* target = element.tag == "ref" ? context.shared->find(element, context) : &element;
    if (!target) return nullptr;
    if (target->tag == "bsdf") return context.shared->bsdf(*target, element.place(), context);
    context.diagnostics.error(element.id_place(),
                              fmt::format("'{}' is a <{}>, not a <bsdf>", element.value("id"), target->tag));
    return nullptr;
}

} // namespace plumb
