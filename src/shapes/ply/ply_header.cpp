// SPDX-License-Identifier: MIT
#include "shapes/ply/ply_header.h"

#include "plumb/base/error.h"
#include "shapes/obj/obj_number.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t largest_header = std::size_t{1} << 20; // bytes
constexpr std::size_t most_properties = 10'000;
constexpr std::string_view blanks = " \t";

std::optional<PlyType> type_of(std::string_view name)
{
    static constexpr std::pair<std::string_view, PlyType> names[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const auto& [word, type] : names)
        if (word == name) return type;
    return std::nullopt;
}

class HeaderReader {
public:
    HeaderReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

    PlyHeader read()
    {
        if (!next_line() || line_ != "ply") fail(line_, "a PLY file starts with the line 'ply'");
        bool has_format = false;
        while (next_line()) {
            const std::vector<std::string_view> words = words_of(line_);
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "format") {
                read_format(words);
                has_format = true;
            } else if (words[0] == "element") {
                read_element(words);
            } else if (words[0] == "property") {
                read_property(words);
            } else if (words[0] == "end_header") {
                if (!has_format) fail(line_, "the header has no line 'format'");
                check_elements();
                header_.size = end_;
                return std::move(header_);
            } else {
                fail(words[0], fmt::format("unknown word '{}' in the header", excerpt(words[0])));
            }
        }
        fail(line_, "the header has no line 'end_header'");
    }

private:
    bool next_line()
    {
        if (end_ >= text_.size() || end_ > largest_header) return false;
        begin_ = end_;
        const std::size_t end = text_.find('\n', begin_);
        end_ = end == text_.npos ? text_.size() : end + 1;
        line_ = text_.substr(begin_, (end == text_.npos ? text_.size() : end) - begin_);
        line_ = line_.substr(0, largest_header);
        while (!line_.empty() && (line_.back() == '\r' || blanks.find(line_.back()) != blanks.npos))
            line_.remove_suffix(1);
        ++number_;
        return true;
    }

    static std::vector<std::string_view> words_of(std::string_view line)
    {
        std::vector<std::string_view> words;
        while (true) {
            line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
            if (line.empty()) return words;
            const std::size_t end = std::min(line.find_first_of(blanks), line.size());
            words.push_back(line.substr(0, end));
            line.remove_prefix(end);
        }
    }

    void read_format(const std::vector<std::string_view>& words)
    {
        if (words.size() != 3 || words[2] != "1.0") fail(line_, "must be 'format ascii 1.0' or the like");
        if (words[1] == "ascii")
            header_.format = PlyHeader::Format::ascii;
        else if (words[1] == "binary_little_endian")
            header_.format = PlyHeader::Format::little_endian;
        else if (words[1] == "binary_big_endian")
            header_.format = PlyHeader::Format::big_endian;
        else
            fail(words[1],
                 fmt::format(
                     "unknown format '{}'; known are ascii, binary_little_endian and binary_big_endian",
                     excerpt(words[1])));
    }

    void read_element(const std::vector<std::string_view>& words)
    {
        if (words.size() != 3) fail(line_, "must be 'element NAME COUNT'");
        PlyElement element;
        element.name = words[1];
        const char* const end = words[2].data() + words[2].size();
        const auto result = std::from_chars(words[2].data(), end, element.count);
        if (result.ec != std::errc() || result.ptr != end)
            fail(words[2],
                 fmt::format("'{}' is not a number of elements, a whole number from 0", excerpt(words[2])));
        for (const PlyElement& other : header_.elements)
            if (other.name == element.name)
                fail(words[1], fmt::format("a second element '{}'", excerpt(words[1])));
        if (header_.elements.size() >= most_properties) fail(words[0], "too many elements");
        header_.elements.push_back(std::move(element));
    }

    void read_property(const std::vector<std::string_view>& words)
    {
        if (header_.elements.empty()) fail(words[0], "a property must stand behind its element");
        const bool is_list = words.size() > 1 && words[1] == "list";
        if (words.size() != (is_list ? 5u : 3u))
            fail(line_, "must be 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
        PlyProperty property;
        if (is_list) {
            property.count_type = read_type(words[2]);
            if (!is_integer(*property.count_type))
                fail(words[2], "the number of values in a list must be of an integer type");
        }
        property.type = read_type(words[words.size() - 2]);
        property.name = words.back();
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        for (const PlyProperty& other : properties)
            if (other.name == property.name)
                fail(words.back(), fmt::format("a second property '{}'", excerpt(words.back())));
        if (properties.size() >= most_properties) fail(words[0], "too many properties");
        properties.push_back(std::move(property));
    }

    PlyType read_type(std::string_view word)
    {
        if (const auto type = type_of(word)) return *type;
        fail(word,
             fmt::format("unknown type '{}'; known are char, uchar, short, ushort, int, uint, float and "
                         "double",
                         excerpt(word)));
    }

    void check_elements()
    {
        for (const PlyElement& element : header_.elements)
            if (element.properties.empty())
                fail(line_, fmt::format("element '{}' has no properties", excerpt(element.name)));
    }

    // at: a part of the current line.
    [[noreturn]] void fail(std::string_view at, const std::string& message) const
    {
        const auto offset = at.empty() ? std::size_t{0} : static_cast<std::size_t>(at.data() - line_.data());
        throw FileError(
            SourceLocation::from_line(file_, number_, line_, offset, std::max<std::size_t>(at.size(), 1)),
            message);
    }

    const std::string& file_;
    std::string_view text_;
    PlyHeader header_;
    std::string_view line_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    int number_ = 0;
};

} // namespace

std::size_t size_of(PlyType type)
{
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::float64: return 8;
    }
    return 0;
}

bool is_integer(PlyType type)
{
    return type != PlyType::float32 && type != PlyType::float64;
}

std::size_t PlyElement::least_size() const
{
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += size_of(property.count_type.value_or(property.type));
    return size;
}

PlyHeader read_ply_header(const std::string& file, std::string_view text)
{
    return HeaderReader(file, text).read();
}

} // namespace plumb
