// SPDX-License-Identifier: MIT
#pragma once

// Lamps of every flat kind, and spheres, at places where single precision has little to give: in coordinate planes, close
// to them and far away, along axes and in any direction, from 0.05 to 20 in size.

#include "plumb/model/shape.h"
#include "support/random.h"

#include <memory>
#include <string>
#include <vector>

namespace plumb::test {

enum class LampKind { rectangle, rectangle_mesh, quad_mesh, triangle, needle, sphere };
inline constexpr LampKind all_lamp_kinds[] = {LampKind::rectangle, LampKind::rectangle_mesh,
                                              LampKind::quad_mesh, LampKind::triangle,
                                              LampKind::needle,    LampKind::sphere};
const char* to_string(LampKind kind);

// A lamp before it becomes a shape. World space.
struct PlacedLamp {
    LampKind kind{};
    double size = 1.0; // of its longest side, or its diameter
    Vec3f center;
    Vec3d normal;               // of its front; of a sphere: nothing
    std::vector<Vec3f> corners; // in order; none of a sphere
    float radius = 0.f;         // of a sphere

    std::string text() const; // for messages
};

// A coordinate that has been trouble: 0, or 1e-3 to 1e3 on either side.
double awkward_coordinate(TestRandom& random);

// plane: the coordinate of its centre, along the axis that it faces where it faces one (two times in three).
PlacedLamp place_lamp(TestRandom& random, LampKind kind, double plane);

// The lowest height of the lamp's triangles; infinite for a sphere.
double height_of(const PlacedLamp& lamp);

// By about what fraction the light of a lamp is off because its corners, and the points on it, are rounded to floats, seen
// with that cosine.
double rounding_error(const PlacedLamp& lamp, double steepness);

std::unique_ptr<Shape> shape_of(const PlacedLamp& lamp);

// A point from which the lamp's front is seen, `distance` from its centre; steepness: the cosine there.
Vec3d point_in_front(TestRandom& random, const PlacedLamp& lamp, double distance, double steepness);

// The irradiance at `at`, whose unit normal is `normal`, from the lamp's front with radiance 1: Lambert's formula for
// polygons, cut at the horizon; of a sphere the closed form, which holds where it is wholly above the horizon. 1 is that of
// the whole hemisphere.
double form_factor(const PlacedLamp& lamp, const Vec3d& at, const Vec3d& normal);

} // namespace plumb::test
