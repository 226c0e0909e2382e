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
    return {beside, way_out_of(directory, slashes), {}};
}

} // namespace plumb
