// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_values.h"

#include "base/lower_case.h"
#include "scene_file/property_values.h"
#include "scene_file/spectra.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumb {

namespace {

std::string triple(double x, double y, double z)
{
    return fmt::format("{}, {}, {}", x, y, z);
}

// --- Spectra --------------------------------------------------------------------------------------------------

enum class Role { emission, reflectance, index };

// "400:1, 700:2".
std::optional<std::vector<SpectrumPoint>> read_pairs(const Element& element, const Attribute& attribute,
                                                     Diagnostics& diagnostics)
{
    std::vector<SpectrumPoint> points;
    const std::string& text = attribute.value;
    const auto fail = [&](std::size_t begin, std::size_t length, std::string message) {
        diagnostics.error(element.part_place(attribute, begin, length), std::move(message));
        return std::nullopt;
    };
    for (std::size_t i = text.find_first_not_of(", "); i != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(", ", i), text.size());
        const std::string pair = text.substr(i, end - i);
        const std::size_t colon = pair.find(':');
        if (colon == pair.npos)
            return fail(i, pair.size(),
                        fmt::format("expected one number or pairs wavelength:value, not '{}'", pair));
        Attribute half = attribute;
        double numbers[2];
        for (int k = 0; k < 2; ++k) {
            half.value = k == 0 ? pair.substr(0, colon) : pair.substr(colon + 1);
            half.value_offset = attribute.value_offset + i + (k == 0 ? 0 : colon + 1);
            half.value_length = half.value.size();
            if (!attribute.verbatim)
                half = {half.name,
                        half.value,
                        attribute.name_offset,
                        attribute.value_offset,
                        attribute.value_length,
                        false,
                        false};
            const auto number = read_number(element, half, diagnostics);
            if (!number) return {};
            numbers[k] = *number;
        }
        if (!points.empty() && !(numbers[0] > points.back().wavelength))
            return fail(i, pair.size(), fmt::format("wavelengths must rise, and {} does not", numbers[0]));
        points.push_back({numbers[0], numbers[1]});
        i = text.find_first_not_of(", ", end);
    }
    return points;
}

// Of a <spectrum> with a value.
std::optional<Vec3d> read_spectrum(const Element& element, const Attribute& value, Role role,
                                   Diagnostics& diagnostics)
{
    if (value.value.find_first_of(":, ") == std::string::npos) {
        const auto number = read_number(element, value, diagnostics);
        if (!number) return {};
        return (role == Role::emission ? color_of_equal_energy() : Vec3d(1.0)) * *number;
    }
    const auto points = read_pairs(element, value, diagnostics);
    if (!points) return {};
    if (role == Role::emission) return color_of_light(*points);
    Vec3d color = color_under_d65(*points);
    if (role == Role::reflectance)
        color = Vec3d(std::min(color.x, 1.0), std::min(color.y, 1.0), std::min(color.z, 1.0));
    return color;
}

bool to_color(Element& parameter, Role role, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || value->broken) return true; // whoever reads it reports it
    if (parameter.tag == "float" || parameter.tag == "integer") {
        const auto number = read_number(parameter, *value, diagnostics);
        if (!number) return false;
        rename_tag(parameter, "color");
        set_attribute(parameter, "value", triple(*number, *number, *number));
        return true;
    }
    if (parameter.tag != "color") return true;
    if (parameter.written_tag() == "spectrum") {
        const auto color = read_spectrum(parameter, *value, role, diagnostics);
        if (color) set_attribute(parameter, "value", triple(color->x, color->y, color->z));
        return color.has_value();
    }
    const auto numbers = read_numbers(parameter, *value, {3, 1}, diagnostics);
    if (!numbers) return false;
    if (numbers->size() == 1)
        set_attribute(parameter, "value", triple((*numbers)[0], (*numbers)[0], (*numbers)[0]));
    return true;
}

// --- Spectra that are objects ---------------------------------------------------------------------------------

double number_of(const Element& element, std::string_view name, double fallback, Diagnostics& diagnostics)
{
    const Element* child = element.child_named(name);
    const Attribute* value = child ? child->attribute("value") : nullptr;
    return value ? read_number(*child, *value, diagnostics).value_or(fallback) : fallback;
}

