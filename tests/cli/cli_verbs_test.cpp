// SPDX-License-Identifier: MIT

// What the program prints.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/vocabulary_manual.h"
#include "support/catch.h"

using namespace plumb;

TEST_CASE("--json reports the run", "[cli][json]")
{
    const SceneDirectory directory;
    // Without looks for lamps, each sample has one ray of the camera.
    directory.write(
        "scene.xml",
        small_scene(R"(<integrator type="path_mis"><integer name="outlineRays" value="0"/></integrator>)"));
    const RunResult result =
        directory.run({"scene.xml", "-o", "a.exr", "--json", "a.json", "--threads", "2"});
    REQUIRE(result.exit_code == 0);
    CHECK(directory.files() == Names{"a.exr", "a.json", "scene.xml"});
    const std::string json = read_bytes(directory / "a.json");
    for (const char* part :
         {"\"scene\": \"scene.xml\"", "\"name\": \"plumb\"", "\"integrator\": \"path_mis\"", "\"spp\": 4",
          "\"resolution\": [\n    48,\n    36\n  ]", "\"crop\": null", "\"camera\": 6912,", "\"threads\": 2",
          "\"instruction_set\": \"avx2\"", "\"outputs\": [\n    \"a.exr\"\n  ]", "\"first\": null"})
        CHECK_THAT(json, ContainsSubstring(part));

    SECTION("to standard output")
    {
        const RunResult printed = directory.run({"scene.xml", "-o", "b.exr", "--json", "-", "--quiet"});
        CHECK(printed.exit_code == 0);
        CHECK(printed.err.empty());
        CHECK(printed.out.starts_with("{\n"));
        CHECK(printed.out.ends_with("}\n"));
    }
    SECTION("standard output that is full is an error")
    {
        const RunResult full =
            directory.run({"scene.xml", "-o", "b.exr", "--json", "-", "--quiet"}, "/dev/full");
        CHECK(full.exit_code == 1);
        CHECK(full.err == "error: cannot write to standard output: No space left on device\n");
    }
}

TEST_CASE("--quiet prints nothing, --verbose more", "[cli][log]")
{
    const SceneDirectory directory;
    const RunResult quiet = directory.run({"scene.xml", "-o", "a.exr", "--quiet"});
    CHECK(quiet.exit_code == 0);
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());
    CHECK(directory.run({"none.xml", "--quiet"}).err == "error: scene file 'none.xml' does not exist\n");

    const RunResult verbose = directory.run({"scene.xml", "-o", "a.exr", "--verbose"});
    CHECK(verbose.exit_code == 0);
    CHECK(verbose.out.empty());
    for (const char* fact :
         {"scene: objects 4, triangles ", "emitters 1\n", "image: 48 x 36 pixels, 4 samples each, seed 0",
          "integrator: path_mis; sampler: independent", "embree: ", "hash "})
        CHECK_THAT(verbose.err, ContainsSubstring(fact));
}

TEST_CASE("samples that were left out are counted, and can be replayed", "[cli][log]")
{
    // A lamp that fills the view and is brighter than the film's range, 2^37 = 1.4e11.
    const SceneDirectory directory;
    directory.write("too bright.xml", R"(<scene dialect="plumb"><integrator type="path_nee"/>
        <camera type="perspective"><integer name="width" value="3"/><integer name="height" value="2"/></camera>
        <shape type="rectangle"><point name="center" value="0,0,5"/><vector name="normal" value="0,0,-1"/>
            <float name="width" value="100"/><float name="height" value="100"/>
            <emitter type="area"><color name="radiance" value="1e12,1,1"/></emitter></shape></scene>)");
    const RunResult result =
        directory.run({"too bright.xml", "-o", "a.exr", "--spp", "4", "--crop", "1,0,2,2", "--json", "-"});
    CHECK(result.exit_code == 0);
    const std::string first = "sample 0 of pixel 1,0 (out of the film's range: 1000000000000 1 1)";
    const std::string words = " replay 'too bright.xml' --pixel 1,0 --sample 0 --spp 4";
    CHECK_THAT(result.err, ContainsSubstring("warning: 16 samples were discarded, the first is " + first +
                                             "; to see its path:\n    renderer" + words + "\n"));
    CHECK_THAT(result.out, ContainsSubstring("\"count\": 16,"));
    CHECK_THAT(result.out, ContainsSubstring("\"why\": \"out of the film's range\""));
    const RunResult info = directory.run({"info", "a.exr"});
    CHECK_THAT(info.out, ContainsSubstring(first));

    const RunResult replay =
        run_program({"/bin/sh", "-c", "\"$0\"" + words, PLUMB_RENDERER}, directory.path());
    CHECK(replay.exit_code == 0);
    CHECK_THAT(replay.out, ContainsSubstring("\nverdict   out of the film's range\n"));
}

