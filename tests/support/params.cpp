// SPDX-License-Identifier: MIT

#include "support/params.h"
#include "plumb/model/shape.h"

#include <fmt/format.h>

#include <stdexcept>

namespace plumb::test {

namespace {

class TwoTone final : public Texture {
public:
    TwoTone(const Color& left, const Color& right) : left_(left), right_(right) {}
    Color mean() const override { return (left_ + right_) * 0.5f; }
    float min_value() const override { return std::min(min_component(left_), min_component(right_)); }
    float max_value() const override { return std::max(max_component(left_), max_component(right_)); }

private:
    Color color_at(const SurfacePoint& at) const override { return at.uv.x < 0.5f ? left_ : right_; }

    Color left_;
    Color right_;
};

SourceLocation place_of(const std::string& text)
{
    return {"test.xml", 1, 1, static_cast<int>(text.size()), text};
}

// A value as a scene file would have it.
struct AsText {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(double value) const { return fmt::format("{}", value); }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(const std::vector<double>& values) const
    {
        std::string text;
        for (const double value : values) text += (text.empty() ? "" : " ") + fmt::format("{}", value);
        return text;
    }
    std::string operator()(const Transform&) const { return {}; }
};

std::vector<double> numbers(const Vec3f& v)
{
    return {v.x, v.y, v.z};
}

} // namespace

ParamsBuilder::ParamsBuilder(std::string kind, std::string type)
    : kind_(std::move(kind)), type_(std::move(type))
{}

ParamsBuilder& ParamsBuilder::add(const std::string& name, const char* tag, Property::Value value)
{
    const std::string text = std::visit(AsText{}, value);
    Property property{tag, text, std::move(value), place_of(name), place_of(text), false};
    properties_.emplace_back(name, std::move(property));
    return *this;
}

ParamsBuilder& ParamsBuilder::boolean(const std::string& name, bool value)
{
    return add(name, "boolean", value);
}

ParamsBuilder& ParamsBuilder::integer(const std::string& name, std::int64_t value)
{
    return add(name, "integer", value);
}

ParamsBuilder& ParamsBuilder::number(const std::string& name, double value)
{
    return add(name, "float", value);
}

ParamsBuilder& ParamsBuilder::string(const std::string& name, const std::string& value)
{
    return add(name, "string", value);
}

ParamsBuilder& ParamsBuilder::color(const std::string& name, const Color& value)
{
    return add(name, "color", std::vector<double>{value.r, value.g, value.b});
}

ParamsBuilder& ParamsBuilder::point(const std::string& name, const Vec3f& value)
{
    return add(name, "point", numbers(value));
}

ParamsBuilder& ParamsBuilder::vector(const std::string& name, const Vec3f& value)
{
    return add(name, "vector", numbers(value));
}

ParamsBuilder& ParamsBuilder::vector2(const std::string& name, const Vec2f& value)
{
    return add(name, "vector", std::vector<double>{value.x, value.y});
}

ParamsBuilder& ParamsBuilder::transform(const std::string& name, const Transform& value)
{
    return add(name, "transform", value);
}

ParamsBuilder& ParamsBuilder::texture(const std::string& name, std::shared_ptr<const Texture> value)
{
    textures_.push_back({name, std::move(value), place_of(name), false});
    return *this;
}

ParamsBuilder& ParamsBuilder::parent_shape(const Shape* shape)
{
    parent_shape_ = shape;
    return *this;
}

ParamsBuilder& ParamsBuilder::directory(const std::filesystem::path& value)
{
    directory_ = value;
    return *this;
}

std::string ParamsBuilder::text() const
{
    std::string result = type_;
    for (const auto& [name, property] : properties_) result += fmt::format(" {}={}", name, property.text);
    for (const auto& child : textures_) result += fmt::format(" {}=<texture>", child.name);
    return result;
}

Params ParamsBuilder::make_params(Diagnostics& diagnostics) const
{
    Params params(kind_, type_, place_of(type_), diagnostics, directory_);
    for (const auto& [name, property] : properties_) params.add(name, property);
    for (const auto& child : textures_) params.add_texture(child);
    params.set_parent_shape(parent_shape_);
    return params;
}

std::vector<std::string> ParamsBuilder::messages(const std::vector<Diagnostic>& found)
{
    std::vector<std::string> result;
    for (const auto& diagnostic : found) {
        const char* severity = diagnostic.severity == Severity::error     ? "error: "
                               : diagnostic.severity == Severity::warning ? "warning: "
                                                                          : "note: ";
        result.push_back(severity + diagnostic.message);
    }
    return result;
}

void ParamsBuilder::throw_errors(const std::vector<Diagnostic>& found)
{
    std::string text;
    for (const auto& diagnostic : found)
        if (diagnostic.severity == Severity::error) text += diagnostic.text() + "\n";
    if (!text.empty()) throw std::logic_error(text);
}

std::shared_ptr<const Texture> two_tone_texture(const Color& left, const Color& right)
{
    return std::make_shared<TwoTone>(left, right);
}

} // namespace plumb::test
