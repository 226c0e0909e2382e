// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_words.h"

#include "scene_file/property_values.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace plumb {

namespace {

class Order {
public:
    Order(Element& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

    void run()
    {
        std::erase_if(root_.attributes, [](const Attribute& a) { return a.name == "version"; });
        std::vector<Element> kept;
        kept.reserve(root_.children.size() + 2);
        for (Element& child : root_.children) {
            if (child.tag == "camera" && std::exchange(has_camera_, true))
                continue; // Mitsuba takes the first
            if (child.tag == "camera") order_camera(child);
            if (child.tag == "integrator") order_integrator(child);
            if (child.tag == "shape") order_shape(child);
            // Nothing can refer to it.
            if ((child.tag == "bsdf" || child.tag == "texture") && child.value("id").empty()) continue;
            kept.push_back(std::move(child));
        }
        // Unless it was refused.
        if (!has_camera_ && !diagnostics_.has_errors())
            diagnostics_.error(
                root_.place(),
                "the scene has no <sensor>; write <sensor type=\"perspective\"> ... </sensor>");
        if (!has_integrator_ && !diagnostics_.has_errors())
            diagnostics_.error(root_.place(),
                               "the scene has no <integrator>; write <integrator type=\"path\"/>");
        if (sampler_) kept.push_back(*std::move(sampler_));
        root_.children = std::move(kept);
    }

private:
    // The film's parameters are the camera's, and the sampler stands in the scene.
    void order_camera(Element& camera)
    {
        if (camera.written_type() == "thinlens")
            for (const auto& [ours, theirs] :
                 {std::pair("lensRadius", "aperture_radius"), std::pair("focalDistance", "focus_distance")})
                require(camera, ours, theirs);
        std::vector<Element> kept, of_film;
        std::optional<Element> filter;
        bool has_film = false;
        for (Element& child : camera.children) {
            if (child.tag == "sampler") {
                sampler_ = std::move(child);
            } else if (child.tag == "film") {
                has_film = true;
                for (Element& inner : child.children) {
                    if (inner.tag == "rfilter")
                        filter = std::move(inner);
                    else
                        of_film.push_back(std::move(inner));
                }
            } else {
                kept.push_back(std::move(child));
            }
        }
        if (!has_film) {
            kept.push_back(made_parameter(camera, "integer", "width", "768"));
            kept.push_back(made_parameter(camera, "integer", "height", "576"));
        }
        for (Element& inner : of_film) kept.push_back(std::move(inner));
        if (filter) order_filter(*filter);
        kept.push_back(filter ? *std::move(filter) : made_object(camera, "rfilter", "gaussian"));
        camera.children = std::move(kept);
        if (sampler_) return;
        sampler_ = made_object(camera, "sampler", "independent");
        sampler_->children.push_back(made_parameter(camera, "integer", "sampleCount", "4"));
    }

    // A gaussian ends at 4 standard deviations.
    void order_filter(Element& filter)
    {
        if (filter.value("type") != "gaussian") return;
        for (const Element& child : filter.children) {
            const Attribute* value = child.value("name") == "stddev" ? child.attribute("value") : nullptr;
            if (!value) continue;
            Diagnostics ignored; // whoever builds it reports it
            const auto stddev = read_number(child, *value, ignored);
            if (stddev)
                filter.children.push_back(
                    made_parameter(filter, "float", "radius", fmt::format("{}", 4.0 * *stddev)));
            return;
        }
    }

    void require(const Element& element, std::string_view ours, std::string_view theirs)
    {
        if (std::any_of(element.children.begin(), element.children.end(),
                        [&](const Element& child) { return child.value("name") == ours; }))
            return;
        diagnostics_.error(element.place(),
                           fmt::format("{0} '{1}' needs a parameter '{2}': <float name=\"{2}\" "
                                       "value=\"1.0\"/>",
                                       element.written_tag(), element.written_type(), theirs));
    }

    // Recursion ends: parse_document().
    void order_integrator(Element& integrator)
    {
        has_integrator_ = true;
        const std::string type = integrator.value("type");
        if (type != "moment" && type != "aov") return;
        if (type == "aov")
            diagnostics_.warning(integrator.place(),
                                 "the channels of 'aov' are not written; --aov writes some");
        const auto inner = std::find_if(integrator.children.begin(), integrator.children.end(),
                                        [](const Element& child) { return child.tag == "integrator"; });
        if (inner == integrator.children.end()) {
            diagnostics_.error(
                integrator.place(),
                fmt::format("integrator '{}' needs one inside it: <integrator type=\"path\"/>", type));
            integrator = made_object(integrator, "integrator", "path_mis");
            return;
        }
        Element only = std::move(*inner);
        integrator = std::move(only);
        order_integrator(integrator);
    }

    // A lamp without a bsdf is black.
    void order_shape(Element& shape)
    {
        const auto has = [&](std::string_view tag) {
            return std::any_of(shape.children.begin(), shape.children.end(),
                               [&](const Element& child) { return child.tag == tag; });
        };
        if (!has("emitter") || has("bsdf") || has("ref")) return;
        Element black = made_object(shape, "bsdf", "diffuse");
        black.children.push_back(made_parameter(shape, "color", "albedo", "0 0 0"));
        shape.children.push_back(std::move(black));
    }

    Element& root_;
    Diagnostics& diagnostics_;
    std::optional<Element> sampler_;
    bool has_camera_ = false;
    bool has_integrator_ = false;
};

} // namespace

void order_mitsuba(Element& root, Diagnostics& diagnostics)
{
    Order(root, diagnostics).run();
}

} // namespace plumb