TEST_CASE("types lists every plugin and prints manuals", "[cli][types]")
{
    const SceneDirectory directory;
    const RunResult list = directory.run({"types"});
    CHECK(list.exit_code == 0);
    CHECK(list.err.empty());
    REQUIRE(known_types().size() > 40);
    for (const TypeInfo& type : known_types()) {
        INFO(type.kind << " " << type.name);
        CHECK_THAT(list.out, ContainsSubstring("\n  " + std::string(type.name) + " "));
        CHECK_FALSE(type.manual.empty());
    }
    const RunResult manual = directory.run({"types", "diffuse"});
    CHECK(manual.exit_code == 0);
    CHECK_THAT(manual.out, ContainsSubstring("bsdf 'diffuse'\n"));
    CHECK_THAT(manual.out, ContainsSubstring("    albedo "));
}

TEST_CASE("types --dialect prints what another language calls types and parameters", "[cli][types]")
{
    const SceneDirectory directory;
    for (const std::string_view name : vocabulary_names()) {
        INFO(name);
        CHECK(directory.run({"types", "--dialect", std::string(name)}).exit_code == 0);
    }
    const RunResult list = directory.run({"types", "--dialect", "mitsuba3"});
    for (const char* part : {"\n  hdrfilm           hdrfilm\n", "\n  blendbsdf         blend\n",
                             "\nnot supported\n", "  shape 'sdfgrid': export it as a mesh\n"})
        CHECK_THAT(list.out, ContainsSubstring(part));

    // Each type has a manual that has each of its parameters, and so have those of the base.
    const Vocabulary& words = *vocabulary_named("mitsuba06");
    for (const Vocabulary* from = &words; from; from = from->base)
        for (const TypeName& type : from->types) {
            INFO(type.kind << " " << type.theirs);
            const auto manual = manual_of_type(words, type.theirs);
            REQUIRE(manual);
            for (const ParamName& param : from->params)
                if (param.kind == type.kind && param.type == type.theirs && param.theirs != "*")
                    CHECK_THAT(*manual, ContainsSubstring("\n    " + std::string(param.theirs) + " "));
        }
    const RunResult manual = directory.run({"types", "--dialect", "mitsuba3", "path"});
    for (const char* part : {"integrator 'path' of mitsuba3: 'path_mis' here\n",
                             "    max_depth                 maxDepth, minus 1; -1 stays\n",
                             "    (unless given)            rrDepth 5\n"})
        CHECK_THAT(manual.out, ContainsSubstring(part));

    const auto complaint = [&](const std::vector<std::string>& words_of_line) {
        const RunResult result = directory.run(words_of_line);
        CHECK(result.exit_code == 2);
        return result.err;
    };
    CHECK(complaint({"types", "--dialect", "mitsuba4"}) ==
          "error: --dialect: unknown dialect 'mitsuba4'; did you mean 'mitsuba3'?\n");
    CHECK(complaint({"types", "--dialect", "x"}) ==
          "error: --dialect: unknown dialect 'x'; known are plumb, epfl, eth, zaragoza, mcgill, mitsuba3, "
          "mitsuba06\n");
    CHECK(
        complaint({"types", "--dialect", "mitsuba3", "velvet"}) ==
        "error: mitsuba3 has no type 'velvet' of its own; 'renderer types --dialect mitsuba3' lists them\n");
}

TEST_CASE("info prints what the header knows", "[cli][info]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--crop", "1,2,30,20"}).exit_code == 0);
    const RunResult info = directory.run({"info", "a.exr"});
    CHECK(info.exit_code == 0);
    CHECK(info.err.empty());
    for (const char* part :
         {"a.exr\n", " 48 x 36\n", " 1,2,30,20\n", " R G B contributing variance.R variance.G variance.B\n",
          "plumb:scene", "plumb:inputHash", "plumb:integrator", " path_mis\n", "worldToCamera"})
        CHECK_THAT(info.out, ContainsSubstring(part));

    const RunResult none = directory.run({"info", "none.exr"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.err, ContainsSubstring("none.exr"));
    CHECK(directory.run({"info", "scene.xml"}).exit_code == 1);
}

TEST_CASE("replay prints the path of one sample", "[cli][replay]")
{
    const SceneDirectory directory;
    const Names words = {"replay", "scene.xml", "--pixel", "24,30", "--sample", "3", "--quiet"};
    const RunResult replay = directory.run(words);
    INFO(replay.err);
    REQUIRE(replay.exit_code == 0);
    CHECK_THAT(replay.out, ContainsSubstring("sample 3 of pixel 24,30, seed 0, integrator path_mis\n"));
    for (const char* part : {"\nray ", "\nhit ", "\nvalue ", "\nweight ", "\nverdict   accepted\n"})
        CHECK_THAT(replay.out, ContainsSubstring(part));
    CHECK(directory.run(words).out == replay.out);

    Names other = words;
    other.insert(other.end(), {"--seed", "1"});
    CHECK(directory.run(other).out != replay.out);
    const RunResult outside =
        directory.run({"replay", "scene.xml", "--pixel", "48,0", "--sample", "0", "--quiet"});
    CHECK(outside.exit_code == 1);
    CHECK(outside.err == "error: pixel 48,0 is not inside the image of 48x36 pixels\n");
    CHECK(directory.files() == Names{"scene.xml"});
}

