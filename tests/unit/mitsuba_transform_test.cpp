// SPDX-License-Identifier: MIT

// Transforms and bounds of shapes beside those of Mitsuba 3.9.1.

#include "plumb/base/error.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <optional>

using namespace plumb;
using namespace plumb::test;

namespace {

// Nothing: the file is refused.
std::optional<Box3f> bounds_of(const std::string& shape)
{
    try {
        const LoadedScene loaded =
            load_text("<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'/>" + shape +
                      "</scene>");
        return loaded.job.scene->objects().front().shape->bounds();
    } catch (const SceneError&) {
        return std::nullopt;
    }
}

struct Operations {
    const char* text;
    std::optional<Vec3d> where; // (1, 0, 0) goes
};

const Operations transforms[] = {
    {R"(<translate y="1"/><rotate z="1" angle="90"/>)", Vec3d{-1, 1, 0}},
    {R"(<rotate z="1" angle="90"/>)", Vec3d{0, 1, 0}},
    {R"(<rotate y="1" angle="90"/>)", Vec3d{0, 0, -1}},
    {R"(<rotate value="0 0 1" angle="90"/>)", Vec3d{0, 1, 0}},
    {R"(<rotate z="2" angle="90"/>)", Vec3d{0, 1, 0}}, // Mitsuba, which takes the axis as it is: 0, 2, 0
    {R"(<rotate x="1" y="1" z="1" angle="120"/>)",
     Vec3d{0, 1, 0}}, // Mitsuba, which takes the axis as it is: 1, 2.366, 0.634
    {R"(<scale value="2"/>)", Vec3d{2, 0, 0}},
    {R"(<scale value="2 3 4"/>)", Vec3d{2, 0, 0}},
    {R"(<scale x="2"/>)", Vec3d{2, 0, 0}},
    {R"(<translate value="1, 2, 3"/>)", Vec3d{2, 2, 3}},
    {R"(<translate value="2"/>)", Vec3d{3, 2, 2}},
    {R"(<matrix value="1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1"/>)", Vec3d{6, 6, 7}},
    {R"(<matrix value="0 -1 0  1 0 0  0 0 1"/>)", Vec3d{0, 1, 0}},
    {R"(<matrix value="1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1"/>)", Vec3d{1, 0, 0}},
    {R"(<matrix value="1 0 0 0  0 1 0 0  0 0 1 0  1 0 0 1"/>)", Vec3d{1, 0, 0}},
    {R"(<lookat origin="0, 0, 0" target="1, 0, 0" up="0, 0, 1"/>)", Vec3d{0, 1, 0}},
    {R"(<lookat origin="0, 0, 0" target="1, 0, 0"/>)", Vec3d{0, -1, 0}},
    {R"(<lookat origin="0, 0, 0" target="1, 0, 0" up="1, 0, 0"/>)", std::nullopt},
    {R"(<lookAt origin="0, 0, 0" target="1, 0, 0" up="0, 0, 1"/>)", std::nullopt}, // of older files
    {R"(<lookat origin="0 0 0" target="1 0 0" up="0 0 1"/>)", Vec3d{0, 1, 0}},
    {R"(<rotate z="1"/>)", std::nullopt},
    {R"(<scale x="-1"/>)", Vec3d{-1, 0, 0}},
};

struct Bounds {
    const char* shape;
    std::optional<Vec3d> min, max;
};

const Bounds shapes[] = {
    {R"(<shape type="sphere"><point name="center" value="1, 0, 0"/><float name="radius" value="2"/><transform name="to_world"><scale value="3"/><translate y="1"/></transform></shape>)",
     Vec3d{-3, -5, -6}, Vec3d{9, 7, 6}},
    {R"(<shape type="sphere"><transform name="to_world"><scale x="2"/></transform></shape>)", std::nullopt,
     std::nullopt}, // Mitsuba warns and has a sphere of radius 2
    {R"(<shape type="cylinder"><point name="p0" value="0, 0, 0"/><point name="p1" value="0, 2, 0"/><float name="radius" value=".5"/></shape>)",
     Vec3d{-0.5, 0, -0.5}, Vec3d{0.5, 2, 0.5}},
    {R"(<shape type="sphere"><point name="center" x="1" y="2" z="3"/></shape>)", Vec3d{0, 1, 2},
     Vec3d{2, 3, 4}},
    {R"(<shape type="sphere"><point name="center" x="1" y="2"/></shape>)", std::nullopt, std::nullopt},
    {R"(<shape type="sphere"><boolean name="flip_normals" value="true"/></shape>)", Vec3d{-1, -1, -1},
     Vec3d{1, 1, 1}},
};

} // namespace

TEST_CASE("transforms do what they do in Mitsuba", "[unit][mitsuba]")
{
    for (const Operations& row : transforms) {
        CAPTURE(row.text);
        const auto bounds = bounds_of(
            "<shape type='rectangle'><transform name='to_world'><scale value='0.001'/><translate x='1'/>" +
            std::string(row.text) + "</transform></shape>");
        REQUIRE(bounds.has_value() == row.where.has_value());
        if (!bounds) continue;
        const Vec3d center = 0.5 * (Vec3d(bounds->min) + Vec3d(bounds->max));
        for (int i = 0; i < 3; ++i) CHECK(center[i] == Approx((*row.where)[i]).margin(1e-5));
    }
}

TEST_CASE("shapes have the bounds that they have in Mitsuba", "[unit][mitsuba]")
{
    for (const Bounds& row : shapes) {
        CAPTURE(row.shape);
        const auto bounds = bounds_of(row.shape);
        REQUIRE(bounds.has_value() == row.min.has_value());
        if (!bounds) continue;
        for (int i = 0; i < 3; ++i) {
            CHECK(static_cast<double>(bounds->min[i]) == Approx((*row.min)[i]).margin(1e-5));
            CHECK(static_cast<double>(bounds->max[i]) == Approx((*row.max)[i]).margin(1e-5));
        }
    }
}