// <spectrum type="d65"> and its like become a parameter with a value. true: nothing is wrong with it.
bool flatten_spectrum(Element& element, std::initializer_list<std::string_view> known, std::string_view tag,
                      const std::string& value, Diagnostics& diagnostics)
{
    for (const Element& child : element.children)
        if (std::find(known.begin(), known.end(), child.value("name")) == known.end()) {
            diagnostics.error(child.place(),
                              fmt::format("unknown parameter '{}' for {} '{}'{}", child.value("name"),
                                          element.tag, element.value("type"),
                                          way_out(child.value("name"), {known.begin(), known.end()})));
            return false;
        }
    element.children.clear();
    std::erase_if(element.attributes, [](const Attribute& a) { return a.name == "type" || a.name == "id"; });
    element.tag = tag; // also for messages: the value is read as that of this tag
    set_attribute(element, "value", value);
    return true;
}

// Values at even distances from one wavelength to another.
bool regular_spectrum(Element& element, Diagnostics& diagnostics)
{
    const double first = number_of(element, "wavelength_min", 0.0, diagnostics),
                 last = number_of(element, "wavelength_max", 0.0, diagnostics);
    const Element* values = element.child_named("values");
    const Attribute* list = values ? values->attribute("value") : nullptr;
    if (!list || !(first < last)) {
        diagnostics.error(element.place(), "a regular spectrum needs a string 'values', and 'wavelength_min' "
                                           "below 'wavelength_max'");
        return false;
    }
    const auto y = read_number_list(*values, *list, diagnostics);
    if (!y) return false;
    if (y->size() < 2) {
        diagnostics.error(values->value_place(*list), "a regular spectrum needs at least two values");
        return false;
    }
    std::string pairs;
    for (std::size_t i = 0; i < y->size(); ++i)
        pairs += fmt::format(
            "{}:{}, ", first + (last - first) * static_cast<double>(i) / static_cast<double>(y->size() - 1),
            (*y)[i]);
    return flatten_spectrum(element, {"wavelength_min", "wavelength_max", "values"}, "spectrum", pairs,
                            diagnostics);
}

bool spectrum_object(Element& element, Diagnostics& diagnostics)
{
    const std::string type = element.value("type");
    const bool good_before = !diagnostics.has_errors();
    const auto flatten = [&](std::initializer_list<std::string_view> known, std::string_view tag,
                             const std::string& value) {
        return flatten_spectrum(element, known, tag, value, diagnostics);
    };
    if (type == "uniform") {
        const double value = number_of(element, "value", 1.0, diagnostics);
        return flatten({"value"}, "float", fmt::format("{}", value));
    }
    if (type == "d65") {
        const double scale = number_of(element, "scale", 1.0, diagnostics);
        const Element* color = element.child_named("color");
        const Attribute* value = color && color->tag == "rgb" ? color->attribute("value") : nullptr;
        if (!value) return flatten({"scale"}, "float", fmt::format("{}", scale));
        const auto numbers = read_numbers(*color, *value, {3, 1}, diagnostics);
        if (!numbers) return false;
        const std::vector<double>& c = *numbers;
        return flatten({"scale", "color"}, "rgb",
                       triple(c[0] * scale, c[c.size() / 2] * scale, c[c.size() - 1] * scale));
    }
    if (type == "srgb") {
        const Element* color = element.child_named("color");
        return flatten({"color"}, "rgb", color ? color->value("value") : "");
    }
    if (type == "blackbody") {
        const double kelvin = number_of(element, "temperature", 5000.0, diagnostics);
        const double scale = number_of(element, "scale", 1.0, diagnostics);
        if (!(kelvin > 0.0)) {
            diagnostics.error(element.place(),
                              fmt::format("temperature must be greater than 0, not {}", kelvin));
            return false;
        }
        if (good_before)
            diagnostics.warning(
                element.place(),
                "Mitsuba has no black bodies in its RGB modes; this is Planck's law in W/(m^2 sr nm)");
        const Vec3d color = color_of_black_body(kelvin) * scale;
        return flatten({"temperature", "scale"}, "rgb", triple(color.x, color.y, color.z));
    }
    if (type == "regular") return regular_spectrum(element, diagnostics);
    // irregular: two lists of the same length.
    const Element *wavelengths = element.child_named("wavelengths"), *values = element.child_named("values");
    const Attribute *first = wavelengths ? wavelengths->attribute("value") : nullptr,
                    *second = values ? values->attribute("value") : nullptr;
    if (!first || !second) {
        diagnostics.error(element.place(), "an irregular spectrum needs strings 'wavelengths' and 'values'");
        return false;
    }
    const auto x = read_number_list(*wavelengths, *first, diagnostics),
               y = read_number_list(*values, *second, diagnostics);
    if (!x || !y) return false;
    if (x->size() != y->size()) {
        diagnostics.error(
            values->value_place(*second),
            fmt::format("expected {} values, one for each wavelength, not {}", x->size(), y->size()));
        return false;
    }
    std::string pairs;
    for (std::size_t i = 0; i < x->size(); ++i) pairs += fmt::format("{}:{}, ", (*x)[i], (*y)[i]);
    return flatten({"wavelengths", "values"}, "spectrum", pairs);
}

