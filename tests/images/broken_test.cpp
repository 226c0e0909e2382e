// SPDX-License-Identifier: MIT

// Files that lie or end early: the lean module gives an image or one clear error.

#include "images/modules.h"
#include "plumb/base/error.h"

using namespace plumb;
using namespace plumb::test;

namespace {

// 24 x 18 pixels of something that is not easy to compress.
std::string good_file(const std::string& extension)
{
    constexpr std::size_t count = std::size_t{3} * 24 * 18;
    std::vector<float> floats(count);
    std::vector<std::uint8_t> bytes(count);
    for (std::size_t i = 0; i < count; ++i) {
        bytes[i] = static_cast<std::uint8_t>(random_bits() % 64 + i / 8);
        floats[i] = static_cast<float>(bytes[i]) / 64.f;
    }
    const Metadata metadata = {{"Software", std::string("Plumb")}};
    ImageFile file{.name = "a" + extension, .metadata = metadata};
    file.data = {0, 0, 24, 18};
    file.full_width = 24;
    file.full_height = 18;
    file.channels = {"R", "G", "B"};
    if (extension == ".exr" || extension == ".hdr") {
        file.floats = floats.data();
        file.floats_per_pixel = 3;
        file.format = {{"compression", std::string("zip")}};
    } else {
        file.bytes = bytes.data();
    }
    const auto encoded = with_openimageio().encode(file); // BMP and TGA, too
    return {encoded.begin(), encoded.end()};
}

const std::vector<std::string> extensions = {".exr", ".png", ".jpg", ".hdr", ".bmp", ".tga"};

// An image, or an error on one line.
bool is_read(const std::filesystem::path& file)
{
    const Decoded image = decode(lean(), file);
    if (image.error.empty()) return true;
    CHECK(image.error.find('\n') == std::string::npos);
    CHECK(image.error.size() > 10);
    CHECK(image.error.back() != '.');
    return false;
}

std::string with(std::string file, std::size_t at, const std::string& bytes)
{
    return file.replace(at, bytes.size(), bytes);
}

} // namespace

TEST_CASE("files that end early are errors", "[images][broken]")
{
    const TempDirectory directory;
    for (const std::string& extension : extensions) {
        const std::string good = good_file(extension);
        CAPTURE(extension, good.size());
        REQUIRE(is_read(directory.write("good" + extension, good)));
        // Half of the pixels are not there. What follows the last of them may be missing.
        for (std::size_t size = 1; size < good.size() / 2; size += 1 + size / 64) {
            CAPTURE(size);
            CHECK_FALSE(is_read(directory.write("short" + extension, good.substr(0, size))));
        }
        for (std::size_t size = good.size() / 2; size < good.size(); ++size)
            is_read(directory.write("short" + extension, good.substr(0, size)));
    }
}

TEST_CASE("files with wrong bytes are images or errors", "[images][broken]")
{
    const TempDirectory directory;
    for (const std::string& extension : extensions) {
        const std::string good = good_file(extension);
        CAPTURE(extension);
        for (int i = 0; i < 600; ++i) {
            std::string bad = good;
            for (std::uint32_t k = 0; k <= random_bits() % 3; ++k) {
                const std::size_t range =
                    random_bits() % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 200);
                bad[random_bits() % range] = static_cast<char>(random_bits());
            }
            is_read(directory.write("bad" + extension, bad));
        }
    }
}

TEST_CASE("files that claim to be enormous are errors", "[images][broken]")
{
    const TempDirectory directory;
    const auto error = [&](const std::string& name, const std::string& bytes) {
        return decode(lean(), directory.write(name, bytes)).error;
    };
    CHECK(error("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 900000000 +X 900000000\n\2\2\2\2") ==
          "it is too large: 900000000 x 900000000 pixels");
    CHECK(error("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 500000000 +X 500000000\n\2\2\2\2") ==
          "an image cannot have 500000000 x 500000000 pixels of 3 channels");
    CHECK_FALSE(is_read(directory.write("a.tga", with(good_file(".tga"), 12, "\xff\xff\xff\xff"))));
    CHECK_FALSE(is_read(directory.write("a.bmp", with(good_file(".bmp"), 18, "\xff\xff\xff\x7f"))));
    CHECK_FALSE(is_read(directory.write("a.bmp", with(good_file(".bmp"), 22, std::string("\0\0\0\x80", 4)))));
    CHECK_FALSE(is_read(directory.write("a.png", with(good_file(".png"), 16, "\x7f\xff\xff\xff"))));
}

TEST_CASE("EXR with windows far from any corner", "[images][broken]")
{
    const TempDirectory directory;
    const std::string good = good_file(".exr");
    const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21);
    const std::size_t at = good.find(window) + window.size();
    REQUIRE(at < good.size());
    const auto error = [&](int x0, int x1) {
        std::string bad = good;
        for (std::size_t i = 0; i < 4; ++i) {
            bad[at + i] = static_cast<char>(x0 >> 8 * i);
            bad[at + 8 + i] = static_cast<char>(x1 >> 8 * i);
        }
        return decode(lean(), directory.write("a.exr", bad)).error;
    };
    CHECK(error(0, 23).empty());
    CHECK(error((1 << 29) + 10, (1 << 29) + 33) ==
          "its pixels are too far from the image's corner: at 536870922,0, and the image at 0,0");
    CHECK_FALSE(error(-2147483647, 2147483646).empty());
    CHECK_FALSE(error(0, -5).empty());
    CHECK_FALSE(error(0, 500000000).empty());
}

TEST_CASE("what only OpenImageIO reads is one clear error without it", "[images][broken]")
{
    const TempDirectory directory;
    const std::string no_tiff =
        "this build of Plumb has no TIFF; one with OpenImageIO has it (configured with PLUMB_IMAGES=oiio)";
    for (const std::string& start : {std::string("II*\0", 4), std::string("MM\0*", 4)})
        CHECK(decode(lean(), directory.write("a.tif", start + std::string(100, 'x'))).error == no_tiff);
    CHECK(decode(lean(), directory.write("a.gif", "GIF89a and so on")).error ==
          "it is not an image of a format that this build of Plumb reads: EXR, PNG, JPEG, HDR, BMP or TGA");
    const Metadata none;
    const ImageFile file{.name = "a.TIFF", .data = {0, 0, 1, 1}, .channels = {"Y"}, .metadata = none};
    CHECK_THROWS_WITH(lean().encode(file), no_tiff);
    CHECK_THROWS_WITH(lean().check_written_format("a.TIFF"), no_tiff);
    CHECK_NOTHROW(with_openimageio().check_written_format("a.TIFF"));
    CHECK_NOTHROW(lean().check_written_format("a.exr"));
}
