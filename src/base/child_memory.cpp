// SPDX-License-Identifier: MIT
#include "base/child_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <vector>

namespace plumb {

namespace {

constexpr std::size_t most_processes = 256;

std::uint64_t peak_of(pid_t process)
{
    std::ifstream file(fmt::format("/proc/{}/status", process));
    constexpr std::string_view key = "VmHWM:";
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) * 1024;
    return 0;
}

} // namespace

std::uint64_t peak_memory_below(pid_t process)
{
    std::uint64_t peak = 0;
    std::vector<pid_t> processes = {process};
    for (std::size_t i = 0; i < processes.size() && i < most_processes; ++i) {
        peak = std::max(peak, peak_of(processes[i]));
        std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", processes[i]));
        for (pid_t child = 0; children >> child;) processes.push_back(child);
    }
    return peak;
}

} // namespace plumb
