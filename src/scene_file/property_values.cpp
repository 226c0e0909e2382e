// SPDX-License-Identifier: MIT
#include "scene_file/property_values.h"

#include "base/lower_case.h"
#include "scene_file/placement.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view separators = ", \t\r\n";
constexpr std::string_view tags_of_properties[] = {"boolean", "integer", "float", "string",
                                                   "point",   "vector",  "color", "transform"};

// Long values are cut in messages.
std::string in_quotes(std::string_view text)
{
    constexpr std::size_t longest = 40;
    return fmt::format("'{}{}'", text.substr(0, longest), text.size() > longest ? "..." : "");
}

// Part of a value.
struct Token {
    std::string_view text;
    std::size_t begin = 0;
};

Token trimmed(std::string_view text)
{
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    const std::size_t end = text.find_last_not_of(blanks);
    return {text.substr(begin, end == text.npos ? 0 : end + 1 - begin), begin};
}

std::vector<Token> split(std::string_view text)
{
    std::vector<Token> tokens;
    for (std::size_t i = text.find_first_not_of(separators); i != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, i), text.size());
        tokens.push_back({text.substr(i, end - i), i});
        i = text.find_first_not_of(separators, end);
    }
    return tokens;
}

// from_chars knows no leading +.
std::string_view without_plus(std::string_view text)
{
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
    return plus ? text.substr(1) : text;
}

class ValueReader {
public:
    ValueReader(const Element& element, const Attribute& attribute, Diagnostics& diagnostics)
        : element_(element), attribute_(attribute), diagnostics_(diagnostics)
    {}

    std::nullopt_t fail(const Token& token, std::string message) const
    {
        if (!attribute_.broken)
            diagnostics_.error(element_.part_place(attribute_, token.begin, token.text.size()),
                               std::move(message));
        return std::nullopt;
    }

    std::nullopt_t fail(std::string message) const
    {
        if (!attribute_.broken) diagnostics_.error(element_.value_place(attribute_), std::move(message));
        return std::nullopt;
    }

    std::optional<double> number(const Token& token) const
    {
        if (token.text.empty()) return fail("expected a number, not an empty value");
        const std::string_view digits = without_plus(token.text);
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
            return fail(token, fmt::format("{} is not a number", in_quotes(token.text)));
        if (error == std::errc::result_out_of_range)
            return fail(token, fmt::format("{} is out of range for a number", in_quotes(token.text)));
        if (!std::isfinite(value))
            return fail(token, fmt::format("{} is not a finite number", in_quotes(token.text)));
        if (!std::isfinite(static_cast<float>(value)))
            return fail(token,
                        fmt::format("{} is too large; numbers go up to 3.4e38", in_quotes(token.text)));
        return value;
    }

    // Complains of each that is wrong.
    std::optional<std::vector<double>> numbers(const std::vector<Token>& tokens) const
    {
        std::vector<double> numbers;
        for (const Token& token : tokens)
            if (const auto value = number(token)) numbers.push_back(*value);
        if (numbers.size() != tokens.size()) return {};
        return numbers;
    }

private:
    const Element& element_;
    const Attribute& attribute_;
    Diagnostics& diagnostics_;
};

std::string counts_text(std::initializer_list<std::size_t> counts)
{
    std::string text;
    for (const std::size_t count : counts) text += (text.empty() ? "" : " or ") + std::to_string(count);
    return text;
}

std::optional<Property::Value> read_value(const Element& element, const Attribute& value,
                                          Diagnostics& diagnostics)
{
    const auto wrap = [](auto result) -> std::optional<Property::Value> {
        if (!result) return {};
        return Property::Value(*std::move(result));
    };
    if (element.tag == "boolean") return wrap(read_boolean(element, value, diagnostics));
    if (element.tag == "integer") return wrap(read_integer(element, value, diagnostics));
    if (element.tag == "float") return wrap(read_number(element, value, diagnostics));
    if (element.tag == "string") return Property::Value(value.value);
    if (element.tag == "color") return wrap(read_numbers(element, value, {3}, diagnostics));
    return wrap(read_numbers(element, value, {3, 2}, diagnostics)); // point, vector
}

} // namespace

