// SPDX-License-Identifier: MIT

// What integrators accept and what they complain of.

#include "support/catch.h"
#include "support/integrators.h"
#include "support/lamp.h"

#include "plumb/base/error.h"
#include "plumb/model/shape.h"

using namespace plumb;
using namespace plumb::test;

namespace {

using Complaints = std::vector<std::string>;

ParamsBuilder mcgill()
{
    return integrator_params("path").string("termination", "max-depth");
}

Complaints with(const std::string& name, const std::string& word)
{
    return integrator_complaints(mcgill().string(name, word));
}

Complaints roulette(double probability)
{
    return integrator_complaints(configured_path(false, "russian-roulette", probability));
}

} // namespace

TEST_CASE("the hand-out's integrator block is accepted as it stands", "[unit][integrator]")
{
    CHECK(integrator_complaints(integrator_params("path")
                                    .boolean("isExplicit", false)
                                    .string("termination", "russian-roulette")
                                    .number("termination-param", 0.2)
                                    .string("direct-measure", "solid-angle")
                                    .string("indirect-measure", "hemisphere")
                                    .string("indirect-warp", "cosine-hemisphere"))
              .empty());
}

TEST_CASE("every word of the configurable path tracer is accepted", "[unit][integrator]")
{
    for (const char* word : {"solid-angle", "area", "hemisphere", "none"})
        CHECK(with("direct-measure", word).empty());
    for (const char* word : {"cosine-hemisphere", "uniform-hemisphere", "none"}) {
        CHECK(with("direct-warp", word).empty());
        CHECK(with("indirect-warp", word).empty());
    }
    CHECK(with("indirect-measure", "hemisphere").empty());
    CHECK(integrator_complaints(mcgill().integer("termination-param", 3)).empty());
    CHECK(integrator_complaints(mcgill().number("termination-param", 3.0)).empty());
    CHECK(integrator_complaints(mcgill().integer("nSamples", 1)).empty());
    CHECK(integrator_complaints(mcgill().integer("maxDepth", 3)).empty());
}

TEST_CASE("unknown words are errors that list the known ones", "[unit][integrator]")
{
    CHECK(with("direct-measure", "solidangle") ==
          Complaints{"error: direct-measure must be 'solid-angle', 'area', 'hemisphere' or 'none', not "
                     "'solidangle'"});
    CHECK(with("indirect-measure", "area") ==
          Complaints{"error: indirect-measure must be 'hemisphere', not 'area'"});
    CHECK(with("indirect-warp", "uniform-sphere") ==
          Complaints{"error: indirect-warp must be 'cosine-hemisphere', 'uniform-hemisphere' or 'none', not "
                     "'uniform-sphere'"});
    CHECK(with("direct-warp", "beckmann") ==
          Complaints{"error: direct-warp must be 'cosine-hemisphere', 'uniform-hemisphere' or 'none', not "
                     "'beckmann'"});
    CHECK(integrator_complaints(integrator_params("path").string("termination", "max_depth")) ==
          Complaints{"error: termination must be 'max-depth' or 'russian-roulette', not 'max_depth'"});
}

TEST_CASE("termination-param is a whole number of bounces or a probability", "[unit][integrator]")
{
    CHECK(roulette(0.2).empty());
    for (const double wrong : {0.0, 1.0, 2.0, -0.1}) {
        const Complaints complaints = roulette(wrong);
        REQUIRE(complaints.size() == 1);
        CHECK_THAT(complaints[0], ContainsSubstring("error: termination-param must be in (0, 1), not"));
    }
    CHECK(
        integrator_complaints(mcgill().number("termination-param", 1.5)) ==
        Complaints{"error: termination-param must be a whole number of bounces for termination 'max-depth', "
                   "not 1.5"});
    const Complaints negative = integrator_complaints(mcgill().integer("termination-param", -1));
    REQUIRE(negative.size() == 1);
    CHECK_THAT(negative[0], ContainsSubstring("error: termination-param must be in [0, "));
    CHECK(integrator_complaints(integrator_params("path").string("termination", "russian-roulette")) ==
          Complaints{
              "error: termination-param must be given for termination 'russian-roulette': the probability "
              "that a path ends, in (0, 1)"});
    CHECK(integrator_complaints(integrator_params("path").boolean("isExplicit", false)) ==
          Complaints{
              "error: termination must be given for this path tracer: 'max-depth' or 'russian-roulette'"});
}

TEST_CASE("parameters without effect are warned of", "[unit][integrator]")
{
    const auto warns = [](const ParamsBuilder& params, const std::string& text) {
        const Complaints complaints = integrator_complaints(params);
        REQUIRE(complaints.size() == 1);
        CHECK_THAT(complaints[0], ContainsSubstring("warning: " + text));
    };
    warns(mcgill().integer("nSamples", 4), "nSamples is not used");
    warns(mcgill().integer("rrDepth", 4), "rrDepth is not used");
    warns(mcgill().boolean("isExplicit", true), "explicit mode without a direct-measure");
}

TEST_CASE("the configurable path tracer's parameters belong to 'path' alone", "[unit][integrator]")
{
    for (const char* type : {"path_mats", "path_nee", "path_mis"}) {
        const Complaints complaints =
            integrator_complaints(integrator_params(type).boolean("isExplicit", true));
        REQUIRE(complaints.size() == 1);
        CHECK_THAT(complaints[0], ContainsSubstring("unknown parameter 'isExplicit'"));
    }
}

