// SPDX-License-Identifier: MIT
#pragma once

// From the tree of a scene file to the parts of a RenderJob.

#include "plumb/scene_file/scene_file.h"
#include "scene_file/objects.h"

namespace plumb {

struct SceneParts {
    std::vector<SceneObject> objects;
    std::vector<Instance> instances;
    std::vector<std::unique_ptr<Emitter>> lights;
    std::unique_ptr<Camera> camera;
    std::unique_ptr<Integrator> integrator;
    std::unique_ptr<Sampler> sampler;
    std::unique_ptr<Filter> filter;
    std::string integrator_type;
    std::string sampler_type;
    SourceLocation integrator_at; // no place where the command line chose it
};

// root: a <scene>, expanded. Parts are null only where `context.diagnostics` has errors.
SceneParts build_scene(const Element& root, const LoadOptions& options, LoadContext& context);

// What the parts make, all that are there, ready to be rendered. Nothing, and an error in `context.diagnostics`, if the
// integrator cannot render the scene.
std::optional<RenderJob> assemble(SceneParts parts, const LoadOptions& options, LoadContext& context);

} // namespace plumb
