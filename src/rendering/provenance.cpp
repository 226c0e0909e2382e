// SPDX-License-Identifier: MIT
#include "rendering/provenance.h"

#include "base/text.h"

#include "plumb/base/error.h"
#include "plumb/model/sampler.h"
#include "plumb/settings/settings_header.h"

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
        if (const auto* const numbers = std::get_if<std::vector<float>>(&value))
            return fmt::format("{}", fmt::join(*numbers, " "));
        return std::get<std::string>(value);
    }
    return "none";
}

// Which settings are not the same, of headers whose inputs are.
std::vector<std::string> setting_changes(const Metadata& then, const Metadata& now)
{
    std::vector<std::string> changes;
    try {
        changes = differences(settings_of_header(then), settings_of_header(now), Effect::samples);
    } catch (const Error&) {
        // whoever reads the settings says so
    }
    if (changes.empty()) changes.emplace_back("the settings differ");
    return changes;
}

constexpr const char* vendor = "the processor vendor";

std::string change_text(std::string_view meaning, std::string_view was, std::string_view is)
{
    return fmt::format("{} was {} and is {}", meaning, was, is);
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

std::optional<std::uint64_t> header_samples(const Metadata& header, std::string_view name,
                                            const std::string& file)
{
    const auto there =
        std::find_if(header.begin(), header.end(), [&](const auto& entry) { return entry.first == name; });
    if (there == header.end()) return std::nullopt;
    const int* const samples = std::get_if<int>(&there->second);
    if (!samples || *samples < 1 || static_cast<std::uint64_t>(*samples) > max_samples_per_pixel)
        throw Error(fmt::format("the header of '{}' is invalid: {} must be an integer from 1 to {}, not {}",
                                file, name, max_samples_per_pixel, value_text(header, name)));
    return static_cast<std::uint64_t>(*samples);
}

RenderSettings header_settings(const Metadata& header, const std::string& file)
{
    try {
        return settings_of_header(header);
    } catch (const Error& problem) {
        throw Error(fmt::format("the header of '{}' is invalid: {}", file, problem.what()));
    }
}

bool has_old_hashes(const Metadata& header)
{
    constexpr std::size_t digits = 32; // SHA-256 has 64
    return header_text(header, "plumb:inputHash").size() == digits;
}

std::vector<std::string> input_changes(const Metadata& then, const Metadata& now)
{
    std::map<std::string, std::string> expected = hash_of_name(header_text(then, "plumb:inputs"));
    std::vector<std::string> changes;
    for (const auto& [name, hash] : hash_of_name(header_text(now, "plumb:inputs"))) {
        const auto found = expected.find(name);
        if (found == expected.end())
            changes.push_back(fmt::format("'{}' is a new input", name));
        else if (found->second != hash)
            changes.push_back(fmt::format("'{}' has changed", name));
        if (found != expected.end()) expected.erase(found);
    }
    for (const auto& [name, hash] : expected)
        changes.push_back(fmt::format("'{}' is no longer an input", name));
    return changes;
}

std::string vendor_change(const Metadata& then, const Metadata& now)
{
    return change_text(vendor, value_text(then, processor_entry), value_text(now, processor_entry));
}

std::vector<std::string> sample_changes(const Metadata& then, const Metadata& now)
{
    constexpr std::pair<const char*, const char*> settings[] = {
        {"Software", "the program"},
        {"plumb:workProgram", "the hash of the program"},
        {"plumb:definitions", "--define"},
        {"plumb:integrator", "the integrator"},
        {"plumb:sampler", "the sampler"},
        {"plumb:samplerTotal", "the sampler's total number of samples"},
        {"plumb:adaptive", "--adaptive"},
        {"plumb:seed", "the seed"},
        {"plumb:dialect", "the dialect"},
        {"plumb:emitters", "--emitters"},
        {"plumb:mirror", "--mirror"},
        {"plumb:point", "the unit of point lights"},
        {"plumb:envmapFlipped", "the flip of environment images"},
        {"plumb:envmapScale", "the scale of environment images"},
        {"plumb:instructionSet", "the instruction set"},
        {"plumb:embree", "Embree's version"},
        {processor_entry, vendor},
        {"plumb:jpegDecoder", "the JPEG decoder"},
    };
    if (has_old_hashes(then) != has_old_hashes(now))
        return {
            "it identifies its inputs by hashes of Plumb 0.1, not by SHA-256, so they cannot be verified"};
    std::vector<std::string> changes = input_changes(then, now);
    for (const auto& [name, meaning] : settings)
        if (const std::string was = value_text(then, name), is = value_text(now, name); was != is)
            changes.push_back(change_text(meaning, was, is));
    if (const int was = language_of(then), is = language_of(now); was != is)
        changes.push_back(fmt::format("the version of the scene language was {} and is {}", was, is));
    if (changes.empty() && value_text(then, "plumb:inputHash") != value_text(now, "plumb:inputHash"))
        changes = setting_changes(then, now);
    return changes;
}

} // namespace plumb
