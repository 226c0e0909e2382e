// SPDX-License-Identifier: MIT
#include "base/named_file.h"

#include "base/lower_case.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path)
{
    std::error_code ignored;
    return fs::exists(path, ignored);
}

// As a path from `directory`, with / between the parts.
std::string seen_from(const fs::path& directory, const fs::path& path)
{
    std::error_code problem;
    const fs::path relative = fs::proximate(path, directory.empty() ? fs::path(".") : directory, problem);
    return (problem ? path : relative).generic_string();
}

// The entry of a directory whose name differs from `name` in upper and lower case only; of several, the first.
std::optional<fs::path> entry_like(const fs::path& directory, const fs::path& name)
{
    std::optional<std::string> found;
    const std::string wanted = lower_case(name.string());
    std::error_code problem;
    for (fs::directory_iterator entry(directory.empty() ? fs::path(".") : directory, problem), end;
         !problem && entry != end; entry.increment(problem)) {
        const std::string candidate = entry->path().filename().string();
        if (lower_case(candidate) == wanted && (!found || candidate < *found)) found = candidate;
    }
    if (!found) return {};
    return directory / *found;
}

// What `name` means in `directory` if upper and lower case make no difference.
std::optional<fs::path> path_like(const fs::path& directory, const fs::path& name)
{
    fs::path path = name.is_absolute() ? name.root_path() : directory;
    for (const fs::path& part : name.relative_path()) {
        if (part.empty() || is_there(path / part)) {
            path /= part;
            continue;
        }
        const auto like = entry_like(path, part);
        if (!like) return {};
        path = *like;
    }
    return path.lexically_normal();
}

bool is_file(const fs::path& path)
{
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_of_windows(const std::string& name)
{
    return name.size() > 2 && name[1] == ':' && name[2] == '/' &&
           ((name[0] >= 'A' && name[0] <= 'Z') || (name[0] >= 'a' && name[0] <= 'z'));
}

// A path on somebody else's computer: as much of its end as names a file beside the scene; or of a relative one, which is
// relative to the directory in which somebody ran the program, in a directory that the scene's is in.
std::optional<fs::path> elsewhere(const fs::path& directory, const std::string& slashes)
{
    constexpr int levels = 8;
    const fs::path name = is_of_windows(slashes) ? fs::path(slashes.substr(2)) : fs::path(slashes);
    const fs::path relative = name.relative_path();
    const auto from = [&](fs::path::iterator first) {
        fs::path rest;
        for (; first != relative.end(); ++first) rest /= *first;
        return rest;
    };
    fs::path::iterator first = relative.begin();
    if (name.is_absolute()) {
        for (; first != relative.end(); ++first)
            if (const fs::path path = (directory / from(first)).lexically_normal(); is_file(path))
                return path;
        return {};
    }
    while (first != relative.end() && *first == "..") ++first;
    const fs::path rest = from(first);
    if (!rest.has_parent_path()) return {}; // there are many files of one name
    fs::path above = directory;
    for (int i = 0; i < levels; ++i) {
        above /= "..";
        if (const fs::path path = (above / rest).lexically_normal(); is_file(path)) return path;
    }
    return {};
}

std::string way_out_of(const fs::path& directory, const fs::path& name)
{
    // The names in another spelling; and the file alone, of a path on somebody else's computer.
    for (const fs::path& candidate : {name, name.filename()}) {
        if (candidate.empty()) continue;
        const auto like = path_like(directory, candidate);
        if (like && is_there(*like)) return fmt::format("; did you mean '{}'?", seen_from(directory, *like));
    }
    if (const auto like = path_like({}, name); like && is_there(*like))
        return fmt::format("; did you mean '{}'?", seen_from(directory, *like));
    return {};
}

} // namespace

NamedFile find_named_file(const fs::path& directory, const std::string& name)
{
    const fs::path beside = (directory / name).lexically_normal();
    if (name.empty() || is_there(beside)) return {beside, {}, {}};
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    if (const fs::path path = (directory / slashes).lexically_normal(); is_there(path)) return {path, {}, {}};
    for (const std::string& text : {name, slashes}) {
        const fs::path here = fs::path(text).lexically_normal();
        if (is_there(here))
            return {here,
                    {},
                    fmt::format("'{}' is not beside '{}' but in the working directory, so another run may "
                                "find another file or none; write '{}'",
                                here.string(), directory.string(), seen_from(directory, here))};
    }
    if (const auto path = elsewhere(directory, slashes))
        return {*path,
                {},
                fmt::format("'{}' does not exist; '{}' is read instead", name, seen_from(directory, *path))};
    return {beside, way_out_of(directory, slashes), {}};
}

} // namespace plumb
