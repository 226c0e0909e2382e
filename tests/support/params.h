// SPDX-License-Identifier: MIT
#pragma once

// Plugins made in tests without a scene file:
//
//     const auto bsdf = ParamsBuilder("bsdf", "diffuse").color("albedo", Color(0.3f)).build<Diffuse, Bsdf>();
//
// after `namespace plumb { class Diffuse; }`. A scene file with the same elements would give the same Params.

#include "plumb/model/bsdf.h"
#include "plumb/model/params.h"
#include "scene_file/catalog.h"

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plumb::test {

class ParamsBuilder {
public:
    ParamsBuilder(std::string kind, std::string type);

    ParamsBuilder& boolean(const std::string& name, bool value);
    ParamsBuilder& integer(const std::string& name, std::int64_t value);
    ParamsBuilder& number(const std::string& name, double value);
    ParamsBuilder& string(const std::string& name, const std::string& value);
    ParamsBuilder& color(const std::string& name, const Color& value);
    ParamsBuilder& point(const std::string& name, const Vec3f& value);
    ParamsBuilder& vector(const std::string& name, const Vec3f& value);
    ParamsBuilder& vector2(const std::string& name, const Vec2f& value);
    ParamsBuilder& transform(const std::string& name, const Transform& value);
    ParamsBuilder& texture(const std::string& name, std::shared_ptr<const Texture> value);
    ParamsBuilder& parent_shape(const Shape* shape);
    ParamsBuilder& directory(const std::filesystem::path& value);

    const std::string& kind() const { return kind_; }
    const std::string& type() const { return type_; }
    std::string text() const; // the type and its parameters, "diffuse albedo=0.5 0.5 0.5"

    // The plugin, and what it complained of. make(params) is called once; unused parameters count as errors.
    template <class Make>
    auto build_with(const Make& make, std::vector<Diagnostic>& found) const
    {
        Diagnostics diagnostics;
        const Params params = make_params(diagnostics);
        auto plugin = make(params);
        params.reject_unused();
        found = diagnostics.all();
        return plugin;
    }

    // Throws std::logic_error with the messages if there are errors.
    template <class Make>
    auto build_with(const Make& make) const
    {
        std::vector<Diagnostic> found;
        auto plugin = build_with(make, found);
        throw_errors(found);
        return plugin;
    }

    template <class T, class Kind>
    std::unique_ptr<Kind> build() const
    {
        return build_with([](const Params& params) { return plumb::build<T, Kind>(params); });
    }

    // The plugin that the catalog has under type().
    template <class Kind>
    std::unique_ptr<Kind> build_type(std::span<const Entry<Kind>> types) const
    {
        for (const auto& entry : types)
            if (entry.name == type_) return build_with(entry.build);
        throw std::logic_error("the catalog has no " + kind_ + " " + type_);
    }

    // The messages of the errors and warnings ("error: alpha must be ...") that building the plugin gives.
    template <class T, class Kind>
    std::vector<std::string> complaints() const
    {
        std::vector<Diagnostic> found;
        build_with([](const Params& params) { return plumb::build<T, Kind>(params); }, found);
        return messages(found);
    }

private:
    Params make_params(Diagnostics& diagnostics) const;
    ParamsBuilder& add(const std::string& name, const char* tag, Property::Value value);
    static void throw_errors(const std::vector<Diagnostic>& found);
    static std::vector<std::string> messages(const std::vector<Diagnostic>& found);

    std::string kind_;
    std::string type_;
    std::vector<std::pair<std::string, Property>> properties_;
    std::vector<TextureChild> textures_;
    const Shape* parent_shape_ = nullptr;
    std::filesystem::path directory_;
};

// A texture with one colour where u < 1/2 and another elsewhere.
std::shared_ptr<const Texture> two_tone_texture(const Color& left, const Color& right);

} // namespace plumb::test
