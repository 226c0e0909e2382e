// SPDX-License-Identifier: MIT
#pragma once

// The words of Plumb's own scene language and of the courses' dialects of it, all of Nori's family.

#include "scene_file/dialects.h"
#include "scene_file/vocabulary.h"

#include <list>

namespace plumb {

const Vocabulary& nori_vocabulary(DialectName name);

// Types that have another name in the catalog, in every dialect of the family.
std::span<const TypeName> other_type_names();
// The manual page of `type` under its other name. manual: of our type.
std::string manual_of_other_name(const TypeName& type, std::string_view manual);

// The presets that a reading is made of: what evidence or the command line may decide otherwise than the dialect.
class Readings {
public:
    Readings(const Dialect& dialect, const DialectWishes& wishes);
    std::span<const Preset> presets() const { return presets_; }

private:
    std::list<std::string> texts_; // that the presets refer to
    std::vector<Preset> presets_;
};

// The tree in our own words.
Element arrange(Element root, const Dialect& dialect, const DialectWishes& wishes, Diagnostics& diagnostics);

} // namespace plumb
