// SPDX-License-Identifier: MIT
#include "cli/provenance.h"

#include "cli/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace plumb {

namespace {

// A line of plumb:inputs is the hash of a file, a space and its name.
std::map<std::string, std::string> hash_of_name(const std::string& inputs)
{
    std::map<std::string, std::string> hashes;
    for (std::size_t begin = 0; begin < inputs.size();) {
        const std::size_t end = std::min(inputs.find('\n', begin), inputs.size());
        const std::size_t space = std::min(inputs.find(' ', begin), end);
        hashes.emplace(inputs.substr(std::min(space + 1, end), end - std::min(space + 1, end)),
                       inputs.substr(begin, space - begin));
        begin = end + 1;
    }
    return hashes;
}

std::string value_text(const Metadata& header, std::string_view name)
{
    for (const auto& [key, value] : header) {
        if (key != name) continue;
        if (const int* const integer = std::get_if<int>(&value)) return fmt::format("{}", *integer);
        if (const float* const number = std::get_if<float>(&value)) return fmt::format("{}", *number);
        return header_text(header, name);
    }
    return "none";
}

} // namespace

std::string header_text(const Metadata& header, std::string_view name)
{
    for (const auto& [key, value] : header)
        if (key == name)
            if (const std::string* const text = std::get_if<std::string>(&value)) return *text;
    return {};
}

std::optional<int> header_integer(const Metadata& header, std::string_view name)
{
    for (const auto& [key, value] : header)
        if (key == name)
            if (const int* const integer = std::get_if<int>(&value)) return *integer;
    return std::nullopt;
}

int language_of(const Metadata& header)
{
    return header_integer(header, "plumb:language").value_or(1); // whose headers do not say so
}

std::vector<std::string> input_changes(const Metadata& then, const Metadata& now)
{
    std::map<std::string, std::string> expected = hash_of_name(header_text(then, "plumb:inputs"));
    std::vector<std::string> changes;
    for (const auto& [name, hash] : hash_of_name(header_text(now, "plumb:inputs"))) {
        const auto found = expected.find(name);
        if (found == expected.end())
            changes.push_back(fmt::format("'{}' was not read then", name));
        else if (found->second != hash)
            changes.push_back(fmt::format("'{}' has changed", name));
        if (found != expected.end()) expected.erase(found);
    }
    for (const auto& [name, hash] : expected) changes.push_back(fmt::format("'{}' is no longer read", name));
    return changes;
}

std::vector<std::string> sample_changes(const Metadata& then, const Metadata& now)
{
    constexpr std::pair<const char*, const char*> settings[] = {
        {"Software", "the program"},
        {"plumb:workProgram", "the program's code"},
        {"plumb:definitions", "what --define says"},
        {"plumb:integrator", "the integrator"},
        {"plumb:sampler", "the sampler"},
        {"plumb:samplerTotal", "the total number of samples, on which those of the sampler depend,"},
        {"plumb:seed", "the seed"},
        {"plumb:dialect", "the dialect"},
        {"plumb:emitters", "what emitters do"},
        {"plumb:mirror", "the mirrored view"},
        {"plumb:point", "the unit of point lights"},
        {"plumb:envmapFlipped", "the flip of environment images"},
        {"plumb:envmapScale", "the scale of environment images"},
        {"plumb:instructionSet", "the instruction set"},
        {"plumb:embree", "Embree's version"},
        {"plumb:processor", "the processor's maker"},
    };
    std::vector<std::string> changes = input_changes(then, now);
    for (const auto& [name, meaning] : settings)
        if (const std::string was = value_text(then, name), is = value_text(now, name); was != is)
            changes.push_back(fmt::format("{} was {} and is {}", meaning, was, is));
    if (const int was = language_of(then), is = language_of(now); was != is)
        changes.push_back(fmt::format("the version of the scene language was {} and is {}", was, is));
    if (changes.empty() && value_text(then, "plumb:inputHash") != value_text(now, "plumb:inputHash"))
        changes.emplace_back("the options are not the same");
    return changes;
}

} // namespace plumb
