// SPDX-License-Identifier: MIT

// What the program writes.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "support/catch.h"

#include <cstring>

using namespace plumb;

TEST_CASE("a scene becomes an image", "[cli][render]")
{
    const SceneDirectory directory;
    const RunResult result = directory.run({"scene.xml", "-o", "a.exr", "-o", "b.png"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, ContainsSubstring("dialect: plumb ("));
    CHECK_THAT(result.err, ContainsSubstring("a.exr and b.png: 6.91 k samples in "));
    CHECK_THAT(result.err, ContainsSubstring(" Mrays/s\n"));
    CHECK(result.err.find('\r') == std::string::npos); // a bar is for terminals
    CHECK(directory.files() == Names{"a.exr", "b.png", "scene.xml"});

    const Image image = read_image(directory / "a.exr", false);
    CHECK(image.full_width() == 48);
    CHECK(image.full_height() == 36);
    CHECK(image.channel_names() == Names{"R", "G", "B", "contributing", "variance.R", "variance.G",
                                         "variance.B"}); // OpenImageIO's order
    CHECK(read_image(directory / "b.png", false).channel_names() == Names{"R", "G", "B"});
    float brightest = 0.f;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) brightest = std::max(brightest, max_component(image.color(x, y)));
    CHECK(brightest > 0.1f);
}

TEST_CASE("the header names the decoder of JPEG images, if the scene has any", "[cli][render]")
{
    const SceneDirectory directory;
    const auto with_texture = [](const std::string& file) {
        std::string scene = small_scene();
        const std::string plain = R"(<color name="albedo" value="0.6,0.5,0.4"/>)";
        return scene.replace(
            scene.find(plain), plain.size(),
            R"(<texture type="imagetexture_color3f" name="albedo"><string name="filepath" value=")" + file +
                R"("/></texture>)");
    };
    REQUIRE(directory.run({"scene.xml", "-o", "a.jpg", "-o", "a.png", "-o", "none.exr"}).exit_code == 0);
    std::filesystem::rename(directory / "a.jpg", directory / "a.image"); // what it holds counts
    directory.write("jpeg.xml", with_texture("a.image"));
    directory.write("png.xml", with_texture("a.png"));
    REQUIRE(directory.run({"jpeg.xml", "-o", "jpeg.exr", "-o", "jpeg.png"}).exit_code == 0);
    REQUIRE(directory.run({"png.xml", "-o", "png.exr"}).exit_code == 0);
    CHECK(text(header(directory / "none.exr"), "plumb:jpegDecoder") == "no plumb:jpegDecoder");
    CHECK(text(header(directory / "png.exr"), "plumb:jpegDecoder") == "no plumb:jpegDecoder");
    CHECK(text(header(directory / "jpeg.exr"), "plumb:jpegDecoder") == jpeg_decoder());
    CHECK(text(header(directory / "jpeg.png"), "plumb:jpegDecoder") == jpeg_decoder());
    CHECK_THAT(jpeg_decoder(), ContainsSubstring("jpeg"));
}

TEST_CASE("without -o the names come from the scene and its samples", "[cli][render]")
{
    const SceneDirectory directory;
    directory.write("scenes/a.b.xml", small_scene());
    REQUIRE(directory.run({"scenes/a.b.xml"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "--spp", "2"}).exit_code == 0);
    CHECK(directory.files() == Names{"a.b_4.exr", "a.b_4.png", "scene.xml", "scene_2.exr", "scene_2.png",
                                     "scenes", "scenes/a.b.xml"});
}

TEST_CASE("identical runs write identical files", "[cli][render]")
{
    const SceneDirectory directory;
    std::filesystem::create_directory(directory / "elsewhere");
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png", "--threads", "1"}).exit_code == 0);
    for (const char* threads : {"1", "3", "16"}) {
        const std::string scene = (directory / "scene.xml").string(); // its directory is not in the header
        REQUIRE(
            directory.run({scene, "-o", "elsewhere/b.exr", "-o", "b.png", "--threads", threads}).exit_code ==
            0);
        CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "elsewhere/b.exr"));
        CHECK(read_bytes(directory / "a.png") == read_bytes(directory / "b.png"));
    }
    REQUIRE(directory.run({"scene.xml", "-o", "c.exr", "--seed", "1"}).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") != read_bytes(directory / "c.exr"));
}

