// SPDX-License-Identifier: MIT
#include "scene_file/file_order.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace plumb {

std::vector<Diagnostic> in_file_order(const std::vector<Diagnostic>& diagnostics,
                                      const std::vector<std::shared_ptr<const TextFile>>& files)
{
    struct Message {
        std::size_t file = 0; // errors without a place come first
        int line = 0;
        int column = 0;
        std::vector<Diagnostic> members;
    };
    std::vector<Message> messages;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity != Severity::note || messages.empty()) messages.emplace_back();
        Message& message = messages.back();
        // What is wrong in a mesh's own lines stands where the scene file names the mesh.
        for (std::size_t i = 0; i < files.size() && message.file == 0; ++i) {
            if (files[i]->path().string() != diagnostic.location.file) continue;
            message.file = i + 1;
            message.line = diagnostic.location.line;
            message.column = diagnostic.location.column;
        }
        message.members.push_back(diagnostic);
    }
    std::stable_sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
        return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
    });
    std::vector<Diagnostic> sorted;
    for (Message& message : messages)
        std::move(message.members.begin(), message.members.end(), std::back_inserter(sorted));
    return sorted;
}

} // namespace plumb
