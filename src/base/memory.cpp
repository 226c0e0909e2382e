// SPDX-License-Identifier: MIT
#include "base/memory.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <sys/resource.h>

namespace plumb {

namespace {

std::optional<std::uint64_t> first_number(const char* path)
{
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return number;
    return {};
}

// The bytes of a line like "MemAvailable:  12345 kB"; Linux only.
std::optional<std::uint64_t> bytes_of(const char* path, std::string_view key)
{
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(key)) return std::stoull(line.substr(key.size())) * 1024;
    return {};
}

// Of the whole machine.
std::optional<std::uint64_t> machine_memory()
{
    return bytes_of("/proc/meminfo", "MemAvailable:");
}

// Of the container that this process runs in.
std::optional<std::uint64_t> container_memory()
{
    const auto limit = first_number("/sys/fs/cgroup/memory.max"); // the word "max" where there is no limit
    const auto used = first_number("/sys/fs/cgroup/memory.current");
    if (!limit || !used) return {};
    return *limit - std::min(*limit, *used);
}

std::optional<std::uint64_t> process_limit()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    return static_cast<std::uint64_t>(limit.rlim_cur);
}

} // namespace

std::optional<std::uint64_t> available_memory()
{
    std::optional<std::uint64_t> least;
    for (const auto& bytes : {machine_memory(), container_memory(), process_limit()})
        if (bytes) least = std::min(*bytes, least.value_or(*bytes));
    return least;
}

std::uint64_t peak_memory()
{
    if (const auto peak = bytes_of("/proc/self/status", "VmHWM:")) return *peak;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void prefer_large_pages(void* begin, std::size_t bytes)
{
    constexpr std::size_t page = std::size_t{2} << 20;
    void* first = begin;
    std::size_t left = bytes;
    if (!std::align(page, page, first, left)) return;
    madvise(first, left / page * page, MADV_HUGEPAGE); // if it will not, the pages are small
}

} // namespace plumb
