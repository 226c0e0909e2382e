// SPDX-License-Identifier: MIT
#pragma once

// The words of Mitsuba's scene files, and what is somewhere else in them.

#include "scene_file/dialects.h"
#include "scene_file/vocabulary.h"

namespace plumb {

// Whether a root is that of a Mitsuba file: it has a `version`. A file that names its dialect is ours.
bool is_mitsuba_scene(const Element& root);
// The words of that version. Null: it is not supported, which is reported.
const Vocabulary* mitsuba_vocabulary(const Element& root, Diagnostics& diagnostics);

// "mitsuba3" or "mitsuba06"; null for other names.
const Vocabulary* mitsuba_vocabulary_named(std::string_view name);

// What the loader would else look for in the file. The command line cannot name another dialect.
DialectChoice mitsuba_choice(const Element& root, const DialectWishes& wishes, Diagnostics& diagnostics);

// Moves what is somewhere else in our own files, and adds what Mitsuba has by default. For Vocabulary::order.
void order_mitsuba(Element& root, Diagnostics& diagnostics);

} // namespace plumb
