// SPDX-License-Identifier: MIT
#include "plumb/model/params.h"

#include "base/named_file.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

std::string listed(const std::vector<std::string_view>& words)
{
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i)
        list += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == words.size() ? " or " : ", ", words[i]);
    return list;
}

const std::vector<double>& numbers(const Property& property)
{
    return std::get<std::vector<double>>(property.value);
}

// How a parameter with this tag is written.
std::string sample_value(std::string_view tag)
{
    if (tag == "integer") return "1";
    if (tag == "float") return "1.0";
    if (tag == "boolean") return "true";
    if (tag == "color" || tag == "point" || tag == "vector") return "1 1 1";
    return "...";
}

} // namespace

bool Range::contains(double x) const
{
    const auto rounded = static_cast<float>(x);
    return (open_min ? x > min && rounded > static_cast<float>(min) : x >= min) &&
           (open_max ? x < max && rounded < static_cast<float>(max) : x <= max);
}

std::string Range::text() const
{
    const bool bounded_below = std::isfinite(min), bounded_above = std::isfinite(max);
    if (bounded_below && bounded_above)
        return fmt::format("in {}{}, {}{}", open_min ? '(' : '[', min, max, open_max ? ')' : ']');
    if (bounded_below) return fmt::format("{} {}", open_min ? "greater than" : "at least", min);
    if (bounded_above) return fmt::format("{} {}", open_max ? "less than" : "at most", max);
    return "finite";
}

Params::Params(std::string kind, std::string type, SourceLocation element_at, Diagnostics& diagnostics,
               std::filesystem::path directory)
    : kind_(std::move(kind)),
      type_(std::move(type)),
      element_at_(std::move(element_at)),
      diagnostics_(diagnostics),
      directory_(std::move(directory))
{}

void Params::add(std::string name, Property property)
{
    properties_.insert_or_assign(std::move(name), std::move(property));
}

void Params::set_wording(Wording wording)
{
    wording_ = std::move(wording);
}

std::string_view Params::as_written(std::string_view name) const
{
    return wording_ && wording_->parameter ? wording_->parameter(name) : name;
}

// --- Finding ------------------------------------------------------------------------------------------------

const Property* Params::find(std::string_view name) const
{
    if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) asked_.emplace_back(name);
    const auto found = properties_.find(name);
    if (found == properties_.end()) return nullptr;
    found->second.asked = true;
    return &found->second;
}

const Property* Params::find_tagged(std::string_view name, std::initializer_list<std::string_view> tags) const
{
    const Property* property = find(name);
    if (property && property->broken) return nullptr;
    if (!property || std::find(tags.begin(), tags.end(), property->tag) != tags.end()) return property;
    fail(name, fmt::format("must be given as <{}>, not <{}>", *tags.begin(), property->tag));
    return nullptr;
}

bool Params::has(std::string_view name) const
{
    const bool texture = find_texture(name) != nullptr;
    return find(name) != nullptr || texture;
}

void Params::fail_missing(std::string_view name, std::string_view tag) const
{
    diagnostics_.error(element_at_,
                       fmt::format("{0} '{1}' needs a parameter '{2}': <{3} name=\"{2}\" value=\"{4}\"/>",
                                   written_kind(), written_type(), as_written(name), tag, sample_value(tag)));
}

// --- Reading ------------------------------------------------------------------------------------------------

bool Params::boolean(std::string_view name, bool fallback) const
{
    const Property* property = find_tagged(name, {"boolean"});
    return property ? std::get<bool>(property->value) : fallback;
}

std::int64_t Params::integer(std::string_view name, std::int64_t fallback, Range range) const
{
    const Property* property = find_tagged(name, {"integer"});
    if (!property) return fallback;
    const auto value = std::get<std::int64_t>(property->value);
    const auto real = static_cast<double>(value);
    if (real >= range.min && real <= range.max && !(range.open_min && real == range.min) &&
        !(range.open_max && real == range.max))
        return value;
    fail(name, fmt::format("must be {}, not {}", range.text(), property->text));
    return fallback;
}

float Params::number(std::string_view name, float fallback, Range range) const
{
    const Property* property = find_tagged(name, {"float", "integer"});
    if (!property) return fallback;
    const auto* integer = std::get_if<std::int64_t>(&property->value);
    const double value = integer ? static_cast<double>(*integer) : std::get<double>(property->value);
    if (range.contains(value)) return static_cast<float>(value);
    fail(name, fmt::format("must be {}, not {}", range.text(), property->text));
    return fallback;
}

std::string Params::string(std::string_view name) const
{
    if (!find(name)) fail_missing(name, "string");
    return string(name, {});
}

std::string Params::string(std::string_view name, std::string fallback) const
{
    const Property* property = find_tagged(name, {"string"});
    return property ? std::get<std::string>(property->value) : std::move(fallback);
}

std::string Params::choice(std::string_view name, std::string fallback,
                           const std::vector<std::string_view>& words) const
{
    const Property* property = find_tagged(name, {"string"});
    if (!property) return fallback;
    const auto& word = std::get<std::string>(property->value);
    if (std::find(words.begin(), words.end(), word) != words.end()) return word;
    fail(name, fmt::format("must be {}, not '{}'", listed(words), word));
    return fallback;
}