TEST_CASE("help and version go to standard output", "[cli][help]")
{
    const SceneDirectory directory;
    CHECK(directory.run({"--version"}).out == "Plumb " PLUMB_VERSION "\n");
    const RunResult help = directory.run({"--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    CHECK(help.out.starts_with("usage: renderer SCENE"));
}

TEST_CASE("closed streams and pipes do no harm", "[cli][console]")
{
    const SceneDirectory directory;
    const auto shell = [&](const std::string& command) {
        return run_program({"/bin/sh", "-c", command, PLUMB_RENDERER}, directory.path());
    };
    // The reader is gone before anything is written: no signal, no message.
    const RunResult pipe = shell("{ sleep 0.2; \"$0\" types; echo exit $? >&2; } | true");
    CHECK(pipe.err == "exit 0\n");
    CHECK(shell("\"$0\" types >&-").exit_code == 1);

    // With standard error closed, the log must not end up in the image.
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr"}).exit_code == 0);
    CHECK(shell("\"$0\" scene.xml -o b.exr --verbose >&- 2>&- <&-").exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "b.exr"));
}

TEST_CASE("--json says what memory is for", "[cli][json]")
{
    const SceneDirectory directory;
    std::string mesh = "vt 0 0\n";
    constexpr int triangles = 100000;
    for (int i = 0; i < triangles; ++i)
        mesh += "v " + std::to_string(i) + " 0 0\nv 0 1 0\nv 0 0 1\nf -3/1 -2/1 -1/1\n";
    directory.write("mesh.obj", mesh);
    std::string scene = small_scene();
    scene.insert(scene.rfind("</scene>"),
                 R"(<mesh type="obj"><string name="filename" value="mesh.obj"/></mesh>)");
    directory.write("scene.xml", scene);
    const RunResult run = directory.run({"scene.xml", "-o", "a.exr", "--json", "-", "--quiet"});
    REQUIRE(run.exit_code == 0);
    const auto number = [&](const std::string& key) {
        const std::size_t at = run.out.find("\"" + key + "\": ");
        REQUIRE(at != std::string::npos);
        return std::stod(run.out.substr(at + key.size() + 4));
    };
    CHECK(number("film") == 48.0 * 36.0 * 112.0);
    CHECK(number("textures") == 0.0);
    // 3 positions with texture coordinates and one triangle each
    CHECK(number("meshes") >= triangles * (3 * 20.0 + 12.0));
    CHECK(number("meshes") < triangles * (3 * 20.0 + 12.0) * 1.01);
    CHECK(number("acceleration") > 40.0 * triangles);
    CHECK(number("acceleration") <= number("acceleration_while_built"));
    CHECK(number("meshes") + number("acceleration_while_built") + number("film") <
          number("peak_memory_bytes"));
}

TEST_CASE("new writes a scene that renders as it is", "[cli][new]")
{
    const TempDirectory directory;
    const RunResult written = run_renderer({"new", "my scene.xml"}, directory.path());
    CHECK(written.exit_code == 0);
    CHECK(written.out.empty());
    CHECK(written.err == "'my scene.xml': written; to see it:\n    renderer 'my scene.xml'\n");
    const std::string text = read_bytes(directory / "my scene.xml");
    CHECK_THAT(text, ContainsSubstring("<scene dialect=\"plumb\">") && ContainsSubstring("<!--"));
    const RunResult checked = run_renderer({"check", "my scene.xml"}, directory.path());
    CHECK(checked.exit_code == 0);
    CHECK_THAT(checked.out, ContainsSubstring("no mistakes found"));
    const RunResult rendered =
        run_renderer({"my scene.xml", "-o", "a.exr", "--spp", "2", "--size", "48x32"}, directory.path());
    CHECK(rendered.exit_code == 0);
    CHECK(rendered.err.find("warning") == std::string::npos);

    // What is there stays there, file or directory or link.
    const RunResult again = run_renderer({"new", "my scene.xml"}, directory.path());
    CHECK(again.exit_code == 1);
    CHECK(again.err == "error: 'my scene.xml' already exists; choose another file name\n");
    CHECK(read_bytes(directory / "my scene.xml") == text);
    std::filesystem::create_symlink("elsewhere", directory / "link.xml");
    CHECK(run_renderer({"new", "link.xml"}, directory.path()).exit_code == 1);
    CHECK_FALSE(std::filesystem::exists(directory / "elsewhere"));
    CHECK(run_renderer({"new", "none/a.xml"}, directory.path()).err ==
          "error: cannot write 'none/a.xml': No such file or directory\n");
    CHECK(run_renderer({"new"}, directory.path()).exit_code == 2);
}

TEST_CASE("types says what scene an example is part of", "[cli][types]")
{
    for (const TypeInfo& type : known_types()) {
        const RunResult result = run_renderer({"types", std::string(type.name)}, PLUMB_SOURCE_DIR);
        CHECK_THAT(result.out, ContainsSubstring("in a scene that begins with <scene dialect=\"plumb\">;\n"
                                                 "'renderer new FILE' writes such a scene."));
    }
}