TEST_CASE("a crop is that part of the whole, bit for bit", "[cli][render]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "whole.exr"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "crop.exr", "--crop", "11,5,20,17"}).exit_code == 0);
    const Image whole = read_image(directory / "whole.exr", false);
    const Image crop = read_image(directory / "crop.exr", false);
    CHECK(crop.data_window() == PixelRect{11, 5, 20, 17});
    CHECK(crop.full_width() == 48);
    CHECK(crop.full_height() == 36);
    int different = 0;
    for (int y = 5; y < 22; ++y)
        for (int x = 11; x < 31; ++x)
            different += std::memcmp(whole.pixel(x, y), crop.pixel(x, y), 3 * sizeof(float)) != 0;
    CHECK(different == 0);
}

TEST_CASE("a crop and a replay need no memory for the whole image", "[cli][render]")
{
    const SceneDirectory directory;
    const Names huge = {"scene.xml", "--spp", "1", "--size", "65535x65535"};
    Names crop = huge, replay = huge;
    crop.insert(crop.end(), {"--crop", "65000,40,3,2", "-o", "crop.exr"});
    REQUIRE(directory.run(crop).exit_code == 0);
    const Image image = read_image(directory / "crop.exr", false);
    CHECK(image.data_window() == PixelRect{65000, 40, 3, 2});
    CHECK(image.full_width() == 65535);
    CHECK(image.full_height() == 65535);
    replay.insert(replay.begin(), "replay");
    replay.insert(replay.end(), {"--pixel", "65000,40", "--sample", "0"});
    CHECK(directory.run(replay).exit_code == 0);
}

TEST_CASE("options change the scene", "[cli][render]")
{
    const SceneDirectory directory;
    directory.write("defined.xml",
                    small_scene(R"(<default name="how" value="path_nee"/><integrator type="$how"/>)"));
    REQUIRE(directory
                .run({"scene.xml",
                      "-o",
                      "a.exr",
                      "--size",
                      "20x10",
                      "--spp",
                      "3",
                      "--integrator",
                      "normals",
                      "--isa",
                      "sse4.2",
                      "--seed",
                      "18446744073709551615",
                      "--mirror",
                      "on",
                      "--emitters",
                      "absorb",
                      "--dialect",
                      "epfl",
                      "--envmap-scale",
                      "0.5"})
                .exit_code == 0);
    const auto changed = header(directory / "a.exr");
    CHECK(read_image(directory / "a.exr", false).full_width() == 20);
    CHECK(text(changed, "plumb:integrator") == "normals");
    CHECK(text(changed, "plumb:seed") == "18446744073709551615");
    CHECK(text(changed, "plumb:instructionSet") == "sse4.2");
    CHECK(text(changed, "plumb:dialect") == "epfl");
    CHECK(text(changed, "plumb:mirror") == "on");
    CHECK(text(changed, "plumb:emitters") == "absorb");

    REQUIRE(directory.run({"defined.xml", "-o", "b.exr", "-D", "how=path"}).exit_code == 0);
    CHECK(text(header(directory / "b.exr"), "plumb:integrator") == "path");
    CHECK(text(header(directory / "b.exr"), "plumb:definitions") == "how=path");
    REQUIRE(directory.run({"defined.xml", "-o", "c.exr"}).exit_code == 0);
    CHECK(text(header(directory / "c.exr"), "plumb:integrator") == "path_nee");
}

