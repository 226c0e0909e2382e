// SPDX-License-Identifier: MIT
#include "fuzz/image_text.h"

#include <charconv>
#include <fmt/format.h>

namespace plumb::fuzz {
namespace {

// The text up to the separator, which it is shortened by.
std::string_view take_until(std::string_view& text, char separator)
{
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

template <class Number>
Number number(std::string_view text, Number otherwise = {})
{
    Number value = otherwise;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::vector<std::string> words_of(std::string_view text)
{
    std::vector<std::string> words;
    while (!text.empty())
        if (const std::string_view word = take_until(text, ' '); !word.empty()) words.emplace_back(word);
    return words;
}

// \n is a line end; any other character behind a backslash is itself.
std::string unescaped(std::string_view text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '\\' && i + 1 < text.size();
        if (escape) ++i;
        result += escape && text[i] == 'n' ? '\n' : text[i];
    }
    return result;
}

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\\' || c == '\n') result += '\\';
        result += c == '\n' ? 'n' : c;
    }
    return result;
}

void parse_window(std::string_view text, TextImage& image)
{
    const std::vector<std::string> words = words_of(text);
    const auto word = [&](std::size_t i) { return number<int>(i < words.size() ? words[i] : "", 1); };
    image.data = {word(0), word(1), word(2), word(3)};
    image.full_width = word(5);
    image.full_height = word(6);
}

void parse_line(std::string_view line, TextImage& image)
{
    const std::string_view kind = take_until(line, ' ');
    if (kind == "window") parse_window(line, image);
    if (kind == "floats") image.floats = words_of(line);
    if (kind == "words") image.words = words_of(line);
    if (kind == "levels") image.integer_levels = number<std::size_t>(line);
    if (kind != "int" && kind != "text" && kind != "float" && kind != "list") return;
    const std::string name(take_until(line, ' '));
    if (kind == "int") image.metadata.emplace_back(name, number<int>(line));
    if (kind == "text") image.metadata.emplace_back(name, unescaped(line));
    if (kind == "float") image.metadata.emplace_back(name, number<float>(line));
    if (kind != "list") return;
    std::vector<float> list;
    for (const std::string& word : words_of(line)) list.push_back(number<float>(word));
    image.metadata.emplace_back(name, std::move(list));
}

std::string entry_text(const std::string& name, const MetadataValue& value)
{
    if (const int* const integer = std::get_if<int>(&value))
        return fmt::format("int {} {}\n", name, *integer);
    if (const float* const real = std::get_if<float>(&value))
        return fmt::format("float {} {}\n", name, *real);
    if (const std::string* const text = std::get_if<std::string>(&value))
        return fmt::format("text {} {}\n", name, escaped(*text));
    std::string line = "list " + name;
    for (const float element : std::get<std::vector<float>>(value)) line += fmt::format(" {}", element);
    return line + "\n";
}

std::string channels_text(std::string line, const std::vector<std::string>& names)
{
    for (const std::string& name : names) line += " " + name;
    return line + "\n";
}

} // namespace

std::size_t TextImage::size() const
{
    return static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height) * channels();
}

std::uint32_t TextImage::value(std::size_t index) const
{
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4 && 4 * index + i < values.size(); ++i)
        result |= std::uint32_t{static_cast<unsigned char>(values[4 * index + i])} << 8 * i;
    return result;
}

TextImage parse_image(std::string_view text)
{
    TextImage image;
    while (!text.empty()) {
        const std::string_view line = take_until(text, '\n');
        if (line == "pixels") {
            image.values = text;
            break;
        }
        parse_line(line, image);
    }
    return image;
}

std::string image_text(const TextImage& image)
{
    const PixelRect& data = image.data;
    std::string text = fmt::format("window {} {} {} {} of {} {}\n", data.x, data.y, data.width, data.height,
                                   image.full_width, image.full_height);
    text += channels_text("floats", image.floats);
    if (!image.words.empty()) text += channels_text("words", image.words);
    if (image.integer_levels > 0) text += fmt::format("levels {}\n", image.integer_levels);
    for (const auto& [name, value] : image.metadata) text += entry_text(name, value);
    return text + "pixels\n" + image.values;
}

std::vector<std::string_view> split_images(std::string_view text)
{
    std::vector<std::string_view> images;
    for (std::size_t end = 0; (end = text.find(image_separator)) != std::string_view::npos;) {
        images.push_back(text.substr(0, end));
        text.remove_prefix(end + image_separator.size());
    }
    images.push_back(text);
    return images;
}

} // namespace plumb::fuzz
