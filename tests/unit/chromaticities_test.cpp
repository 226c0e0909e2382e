// SPDX-License-Identifier: MIT

#include "image/chromaticities.h"
#include "plumb/base/error.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <cstring>
#include <fstream>

using namespace plumb;

namespace {

constexpr Chromaticities aces = {0.7347f, 0.2653f, 0.f, 1.f, 0.0001f, -0.077f, 0.32168f, 0.33767f};
constexpr Chromaticities rec2020 = {0.708f, 0.292f, 0.17f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.329f};

// One pixel.
Image image_of(const Color& color, std::vector<std::string> channels = {"R", "G", "B"})
{
    Image image({0, 0, 1, 1}, 1, 1, std::move(channels));
    for (int c = 0; c < 3; ++c) image.pixel(0, 0)[c] = color[c];
    return image;
}

// Writes other numbers over those in a file that Plumb has written.
void replace_chromaticities(const std::filesystem::path& path, const Chromaticities& with)
{
    std::string bytes = read_bytes(path);
    const std::string name("chromaticities\0chromaticities\0", 30);
    const std::size_t at = bytes.find(name);
    REQUIRE(at != std::string::npos);
    std::memcpy(bytes.data() + at + name.size() + 4, with.data(), sizeof with); // after the size
    std::ofstream(path, std::ios::binary) << bytes;
}

} // namespace

TEST_CASE("an .exr says that its colours are linear sRGB", "[unit][image]")
{
    const TempDirectory directory;
    write_image(directory / "a.exr", image_of({0.25f, 2.f, -0.5f}));
    const Image again = read_image(directory / "a.exr", true);
    CHECK(chromaticities_of(again.metadata) == srgb_chromaticities);
    CHECK(again.color(0, 0) == Color(0.25f, 2.f, -0.5f)); // exactly
    // What has no colours says nothing of them.
    write_image(directory / "b.exr", image_of(Color(0.5f), {"X", "Y", "Z"}));
    CHECK_FALSE(chromaticities_of(read_image(directory / "b.exr", true).metadata));
}

TEST_CASE("colours of other colour spaces become linear sRGB", "[unit][image]")
{
    // Published matrices: ACES 2065-1 (adapted after Bradford), Rec. 2020.
    struct Space {
        Chromaticities chromaticities;
        std::array<double, 9> matrix;
    };
    const Space spaces[] = {
        {aces, {2.52169, -1.13413, -0.38756, -0.27648, 1.37272, -0.09624, -0.01538, -0.15298, 1.16835}},
        {rec2020, {1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187}},
    };
    const TempDirectory directory;
    const auto path = directory / "a.exr";
    for (const Space& space : spaces) {
        const auto matrix = to_srgb(space.chromaticities);
        REQUIRE(matrix);
        for (std::size_t i = 0; i < 9; ++i) CHECK((*matrix)[i] == Approx(space.matrix[i]).margin(1e-4));
        for (const Color& color : {Color(1.f, 0.f, 0.f), Color(0.2f, 0.5f, 0.1f), Color(3.f)}) {
            write_image(path, image_of(color));
            replace_chromaticities(path, space.chromaticities);
            const Image read = read_image(path, true);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(static_cast<double>(read.color(0, 0)[static_cast<int>(i)]) ==
                      Approx((*matrix)[3 * i] * static_cast<double>(color.r) +
                             (*matrix)[3 * i + 1] * static_cast<double>(color.g) +
                             (*matrix)[3 * i + 2] * static_cast<double>(color.b))
                          .epsilon(1e-6)
                          .margin(1e-6));
            CHECK(chromaticities_of(read.metadata) == srgb_chromaticities);
            // Numbers that are not colours stay.
            CHECK(read_image(path, false).color(0, 0) == color);
        }
        // White is white.
        for (std::size_t row = 0; row < 3; ++row)
            CHECK((*matrix)[3 * row] + (*matrix)[3 * row + 1] + (*matrix)[3 * row + 2] == Approx(1.0));
    }
    CHECK_FALSE(to_srgb({0.6400f, 0.3300f, 0.3000f, 0.6000f, 0.1500f, 0.0600f, 0.3127f, 0.3291f}));
}

TEST_CASE("chromaticities that are no colour space are an error", "[unit][image]")
{
    const TempDirectory directory;
    const auto path = directory / "a.exr";
    write_image(path, image_of(Color(1.f)));
    replace_chromaticities(path, {});
    CHECK_THROWS_WITH(read_image(path, true),
                      ContainsSubstring("its chromaticities are no colour space: 0 0, 0 0, 0 0, 0 0"));
    // Error bars of another colour space.
    Image bars({0, 0, 1, 1}, 1, 1, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    write_image(path, bars);
    replace_chromaticities(path, aces);
    CHECK_THROWS_WITH(read_image(path, true), ContainsSubstring("variances beside them cannot be converted"));
}
