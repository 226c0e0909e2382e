// SPDX-License-Identifier: MIT

// What differs from one kind of processor to another: Embree's instruction sets, and the mode of floating-point numbers.

#include "plumb/scene/instruction_set.h"

#include "base/float_mode.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "plumb/settings/render_settings.h"
#include "support/catch.h"
#include "support/params.h"

#include <algorithm>
#include <limits>

namespace plumb {
class Diffuse;
class Sphere;
} // namespace plumb

using namespace plumb;
using test::ParamsBuilder;

namespace {

// A unit sphere at the origin.
Scene traced_with(const std::string& instruction_set)
{
    std::vector<SceneObject> objects;
    objects.push_back({ParamsBuilder("mesh", "sphere").build<Sphere, Shape>(),
                       ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "sphere"});
    return {std::move(objects), {}, {false, instruction_set}};
}

std::string refusal(const std::string& instruction_set)
{
    try {
        traced_with(instruction_set);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

} // namespace

TEST_CASE("every instruction set that the processor has traces rays, the default among them", "[unit][isa]")
{
    std::vector<std::string_view> traced;
    for (const InstructionSet& set : instruction_sets()) {
        if (set.runs_here()) {
            const Scene scene = traced_with(std::string(set.name));
            CHECK(scene.options().instruction_set == set.name);
            CHECK(scene.intersect({Vec3f(0.f, 0.f, 5.f), Vec3f(0.f, 0.f, -1.f)}));
            CHECK_FALSE(scene.intersect({Vec3f(0.f, 2.f, 5.f), Vec3f(0.f, 0.f, -1.f)}));
            traced.push_back(set.name);
        } else {
            CHECK(refusal(std::string(set.name)) == "this processor cannot run Embree with " +
                                                        std::string(set.name) +
                                                        "; choose another with --isa");
        }
    }
    CHECK(std::find(traced.begin(), traced.end(), default_instruction_set().name) != traced.end());
    CHECK(SceneOptions().instruction_set == default_instruction_set().name);
}

TEST_CASE("an instruction set of another kind of processor is refused, with those that there are",
          "[unit][isa]")
{
    const std::string text = refusal("altivec");
    CHECK_THAT(text, ContainsSubstring("unknown instruction set 'altivec'; known "));
    for (const std::string_view name : instruction_set_names())
        CHECK_THAT(text, ContainsSubstring(std::string(name)));
}

TEST_CASE("--isa and its help name the instruction sets that there are", "[unit][isa][options]")
{
    const auto* row = find_setting<RenderSettings>("isa");
    REQUIRE(row);
    for (const std::string_view name : instruction_set_names()) {
        CHECK_THAT(std::string(row->help), ContainsSubstring(std::string(name)));
        RenderSettings settings;
        row->set(settings, "--isa", name);
        CHECK(settings.method.instruction_set == name);
    }
    CHECK_THAT(std::string(row->help),
               ContainsSubstring("(default " + std::string(default_instruction_set().name) + ")"));
}

TEST_CASE("denormal numbers are zero while rays are traced, as operands and as results", "[unit][isa]")
{
    volatile float denormal = std::numeric_limits<float>::denorm_min();
    volatile float smallest = std::numeric_limits<float>::min();
    volatile float large = 0x1p100f;
    CHECK(denormal * large != 0.f);
    CHECK(smallest * 0.5f != 0.f);
    {
        const FlushDenormals flush;
        const float from_operand = denormal * large;
        const float from_result = smallest * 0.5f;
        CHECK(from_operand == 0.f);
        CHECK(from_result == 0.f);
    }
    CHECK(denormal * large != 0.f);
}
