// SPDX-License-Identifier: MIT
#pragma once

// The samples of scene language in the doc blocks of plugins: every one is a test case, so that a new type is tested when
// it has its row in the catalog. Files that they name are made up.

#include "scene_file/catalog.h"
#include "scene_file/document.h"
#include "scene_file/manual.h"
#include "scene_file/objects.h"
#include "scene_file/shared_objects.h"
#include "support/temp_folder.h"

#include <set>
#include <stdexcept>

namespace plumb::test {

// The indented XML elements of a manual page, in order.
std::vector<std::string> samples_in(std::string_view manual);

// One sample as a tree, with the files that it names.
class Sample {
public:
    explicit Sample(const std::string& xml);

    const Element& element() const { return element_; }
    const std::string& text() const { return text_; }

    // Throws std::runtime_error with all that is wrong with it. element: this one or one inside it.
    template <class Kind>
    std::unique_ptr<Kind> build(std::span<const Entry<Kind>> entries, const Element& element,
                                const Shape* parent = nullptr) const
    {
        Diagnostics diagnostics;
        const Dialect dialect;
        LoadContext context{diagnostics, dialect, false, {}};
        SharedObjects shared(element, context);
        ObjectReader reader(element, context, {"emitter", "rfilter"});
        reader.params().set_parent_shape(parent);
        std::unique_ptr<Kind> built = reader.build(entries);
        if (diagnostics.has_errors() || !built) throw std::runtime_error(complaints(diagnostics));
        return built;
    }
    template <class Kind>
    std::unique_ptr<Kind> build(std::span<const Entry<Kind>> entries) const
    {
        return build(entries, element_);
    }

private:
    std::string complaints(const Diagnostics& diagnostics) const;

    TempFolder folder_;
    std::string text_;
    Element element_;
};

// All samples of a table, those of each class once.
template <class Kind>
std::vector<std::unique_ptr<Sample>> samples_of(std::span<const Entry<Kind>> entries)
{
    std::vector<std::unique_ptr<Sample>> samples;
    std::set<std::string_view> seen;
    for (const Entry<Kind>& entry : entries)
        if (seen.insert(entry.class_name).second)
            for (const std::string& text : samples_in(plugin_source_manual(entry.class_name)))
                samples.push_back(std::make_unique<Sample>(text));
    return samples;
}

} // namespace plumb::test
