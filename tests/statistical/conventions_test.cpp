// SPDX-License-Identifier: MIT

// Small scenes in our language beside the values that Mitsuba 3.9.1 (scalar_rgb) renders for like ones: what parameters that
// exist for its conventions mean.

#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/mesh_files.h"
#include "support/scene_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Rendered {
    Vec2i size;
    std::vector<double> red;   // pixel by pixel, row by row
    std::vector<double> error; // standard errors
    double mean() const
    {
        double sum = 0.0;
        for (const double value : red) sum += value;
        return sum / static_cast<double>(red.size());
    }
};

Rendered render_file(const std::filesystem::path& path)
{
    const LoadedScene scene = load_scene(path);
    const Film film = render(scene.job, {}).film;
    const Image image = film.develop();
    Rendered result{{image.data_window().width, image.data_window().height}, {}, {}};
    for (int y = 0; y < result.size.y; ++y)
        for (int x = 0; x < result.size.x; ++x) {
            result.red.push_back(image.color(x, y).r);
            result.error.push_back(std::sqrt(static_cast<double>(film.variance_of_mean({x, y}).r)));
        }
    return result;
}

Rendered render_text(const std::string& body, int samples, const std::string& integrator = "path_mis")
{
    const TempDirectory directory;
    const std::string rest =
        integrator.starts_with("<") ? integrator : "<integrator type='" + integrator + "'/>";
    return render_file(directory.write(
        "scene.xml",
        "<scene dialect='plumb'>" + rest + body +
            fmt::format(
                "<sampler type='independent'><integer name='sampleCount' value='{}'/></sampler></scene>",
                samples)));
}

// Within 5 standard errors of both, or 1e-4.
void check_row(const std::string& name, const Rendered& seen, const std::vector<double>& expected,
               double its_error)
{
    REQUIRE(seen.red.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(name, i, seen.red[i], expected[i], seen.error[i]);
        const double error = std::sqrt(sqr(seen.error[i]) + sqr(its_error));
        CHECK(std::abs(seen.red[i] - expected[i]) <= std::max(5.0 * error, 1e-4));
    }
}

std::string value(const std::string& tag, const std::string& name, const std::string& text)
{
    return fmt::format("<{} name='{}' value='{}'/>", tag, name, text);
}

std::string orthographic(double scale, int width, const std::string& inside)
{
    return fmt::format(
        "<camera type='orthographic'><integer name='width' value='{}'/><integer name='height' value='1'/>"
        "<transform name='toWorld'><scale value='{},{},{}'/>"
        "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>{}</camera>",
        width, scale, scale, scale, inside);
}

std::string perspective(int width, int height, const std::string& inside)
{
    return fmt::format(
        "<camera type='perspective'><integer name='width' value='{}'/><integer name='height' value='{}'/>"
        "{}<rfilter type='box'/></camera>",
        width, height, inside);
}

// A rectangle that emits; facing the camera at the origin that looks along +z if `turned`.
std::string lamp(const std::string& width, const std::string& height, const std::string& center,
                 bool turned = true)
{
    return "<shape type='rectangle'>" + value("float", "width", width) + value("float", "height", height) +
           value("point", "center", center) + value("vector", "normal", turned ? "0 0 -1" : "0 0 1") +
           "<bsdf type='diffuse'><color name='albedo' value='0 0 0'/></bsdf><emitter type='area'/></shape>";
}

const std::string white = "<bsdf type='diffuse'><color name='albedo' value='1 1 1'/></bsdf>";
const std::string direct = "<integrator type='path_mis'><integer name='maxDepth' value='1'/></integrator>";
const std::string floor_of_100 = "<shape type='rectangle'>" + value("float", "width", "100") +
                                 value("float", "height", "100") + white + "</shape>";
const std::string pi3 = "3.14159265358979 3.14159265358979 3.14159265358979";

} // namespace