bool is_spectrum_object(const Element& element)
{
    constexpr std::string_view types[] = {"uniform", "d65", "srgb", "blackbody", "irregular", "regular"};
    return (element.tag == "spectrum" || element.tag == "texture") &&
           std::find(std::begin(types), std::end(types), element.value("type")) != std::end(types);
}

// --- Syntax ---------------------------------------------------------------------------------------------------

// x= y= z= as one list. missing: what stands for one that is not there; nothing: all are required.
bool join_axes(Element& element, std::string_view into, std::optional<double> missing,
               Diagnostics& diagnostics)
{
    std::string list;
    for (const char* axis : {"x", "y", "z"}) {
        const Attribute* one = element.attribute(axis);
        if (!one && !missing) {
            diagnostics.error(element.place(), fmt::format("<{}> needs x, y and z, or value", element.tag));
            return false;
        }
        const auto number = one ? read_number(element, *one, diagnostics) : missing;
        if (!number) return false;
        list += fmt::format("{}{}", list.empty() ? "" : ", ", *number);
    }
    Attribute joined;
    for (const char* axis : {"z", "y", "x"})
        if (const Attribute* one = element.attribute(axis)) joined = *one;
    joined.name = into;
    joined.value = std::move(list);
    joined.verbatim = false;
    std::erase_if(element.attributes,
                  [](const Attribute& a) { return a.name == "x" || a.name == "y" || a.name == "z"; });
    element.attributes.push_back(std::move(joined));
    return true;
}

bool has_axes(const Element& element)
{
    return element.attribute("x") || element.attribute("y") || element.attribute("z");
}

// One number stands for three.
bool repeat_one(Element& element, Diagnostics& diagnostics)
{
    const Attribute* value = element.attribute("value");
    if (!value) return true;
    const auto numbers = read_numbers(element, *value, {3, 1}, diagnostics);
    if (!numbers) return false;
    if (numbers->size() == 1)
        set_attribute(element, "value", triple((*numbers)[0], (*numbers)[0], (*numbers)[0]));
    return true;
}

bool vector_syntax(Element& element, std::optional<double> missing, Diagnostics& diagnostics)
{
    return has_axes(element) ? join_axes(element, "value", missing, diagnostics)
                             : repeat_one(element, diagnostics);
}

