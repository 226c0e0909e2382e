// SPDX-License-Identifier: MIT

// check says when a scene lies so far from the origin that floats cannot hold it.

#include "plumb/check.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// A room of size 2 with a sphere in it, `offset` from the origin along each axis.
std::string room(double offset, const std::string& more = "")
{
    const auto at = [&](double x, double y, double z) {
        return fmt::format("{},{},{}", x + offset, y + offset, z + offset);
    };
    const auto wall = [&](double x, double y, double z) {
        return fmt::format(
            "<mesh type='rectangle'><float name='width' value='2'/><float name='height' value='2'/><point "
            "name='center' value='{}'/><vector name='normal' value='{},{},{}'/></mesh>",
            at(-x, -y, -z), x, y, z);
    };
    return "<scene dialect='plumb'><integrator type='path_mis'/><camera type='perspective'>"
           "<integer name='width' value='8'/><integer name='height' value='8'/><transform "
           "name='toWorld'><lookat "
           "origin='" +
           at(0, 0, 0.9) + "' target='" + at(0, 0, 0) + "' up='0,1,0'/></transform></camera>" +
           wall(1, 0, 0) + wall(-1, 0, 0) + wall(0, 1, 0) + wall(0, -1, 0) + wall(0, 0, 1) + wall(0, 0, -1) +
           "<mesh type='sphere'><point name='center' value='" + at(0, 0, -0.5) +
           "'/><float name='radius' value='0.3'/><emitter type='area'/></mesh>" + more + "</scene>";
}

std::string doubts(const std::string& scene)
{
    const LoadedScene loaded = load_text(scene);
    std::string text;
    for (const Doubt& doubt : find_doubts(loaded.job)) text += doubt.object + ": " + doubt.text + "\n";
    return text;
}

} // namespace

TEST_CASE("a scene far from the origin is doubtful", "[unit][check]")
{
    for (const double offset : {0.0, 1.0, 10.0, 100.0}) CHECK(doubts(room(offset)).empty());
    CHECK(doubts(room(1000.0)) == ": the scene is too far from the origin for 32-bit floats: at coordinates "
                                  "up to 1001 floats are 6.1e-05 apart, 1/32768 of its size of 2; move all "
                                  "of it, including the camera, by (-1000, -1000, -1000)\n");
    CHECK_THAT(doubts(room(1e5)), ContainsSubstring("floats are 0.0078 apart, 1/256 of its size of 2; move"));
}

TEST_CASE("something far away hides nothing", "[unit][check]")
{
    const std::string far =
        "<mesh type='sphere'><point name='center' value='-5000,0,0'/><float name='radius' "
        "value='900'/></mesh>";
    CHECK_THAT(
        doubts(room(1000.0, far)),
        ContainsSubstring(
            ": the camera is too far from the origin for 32-bit floats: at coordinates up to 1001 floats "
            "are 6.1e-05 apart, 1/") &&
            ContainsSubstring(" to what it sees; move the whole scene by (-1000, -1000, -1001)\n"));
    CHECK_THAT(doubts(room(0.0, far)), !ContainsSubstring("floats"));
}

TEST_CASE("a small lamp far away is doubtful only where floats cannot hold it", "[unit][check]")
{
    const auto ball = [](double radius) {
        return fmt::format("<mesh type='sphere'><point name='center' value='0,100,0'/><float name='radius' "
                           "value='{}'/><emitter type='area'/></mesh>",
                           radius);
    };
    CHECK(doubts(room(0.0, ball(0.01))).empty());
    CHECK_THAT(doubts(room(0.0, ball(0.001))),
               ContainsSubstring("mesh 'sphere' (scene.xml:1): it is too small for 32-bit floats at its "
                                 "position: at coordinates up to 100 floats are 7.6e-06 apart, 1/26"));
}
