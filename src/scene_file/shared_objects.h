// SPDX-License-Identifier: MIT
#pragma once

// BSDFs and textures that stand in one place of a scene and are used in several, by <ref id="...">.

#include "scene_file/objects.h"

#include <set>

namespace plumb {

// Each is built once, before the shapes, in the order of the references: one that another needs is built first. A reference
// may come before what it names. One that contains itself is an error.
class SharedObjects {
public:
    // Builds what stands directly in `root` or is named by a <ref> anywhere in it. The context refers to this object from
    // then on. root must outlive it.
    SharedObjects(const Element& root, LoadContext& context);
    SharedObjects(const SharedObjects&) = delete;
    SharedObjects& operator=(const SharedObjects&) = delete;

    // What a <ref> names. Null if there is no such thing, which is reported.
    const Element* find(const Element& ref, LoadContext& context) const;

    // What has the id; null if nothing has.
    const Element* named(std::string_view id) const;

    // element: a <bsdf>; at: where it is used. Null if it cannot be built, which is reported. Once the constructor is done,
    // several threads may ask, each with a context of its own.
    std::shared_ptr<const Bsdf> bsdf(const Element& element, const SourceLocation& at, LoadContext& context);
    std::shared_ptr<const Texture> texture(const Element& element, const SourceLocation& at,
                                           LoadContext& context);

private:
    struct Object {
        std::shared_ptr<const Bsdf> bsdf;
        std::shared_ptr<const Texture> texture;
    };

    // A texture that was built before it is asked for, and what was to be said of it.
    struct Prepared {
        std::shared_ptr<const Texture> texture;
        Diagnostics diagnostics;
        std::vector<std::filesystem::path> files;
        std::uint64_t texture_bytes = 0;
    };

    void collect(const Element& element);
    void prepare_textures(const std::vector<const Element*>& roots, const LoadContext& context);
    std::shared_ptr<const Texture> build_texture(const Element& element, LoadContext& context);
    void reject_second(const std::string& id, LoadContext& context) const;
    Object object(const Element& element, const SourceLocation& at, LoadContext& context);
    void fail_cycle(const Element& element, const SourceLocation& at, LoadContext& context) const;

    std::map<std::string, std::vector<const Element*>, std::less<>> by_id_;
    std::vector<const Element*> refs_;
    std::set<const Element*> shared_; // built once
    std::map<const Element*, Object> built_;
    std::map<const Element*, Prepared> prepared_; // until the constructor is done
    std::vector<const Element*> open_;            // being built: a reference to one of them closes a cycle
};

// What `element`, a <bsdf> or a <ref> to one, stands for. Null if it cannot be built, which is reported.
std::shared_ptr<const Bsdf> build_bsdf(const Element& element, LoadContext& context);

} // namespace plumb
