// SPDX-License-Identifier: MIT
#pragma once

// Children of <scene> that may read files. Each is built on its own, with messages of its own, so that several can be
// built at a time.

#include "plumb/scene/scene.h"
#include "scene_file/objects.h"

#include <functional>

namespace plumb {

struct BuiltChild {
    SceneObject object;             // of a shape
    std::unique_ptr<Emitter> light; // of an emitter
    Diagnostics diagnostics;
    std::vector<std::filesystem::path> files;
    std::uint64_t texture_bytes = 0;
};

// element: a shape, with its BSDF and emitter, or a light. scene: for its settings; several threads may pass the same.
BuiltChild build_child(const Element& element, const LoadContext& scene);

// Several at a time. take: called in their order with each one's index, its messages and files being in the context.
void build_children(std::span<const Element* const> elements, LoadContext& context,
                    const std::function<void(std::size_t, BuiltChild&)>& take);

// Keeps the one child of its kind; the next one is an error.
void keep_only(const Element*& kept, const Element& child, Diagnostics& diagnostics);

// An element that no file contains, with the place of another one.
Element synthetic_element(const Element& at, std::string tag, const std::string& type);

} // namespace plumb
