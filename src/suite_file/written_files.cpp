// SPDX-License-Identifier: MIT
#include "suite_file/written_files.h"

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include <fmt/format.h>

namespace plumb {

namespace {

// "_r12": the number; nothing for any other text.
std::optional<int> replica_of(std::string_view suffix)
{
    if (!suffix.starts_with("_r") || suffix.size() < 3 || suffix[2] == '0') return {};
    int number = 0;
    const char* const end = suffix.data() + suffix.size();
    const auto [stop, problem] = std::from_chars(suffix.data() + 2, end, number);
    return problem == std::errc() && stop == end && number > 0 ? std::optional(number) : std::nullopt;
}

// The file that an entry writes under its title and a suffix; empty: it writes none.
std::string written_file(const SuiteEntry& entry, std::string_view suffix)
{
    const std::string stem = entry.title() + std::string(suffix);
    const bool is_command = entry.foreign && !entry.foreign->command.empty();
    if (const auto replica = replica_of(suffix))
        return is_command && entry.foreign->replicas > 1 && *replica <= entry.foreign->replicas
                   ? stem + ".exr"
                   : "";
    if (suffix == "_diff" || suffix == "_significant") return entry.reference.empty() ? "" : stem + ".png";
    return suffix == "_work" && is_command ? stem : "";
}

} // namespace

void check_written_files(const std::vector<SuiteEntry>& entries, Diagnostics& diagnostics)
{
    std::unordered_map<std::string, const SuiteEntry*> by_title;
    for (const SuiteEntry& entry : entries) by_title.emplace(entry.title(), &entry);
    for (const SuiteEntry& entry : entries) {
        const std::string title = entry.title();
        const std::size_t cut = title.rfind('_');
        if (cut == title.npos) continue;
        const auto other = by_title.find(title.substr(0, cut));
        if (other == by_title.end()) continue;
        const std::string file = written_file(*other->second, title.substr(cut));
        if (file.empty()) continue;
        diagnostics.error(entry.at, fmt::format("two entries write '{}'; give one of them another name: "
                                                R"(<render name="..." .../>)",
                                                file));
        diagnostics.note(other->second->at, "the other one is here");
    }
}

} // namespace plumb