bool rotate_syntax(Element& element, Diagnostics& diagnostics)
{
    if (has_axes(element)) {
        if (!join_axes(element, "axis", 0.0, diagnostics)) return false;
    } else if (Attribute* value = find_attribute(element, "value")) {
        value->name = "axis";
    }
    const Attribute* axis = element.attribute("axis");
    const auto numbers = axis ? read_numbers(element, *axis, {3}, diagnostics) : std::nullopt;
    if (!numbers) return axis == nullptr; // its absence is reported elsewhere
    const double length = std::hypot((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    if (length > 0.0 && std::abs(length - 1.0) > 1e-4)
        diagnostics.warning(
            element.place(),
            fmt::format("the axis has the length {:.4g} and is made a unit vector; Mitsuba, which does not, "
                        "also scales and shears here",
                        length));
    return true;
}

bool lookat_syntax(Element& element, Diagnostics& diagnostics)
{
    if (element.attribute("up")) return true;
    const Attribute *origin = element.attribute("origin"), *target = element.attribute("target");
    if (!origin || !target) return true; // reported elsewhere
    const auto from = read_numbers(element, *origin, {3}, diagnostics),
               to = read_numbers(element, *target, {3}, diagnostics);
    if (!from || !to) return false;
    Vec3d z((*to)[0] - (*from)[0], (*to)[1] - (*from)[1], (*to)[2] - (*from)[2]);
    const double length = std::sqrt(z.x * z.x + z.y * z.y + z.z * z.z);
    if (!(length > 0.0)) return true; // reported elsewhere
    z = z / length;
    const double sign = std::copysign(1.0, z.z), a = -1.0 / (sign + z.z); // Duff et al. 2017, as frame.h
    set_attribute(element, "up", triple(1.0 + sign * z.x * z.x * a, sign * z.x * z.y * a + 0.0, -sign * z.x));
    return true;
}

bool matrix_syntax(Element& element, Diagnostics& diagnostics)
{
    const Attribute* value = element.attribute("value");
    if (!value) return true;
    const auto m = read_numbers(element, *value, {16, 9}, diagnostics);
    if (!m) return false;
    const std::size_t width = m->size() == 16 ? 4 : 3;
    if (width == 4 && ((*m)[12] != 0.0 || (*m)[13] != 0.0 || (*m)[14] != 0.0 || (*m)[15] != 1.0))
        diagnostics.warning(element.value_place(*value),
                            "the last row of the matrix is not 0 0 0 1; it is ignored, as in Mitsuba");
    std::string list;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            list += fmt::format("{} ", column < width ? (*m)[row * width + column] : 0.0);
    set_attribute(element, "value", list + "0 0 0 1");
    return true;
}

bool check_separators(const Element& element, Diagnostics& diagnostics)
{
    for (const Attribute& attribute : element.attributes) {
        const std::size_t at = attribute.value.find_first_of("\t\r\n");
        if (at == std::string::npos || element.tag == "string") continue;
        diagnostics.error(
            element.value_place(attribute),
            "numbers are separated by commas or blanks, as in Mitsuba, not by tabs or line ends");
        return false;
    }
    return true;
}

} // namespace

bool mitsuba_syntax(Element& element, Diagnostics& diagnostics)
{
    if (is_spectrum_object(element) && element.attribute("name"))
        return spectrum_object(element, diagnostics);
    if (!check_separators(element, diagnostics)) return false;
    if (element.tag == "point" || element.tag == "vector")
        return vector_syntax(element, std::nullopt, diagnostics);
    if (element.tag == "translate") return vector_syntax(element, 0.0, diagnostics);
    if (element.tag == "scale") return vector_syntax(element, 1.0, diagnostics);
    if (element.tag == "rotate") return rotate_syntax(element, diagnostics);
    if (element.tag == "lookat") return lookat_syntax(element, diagnostics);
    if (element.tag == "matrix") return matrix_syntax(element, diagnostics);
    return true;
}

bool color_of_emission(Element& parameter, Diagnostics& diagnostics)
{
    return to_color(parameter, Role::emission, diagnostics);
}

bool color_of_reflectance(Element& parameter, Diagnostics& diagnostics)
{
    return to_color(parameter, Role::reflectance, diagnostics);
}

bool color_of_index(Element& parameter, Diagnostics& diagnostics)
{
    return to_color(parameter, Role::index, diagnostics);
}

bool to_number(Element& parameter, Diagnostics& diagnostics)
{
    if (parameter.tag != "color") return true;
    if (!to_color(parameter, Role::index, diagnostics)) return false;
    const Attribute* value = parameter.attribute("value");
    const auto c = value ? read_numbers(parameter, *value, {3}, diagnostics) : std::nullopt;
    if (!c) return false;
    rename_tag(parameter, "float");
    set_attribute(parameter, "value",
                  fmt::format("{}", 0.212671 * (*c)[0] + 0.715160 * (*c)[1] + 0.072169 * (*c)[2]));
    return true;
}

bool only_if_true(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "boolean") return true;
    return read_boolean(parameter, *value, diagnostics).value_or(false);
}

