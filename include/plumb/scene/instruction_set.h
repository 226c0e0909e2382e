// SPDX-License-Identifier: MIT
#pragma once

// The instruction sets that Embree can be told to trace with, on the kind of processor that Plumb was built for. One
// of them is always named: Embree left to itself takes the best that the processor has, and the images of two
// machines would differ.

#include <span>
#include <string_view>
#include <vector>

namespace plumb {

struct InstructionSet {
    std::string_view name;     // ours: of --isa and of headers
    const char* embree_config; // what tells Embree, for rtcNewDevice
    bool (*runs_here)();       // whether this processor has it
};

std::span<const InstructionSet> instruction_sets(); // at least one, the smallest first
std::vector<std::string_view> instruction_set_names();
const InstructionSet& default_instruction_set();

} // namespace plumb
