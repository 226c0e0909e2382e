// SPDX-License-Identifier: MIT
#pragma once

// What SettingRow::get returns of one value. Numbers have the shortest text that reads back as the same number.

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

using Texts = std::vector<std::string>;

template <class T>
Texts text_unless(const T& value, const T& usual)
{
    return value == usual ? Texts() : Texts{fmt::format("{}", value)};
}

template <class T>
Texts optional_text(const std::optional<T>& value)
{
    return value ? Texts{fmt::format("{}", *value)} : Texts();
}

// One of two words.
template <class T>
Texts word_text(const std::optional<T>& value, T first, const char* word, const char* other)
{
    return value ? Texts{*value == first ? word : other} : Texts();
}

inline Texts switch_text(bool on)
{
    return on ? Texts{"true"} : Texts();
}

} // namespace plumb