TEST_CASE("filters over an edge", "[statistical][conventions][filter]")
{
    const std::string light = lamp("200", "200", "100 0 0", false);
    const auto check = [&](const std::string& filter, const std::vector<double>& row, double error) {
        check_row(filter,
                  render_text(orthographic(4.5, 9, "<rfilter type='" + filter + "'/>") + light, 20'000), row,
                  error);
    };
    check("catmullrom", {0.0, 0.0, 0.0, -0.03869, 0.49921, 1.03872, 1.0, 1.0, 1.0}, 0.000726);
    check("lanczos", {0.0, 0.0, 0.01481, -0.06525, 0.49906, 1.06526, 0.9852, 1.0, 1.0}, 0.000729);
    check("tent", {0.0, 0.0, 0.0, 0.0, 0.49921, 1.0, 1.0, 1.0, 1.0}, 0.00059);
    check("mitchell", {0.0, 0.0, 0.0, -0.01107, 0.49915, 1.01099, 1.0, 1.0, 1.0}, 0.000652);
}

TEST_CASE("filters are cut at the edge of film or crop, if the camera does not sample the border",
          "[statistical][conventions][filter]")
{
    // Light only beyond the right edge. Mitsuba reads its Gaussian from a table of 31 steps: .1668 and .0014.
    const std::string light = lamp("200", "200", "104.5 0 0", false);
    const std::string border = value("boolean", "sampleBorder", "false");
    const Rendered cut = render_text(orthographic(4.5, 9, border) + light, 64);
    for (const double x : cut.red) CHECK(x == 0.0);
    const Rendered sampled = render_text(orthographic(4.5, 9, "") + light, 20'000);
    CHECK(sampled.red[8] == Approx(0.1633).margin(0.015));
    CHECK(sampled.red[7] == Approx(0.001).margin(0.001));
    // A crop in the file has edges of its own.
    const std::string crop = value("integer", "cropOffsetX", "1") + value("integer", "cropWidth", "4");
    const std::string from_middle = lamp("200", "200", "100.5 0 0", false); // from the crop's right edge on
    const Rendered cropped = render_text(orthographic(4.5, 9, crop + border) + from_middle, 64);
    REQUIRE(cropped.red.size() == 4);
    for (const double x : cropped.red) CHECK(x == 0.0);
    CHECK(render_text(orthographic(4.5, 9, crop) + from_middle, 2000).red[3] > 0.1);

    // What is left of the filter counts as all of it: a white image stays white, exactly for filters without lobes.
    const std::string all_white = "<emitter type='environment'/>";
    for (const char* filter : {"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"}) {
        CAPTURE(filter);
        const bool has_lobes = std::string(filter) == "mitchell" || std::string(filter) == "catmullrom" ||
                               std::string(filter) == "lanczos";
        const Rendered seen = render_text(
            orthographic(1, 3, border + "<rfilter type='" + std::string(filter) + "'/>") + all_white, 20'000);
        for (std::size_t i = 0; i < seen.red.size(); ++i)
            CHECK(std::abs(seen.red[i] - 1.0) <= (has_lobes ? 5.0 * seen.error[i] : 1e-5));
    }
    // The edge is the file's, whatever is rendered of it.
    const TempDirectory directory;
    const auto path = directory.write(
        "scene.xml", "<scene dialect='plumb'><integrator type='path_mis'/>" + orthographic(4.5, 9, border) +
                         lamp("200", "200", "100 0 0", false) + "<sampler type='independent'/></scene>");
    const LoadedScene scene = load_scene(path);
    RenderOptions options;
    options.samples_per_pixel = 16;
    const Image whole = render(scene.job, options).film.develop();
    options.crop = PixelRect{3, 0, 3, 1};
    const Image part = render(scene.job, options).film.develop();
    for (int x = 3; x < 6; ++x) CHECK(part.color(x, 0) == whole.color(x, 0));
}

TEST_CASE("a crop shows a window of the same view", "[statistical][conventions][camera]")
{
    const std::string view = value("float", "fov", "90");
    const std::string crop = value("integer", "cropOffsetY", "1") + value("integer", "cropWidth", "2") +
                             value("integer", "cropHeight", "4");
    const std::string ball =
        "<shape type='sphere'><point name='center' value='.8 0 1'/><float name='radius' value='.1'/>"
        "<emitter type='area'><color name='radiance' value='100 0 0'/></emitter></shape>";
    const Rendered seen = render_text(perspective(5, 5, view + crop) + ball, 2000);
    CHECK((seen.size.x == 2 && seen.size.y == 4));
    check_row("crop", seen, {0, 0, 25.93, 0, 0, 0, 0, 0}, 0.97);
}

TEST_CASE("the field of view is along an axis, or that of a focal length",
          "[statistical][conventions][camera]")
{
    const std::string light = lamp("0.6", "0.4", "0 0 1");
    const auto check = [&](int width, int height, const std::string& view, double mean) {
        CAPTURE(width, height, view);
        CHECK(render_text(perspective(width, height, view) + light, 2000).mean() ==
              Approx(mean).margin(0.005));
    };
    const auto fov = [](const std::string& axis) {
        return value("float", "fov", "60") + value("string", "fovAxis", axis);
    };
    check(8, 4, fov("x"), 0.36025);
    check(8, 4, fov("y"), 0.08995);
    check(8, 4, fov("diagonal"), 0.45011);
    check(8, 4, fov("smaller"), 0.08995);
    check(8, 4, fov("larger"), 0.36025);
    check(4, 8, fov("x"), 0.08999);
    check(4, 8, fov("y"), 0.34642);
    check(4, 8, fov("diagonal"), 0.38741);
    check(4, 8, fov("smaller"), 0.08999);
    check(4, 8, fov("larger"), 0.34642);
    const std::string small = lamp("0.2", "0.2", "0 0 1");
    CHECK(render_text(perspective(4, 4, value("float", "focalLengthMm", "50")) + small, 4000).mean() ==
          Approx(0.106674).margin(0.005));
    CHECK(render_text(perspective(8, 4, value("float", "focalLengthMm", "35")) + small, 4000).mean() ==
          Approx(0.065393).margin(0.005));
}

TEST_CASE("principal points, clipping planes and lenses", "[statistical][conventions][camera]")
{
    const std::string fov = value("float", "fov", "60");
    const Rendered x = render_text(perspective(4, 4, fov + value("float", "principalPointOffsetX", "0.25")) +
                                       lamp("50", "100", "25 0 1"),
                                   64);
    for (std::size_t i = 0; i < 16; ++i) CHECK(x.red[i] == Approx(i % 4 == 0 ? 1.0 : 0.0).margin(0.05));
    const Rendered y = render_text(perspective(4, 4, fov + value("float", "principalPointOffsetY", "0.25")) +
                                       lamp("100", "50", "0 25 1"),
                                   64);
    for (std::size_t i = 0; i < 16; ++i) CHECK(y.red[i] == Approx(i < 4 ? 1.0 : 0.0).margin(0.05));

    const auto clipped = [&](const std::string& planes, const std::string& z) {
        return render_text(orthographic(0.001, 1, planes) + lamp("1", "1", "0 0 " + z, false), 4).red[0];
    };
    const std::string planes = value("float", "nearClip", "0.5") + value("float", "farClip", "3");
    CHECK(clipped(planes, "4") == 1.0); // 1 before the camera, whatever its scale
    CHECK(clipped(planes, "4.75") == 0.0);
    CHECK(clipped(planes, "1") == 0.0);

    const std::string lens =
        value("float", "fov", "20") + value("float", "lensRadius", "0.5") +
        value("float", "focalDistance", "2.5") +
        "<transform name='toWorld'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>";
    const std::string ball =
        "<shape type='sphere'><float name='radius' value='.1'/><emitter type='area'/></shape>";
    check_row("thinlens", render_text(perspective(9, 1, lens) + ball, 20'000),
              {0.0, 0.00479, 0.03561, 0.0397, 0.04034, 0.04001, 0.03744, 0.00461, 0.0}, 0.001604);
}

TEST_CASE("spot lights fall off linearly in the angle", "[statistical][conventions][emitter]")
{
    const auto seen = [&](double degrees, const std::string& more) {
        const double x = -2.0 * std::tan(degrees * pi_d / 180.0);
        const std::string spot = fmt::format("<emitter type='spot'><point name='position' value='{} 0 2'/>"
                                             "<vector name='direction' value='0 0 -1'/>{}{}</emitter>",
                                             x, value("color", "intensity", pi3), more);
        return render_text(orthographic(1e-6, 1, "") + floor_of_100 + spot, 4, direct).red[0];
    };
    const std::pair<double, double> values[] = {{0, 0.25},        {10, 0.238784}, {16, 0.177758},
                                                {17.5, 0.108541}, {19, 0.042365}, {21, 0.0},
                                                {14.99, 0.225313}};
    for (const auto& [degrees, expected] : values) {
        CAPTURE(degrees);
        CHECK(seen(degrees, "") == Approx(expected).margin(2e-4));
    }
    CHECK(seen(30, value("float", "cutoffAngle", "40")) == Approx(0.162389).margin(2e-4));
    CHECK(seen(20, value("float", "cutoffAngle", "40") + value("float", "beamWidth", "10")) ==
          Approx(0.138317).margin(2e-4));
}

TEST_CASE("projectors light a wall evenly, whatever their field of view",
          "[statistical][conventions][emitter]")
{
    for (const double distance : {2.0, 4.0})
        for (const double fov : {30.0, 60.0, 90.0}) {
            const std::string projector = fmt::format(
                "<emitter type='projector'><point name='position' value='0 0 {}'/>"
                "<vector name='direction' value='0 0 -1'/><float name='fov' value='{}'/></emitter>",
                distance, fov);
            CAPTURE(distance, fov);
            CHECK(render_text(orthographic(1e-6, 1, "") + floor_of_100 + projector, 4, direct).red[0] ==
                  Approx(1.0 / sqr(distance)).epsilon(1e-4));
            // Everywhere inside its image, and nowhere else.
            const double edge = distance * std::tan(fov * pi_d / 360.0);
            const Rendered row =
                render_text(orthographic(1.25 * edge, 5, "<rfilter type='box'/>") + floor_of_100 + projector,
                            256, direct);
            CHECK(row.red[0] == Approx(0.6 / sqr(distance) * 5.0 / 6.0).epsilon(0.2));
            for (int i = 1; i < 4; ++i)
                CHECK(row.red[static_cast<std::size_t>(i)] == Approx(1.0 / sqr(distance)).epsilon(1e-4));
        }
}

TEST_CASE("environments as Mitsuba reads them", "[statistical][conventions][emitter]")
{
    // The image has its columns as red, 8 x 5.
    const TempDirectory directory;
    Image image(8, 5);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 8; ++x) {
            image.pixel(x, y)[0] = static_cast<float>(x);
            image.pixel(x, y)[1] = static_cast<float>(y);
            image.pixel(x, y)[2] = 1.f;
        }
    write_image(directory / "sky.exr", image);
    const auto seen = [&](const std::string& target, const std::string& more) {
        const std::string scene =
            "<scene dialect='plumb'><integrator type='path_mis'/>" +
            perspective(1, 1,
                        value("float", "fov", "0.001") +
                            "<transform name='toWorld'><lookat origin='0,0,0' target='" + target +
                            "' up='0.1,1,0.2'/></transform>") +
            "<emitter type='environment'>" + value("string", "filename", "sky.exr") +
            value("float", "columnOffset", "0.25") + value("boolean", "rowsAtPoles", "true") + more +
            "</emitter><sampler type='independent'/></scene>";
        const LoadedScene loaded = load_scene(directory.write("scene.xml", scene));
        return render(loaded.job, {}).film.develop().color(0, 0);
    };
    const auto check = [&](const std::string& target, const std::string& more, double column, double row) {
        CAPTURE(target, more);
        const Color color = seen(target, more);
        CHECK(static_cast<double>(color.r) == Approx(column).margin(1e-3));
        CHECK(static_cast<double>(color.g) == Approx(row).margin(1e-3));
    };
    const auto turn = [](const std::string& operation) {
        return "<transform name='toWorld'>" + operation + "</transform>";
    };
    check("1,0,0", "", 1.5, 2);
    check("-1,0,0", "", 5.5, 2);
    check("0,0,1", "", 3.5, 2);
    check("1,0,1", "", 2.5, 2);
    check("-1,0,1", "", 4.5, 2);
    check("1,1,0", "", 1.5, 1);
    check("0,0,1", turn("<rotate axis='0,1,0' angle='90'/>"), 5.5, 2);
    check("1,0,0", turn("<scale value='-1,1,1'/>"), 5.5, 2);
    check("0,0,1", value("float", "scale", "2"), 7, 4);
    CHECK(static_cast<double>(seen("0,1,0", "").g) == Approx(0.0).margin(1e-3));
    CHECK(static_cast<double>(seen("0,-1,0", "").g) == Approx(4.0).margin(1e-3));
    CHECK(static_cast<double>(seen("0,0,1", turn("<rotate axis='1,0,0' angle='90'/>")).g) ==
          Approx(0.0).margin(1e-3));
}

TEST_CASE("meshes without normals are faceted or smooth", "[statistical][conventions][shape]")
{
    const TempDirectory directory;
    // A roof of two planes at 45 degrees, under a sun above.
    const std::string roof =
        "v -1 -1 -1\nv 0 -1 0\nv 0 1 0\nv -1 1 -1\nv 1 -1 -1\nv 1 1 -1\nf 1 2 3 4\nf 2 5 6 3\n";
    directory.write("roof.obj", roof);
    directory.write(
        "roof.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n-1 -1 -1\n0 -1 0\n0 1 0\n"
        "-1 1 -1\n1 -1 -1\n1 1 -1\n4 0 1 2 3\n4 1 4 5 2\n");
    directory.write("roof.serialized",
                    serialized_file({serialized_mesh(
                        0x1000, 6, {-1, -1, -1, 0, -1, 0, 0, 1, 0, -1, 1, -1, 1, -1, -1, 1, 1, -1},
                        {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2})}));
    // The file's normals are those of the floor.
    directory.write("normals.obj",
                    "v -1 -1 -1\nv 0 -1 0\nv 0 1 0\nv -1 1 -1\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
    const auto seen = [&](const std::string& type, const std::string& file, const std::string& more) {
        const std::string scene = "<scene dialect='plumb'>" + direct +
                                  orthographic(1, 8, "<rfilter type='box'/>") +
                                  "<emitter type='directional'><vector name='direction' value='0 0 -1'/>" +
                                  value("color", "radiance", pi3) + "</emitter><shape type='" + type + "'>" +
                                  value("string", "filename", file) + more + white +
                                  "</shape><sampler type='independent'><integer name='sampleCount' "
                                  "value='4096'/></sampler></scene>";
        return render_file(directory.write("scene.xml", scene));
    };
    const std::string smooth = value("boolean", "smooth", "true"),
                      facets = value("boolean", "faceNormals", "true"),
                      flip = value("boolean", "flipNormals", "true");
    const std::vector<double> flat(8, 0.70711),
        round = {0.7679, 0.87829, 0.95647, 0.99423, 0.99428, 0.95666, 0.87832, 0.76807};
    for (const std::string type : {"obj", "ply", "serialized"}) {
        check_row(type, seen(type, "roof." + type, ""), flat, 0);
        check_row(type, seen(type, "roof." + type, facets), flat, 0);
        check_row(type, seen(type, "roof." + type, smooth), round, 0.00019);
        check_row(type, seen(type, "roof." + type, flip), std::vector<double>(8, 0.0), 0);
        check_row(type, seen(type, "roof." + type, flip + smooth), std::vector<double>(8, 0.0), 0);
    }
    check_row("vn", seen("obj", "normals.obj", smooth), {1, 1, 1, 1, 0, 0, 0, 0}, 0);
    check_row("vn", seen("obj", "normals.obj", facets), {.7071, .7071, .7071, .7071, 0, 0, 0, 0}, 0);
    check_row("vn", seen("obj", "normals.obj", flip), std::vector<double>(8, 0.0), 0);
}

TEST_CASE("hidden emitters are not there for the camera, and everywhere else",
          "[statistical][conventions][integrator]")
{
    for (const std::string type : {"path", "path_mats", "path_nee", "path_ems", "path_mis"}) {
        CAPTURE(type);
        const std::string hide =
            "<integrator type='" + type + "'><boolean name='hideEmitters' value='true'/></integrator>";
        const std::string camera = orthographic(1e-4, 1, "");
        const std::string light = lamp("2", "2", "0 0 0", false), sky = "<emitter type='environment'/>";
        const auto seen = [&](const std::string& body, int samples) {
            return render_text(camera + body, samples, hide).red[0];
        };
        CHECK(seen(sky, 4) == 0.0);
        CHECK(seen(light, 4) == 0.0);
        CHECK(seen(light + light, 4) == 0.0); // one behind the other, or in the same place
        const std::string mirror =
            "<shape type='rectangle'><point name='center' value='0 0 -1'/><bsdf type='mirror'/></shape>";
        CHECK(seen(mirror + sky, 4) == 1.0);
        // The wall behind the lamp is lit by a point light between them.
        const std::string wall =
            "<shape type='rectangle'><float name='width' value='2'/><float name='height' value='2'/>"
            "<point name='center' value='0 0 -1'/><bsdf type='diffuse'>"
            "<color name='albedo' value='.5 .5 .5'/></bsdf></shape>";
        const std::string point =
            "<emitter type='point'><point name='position' value='0 0 -0.5'/>"
            "<color name='radiance' value='.785398163 .785398163 .785398163'/></emitter>";
        const std::string black =
            "<shape type='rectangle'><float name='width' value='2'/><float name='height' value='2'/>"
            "<bsdf type='diffuse'><color name='albedo' value='0 0 0'/></bsdf>"
            "<emitter type='area'/></shape>";
        check_row(type, render_text(camera + wall + point + black, 4000, hide), {0.5}, 0.0);
        // Through a pane that does not bend the view the environment stays hidden; what it reflects is seen.
        const std::string pane =
            "<shape type='rectangle'><bsdf type='dielectric'><float name='intIOR' value='1.0001'/>"
            "<float name='extIOR' value='1'/></bsdf></shape>";
        CHECK(seen(pane + sky, 4) == Approx(0.0).margin(1e-3));
    }
}
