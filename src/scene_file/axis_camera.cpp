// SPDX-License-Identifier: MIT
#include "scene_file/axis_camera.h"

#include "plumb/math/transform.h"
#include "scene_file/property_values.h"

#include <algorithm>

namespace plumb {

namespace {

constexpr const char* narrow_view = "1e-6"; // degrees

bool is_one(const Element& camera, std::string_view name)
{
    return std::any_of(camera.children.begin(), camera.children.end(), [name](const Element& child) {
        return child.tag == "integer" && child.value("name") == name && child.value("value") == "1";
    });
}

bool has_one_pixel(const Element& camera, const std::optional<Vec2i>& resolution)
{
    return resolution ? *resolution == Vec2i(1, 1) : is_one(camera, "width") && is_one(camera, "height");
}

std::optional<Vec3d> vector_of(const Element& lookat, std::string_view name)
{
    const Attribute* attribute = lookat.attribute(name);
    Diagnostics ignored; // whoever reads the camera reports it
    if (!attribute) return std::nullopt;
    const auto numbers = read_numbers(lookat, *attribute, {3}, ignored);
    if (!numbers) return std::nullopt;
    return Vec3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

// The axis that is furthest from the view of a lookat whose up is parallel to it; nothing for other ones.
const char* missing_up(const Element& lookat)
{
    const auto origin = vector_of(lookat, "origin"), target = vector_of(lookat, "target"),
               up = vector_of(lookat, "up");
    if (!origin || !target || !up || *origin == *target || *up == Vec3d(0.0) ||
        Transform::look_at(*origin, *target, *up))
        return nullptr;
    for (const auto& [axis, text] :
         {std::pair(Vec3d(1.0, 0.0, 0.0), "1,0,0"), std::pair(Vec3d(0.0, 1.0, 0.0), "0,1,0")})
        if (Transform::look_at(*origin, *target, axis)) return text;
    return nullptr;
}

void narrow(Element& camera)
{
    std::erase_if(camera.children, [](const Element& child) { return child.value("name") == "fov"; });
    Element fov;
    fov.tag = "float";
    fov.file = camera.file;
    fov.tag_offset = camera.tag_offset;
    fov.attributes = {{.name = "name", .value = "fov", .verbatim = false},
                      {.name = "value", .value = narrow_view, .verbatim = false}};
    camera.children.push_back(std::move(fov));
}

} // namespace

std::optional<Element> axis_camera(const Element& camera, const std::optional<Vec2i>& resolution,
                                   Diagnostics& diagnostics)
{
    if (!has_one_pixel(camera, resolution)) return std::nullopt;
    std::optional<Element> axis;
    for (std::size_t i = 0; i < camera.children.size(); ++i)
        for (std::size_t j = 0; j < camera.children[i].children.size(); ++j) {
            const Element& lookat = camera.children[i].children[j];
            const char* const up = lookat.tag == "lookat" ? missing_up(lookat) : nullptr;
            if (!up) continue;
            diagnostics.warning(
                lookat.value_place(*lookat.attribute("up")),
                "lookat's up is parallel to the direction from origin to target: the one pixel shows "
                "what the axis of the camera sees, as in the courses' renderers");
            if (!axis) axis = camera;
            for (Attribute& attribute : axis->children[i].children[j].attributes)
                if (attribute.name == "up") attribute.value = up;
        }
    if (axis) narrow(*axis);
    return axis;
}

} // namespace plumb