std::optional<double> read_number(const Element& element, const Attribute& attribute,
                                  Diagnostics& diagnostics)
{
    return ValueReader(element, attribute, diagnostics).number(trimmed(attribute.value));
}

std::optional<std::vector<double>> read_numbers(const Element& element, const Attribute& attribute,
                                                std::initializer_list<std::size_t> counts,
                                                Diagnostics& diagnostics)
{
    const ValueReader reader(element, attribute, diagnostics);
    const std::vector<Token> tokens = split(attribute.value);
    const auto numbers = reader.numbers(tokens);
    if (std::find(counts.begin(), counts.end(), tokens.size()) == counts.end())
        return reader.fail(fmt::format("expected {} numbers, not {}", counts_text(counts), tokens.size()));
    return numbers;
}

std::optional<std::vector<double>> read_number_list(const Element& element, const Attribute& attribute,
                                                    Diagnostics& diagnostics)
{
    const ValueReader reader(element, attribute, diagnostics);
    const std::vector<Token> tokens = split(attribute.value);
    if (tokens.empty()) return reader.fail("expected a list of numbers, not an empty value");
    return reader.numbers(tokens);
}

std::optional<bool> read_boolean(const Element& element, const Attribute& attribute, Diagnostics& diagnostics)
{
    const std::string word = lower_case(std::string(trimmed(attribute.value).text));
    if (word == "true") return true;
    if (word == "false") return false;
    return ValueReader(element, attribute, diagnostics)
        .fail(fmt::format("expected true or false, not {}", in_quotes(attribute.value)));
}

std::optional<std::int64_t> read_integer(const Element& element, const Attribute& attribute,
                                         Diagnostics& diagnostics)
{
    const ValueReader reader(element, attribute, diagnostics);
    const Token token = trimmed(attribute.value);
    const std::string_view digits = without_plus(token.text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        return reader.fail(fmt::format("expected an integer, not {}", in_quotes(attribute.value)));
    if (error == std::errc::result_out_of_range)
        return reader.fail(fmt::format("{} is too large for an integer", in_quotes(attribute.value)));
    return value;
}

bool check_attributes(const Element& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional, Diagnostics& diagnostics)
{
    std::vector<std::string_view> known(required);
    known.insert(known.end(), optional);
    for (const Attribute& attribute : element.attributes)
        if (std::find(known.begin(), known.end(), attribute.name) == known.end())
            diagnostics.error(
                element.name_place(attribute),
                fmt::format("unknown attribute '{}' for <{}>{}", attribute.name, element.tag,
                            known.empty() ? "; it takes none" : way_out(attribute.name, known)));
    bool complete = true;
    for (const std::string_view name : required) {
        if (element.attribute(name)) continue;
        complete = false;
        diagnostics.error(
            element.place(),
            fmt::format("<{0}> needs an attribute '{1}': <{0} {1}=\"...\" .../>", element.tag, name));
    }
    return complete;
}

std::span<const std::string_view> property_tags()
{
    return tags_of_properties;
}

bool is_property_tag(std::string_view tag)
{
    return std::find(std::begin(tags_of_properties), std::end(tags_of_properties), tag) !=
           std::end(tags_of_properties);
}

std::optional<Property> read_property(const Element& element, Diagnostics& diagnostics)
{
    Property property;
    property.tag = element.tag;
    std::optional<Property::Value> value;
    if (element.tag == "transform") {
        check_attributes(element, {"name"}, {}, diagnostics);
        property.value_at = element.place();
        if (const auto transform = read_transform(element, diagnostics)) value = *transform;
    } else {
        check_attributes(element, {"name", "value"}, {}, diagnostics);
        for (const Element& child : element.children)
            diagnostics.error(child.place(), rejection(element, child));
        if (const Attribute* attribute = element.attribute("value")) {
            property.text = attribute->value;
            property.value_at = element.value_place(*attribute);
            if (!attribute->broken) value = read_value(element, *attribute, diagnostics);
        }
    }
    const Attribute* name = element.attribute("name");
    if (!name) return {};
    property.name_at = element.value_place(*name);
    property.broken = !value;
    if (value) property.value = *std::move(value);
    return property;
}

} // namespace plumb