TEST_CASE("the header says how to make the image again", "[cli][header]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({(directory / "scene.xml").string(), "-o", "a.exr"}).exit_code == 0);
    const auto found = header(directory / "a.exr");
    CHECK(text(found, "Software") == "Plumb " PLUMB_VERSION);
    CHECK(text(found, "plumb:scene") == "scene.xml");
    CHECK(text(found, "plumb:inputHash").size() == 64);
    CHECK(text(found, "plumb:integrator") == "path_mis");
    CHECK(text(found, "plumb:sampler") == "independent");
    CHECK(text(found, "plumb:seed") == "0");
    CHECK(text(found, "plumb:dialect") == "plumb");
    CHECK_FALSE(text(found, "plumb:dialectReason").empty());
    CHECK(text(found, "plumb:emitters") == "scatter");
    CHECK(text(found, "plumb:mirror") == "off");
    CHECK(text(found, "plumb:instructionSet") == "avx2");
    CHECK(text(found, "plumb:leftOut") == "0");
    REQUIRE(found.count("plumb:samplesPerPixel") == 1);
    CHECK(std::get<int>(found.at("plumb:samplesPerPixel")) == 4);

    // The camera looks from (0, 1.5, 5) at (0, 0.7, 0): row vector (world point, 1) times matrix.
    REQUIRE(found.count("worldToCamera") == 1);
    const auto matrix = std::get<std::vector<float>>(found.at("worldToCamera"));
    REQUIRE(matrix.size() == 16);
    const auto camera = [&](double x, double y, double z, std::size_t axis) {
        return x * static_cast<double>(matrix[axis]) + y * static_cast<double>(matrix[4 + axis]) +
               z * static_cast<double>(matrix[8 + axis]) + static_cast<double>(matrix[12 + axis]);
    };
    for (const std::size_t axis : {0u, 1u, 2u})
        CHECK(camera(0.0, 1.5, 5.0, axis) == Approx(0.0).margin(1e-5));
    CHECK(camera(0.0, 0.7, 0.0, 0) == Approx(0.0).margin(1e-5));
    CHECK(camera(0.0, 0.7, 0.0, 1) == Approx(0.0).margin(1e-5));
    CHECK(camera(0.0, 0.7, 0.0, 2) == Approx(std::sqrt(0.8 * 0.8 + 25.0)));
    CHECK(camera(-1.0, 0.7, 0.0, 0) == Approx(1.0)); // +x is left

    // One byte of the input changes the hash.
    directory.write("other/scene.xml", small_scene() + " ");
    REQUIRE(directory.run({"other/scene.xml", "-o", "b.exr"}).exit_code == 0);
    CHECK(text(header(directory / "b.exr"), "plumb:inputHash") != text(found, "plumb:inputHash"));

    // No place and no machine.
    const std::string bytes = read_bytes(directory / "a.exr");
    CHECK(bytes.find(directory.path().string()) == std::string::npos);
}

TEST_CASE("the peak memory is the program's, not that of the one which started it", "[cli][render]")
{
    constexpr std::size_t large = 600'000'000;
    const std::vector<char> ours(large, 'x');
    const SceneDirectory directory;
    const RunResult run = directory.run({"scene.xml", "-o", "a.exr", "--json", "-", "--quiet"});
    REQUIRE(run.exit_code == 0);
    const std::string key = "\"peak_memory_bytes\": ";
    const std::size_t place = run.out.find(key);
    REQUIRE(place != std::string::npos);
    const std::size_t peak = std::stoull(run.out.substr(place + key.size()));
    CHECK(peak > 1'000'000);
    CHECK(peak < large);
    CHECK(ours.back() == 'x');
}

TEST_CASE("a rendering tells what its integrator has learnt", "[cli][render]")
{
    const SceneDirectory directory;
    const RunResult glass = directory.run({"scene.xml", "-o", "a.exr"});
    CHECK_THAT(glass.err, ContainsSubstring("guide: learnt in ") &&
                              ContainsSubstring(" of that, caustics from ") && ContainsSubstring(" cells\n"));

    const auto wall = [](const std::string& center, const std::string& normal) {
        return "<shape type='rectangle'><point name='center' value='" + center +
               "'/><vector name='normal' value='" + normal +
               "'/><float name='width' value='4'/><float name='height' value='4'/></shape>";
    };
    // Open above one of its walls.
    directory.write("room.xml", "<scene dialect='plumb'><integrator type='path_mis'/><camera "
                                "type='perspective'><integer name='width' "
                                "value='24'/><integer name='height' value='18'/></camera>" +
                                    wall("0,-1,0", "0,1,0") + wall("0,1,0", "0,-1,0") +
                                    wall("2,0,0", "-1,0,0") + wall("0,0,2", "0,0,-1") +
                                    wall("0,0,-2", "0,0,1") + wall("-2,-2,0", "1,0,0") +
                                    "<emitter type='environment'/></scene>");
    const RunResult room = directory.run({"room.xml", "-o", "b.exr"});
    INFO(room.err);
    CHECK_THAT(room.err, ContainsSubstring(" of that, ") && ContainsSubstring(" windows to the sky\n"));
    const RunResult json = directory.run({"room.xml", "-o", "b.exr", "--json", "-", "--quiet"});
    CHECK_THAT(json.out, ContainsSubstring("\"paths\": 4096") && !ContainsSubstring("\"windows\": 0"));
}
