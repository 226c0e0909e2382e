// SPDX-License-Identifier: MIT
// What other readings of a scene would change in its image.

#include "plumb/scene/scene.h"
#include "scene_file/dialects.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

// Integrators whose images do not depend on what emitters do to light.
constexpr std::string_view blind_integrators[] = {"normals", "depth", "ao", "av", "simple"};

bool is_black(const Element& bsdf)
{
    const Element* albedo = bsdf.child_named("albedo");
    return bsdf.value("type") == "diffuse" && albedo && albedo->tag == "color" &&
           albedo->value("value").find_first_of("123456789") == std::string::npos;
}

// What a scene has that courses read differently.
struct Stakes {
    bool sees_emitters = true;
    bool has_reflecting_lamp = false;
    bool has_sun = false;
    bool has_image_around = false; // an environment with a file

    explicit Stakes(const Element& root) { visit(root); }

private:
    void visit(const Element& element)
    {
        const std::string type = element.value("type");
        if (element.tag == "integrator" &&
            std::find(std::begin(blind_integrators), std::end(blind_integrators), type) !=
                std::end(blind_integrators))
            sees_emitters = false;
        if (element.tag == "emitter" && type == "directional") has_sun = true;
        if (element.tag == "emitter" && type == "environment" && element.child_named("filename"))
            has_image_around = true;
        if (element.tag == "mesh" || element.tag == "shape") visit_shape(element);
        for (const Element& child : element.children) visit(child);
    }

    void visit_shape(const Element& shape)
    {
        bool emits = false, black = false;
        for (const Element& child : shape.children) {
            emits = emits || child.tag == "emitter";
            black = black || (child.tag == "bsdf" && is_black(child));
        }
        has_reflecting_lamp = has_reflecting_lamp || (emits && !black);
    }
};

// The mean radiance of what surrounds the scene, as luminance; 0 if nothing does. Exact to a per cent or so.
double mean_around(const Scene& scene)
{
    double mean = 0.0;
    for (const Emitter* emitter : scene.emitters()) {
        if (!emitter->is_infinite() || emitter->is_delta()) continue;
        constexpr int side = 16;
        for (int i = 0; i < side * side; ++i) {
            const int row = i / side;
            const Vec2f u((static_cast<float>(i % side) + 0.5f) / side,
                          (static_cast<float>(row) + 0.5f) / side);
            if (const auto light = emitter->sample({}, 0.5, u, Measure::best))
                mean +=
                    static_cast<double>(luminance(light->radiance) / light->pdf) / (4.0 * pi_d * side * side);
        }
    }
    return mean;
}

class Differences {
public:
    Differences(const Element& root, const DialectChoice& choice, const DialectWishes& wishes,
                const Scene* scene)
        : stakes_(root), read_(choice.dialect), wishes_(wishes), scene_(scene)
    {}

    // "for eth the view is mirrored (--mirror on)"; empty: the image is the same.
    std::string to(DialectName name) const
    {
        const Dialect other = Dialect::standard(name);
        std::vector<std::string> found;
        if (!wishes_.mirrored_view && scene_ && other.mirrored_view != read_.mirrored_view)
            found.push_back(other.mirrored_view ? "the view is mirrored (--mirror on)"
                                                : "the view is not mirrored (--mirror off)");
        if (!wishes_.emitters_absorb && stakes_.sees_emitters && stakes_.has_reflecting_lamp &&
            other.emitters_absorb != read_.emitters_absorb)
            found.push_back(
                other.emitters_absorb
                    ? "light ends at emitters, which darkens them and their surroundings (--emitters absorb)"
                    : "emitters also scatter light, which brightens them and their surroundings (--emitters "
                      "scatter)");
        if (stakes_.sees_emitters && stakes_.has_sun &&
            other.sun_points_to_light != read_.sun_points_to_light)
            found.emplace_back("directional light comes from the other side");
        if (auto text = map(other); !text.empty()) found.push_back(std::move(text));
        if (found.empty()) return {};
        std::string list;
        for (std::size_t i = 0; i < found.size(); ++i)
            list += (i == 0 ? "" : i + 1 < found.size() ? ", " : " and ") + found[i];
        return fmt::format("for {} {}", to_string(name), list);
    }

    // What a scale that evidence decides for does.
    std::string scaled_map() const
    {
        if (!has_map() || read_.environment_scale == 1.f) return {};
        const double mean = mean_around(*scene_);
        return fmt::format("the environment image is flipped and divided by {:g}: mean {:.2g}, not {:.2g} "
                           "(--envmap-scale 1, or --dialect plumb)",
                           1.0 / static_cast<double>(read_.environment_scale), mean,
                           mean / static_cast<double>(read_.environment_scale));
    }

private:
    bool has_map() const
    {
        return !wishes_.environment_scale && scene_ && stakes_.sees_emitters && stakes_.has_image_around;
    }

    std::string map(const Dialect& other) const
    {
        if (!has_map() || other.environment_scale == read_.environment_scale) return {};
        const double mean = mean_around(*scene_);
        const double factor = static_cast<double>(other.environment_scale / read_.environment_scale);
        return fmt::format("the environment image is flipped and {} by {:g}: mean {:.2g}, not {:.2g}",
                           factor < 1.0 ? "divided" : "multiplied", factor < 1.0 ? 1.0 / factor : factor,
                           mean * factor, mean);
    }

    Stakes stakes_;
    const Dialect& read_;
    const DialectWishes& wishes_;
    const Scene* scene_;
};

} // namespace

void warn_of_open_readings(const Element& root, const DialectChoice& choice, const DialectWishes& wishes,
                           const Scene* scene, Diagnostics& diagnostics)
{
    if (!choice.evidence) return;
    const DialectEvidence& evidence = *choice.evidence;
    const Differences differences(root, choice, wishes, scene);
    const auto warn = [&](const std::string& what, const std::string& flags) {
        diagnostics.warning(root.place(),
                            fmt::format("{}; it is read as {}; {}; {}, or a dialect attribute "
                                        "here, settles it",
                                        evidence.reason, to_string(evidence.name), what, flags));
    };
    std::string what, flags;
    for (const DialectName suspect : evidence.suspects) {
        const std::string difference = differences.to(suspect);
        if (difference.empty()) continue;
        what += (what.empty() ? "" : "; ") + difference;
        flags += fmt::format("{}--dialect {}", flags.empty() ? "" : ", ", to_string(suspect));
    }
    if (!what.empty()) return warn(what, flags);
    if (evidence.name == DialectName::plumb) return;
    // Of a course: what one mark is not enough for, or what two have done to an image.
    if (const std::string difference = differences.to(evidence.name); !difference.empty())
        return warn(difference, fmt::format("--dialect {}", to_string(evidence.name)));
    if (const std::string scaled = differences.scaled_map(); !scaled.empty())
        diagnostics.warning(root.place(), fmt::format("{}; it is read as {}: {}", evidence.reason,
                                                      to_string(evidence.name), scaled));
}

} // namespace plumb
