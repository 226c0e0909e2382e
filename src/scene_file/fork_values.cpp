// SPDX-License-Identifier: MIT
#include "scene_file/fork_words.h"

#include "scene_file/property_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace plumb {

bool angle_of_cosine(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "float") return true; // whoever reads it reports it
    const auto number = read_number(parameter, *value, diagnostics);
    if (!number) return false;
    if (std::abs(*number) <= 1.0)
        set_attribute(parameter, "value", fmt::format("{}", std::acos(*number) * (180.0 / std::numbers::pi)));
    return true;
}

bool to_fraction(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || (parameter.tag != "float" && parameter.tag != "integer")) return true;
    const auto number = read_number(parameter, *value, diagnostics);
    if (!number) return false;
    const double limited = std::clamp(*number, 0.0, 1.0);
    if (limited == *number) return true;
    diagnostics.warning(
        parameter.value_place(*value),
        fmt::format("{} must be in [0, 1], not {}; {} is used", parameter.written_name(), *number, limited));
    set_attribute(parameter, "value", fmt::format("{}", limited));
    return true;
}

bool negated(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "boolean") return true;
    const auto is_true = read_boolean(parameter, *value, diagnostics);
    if (!is_true) return false;
    set_attribute(parameter, "value", *is_true ? "false" : "true");
    return true;
}

bool grey_color(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || (parameter.tag != "float" && parameter.tag != "integer")) return true;
    const auto number = read_number(parameter, *value, diagnostics);
    if (!number) return false;
    rename_tag(parameter, "color");
    set_attribute(parameter, "value", fmt::format("{0} {0} {0}", *number));
    return true;
}

namespace {

bool to_texture(Element& parameter, bool raw)
{
    if (parameter.tag != "string" || !parameter.attribute("value")) return true;
    if (parameter.value("value").empty()) return false; // none
    Element filename = parameter;
    filename.children.clear();
    set_attribute(filename, "name", "filename");
    rename_tag(parameter, "texture");
    std::erase_if(parameter.attributes, [](const Attribute& attribute) { return attribute.name == "value"; });
    set_attribute(parameter, "type", "bitmap");
    parameter.children = {std::move(filename)};
    if (raw) parameter.children.push_back(made_parameter(parameter, "boolean", "raw", "true"));
    return true;
}

// operation: of a transform; rest: of the axes that the parameter says nothing about.
bool to_uv(Element& parameter, std::string_view operation, const char* form, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag == "transform") return true;
    const auto numbers = read_number_list(parameter, *value, diagnostics);
    if (!numbers) return false;
    const double u = numbers->front(), v = numbers->size() > 1 ? (*numbers)[1] : u;
    Element inner = made_object(parameter, operation, "");
    set_attribute(inner, "value", fmt::format(fmt::runtime(form), u, v));
    rename_tag(parameter, "transform");
    std::erase_if(parameter.attributes, [](const Attribute& attribute) { return attribute.name == "value"; });
    parameter.children = {std::move(inner)};
    return true;
}

} // namespace

bool image_of(Element& parameter, Diagnostics&)
{
    return to_texture(parameter, false);
}

bool data_image_of(Element& parameter, Diagnostics&)
{
    return to_texture(parameter, true);
}

bool uv_scale(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "scale", "{0} {1} 1", diagnostics);
}

bool u_scale(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "scale", "{0} 1 1", diagnostics);
}

bool v_scale(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "scale", "1 {0} 1", diagnostics);
}

bool uv_shift(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "translate", "{0} {1} 0", diagnostics);
}

bool u_shift(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "translate", "{0} 0 0", diagnostics);
}

bool v_shift(Element& parameter, Diagnostics& diagnostics)
{
    return to_uv(parameter, "translate", "0 {0} 0", diagnostics);
}

} // namespace plumb