bool only_rgb(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || value->broken) return false;
    const std::string format = lower_case(value->value);
    const std::vector<std::string_view> known = {"rgb",  "rgba",      "xyz",
                                                 "xyza", "luminance", "luminance_alpha"};
    if (std::find(known.begin(), known.end(), format) == known.end())
        diagnostics.error(parameter.value_place(*value),
                          fmt::format("unknown pixel_format '{}'{}", value->value, way_out(format, known)));
    else if (format != "rgb" && format != "rgba")
        diagnostics.warning(parameter.value_place(*value),
                            fmt::format("the image is written as linear RGB, not as {}", format));
    return false;
}

bool depth_minus_one(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "integer") return true; // whoever reads it reports it
    const auto depth = read_integer(parameter, *value, diagnostics);
    if (!depth) return false;
    if (*depth == 0)
        diagnostics.warning(parameter.value_place(*value),
                            "max_depth 0 is a black image, as in Mitsuba; 1 shows what emits light");
    if (*depth >= 0)
        set_attribute(parameter, "value", *depth == 0 ? std::string(no_light) : std::to_string(*depth - 1));
    return true;
}

bool index_by_name(Element& parameter, Diagnostics& diagnostics)
{
    struct Index {
        std::string_view name;
        double value;
    };
    constexpr Index indices[] = {
        {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
        {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
        {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
        {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
        {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
        {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
        {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
        {"pet", 1.5750},      {"diamond", 2.419},
    };
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "string") return true;
    const std::string name = lower_case(value->value);
    std::vector<std::string_view> known;
    for (const Index& index : indices) {
        known.push_back(index.name);
        if (index.name != name) continue;
        rename_tag(parameter, "float");
        set_attribute(parameter, "value", fmt::format("{}", index.value));
        return true;
    }
    diagnostics.error(parameter.value_place(*value),
                      fmt::format("no material '{}' has a known index of refraction{}", value->value,
                                  way_out(value->value, known)));
    return false;
}

bool millimetres(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || parameter.tag != "string") return true;
    Attribute number = *value;
    if (number.value.ends_with("mm")) {
        number.value.resize(number.value.size() - 2);
        number.value_length -= std::min<std::size_t>(number.value_length, 2);
    }
    const auto length = read_number(parameter, number, diagnostics);
    if (!length) return false;
    rename_tag(parameter, "float");
    set_attribute(parameter, "value", fmt::format("{}", *length));
    return true;
}

bool without_scale(Element& parameter, Diagnostics& diagnostics)
{
    if (parameter.tag != "transform") return true;
    Diagnostics ignored; // whoever reads it reports it
    const auto transform = read_transform(parameter, ignored);
    if (!transform) return true;
    const Transform::Rows& m = transform->rows();
    for (std::size_t column = 0; column < 3; ++column) {
        const double length = std::hypot(m[0][column], m[1][column], m[2][column]);
        if (std::abs(length - 1.0) < 1e-3) continue;
        diagnostics.error(
            parameter.place(),
            fmt::format(
                "the transform of a camera must not scale, as in Mitsuba; this one has a factor of {:.4g}",
                length));
        return false;
    }
    return true;
}

namespace {

// A transform as one of its columns.
bool replace_transform(Element& parameter, std::string_view tag, std::size_t column, Diagnostics& diagnostics)
{
    if (parameter.tag != "transform") return true;
    const auto transform = read_transform(parameter, diagnostics);
    if (!transform) return false;
    const Transform::Rows& m = transform->rows();
    rename_tag(parameter, tag);
    parameter.children.clear();
    set_attribute(parameter, "value", triple(m[0][column], m[1][column], m[2][column]));
    return true;
}

} // namespace

bool position_of(Element& parameter, Diagnostics& diagnostics)
{
    return replace_transform(parameter, "point", 3, diagnostics);
}

bool direction_of(Element& parameter, Diagnostics& diagnostics)
{
    return replace_transform(parameter, "vector", 2, diagnostics);
}

} // namespace plumb
