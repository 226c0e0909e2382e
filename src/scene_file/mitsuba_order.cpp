// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_words.h"

#include "base/text.h"
#include "plumb/render/channel_set.h"
#include "scene_file/mitsuba_values.h"
#include "scene_file/property_values.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace plumb {

namespace {

class MitsubaOrder {
public:
    MitsubaOrder(Element& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

    void run()
    {
        std::erase_if(root_.attributes, [](const Attribute& a) { return a.name == "version"; });
        dissolve_merged(root_);
        leave_out_empty_groups();
        std::vector<Element> kept;
        kept.reserve(root_.children.size() + 3);
        for (Element& child : root_.children) {
            if (child.tag == "camera" && std::exchange(has_camera_, true))
                continue; // Mitsuba takes the first
            if (child.tag == "camera") order_camera(child);
            if (child.tag == "integrator") order_integrator(child);
            if (child.tag == "film" || child.tag == "rfilter") continue; // nothing refers to it any more
            if (child.tag == "sampler") continue;
            if (child.tag == "shape") order_shape(child);
            // Nothing can refer to it.
            if ((child.tag == "bsdf" || child.tag == "texture") && child.value("id").empty()) continue;
            kept.push_back(std::move(child));
        }
        // Unless it was refused.
        const bool is_whole = !diagnostics_.has_errors();
        if (!has_camera_ && is_whole)
            diagnostics_.error(
                root_.place(),
                "the scene has no <sensor>; write <sensor type=\"perspective\"> ... </sensor>");
        if (!has_integrator_ && is_whole)
            diagnostics_.error(root_.place(),
                               "the scene has no <integrator>; write <integrator type=\"path\"/>");
        // So that it is said once.
        if (!has_camera_) kept.push_back(made_object(root_, "camera", "perspective"));
        if (!has_integrator_) kept.push_back(made_object(root_, "integrator", "path_mis"));
        if (sampler_) kept.push_back(*std::move(sampler_));
        if (aovs_at_) {
            set_attribute(*aovs_at_, "value", aovs_);
            kept.push_back(*std::move(aovs_at_));
        }
        root_.children = std::move(kept);
    }

private:
    // The shapes of a 'merge' take its place. Recursion ends: parse_document().
    static void dissolve_merged(Element& parent)
    {
        std::vector<Element> kept;
        kept.reserve(parent.children.size());
        for (Element& child : parent.children) {
            if (child.tag == "shape") dissolve_merged(child);
            if (child.tag != "shape" || child.value("type") != "merge") {
                kept.push_back(std::move(child));
                continue;
            }
            for (Element& inner : child.children)
                if (inner.tag == "shape") kept.push_back(std::move(inner));
        }
        parent.children = std::move(kept);
    }

    static bool holds(const Element& element, std::string_view tag)
    {
        return std::any_of(element.children.begin(), element.children.end(),
                           [&](const Element& child) { return child.tag == tag; });
    }

    // --lenient may have left out all that was in a group; then its instances show nothing.
    void leave_out_empty_groups()
    {
        std::set<std::string> empty;
        std::erase_if(root_.children, [&](const Element& child) {
            if (child.tag != "shape" || child.value("type") != "group" || holds(child, "shape") ||
                child.value("id").empty())
                return false;
            diagnostics_.warning(child.place(),
                                 fmt::format("the group '{}' has no shapes; it is left out with "
                                             "its instances",
                                             child.value("id")));
            empty.insert(child.value("id"));
            return true;
        });
        if (empty.empty()) return;
        std::erase_if(root_.children, [&](const Element& child) {
            return child.tag == "shape" && child.value("type") == "instance" &&
                   std::any_of(child.children.begin(), child.children.end(), [&](const Element& inner) {
                       return inner.tag == "ref" && empty.contains(inner.value("id"));
                   });
        });
    }

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

    // The integrator inside takes the place of 'moment' and 'aov', whose channels become layers. prefix: of their names.
    // Recursion ends: parse_document().
    void order_integrator(Element& integrator, const std::string& prefix = {})
    {
        has_integrator_ = true;
        const std::string type = integrator.written_type();
        show_nothing_if_so_deep(integrator);
        if (type == "depth")
            std::erase_if(integrator.children,
                          [](const Element& child) { return child.value("name") != "inverse"; });
        if (type != "moment" && type != "aov" && type != "adaptive" && type != "irrcache") return;
        if (type == "aov") add_channels(integrator, prefix);
        Element* inner = nullptr;
        for (Element& child : integrator.children) {
            if (child.tag != "integrator") continue;
            if (!inner)
                inner = &child;
            else
                diagnostics_.warning(child.place(),
                                     fmt::format("only the first integrator inside '{}' is rendered", type));
        }
        if (!inner && type == "aov") {
            integrator = only_lights(integrator);
            return;
        }
        if (!inner) {
            diagnostics_.error(
                integrator.place(),
                fmt::format("integrator '{}' needs one inside it: <integrator type=\"path\"/>", type));
            integrator = made_object(integrator, "integrator", "path_mis");
            return;
        }
        const std::string name = inner->value("name").empty() ? "_arg_0" : inner->value("name");
        if (type == "moment") {
            if (inner->written_type() == "aov")
                diagnostics_.warning(
                    integrator.place(),
                    "second moments are written of light only, not of the channels of 'aov'");
            add_layer(integrator, prefix + name, "xyz");
            add_layer(integrator, prefix + "m2_" + name, "xyz_squared");
        }
        Element only = std::move(*inner);
        std::erase_if(only.attributes, [](const Attribute& a) { return a.name == "name"; });
        integrator = std::move(only);
        order_integrator(integrator, prefix + name + ".");
    }

    // No light at all is emission alone, without what emits it.
    static void show_nothing_if_so_deep(Element& integrator)
    {
        for (Element& child : integrator.children) {
            if (child.value("name") != "maxDepth" || child.value("value") != no_light) continue;
            set_attribute(child, "value", "0");
            std::erase_if(integrator.children,
                          [](const Element& one) { return one.value("name") == "hideEmitters"; });
            integrator.children.push_back(made_parameter(integrator, "boolean", "hideEmitters", "true"));
            return;
        }
    }

    // Without an integrator inside, 'aov' writes its channels alone.
    static Element only_lights(const Element& aov)
    {
        Element integrator = made_object(aov, "integrator", "path_mis");
        integrator.children.push_back(made_parameter(aov, "integer", "maxDepth", "0"));
        return integrator;
    }

    // "dd.y:depth, nn:sh_normal".
    void add_channels(const Element& aov, const std::string& prefix)
    {
        struct Channel {
            std::string_view theirs, ours;
        };
        constexpr Channel channels[] = {
            {"depth", "mean_depth"},
            {"position", "mean_position"},
            {"uv", "mean_uv"},
            {"geo_normal", "mean_geometric_normal"},
            {"sh_normal", "mean_normal"},
            {"dp_du", "mean_dp_du"},
            {"dp_dv", "mean_dp_dv"},
            {"prim_index", "mean_primitive"},
            {"shape_index", "mean_object"},
            {"albedo", "albedo"},
        };
        const auto list = std::find_if(aov.children.begin(), aov.children.end(),
                                       [](const Element& child) { return child.value("name") == "aovs"; });
        const Attribute* value = list == aov.children.end() ? nullptr : list->attribute("value");
        if (!value || value->broken) return;
        for (const std::string& one : list_items(value->value)) {
            const std::size_t colon = one.find(':');
            const std::string theirs = colon == one.npos ? "" : one.substr(colon + 1);
            const auto* channel = std::find_if(std::begin(channels), std::end(channels),
                                               [&](const Channel& row) { return row.theirs == theirs; });
            const std::string layer = prefix + one.substr(0, colon);
            if (channel == std::end(channels) || !is_layer_name(layer)) {
                diagnostics_.warning(
                    list->value_place(*value),
                    fmt::format("the channel '{}' is not written; those that are have the form NAME:TYPE, "
                                "where TYPE is albedo, depth, position, uv, geo_normal, sh_normal, dp_du, "
                                "dp_dv, prim_index or shape_index",
                                one));
                continue;
            }
            if (theirs == "albedo")
                diagnostics_.warning(list->value_place(*value),
                                     "'albedo' is all that a surface reflects or transmits; in Mitsuba it is "
                                     "the diffuse part");
            add_layer(aov, layer, channel->ours);
        }
    }

    void add_layer(const Element& at, const std::string& layer, std::string_view aov)
    {
        aovs_ += fmt::format("{}{}:{}", aovs_.empty() ? "" : ",", layer, aov);
        if (!aovs_at_) aovs_at_ = made_parameter(at, "string", "aovs", "");
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
    std::string aovs_;
    std::optional<Element> aovs_at_;
    bool has_camera_ = false;
    bool has_integrator_ = false;
};

} // namespace

void order_mitsuba(Element& root, Diagnostics& diagnostics)
{
    MitsubaOrder(root, diagnostics).run();
}

} // namespace plumb