Vec3f Params::point(std::string_view name, const Vec3f& fallback) const
{
    return three_numbers(find_tagged(name, {"point", "vector"}), name, fallback);
}

Vec3f Params::vector(std::string_view name, const Vec3f& fallback) const
{
    return three_numbers(find_tagged(name, {"vector", "point"}), name, fallback);
}

Vec3f Params::three_numbers(const Property* property, std::string_view name, const Vec3f& fallback) const
{
    if (!property) return fallback;
    const std::vector<double>& values = numbers(*property);
    if (values.size() == 3)
        return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
    fail(name, fmt::format("must have 3 numbers, not {}", values.size()));
    return fallback;
}

Vec2f Params::vector2(std::string_view name, const Vec2f& fallback) const
{
    const Property* property = find_tagged(name, {"vector", "point"});
    if (!property) return fallback;
    const std::vector<double>& values = numbers(*property);
    if (values.size() == 2) return {static_cast<float>(values[0]), static_cast<float>(values[1])};
    fail(name, fmt::format("must have 2 numbers, not {}", values.size()));
    return fallback;
}

Color Params::color(std::string_view name, const Color& fallback, Range range) const
{
    const Property* property = find_tagged(name, {"color"});
    if (!property) return fallback;
    const std::vector<double>& values = numbers(*property);
    if (std::all_of(values.begin(), values.end(), [&](double x) { return range.contains(x); }))
        return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
    fail(name, fmt::format("must be {}, not {}", range.text(), property->text));
    return fallback;
}

Color Params::color(std::string_view name) const
{
    if (!find(name)) fail_missing(name, "color");
    return color(name, Color(0.f), Range::at_least(0.0));
}

Color Params::raw_values(std::string_view name, const Color& fallback) const
{
    const Property* property = find_tagged(name, {"vector", "color", "point", "float", "integer"});
    if (!property) return fallback;
    if (!std::holds_alternative<std::vector<double>>(property->value)) return Color(number(name, 0.f));
    const Vec3f values = three_numbers(property, name, {fallback.r, fallback.g, fallback.b});
    return {values.x, values.y, values.z};
}

Transform Params::transform(std::string_view name) const
{
    const Property* property = find_tagged(name, {"transform"});
    return property ? std::get<Transform>(property->value) : Transform();
}

std::filesystem::path Params::file(std::string_view name) const
{
    const Property* property = find_tagged(name, {"string"});
    if (!property) {
        if (!find(name)) fail_missing(name, "string");
        missing_file_ = true;
        return {};
    }
    const auto [path, way_out, notice] = find_named_file(directory_, std::get<std::string>(property->value));
    if (!notice.empty()) warn(name, notice);
    std::error_code status;
    const bool found = std::filesystem::is_regular_file(path, status);
    if (found) {
        files_.push_back(path);
        return path;
    }
    missing_file_ = true;
    fail(name,
         fmt::format("{}: '{}'{}",
                     std::filesystem::is_directory(path, status) ? "is a directory, not a file"
                     : std::filesystem::exists(path, status)     ? "is a device or a pipe, not a regular file"
                                                                 : "names a file that does not exist",
                     path.string(), way_out));
    return path;
}

// --- Diagnostics --------------------------------------------------------------------------------------------

const SourceLocation& Params::value_place(std::string_view name) const
{
    if (const auto found = properties_.find(name); found != properties_.end()) return found->second.value_at;
    for (const TextureChild& child : textures_)
        if (child.name == name) return child.at;
    return element_at_;
}

void Params::fail(std::string_view name, std::string message) const
{
    diagnostics_.error(value_place(name), fmt::format("{} {}", as_written(name), message));
}

void Params::warn(std::string_view name, std::string message) const
{
    diagnostics_.warning(value_place(name), std::move(message));
}

void Params::ignore(std::string_view name, std::string message) const
{
    const auto found = properties_.find(name);
    if (found == properties_.end()) return;
    found->second.asked = true;
    if (!message.empty()) diagnostics_.warning(found->second.name_at, std::move(message));
}

bool Params::is_unused(std::string_view name) const
{
    const auto found = properties_.find(name);
    return found != properties_.end() && !found->second.asked;
}

void Params::reject_unused() const
{
    std::vector<std::string_view> known;
    for (const std::string& name : asked_) known.push_back(as_written(name));
    const auto reject = [&](std::string_view what, std::string_view name, const SourceLocation& at) {
        const std::string rest =
            known.empty() ? "; it takes none" : way_out(std::string(as_written(name)), known);
        const std::string message = fmt::format("unknown {} '{}' for {} '{}'{}", what, as_written(name),
                                                written_kind(), written_type(), rest);
        if (closest_name(as_written(name), known).empty())
            diagnostics_.unsupported(at, message, lenient_);
        else // a misspelling
            diagnostics_.add(lenient_ ? Severity::warning : Severity::error, at, message);
    };
    for (const auto& [name, property] : properties_)
        if (!property.asked) reject("parameter", name, property.name_at);
    for (const TextureChild& child : textures_)
        if (!child.asked) reject("texture", child.name, child.at);
    reject_unused_bsdfs();
}

} // namespace plumb
