// SPDX-License-Identifier: MIT
// <transform> and the operations in it.

#include "scene_file/placement.h"
#include "scene_file/property_values.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

std::optional<Vec3d> read_vector(const Element& element, std::string_view name, Diagnostics& diagnostics)
{
    const auto numbers = read_numbers(element, *element.attribute(name), {3}, diagnostics);
    if (!numbers) return {};
    return Vec3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::optional<Transform> read_translate(const Element& element, Diagnostics& diagnostics)
{
    if (!check_attributes(element, {"value"}, {}, diagnostics)) return {};
    const auto offset = read_vector(element, "value", diagnostics);
    if (!offset) return {};
    return Transform::translate(*offset);
}

std::optional<Transform> read_scale(const Element& element, Diagnostics& diagnostics)
{
    if (!check_attributes(element, {"value"}, {}, diagnostics)) return {};
    const auto factors = read_vector(element, "value", diagnostics);
    if (!factors) return {};
    const auto scale = Transform::scale(*factors);
    if (!scale)
        diagnostics.error(
            element.value_place(*element.attribute("value")),
            fmt::format("a scale must not be 0 along any axis, as in '{}': nothing would be left",
                        element.value("value")));
    return scale;
}

std::optional<Transform> read_rotate(const Element& element, Diagnostics& diagnostics)
{
    if (!check_attributes(element, {"axis", "angle"}, {}, diagnostics)) return {};
    const auto axis = read_vector(element, "axis", diagnostics);
    const auto angle = read_number(element, *element.attribute("angle"), diagnostics);
    if (!axis || !angle) return {};
    if (*axis == Vec3d(0.0)) {
        diagnostics.error(element.value_place(*element.attribute("axis")),
                          "the axis of a rotation must not be the zero vector");
        return {};
    }
    return Transform::rotate(*axis, *angle);
}

std::optional<Transform> read_lookat(const Element& element, Diagnostics& diagnostics)
{
    if (!check_attributes(element, {"origin", "target", "up"}, {}, diagnostics)) return {};
    const auto origin = read_vector(element, "origin", diagnostics);
    const auto target = read_vector(element, "target", diagnostics);
    const auto up = read_vector(element, "up", diagnostics);
    if (!origin || !target || !up) return {};
    const auto fail = [&](std::string_view name, std::string_view message) {
        diagnostics.error(element.value_place(*element.attribute(name)), std::string(message));
        return std::nullopt;
    };
    if (*origin == *target) return fail("target", "lookat's target must differ from its origin");
    if (*up == Vec3d(0.0)) return fail("up", "lookat's up must not be the zero vector");
    const auto look_at = Transform::look_at(*origin, *target, *up);
    if (!look_at)
        return fail("up", "lookat's up must not be parallel to the direction from origin to target");
    return look_at;
}

std::optional<Transform> read_matrix(const Element& element, Diagnostics& diagnostics)
{
    if (!check_attributes(element, {"value"}, {}, diagnostics)) return {};
    const Attribute& value = *element.attribute("value");
    const auto numbers = read_numbers(element, value, {16}, diagnostics);
    if (!numbers) return {};
    Transform::Rows rows;
    for (std::size_t i = 0; i < 16; ++i) rows[i / 4][i % 4] = (*numbers)[i];
    const bool affine = rows[3] == std::array{0.0, 0.0, 0.0, 1.0};
    const auto matrix = affine ? Transform::from_rows(rows) : std::nullopt;
    if (!matrix)
        diagnostics.error(element.value_place(value),
                          affine
                              ? "the matrix is singular: it has no inverse"
                              : "the last row of a matrix must be 0 0 0 1; matrices are written row by row");
    return matrix;
}

using ReadOperation = std::optional<Transform> (*)(const Element&, Diagnostics&);
struct Operation {
    std::string_view tag;
    ReadOperation read;
};
constexpr Operation operations[] = {{"translate", read_translate},
                                    {"scale", read_scale},
                                    {"rotate", read_rotate},
                                    {"lookat", read_lookat},
                                    {"matrix", read_matrix}};

const Operation* find_operation(std::string_view tag)
{
    const auto* found = std::find_if(std::begin(operations), std::end(operations),
                                     [&](const Operation& operation) { return operation.tag == tag; });
    return found == std::end(operations) ? nullptr : found;
}

// Whether the matrix and its inverse can be used with 32-bit floats.
bool is_sane(const Transform& transform)
{
    const auto finite = [](const Transform& t) {
        return std::all_of(t.rows().begin(), t.rows().end(), [](const auto& row) {
            return std::all_of(row.begin(), row.end(),
                               [](double x) { return std::isfinite(static_cast<float>(x)); });
        });
    };
    return transform.determinant() != 0.0 && finite(transform) && finite(transform.inverse());
}

} // namespace

std::optional<Transform> read_transform(const Element& element, Diagnostics& diagnostics)
{
    Transform product;
    bool good = true;
    for (const Element& child : element.children) {
        const Operation* operation = find_operation(child.tag);
        if (!operation) {
            diagnostics.error(child.place(), rejection(element, child));
            good = false;
            continue;
        }
        for (const Element& inner : child.children) {
            diagnostics.error(inner.place(), rejection(child, inner));
            good = false;
        }
        if (const auto step = operation->read(child, diagnostics))
            product = *step * product;
        else
            good = false;
    }
    if (!good) return {};
    if (!is_sane(product)) {
        diagnostics.error(element.place(),
                          "the operations of this transform make a matrix that is singular, or too "
                          "large or too small for 32-bit floats");
        return {};
    }
    return product;
}

} // namespace plumb
