// SPDX-License-Identifier: MIT
#pragma once

// Cameras whose lookat has no up.

#include "plumb/math/math.h"
#include "scene_file/document.h"

namespace plumb {

// Of a camera of one pixel whose lookat has `up` parallel to the view: the same with an `up` of its own and a field of
// view of next to nothing. The courses' code makes a matrix without sides of such a lookat, so that every ray is the
// axis, and tests of ETH ask for what the axis sees. Nothing for every other camera. resolution: the command line's.
std::optional<Element> axis_camera(const Element& camera, const std::optional<Vec2i>& resolution,
                                   Diagnostics& diagnostics);

} // namespace plumb
