// SPDX-License-Identifier: MIT
#pragma once

// Layers of parts of the light, which add up to the image: by the number of bounces, by how the light was found, by the
// emitter that it comes from.
//
// Names of layers. by_depth.N: light that left N surfaces on its way from the emitter to the camera, 0 is the emitter itself.
// by_technique.view: emitters that the camera sees, directly or by delta bounces alone; by_technique.emitter_sampling: light
// that a chosen emitter sent to a surface; by_technique.direction_sampling: that a path met in a direction which it chose.
// by_light.N: of the scene's emitter number N, from 1. by_depth.more and by_light.more: of all others.

#include "plumb/math/color.h"
#include "plumb/render/channel_set.h"
#include "plumb/scene/light_notes.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

class Scene;

struct LightSplit {
    enum class By { depth, technique, light };
    By by = By::depth;
    int own = 0; // how many depths or lights have layers of their own, from 1; the others share one
    friend bool operator==(const LightSplit&, const LightSplit&) = default;
};

// "depth", "depth:12", "technique", "light", "light:4", and back; without a number it is the default. Throws Error for
// anything else, and if one kind of split is there twice.
std::vector<LightSplit> light_splits_from_text(std::span<const std::string> texts);
std::vector<std::string> to_texts(std::span<const LightSplit> splits);

// The layers, split by split. The lights with layers of their own are the most powerful ones.
ChannelSet layers_of(std::span<const LightSplit> splits, const Scene& scene);

// "1 shape 'rectangle' (cbox.xml:12)" for each light with a layer of its own; nothing without such a split.
std::vector<std::string> light_table(std::span<const LightSplit> splits, const Scene& scene);

// Tells of each contribution to a sample which layers it belongs to.
class LightSplitter {
public:
    // first_layer: the index of the first of their layers in the film's set.
    LightSplitter(std::span<const LightSplit> splits, const Scene& scene, std::size_t first_layer);
    bool empty() const { return splits_.empty(); }

    // radiance: of the sample. room is overwritten.
    std::span<const LightShare> shares(const LightNotes& notes, const Color& radiance,
                                       std::vector<LightShare>& room) const;

private:
    struct Placed {
        LightSplit split;
        std::uint32_t first; // layer
    };
    std::uint32_t layer_of(const Placed& placed, const LightNote& note) const;

    std::vector<Placed> splits_;
    std::vector<std::uint32_t>
        layer_of_emitter_; // counted from the split's first; one more: of the environment
};

} // namespace plumb
