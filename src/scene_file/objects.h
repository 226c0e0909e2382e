// SPDX-License-Identifier: MIT
#pragma once

// From one element of the tree to one plugin.

#include "plumb/model/dialect.h"
#include "scene_file/catalog.h"
#include "scene_file/document.h"

namespace plumb {

class SharedObjects;
struct Vocabulary;

// What loading needs to know everywhere.
struct LoadContext {
    Diagnostics& diagnostics;
    const Dialect& dialect;
    bool lenient = false;
    std::vector<std::filesystem::path> files; // that plugins read, in order, each once
    std::uint64_t texture_bytes = 0;          // of the images in textures
    SharedObjects* shared = nullptr;          // never null where BSDFs are built
    int bsdf_depth = 0;                       // how many BSDFs are around what is being built
    const Vocabulary* vocabulary = nullptr;   // the file's, for messages; null: our own words

    void add_file(const std::filesystem::path& file);
};

std::string_view kind_of(const Element& element);

// An element's parameters, ready for the constructor. Children that are no properties, textures or BSDFs of it must have one
// of the given tags; the caller deals with those.
class ObjectReader {
public:
    ObjectReader(const Element& element, LoadContext& context,
                 std::initializer_list<std::string_view> child_tags = {});

    Params& params() { return params_; }
    const std::string& type() const { return type_; }

    // The plugin; or null, when everything that is wrong has been reported.
    template <class Kind>
    std::unique_ptr<Kind> build(std::span<const Entry<Kind>> entries)
    {
        const Entry<Kind>* entry = find(entries);
        if (!entry) return nullptr;
        std::unique_ptr<Kind> object;
        run(entry->class_name, [&] { object = entry->build(params_); });
        return object;
    }

    // For a plugin that cannot be built: checks what can be checked.
    template <class Kind>
    void check(std::span<const Entry<Kind>> entries)
    {
        if (const Entry<Kind>* entry = find(entries)) check_against_manual(entry->class_name);
    }

private:
    template <class Kind>
    const Entry<Kind>* find(std::span<const Entry<Kind>> entries)
    {
        for (const Entry<Kind>& entry : entries)
            if (entry.name == type_) return &entry;
        const Attribute* type = element_.attribute("type");
        if (type && !type->broken) fail_unknown_type();
        return nullptr;
    }

    void read_children(std::initializer_list<std::string_view> child_tags);
    void add_property(const Element& child);
    void add_texture(const Element& child);
    void add_texture(const Element& child, std::shared_ptr<const Texture> texture);
    void add_bsdf(const Element& child);
    void add_ref(const Element& child);
    std::optional<std::string> texture_name(const Element& child);
    bool is_first(const Element& child, std::string_view name, const SourceLocation& at);
    void fail_unknown_type() const;
    void run(std::string_view class_name, const std::function<void()>& construct);
    void check_against_manual(std::string_view class_name);
    void finish();
    SourceLocation file_place() const;

    const Element& element_;
    LoadContext& context_;
    std::string type_;
    Params params_;
    std::map<std::string, SourceLocation, std::less<>>
        given_; // names of parameters, and where they stand first
};

} // namespace plumb
