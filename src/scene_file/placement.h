// SPDX-License-Identifier: MIT
#pragma once

// Which elements may stand in which.

#include "scene_file/document.h"

namespace plumb {

// Every tag that may be a child of <scene>, <test> or <suite>, or of what is in them.
std::vector<std::string_view> all_tags();

// The tags of the elements that `tag` may stand in; none where it is a parameter (it may stand in every object), the
// root of a file, or unknown.
std::vector<std::string_view> parents_of(std::string_view tag);

// Why `child` may not stand in `parent`, and where it belongs: "a <scene> cannot contain a <rfilter>; it belongs in
// <camera>"; or what is wrong with the tag itself. For children that `parent` does not take.
std::string rejection(const Element& parent, const Element& child);

// "a bsdf", "an emitter", "an <include>".
std::string with_article(std::string_view noun);

} // namespace plumb
