// SPDX-License-Identifier: MIT

// Small scenes of Mitsuba, with what Mitsuba renders of them (tests/mitsuba).

#include "build_paths.h"
#include "plumb/base/error.h"
#include "plumb/image/image.h"
#include "plumb/render/render.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

using namespace plumb;

namespace {

const std::filesystem::path directory = std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "mitsuba";

struct Case {
    std::string name;
    bool is_error = false;
    double standard_error = 0.0; // the largest of any pixel
    int width = 0, height = 0, channels = 0;
    std::vector<double> pixels;
};

std::vector<Case> read_cases()
{
    std::ifstream file(directory / "values.txt");
    std::vector<Case> cases;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        Case one;
        std::string samples;
        words >> one.name >> samples;
        one.is_error = samples == "error";
        if (!one.is_error) words >> one.standard_error >> one.width >> one.height >> one.channels;
        for (double value = 0.0; words >> value;) one.pixels.push_back(value);
        cases.push_back(std::move(one));
    }
    return cases;
}

// Names of cases that do not give Mitsuba's value or error, and why.
std::map<std::string, std::string> read_exceptions()
{
    std::ifstream file(directory / "exceptions.txt");
    std::map<std::string, std::string> reasons;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        const std::size_t blank = line.find(' ');
        reasons.emplace(line.substr(0, blank), line.substr(line.find_first_not_of(' ', blank)));
    }
    return reasons;
}

// What is wrong with our image; empty: nothing. Our own noise is estimated from independent images.
std::string difference(const LoadedScene& scene, const Case& expected, std::uint64_t samples)
{
    constexpr int images = 16;
    const Vec2i resolution = scene.job.camera->resolution();
    if (resolution != Vec2i(expected.width, expected.height))
        return "the image has " + std::to_string(resolution.x) + " x " + std::to_string(resolution.y) +
               " pixels";
    const int channels = expected.channels == 1 ? 1 : 3; // the first three of an image with AOVs or alpha
    std::vector<double> sum(static_cast<std::size_t>(resolution.x * resolution.y * channels)),
        squares(sum.size());
    for (int i = 0; i < images; ++i) {
        RenderOptions options;
        options.samples_per_pixel = samples;
        options.seed = static_cast<std::uint64_t>(i);
        const Image image = render(scene.job, options).film.develop();
        std::size_t k = 0;
        for (int y = 0; y < resolution.y; ++y)
            for (int x = 0; x < resolution.x; ++x) {
                const Color color = image.color(x, y);
                for (int c = 0; c < channels; ++c, ++k) {
                    const auto value = static_cast<double>(channels == 1 ? luminance(color) : color[c]);
                    sum[k] += value;
                    squares[k] += value * value;
                }
            }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
        const std::size_t pixel = k / static_cast<std::size_t>(channels),
                          c = k % static_cast<std::size_t>(channels);
        const double wanted = expected.pixels[pixel * static_cast<std::size_t>(expected.channels) + c];
        const double mean = sum[k] / images;
        const double variance = std::max(0.0, squares[k] / images - mean * mean) / (images - 1);
        const double allowed = 1e-4 * std::max(1.0, std::abs(wanted)) +
                               5.0 * std::sqrt(variance + expected.standard_error * expected.standard_error);
        if (std::abs(mean - wanted) <= allowed) continue;
        std::ostringstream text;
        text << "pixel " << pixel << " channel " << c << " is " << mean << " instead of " << wanted
             << ", where " << allowed << " is allowed";
        return text.str();
    }
    return {};
}

// Empty: as in Mitsuba.
std::string failure(const Case& one)
{
    try {
        const LoadedScene scene = load_scene(directory / (one.name + ".xml"));
        if (one.is_error) return "it loads";
        std::string wrong = difference(scene, one, 16);
        if (!wrong.empty()) wrong = difference(scene, one, 1600);
        return wrong;
    } catch (const SceneError& error) {
        return one.is_error ? std::string() : error.diagnostics().front().text();
    } catch (const Error& error) {
        return one.is_error ? std::string() : error.what();
    }
}

} // namespace

TEST_CASE("scenes of Mitsuba look as Mitsuba renders them", "[statistical][mitsuba]")
{
    const std::map<std::string, std::string> exceptions = read_exceptions();
    std::map<std::string, std::string> unused = exceptions;
    for (const Case& one : read_cases()) {
        const std::string wrong = failure(one);
        unused.erase(one.name);
        const auto exception = exceptions.find(one.name);
        CAPTURE(one.name, wrong);
        if (exception == exceptions.end())
            CHECK(wrong.empty());
        else if (wrong.empty() && !exception->second.starts_with("awaits"))
            FAIL_CHECK("it need no longer be in exceptions.txt: " << exception->second);
    }
    CHECK(unused.empty());
}
