// SPDX-License-Identifier: MIT
#include "core/memory.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>

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

// Of the whole machine; Linux only.
std::optional<std::uint64_t> machine_memory()
{
    std::ifstream file("/proc/meminfo");
    std::string key, unit;
    std::uint64_t kibibytes = 0;
    while (file >> key >> kibibytes) {
        std::getline(file, unit);
        if (key == "MemAvailable:") return kibibytes * 1024;
    }
    return {};
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

void prefer_large_pages(void* begin, std::size_t bytes)
{
    constexpr std::size_t page = std::size_t{2} << 20;
    void* first = begin;
    std::size_t left = bytes;
    if (!std::align(page, page, first, left)) return;
    madvise(first, left / page * page, MADV_HUGEPAGE); // if it will not, the pages are small
}

} // namespace plumb
