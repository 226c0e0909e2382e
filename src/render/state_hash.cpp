// SPDX-License-Identifier: MIT
#include "render/state_hash.h"

#include <bit>
#include <fmt/format.h>
#include <map>

namespace plumb {
namespace {

// The header as one text, in an order that no file changes. Without the hash, and without empty values, which no file keeps.
std::string text_of(const Metadata& header)
{
    const std::map<std::string, MetadataValue> sorted(header.begin(), header.end());
    std::string text;
    for (const auto& [name, value] : sorted) {
        if (name == state_hash_name || value == MetadataValue(std::string())) continue;
        text += name + "=";
        if (const int* const integer = std::get_if<int>(&value))
            text += fmt::format("{}", *integer);
        else if (const float* const number = std::get_if<float>(&value))
            text += fmt::format("{:x}", std::bit_cast<std::uint32_t>(*number));
        else if (const std::string* const string = std::get_if<std::string>(&value))
            text += *string;
        else
            for (const float element : std::get<std::vector<float>>(value))
                text += fmt::format("{:x} ", std::bit_cast<std::uint32_t>(element));
        text += "\n";
    }
    return text;
}

} // namespace

Metadata state_header(const Metadata& header)
{
    Metadata result;
    for (const auto& entry : header)
        if (entry.first.starts_with("plumb:") || entry.first == "Software" || entry.first == "worldToCamera")
            result.push_back(entry);
    return result;
}

std::string hash_of_row(std::span<const std::uint32_t> row)
{
    Hash128 hash;
    hash.update({reinterpret_cast<const char*>(row.data()), row.size_bytes()});
    return hash.hex();
}

StateHash::StateHash(const Metadata& header, const std::vector<std::string>& word_channels)
{
    hash_.update(text_of(header));
    for (const std::string& name : word_channels) hash_.update(name + "\n");
}

void StateHash::add(std::string_view row_hash)
{
    hash_.update(row_hash);
}

} // namespace plumb
