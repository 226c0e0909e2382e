// SPDX-License-Identifier: MIT
#pragma once

// From the tree of a scene file to the parts of a RenderJob.

#include "plumb/render/render.h"
#include "plumb/scene/scene.h"
#include "plumb/settings/render_settings.h"
#include "scene_file/groups.h"
#include "scene_file/objects.h"
#include "scene_file/shared_objects.h"

#include <span>

namespace plumb {

struct SceneContents {
    std::vector<SceneObject> objects;
    std::vector<Instance> instances;
    std::vector<std::unique_ptr<Emitter>> lights;
    std::vector<std::string> light_names;
};

// What a scene is rendered with. Null only where `context.diagnostics` has errors.
struct MethodAndView {
    std::unique_ptr<Camera> camera;
    std::unique_ptr<Filter> filter;
    std::unique_ptr<Integrator> integrator; // not prepared for a scene
    std::unique_ptr<Sampler> sampler;
    std::string integrator_type;
    std::string sampler_type;
    SourceLocation integrator_at; // no place where the settings chose it
};

class SceneBuilder {
public:
    // root: a <scene>, expanded. It and the context must outlive the builder.
    SceneBuilder(const Element& root, LoadContext& context);

    SceneContents build_contents();
    // The layers that the file asks for, as in --aov.
    const std::vector<std::string>& aovs() const { return aovs_; }
    // As often as wanted.
    MethodAndView build_method_and_view(const MethodSettings& method, const ViewSettings& view);

private:
    void keep_only(const Element*& kept, const Element& child);
    void add_child(const Element& child);
    void check_shared(const Element& child);
    void check_property(const Element& child);
    void read_aovs(const Property& property);
    void build_camera(MethodAndView& parts, const ViewSettings& view);
    void check_memory(Vec2i resolution, const ViewSettings& view);
    void build_integrator(MethodAndView& parts, const MethodSettings& method);
    void build_sampler(MethodAndView& parts, const MethodSettings& method);
    template <class Kind>
    bool check_option(std::string_view option, std::string_view type, std::span<const Entry<Kind>> entries);
    void fail_missing(std::string_view tag, std::string_view sample);

    const Element& root_;
    LoadContext& context_;
    Diagnostics& diagnostics_;
    SharedObjects shared_;
    std::vector<const Element*> children_; // shapes and lights
    Groups groups_;
    const Element* camera_ = nullptr;
    const Element* integrator_ = nullptr;
    const Element* sampler_ = nullptr;
    const Element* environment_ = nullptr;
    std::vector<std::string> aovs_;
};

std::shared_ptr<const Scene> make_scene(SceneContents contents, const std::string& instruction_set,
                                        const Dialect& dialect);

// All of them, ready to be rendered. Nothing, and an error in `context.diagnostics`, if the integrator cannot render the
// scene.
std::optional<RenderJob> assemble(std::shared_ptr<const Scene> scene, MethodAndView parts,
                                  LoadContext& context);

} // namespace plumb
