// SPDX-License-Identifier: MIT
#pragma once

// What is doubtful about a scene that loads without an error.

#include "plumb/render/render.h"

#include <string>
#include <vector>

namespace plumb {

// Something that is most likely not meant. object: as SceneObject::name has it; empty: the scene as a whole.
struct Doubt {
    std::string object;
    std::string text;
};

// Looks for glass that is not closed, alone or together with glass that ends where it does, or whose front looks
// inwards; lamps that emit nothing, that face a wall, or that are closed and shine inwards although the camera is
// outside; BSDFs that reflect more light than they receive; a camera inside an object; a scene without light, or whose light
// no path from the camera finds; scenes and objects that lie so far from the origin that floats are too coarse for them;
// surfaces that lie in each other, of two objects or of one. In the order of the objects, one kind of doubt after the other.
// Takes samples with fixed seeds: the same scene has the same doubts.
std::vector<Doubt> find_doubts(const RenderJob& job);

} // namespace plumb
