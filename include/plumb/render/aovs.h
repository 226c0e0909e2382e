// SPDX-License-Identifier: MIT
#pragma once

// AOVs (arbitrary output variables): what a camera sample sees first, and what it costs, as layers of a film. A new one is a row
// of the table in aovs.cpp.

#include "plumb/math/color.h"
#include "plumb/render/channel_set.h"

#include <optional>
#include <unordered_map>

namespace plumb {

class Bsdf;
class Camera;
class Scene;
class Shape;
struct FirstSurfaces;
struct SeenSurface;
struct SurfacePoint;

struct AovView;

// Of a camera sample.
struct SampleFacts {
    const FirstSurfaces& first;
    Color radiance;
    std::uint64_t rays = 0; // that it took
};

struct AovRow {
    Layer layer;
    std::string_view unit; // "scene units"; empty: none
    std::string_view manual;
    bool
        behind; // there is also NAME_behind: of the first surface that is not a perfect mirror or clear glass
    // One of them: the components, or the id, of a surface that is seen.
    void (*measure)(const SeenSurface& seen, const AovView& view, float* values);
    std::uint32_t (*identify)(const SeenSurface& seen, const AovView& view);
    // Of an id: what the ids from 1 are.
    std::vector<std::string> (*table)(const Scene& scene);
    // Instead of both: of a sample, whatever it saw.
    void (*of_sample)(const SampleFacts& sample, float* values) = nullptr;
};
std::span<const AovRow> aov_rows();
// Of all layers: those of the rows, NAME_behind, and variance_of_NAME of each that is no id.
std::vector<std::string> aov_names();

// What is asked for is a NAME of these, or LAYER:NAME, whose layer is called LAYER in the file: letters, digits, '_', '-' and
// inner dots. So the same NAME can be there more than once.

// The layers: those without a name of their own first, in the table's order, each once; then the others as they come. Throws
// Error for an unknown name, and for two layers of one name.
ChannelSet layers_of(std::span<const std::string> names);

// Of each layer of ids among the names: its name, and what the ids from 1 are.
std::vector<std::pair<std::string, std::vector<std::string>>> id_tables(std::span<const std::string> names,
                                                                        const Scene& scene);

// What rows need besides the surface.
struct AovView {
    AovView(const Scene& scene, const Camera& camera);
    double depth_along_view(const float* position) const; // in front of the camera
    // From 1: the scene's objects, and then its instances, each as a whole.
    std::uint32_t object_of(const SurfacePoint& at) const;
    std::uint32_t material_of(const Bsdf* bsdf) const; // from 1

private:
    const Scene& scene_;
    double eye_[3];
    double forward_[3]; // of unit length
    std::unordered_map<const Shape*, std::uint32_t> objects_;
    std::unordered_map<const Bsdf*, std::uint32_t> materials_;
};

// The materials of the objects, in instances too, each once, in the order of the objects.
std::vector<std::string> material_names(const Scene& scene);

// Measures samples for a film with the layers of these names. Scene and camera must outlive it.
class AovMeter {
public:
    AovMeter(std::span<const std::string> names, const Scene& scene, const Camera& camera);
    bool empty() const { return wanted_.empty(); }

    // Room for the values of one sample; each thread has its own.
    struct Values {
        std::vector<float> values;
        std::vector<std::uint32_t> ids;
    };
    LayerSample measure(const SampleFacts& sample, Values& room) const;

private:
    struct Wanted {
        const AovRow* row;
        bool behind;
    };
    std::vector<Wanted> wanted_;
    std::optional<AovView> view_; // if anything is wanted
};

} // namespace plumb
