// SPDX-License-Identifier: MIT

// help, misspelled verbs, and the manuals of types, kinds and elements.

#include "cli/small_scene.h"
#include "cli/verbs.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/catalog.h"
#include "scene_file/placement.h"
#include "support/catch.h"

using namespace plumb;

TEST_CASE("help is another word for --help", "[cli][help]")
{
    const TempDirectory directory;
    const auto out = [&](const Names& words) {
        const RunResult result = run_renderer(words, directory.path());
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        return result.out;
    };
    const std::string all = out({"--help"});
    CHECK_THAT(all, ContainsSubstring("renderer help [VERB]"));
    CHECK(out({"help"}) == all);
    CHECK(out({"help", "render"}) == all);
    CHECK(out({"-h"}) == all);
    for (const Verb* row : all_verbs()) {
        if (row->name.empty()) continue;
        const std::string verb(row->name);
        CAPTURE(verb);
        CHECK_THAT(all, ContainsSubstring("renderer " + verb + " "));
        const std::string manual = out({verb, "--help"});
        CHECK_THAT(manual, ContainsSubstring("usage: renderer " + verb));
        CHECK(out({"help", verb}) == manual);
    }
    CHECK(out({"-V"}) == out({"--version"}));
    CHECK(out({"-V"}).starts_with("Plumb "));
}

TEST_CASE("words that are no verbs are wrong usage", "[cli][help]")
{
    const SceneDirectory directory;
    const auto complaint = [&](const Names& words) {
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        return result.err;
    };
    CHECK(complaint({}) == "error: no scene file given; 'renderer --help' shows how\n");
    CHECK(complaint({"help", "nonsense"}) ==
          "error: unknown verb 'nonsense'; 'renderer --help' lists the verbs\n");
    CHECK(complaint({"help", "comapre"}) == "error: unknown verb 'comapre'; did you mean 'compare'?\n");
    CHECK(complaint({"help", "diffuse"}) ==
          "error: 'diffuse' is not a verb; 'renderer types diffuse' prints its manual\n");
    CHECK(complaint({"help", "types", "diffuse"}) == "error: unexpected argument 'diffuse' after 'types'\n");
    CHECK(complaint({"nonsense", "scene.xml"}) ==
          "error: unknown verb 'nonsense'; 'renderer --help' lists the verbs\n");
    CHECK(complaint({"comapre", "a.exr", "b.exr"}) ==
          "error: unknown verb 'comapre'; did you mean 'compare'?\n");
    CHECK(complaint({"comapre", "a.exr", "b.exr", "--diff", "d.png"}) ==
          "error: unknown verb 'comapre'; did you mean 'compare'?\n");
    CHECK(complaint({"tpyes"}) == "error: unknown verb 'tpyes'; did you mean 'types'?\n");
    // Every verb with two letters swapped, alone and with other words.
    for (const Verb* row : all_verbs()) {
        std::string slip(row->name);
        if (slip.empty()) continue;
        std::swap(slip[0], slip[1]);
        CAPTURE(slip);
        const std::string expected =
            "error: unknown verb '" + slip + "'; did you mean '" + std::string(row->name) + "'?\n";
        CHECK(complaint({slip}) == expected);
        CHECK(complaint({slip, "scene.xml", "b.exr"}) == expected);
    }
    CHECK(directory.files() == Names{"scene.xml"});
}

TEST_CASE("a scene may be called as nobody would call it", "[cli][help]")
{
    const SceneDirectory directory;
    directory.write("chek", small_scene());
    CHECK(directory.run({"check", "chek", "--quiet"}).exit_code == 0);
    CHECK(directory.run({"chek", "-o", "a.exr"}).exit_code == 0);
}

TEST_CASE("types prints the manuals of kinds and elements, too", "[cli][help]")
{
    const TempDirectory directory;
    const auto out = [&](const std::string& name) {
        const RunResult result = run_renderer({"types", name}, directory.path());
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        return result.out;
    };
    // A kind's page lists its types and no others.
    for (const TypeInfo& type : known_types()) {
        CAPTURE(type.kind, type.name);
        const std::string page = out(std::string(type.kind));
        for (const TypeInfo& other : known_types())
            CHECK((page.find("\n  " + std::string(other.name) + " ") != std::string::npos) ==
                  (other.kind == type.kind));
    }
    CHECK(out("mesh") == out("shape"));
    for (const std::string_view tag : all_tags()) {
        if (kind_of_tag(tag).empty() && tag != "render" && tag != "group" && tag != "define")
            CHECK_THAT(out(std::string(tag)), ContainsSubstring(std::string(tag)));
    }
    CHECK_THAT(out("transform"), ContainsSubstring("lookat      origin="));
    CHECK_THAT(out("rfilter"), ContainsSubstring("It stands in <camera>"));
    CHECK(out("lookat") == out("transform"));

    const auto complaint = [&](const std::string& name) {
        const RunResult result = run_renderer({"types", name}, directory.path());
        CHECK(result.exit_code == 2);
        return result.err;
    };
    CHECK_THAT(out("mipath"), ContainsSubstring("'path_mis' here"));
    CHECK(complaint("metal") == "error: bsdf 'metal' is 'roughconductor' here\n");
    CHECK(complaint("camrea") == "error: unknown type 'camrea'; did you mean 'camera'?\n");
    CHECK(complaint("nonsense") == "error: unknown type 'nonsense'; 'renderer types' lists them\n");
}
