// SPDX-License-Identifier: MIT
#include "suite_file/suite_names.h"

#include "plumb/suite_file/suite.h"

#include <algorithm>
#include <system_error>

namespace plumb {

namespace fs = std::filesystem;

bool is_pattern(std::string_view text)
{
    return text.find_first_of("*?") != text.npos;
}

std::vector<std::string_view> words_of(std::string_view text)
{
    constexpr std::string_view separators = ", \t\r\n";
    std::vector<std::string_view> words;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
        if (text.empty()) return words;
        const std::size_t end = std::min(text.find_first_of(separators), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

NamedFile find_scene(const fs::path& directory, const std::string& text)
{
    if (!is_pattern(text)) return find_named_file(directory, text);
    const std::size_t slash = text.find_last_of("/\\");
    if (slash == text.npos) return {directory / text, {}, {}};
    return {find_named_file(directory, text.substr(0, slash)).path / text.substr(slash + 1), {}, {}};
}

std::vector<fs::path> matching_files(const fs::path& pattern)
{
    std::vector<fs::path> files;
    std::error_code problem;
    const fs::path directory = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
    for (fs::directory_iterator entry(directory, problem), end; !problem && entry != end;
         entry.increment(problem))
        if (entry->is_regular_file(problem) &&
            matches_pattern(entry->path().filename().string(), pattern.filename().string()))
            files.push_back(pattern.parent_path() / entry->path().filename());
    std::sort(files.begin(), files.end());
    return files;
}

bool is_inner_name(const std::string& name)
{
    const fs::path path(name);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    return path.has_filename() && !path.is_absolute() && path == path.lexically_normal() &&
           *path.begin() != ".." && *path.begin() != "." &&
           std::none_of(name.begin(), name.end(), is_control);
}

bool matches_pattern(std::string_view text, std::string_view pattern)
{
    // After a mismatch, the last * takes one character more.
    std::size_t t = 0, p = 0, star = pattern.npos, star_text = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            star_text = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != pattern.npos) {
            p = star + 1;
            t = ++star_text;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == pattern.npos;
}

} // namespace plumb
