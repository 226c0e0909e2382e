// SPDX-License-Identifier: MIT
#include "base/lower_case.h"
#include "scene_file/dialects.h"

#include <algorithm>

namespace plumb {

namespace {

namespace fs = std::filesystem;

// A course's directory holds a dozen scenes. Where there are many more, files have other reasons to lie together.
constexpr std::size_t most_entries = 5000;
constexpr std::size_t most_files = 64;
constexpr std::uintmax_t most_bytes = 1U << 20; // of one

// Of regular files that are called .xml; nothing if there are too many.
std::vector<fs::path> xml_files_beside(const fs::path& scene)
{
    std::vector<fs::path> files;
    std::error_code failed;
    const fs::path directory = scene.parent_path().empty() ? fs::path(".") : scene.parent_path();
    std::size_t entries = 0;
    for (fs::directory_iterator entry(directory, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        if (++entries > most_entries) return {};
        std::error_code ignored;
        if (lower_case(entry->path().extension().string()) != ".xml" ||
            entry->path().filename() == scene.filename() || !entry->is_regular_file(ignored) ||
            entry->file_size(ignored) > most_bytes)
            continue;
        files.push_back(entry->path());
    }
    std::sort(files.begin(), files.end());
    return files.size() > most_files ? std::vector<fs::path>() : files;
}

} // namespace

std::vector<Element> scene_files_beside(const fs::path& scene)
{
    std::vector<Element> roots;
    for (const fs::path& file : xml_files_beside(scene)) {
        Diagnostics ignored; // what is wrong with other files is their own matter
        std::optional<Element> root;
        try {
            root = parse_document(file, read_text(file), ignored);
        } catch (const Error&) {
            continue;
        }
        if (!root || root->tag != "scene") continue;
        if (root->attribute("dialect")) return {};
        roots.push_back(*std::move(root));
    }
    return roots;
}

} // namespace plumb
