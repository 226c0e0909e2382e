// SPDX-License-Identifier: MIT
#include "plumb/scene/instruction_set.h"

namespace plumb {
namespace {

// The compiler's builtin wants its word as it stands.
#if defined(__x86_64__)
constexpr InstructionSet known[] = {
    {"sse2", "isa=sse2", [] { return __builtin_cpu_supports("sse2") != 0; }},
    {"sse4.2", "isa=sse4.2", [] { return __builtin_cpu_supports("sse4.2") != 0; }},
    {"avx", "isa=avx", [] { return __builtin_cpu_supports("avx") != 0; }},
    {"avx2", "isa=avx2", [] { return __builtin_cpu_supports("avx2") != 0; }},
    {"avx512", "isa=avx512",
     [] { return __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0; }},
};
constexpr const InstructionSet& usual = known[3];
#elif defined(__aarch64__)
// Every 64-bit ARM has it. Embree knows it as SSE2, translated to NEON, and so it must be told.
constexpr InstructionSet known[] = {{"neon", "isa=sse2", [] { return true; }}};
constexpr const InstructionSet& usual = known[0];
#else
// We have never seen Embree on anything else: it may choose.
constexpr InstructionSet known[] = {{"default", "", [] { return true; }}};
constexpr const InstructionSet& usual = known[0];
#endif

} // namespace

std::span<const InstructionSet> instruction_sets()
{
    return known;
}

std::vector<std::string_view> instruction_set_names()
{
    std::vector<std::string_view> names;
    for (const InstructionSet& set : known) names.push_back(set.name);
    return names;
}

const InstructionSet& default_instruction_set()
{
    return usual;
}

} // namespace plumb
