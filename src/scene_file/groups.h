// SPDX-License-Identifier: MIT
#pragma once

// Groups of shapes, and their instances.

#include "plumb/scene/scene.h"
#include "scene_file/objects.h"

namespace plumb {

class Groups {
public:
    static bool takes(const Element& shape); // whether it is a group or an instance

    // Remembers it. A group may come after its instances.
    void add(const Element& shape);

    // All instances, in the order of the file. Groups without instances are checked, and a warning says so.
    std::vector<Instance> build(LoadContext& context);

private:
    struct Known {
        const Element* element;
        std::shared_ptr<const Group> group; // null if it could not be built, which has been reported
        bool used = false;
    };

    void build_groups(LoadContext& context);
    std::optional<Instance> instance(const Element& element, LoadContext& context);
    const Element* only_ref(const Element& instance, LoadContext& context) const;
    Known* named(const Element& ref, LoadContext& context);

    std::vector<const Element*> groups_;
    std::vector<const Element*> instances_;
    std::map<std::string, Known, std::less<>> by_id_;
};

} // namespace plumb