TEST_CASE("maxDepth, rrDepth and heuristic are checked", "[unit][integrator]")
{
    for (const char* type : {"path", "path_mats", "path_nee", "path_mis"}) {
        CHECK(integrator_complaints(integrator_params(type).integer("maxDepth", -1).integer("rrDepth", 0))
                  .empty());
        CHECK(integrator_complaints(integrator_params(type).integer("maxDepth", -2)).size() == 1);
        CHECK(integrator_complaints(integrator_params(type).integer("rrDepth", -1)).size() == 1);
    }
    CHECK(integrator_complaints(integrator_params("path_mis").string("heuristic", "maximum")) ==
          Complaints{"error: heuristic must be 'balance' or 'power', not 'maximum'"});
    CHECK(integrator_complaints(integrator_params("path_nee").string("heuristic", "power")).size() == 1);
}

TEST_CASE("the integrators of direct light check their parameters", "[unit][integrator]")
{
    CHECK(integrator_complaints(integrator_params("direct").integer("nSamples", 0)).size() == 1);
    CHECK(integrator_complaints(integrator_params("direct").string("measure", "sphere")) ==
          Complaints{"error: measure must be 'area', 'solid-angle', 'hemisphere' or 'bsdf', not 'sphere'"});
    CHECK(integrator_complaints(integrator_params("direct-mis").string("measure1", "bsdf")) ==
          Complaints{
              "error: measure2 must differ from measure1; to use one technique alone there is 'direct'"});
    CHECK(integrator_complaints(integrator_params("av")) ==
          Complaints{"error: length must be given: how far occluders reach, in units of the scene"});
    CHECK(integrator_complaints(integrator_params("simple").color("energy", Color(1.f))) ==
          Complaints{"error: position must be given with energy: where the light is"});
    CHECK(integrator_complaints(integrator_params("simple").point("position", Vec3f(1.f))).size() == 1);
}

TEST_CASE("solid-angle sampling of meshes and parallelograms is refused when the scene is known",
          "[unit][integrator]")
{
    LittleScene little;
    little.sphere(Vec3f(0.f), 1.f, diffuse(0.5f), Color(1.f)).environment(Color(1.f));
    little.rectangle(Vec3f(0.f), 1.f, 1.f, Vec3f(0, 1, 0), diffuse(0.5f), Color(1.f));
    const Scene good = little.build();
    const Lamp rectangle_of_triangles = white(mesh(even_sheet)), bent = white(mesh(bent_sheet));
    const Lamp parallelogram = white(
        ParamsBuilder("shape", "rectangle")
            .transform("toWorld",
                       *Transform::from_rows({{{1, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}))
            .build<Rectangle, Shape>());
    const Scene& bad = bent.scene();
    const ParamsBuilder asking[] = {
        configured_path(true, "max-depth", 1).string("direct-measure", "solid-angle"),
        integrator_params("direct").string("measure", "solid-angle"),
        integrator_params("direct-mis").string("measure1", "solid-angle"),
    };
    for (const ParamsBuilder& params : asking) {
        CHECK_NOTHROW(make_integrator(params, good));
        CHECK_NOTHROW(make_integrator(params, rectangle_of_triangles.scene()));
        CHECK_THROWS_AS(make_integrator(params, parallelogram.scene()), Error);
        CHECK_THROWS_AS(make_integrator(params, bad), Error);
    }
    try {
        make_integrator(asking[0], bad);
    } catch (const Error& error) {
        CHECK(std::string(error.what()) ==
              "direct-measure cannot be 'solid-angle': the light of lamp can only "
              "be sampled by area; use 'area'");
    }
    // Implicit mode checks the word and does not use it.
    CHECK_NOTHROW(
        make_integrator(configured_path(false, "max-depth", 1).string("direct-measure", "solid-angle"), bad));
}

TEST_CASE("an integrator says what it leaves out", "[unit][integrator]")
{
    const Scene scene = LittleScene().room(diffuse(0.5f), Color(1.f)).build();
    const auto bias = [&](const ParamsBuilder& params) { return make_integrator(params, scene)->bias(); };
    for (const char* type : {"path", "path_nee", "path_mis", "path_mats"}) {
        CHECK(bias(integrator_params(type)).empty());
        CHECK(bias(integrator_params(type).integer("maxDepth", 5)) ==
              "light of more than 5 surface bounces is omitted");
        CHECK(bias(integrator_params(type).integer("maxDepth", 0)) == "all light except emission is omitted");
    }
    CHECK(bias(configured_path(false, "russian-roulette", 0.2)).empty());
    CHECK(bias(configured_path(true, "max-depth", 3)) == "light of more than 3 surface bounces is omitted");
    for (const char* type :
         {"direct", "direct_ems", "direct_mats", "direct_mis", "direct-mis", "direct_whitted"})
        CHECK(bias(integrator_params(type)) == "light of more than 1 surface bounce is omitted");
    for (const char* type : {"whitted", "normals", "depth", "ao", "simple"})
        CHECK_FALSE(bias(integrator_params(type)).empty());
    CHECK_FALSE(bias(integrator_params("av").number("length", 1.0)).empty());
}
