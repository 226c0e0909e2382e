// SPDX-License-Identifier: MIT
#include "scene_file/file_order.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace plumb {

std::vector<Diagnostic> in_file_order(const std::vector<Diagnostic>& diagnostics,
                                      const std::vector<std::shared_ptr<const TextFile>>& files)
{
    struct Group {
        std::size_t file = 0; // errors without a place come first
        int line = 0;
        int column = 0;
        std::vector<Diagnostic> members;
    };
    std::vector<Group> groups;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity != Severity::note || groups.empty()) groups.emplace_back();
        Group& group = groups.back();
        // What is wrong in a mesh's own lines stands where the scene file names the mesh.
        for (std::size_t i = 0; i < files.size() && group.file == 0; ++i) {
            if (files[i]->path().string() != diagnostic.location.file) continue;
            group.file = i + 1;
            group.line = diagnostic.location.line;
            group.column = diagnostic.location.column;
        }
        group.members.push_back(diagnostic);
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
    });
    std::vector<Diagnostic> sorted;
    for (Group& group : groups)
        std::move(group.members.begin(), group.members.end(), std::back_inserter(sorted));
    return sorted;
}

} // namespace plumb
