// SPDX-License-Identifier: MIT
#include "core/named_file.h"

#include "core/lower_case.h"

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

// As a path from `folder`, with / between the parts.
std::string seen_from(const fs::path& folder, const fs::path& path)
{
    std::error_code problem;
    const fs::path relative = fs::proximate(path, folder.empty() ? fs::path(".") : folder, problem);
    return (problem ? path : relative).generic_string();
}

// The entry of a folder whose name differs from `name` in upper and lower case only; of several, the first.
std::optional<fs::path> entry_like(const fs::path& folder, const fs::path& name)
{
    std::optional<std::string> found;
    const std::string wanted = lower_case(name.string());
    std::error_code problem;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, problem), end;
         !problem && entry != end; entry.increment(problem)) {
        const std::string candidate = entry->path().filename().string();
        if (lower_case(candidate) == wanted && (!found || candidate < *found)) found = candidate;
    }
    if (!found) return {};
    return folder / *found;
}

// What `name` means in `folder` if upper and lower case make no difference.
std::optional<fs::path> path_like(const fs::path& folder, const fs::path& name)
{
    fs::path path = name.is_absolute() ? name.root_path() : folder;
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

std::string way_out_of(const fs::path& folder, const fs::path& name)
{
    // The names in another spelling; and the file alone, of a path on somebody else's computer.
    for (const fs::path& candidate : {name, name.filename()}) {
        if (candidate.empty()) continue;
        const auto like = path_like(folder, candidate);
        if (like && is_there(*like)) return fmt::format("; did you mean '{}'?", seen_from(folder, *like));
    }
    if (const auto like = path_like({}, name); like && is_there(*like))
        return fmt::format("; did you mean '{}'?", seen_from(folder, *like));
    return {};
}

} // namespace

NamedFile find_named_file(const fs::path& folder, const std::string& name)
{
    const fs::path beside = (folder / name).lexically_normal();
    if (name.empty() || is_there(beside)) return {beside, {}, {}};
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    if (const fs::path path = (folder / slashes).lexically_normal(); is_there(path)) return {path, {}, {}};
    for (const std::string& text : {name, slashes}) {
        const fs::path here = fs::path(text).lexically_normal();
        if (is_there(here))
            return {here,
                    {},
                    fmt::format("'{}' is not beside '{}' but in the working directory, so another run may "
                                "find another file or none; write '{}'",
                                here.string(), folder.string(), seen_from(folder, here))};
    }
    return {beside, way_out_of(folder, slashes), {}};
}

} // namespace plumb
