// SPDX-License-Identifier: MIT

// Radiance's files of every kind.

#include "images/modules.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

std::string header(const std::string& size, const std::string& lines = "FORMAT=32-bit_rle_rgbe\n")
{
    return "#?RADIANCE\n" + lines + "\n" + size + "\n";
}

// None looks like the start of an encoded row, or like a run of the older encoding.
std::string random_pixels(int count)
{
    std::string bytes;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t bits = random_bits();
        bytes += static_cast<char>(bits | 0x80);
        for (const int shift : {8, 16, 24}) bytes += static_cast<char>(bits >> shift);
    }
    return bytes;
}

// One row in the newer encoding, of random runs.
std::string encoded_row(int width)
{
    std::string bytes = {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
    for (int component = 0; component < 4; ++component)
        for (int x = 0; x < width;) {
            const bool is_run = random_bits() % 2 == 0;
            const int count = std::min(width - x, 1 + static_cast<int>(random_bits() % (is_run ? 127 : 128)));
            bytes += static_cast<char>(is_run ? 128 + count : count);
            for (int i = 0; i < (is_run ? 1 : count); ++i) bytes += static_cast<char>(random_bits());
            x += count;
        }
    return bytes;
}

} // namespace

TEST_CASE("HDR without and with encoded rows", "[images][hdr]")
{
    const TempDirectory directory;
    for (const int width : {1, 7, 8, 9, 200, 300}) {
        const std::string start = header(fmt::format("-Y 5 +X {}", width));
        check_same(directory.write("flat.hdr", start + random_pixels(5 * width)));
        if (width < 8) continue;
        std::string rows;
        for (int y = 0; y < 5; ++y) rows += encoded_row(width);
        check_same(directory.write("encoded.hdr", start + rows));
        check_same(directory.write("mixed.hdr", start + encoded_row(width) + random_pixels(width) +
                                                    encoded_row(width) + random_pixels(2 * width)));
    }
    check_same(directory.write("wide.hdr", header("-Y 1 +X 40000") + random_pixels(40000)));
}

TEST_CASE("HDR with its rows in any order", "[images][hdr]")
{
    const TempDirectory directory;
    for (const char* const size : {"-Y 3 +X 20", "-Y 3 -X 20", "+Y 3 -X 20", "+Y 3 +X 20", "+X 3 -Y 20",
                                   "+X 3 +Y 20", "-X 3 +Y 20", "-X 3 -Y 20"})
        check_same(directory.write("a.hdr", header(size) + random_pixels(60)));
}

TEST_CASE("HDR with other lines in its header", "[images][hdr]")
{
    const TempDirectory directory;
    const std::string pixels = random_pixels(4);
    const std::string format = "FORMAT=32-bit_rle_rgbe\n";
    for (const std::string& lines :
         {"# a comment\n" + format, format + "EXPOSURE=2.5\n", "GAMMA=2.2\n" + format, format + "GAMMA=1\n",
          format + "SOFTWARE=some program\n",
          format + "PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n"}) {
        CAPTURE(lines);
        check_same(directory.write("a.hdr", header("-Y 2 +X 2", lines) + pixels));
    }
    check_same(directory.write("a.hdr", "#?RGBE\n" + format + "\n-Y 2 +X 2\n" + pixels));
}

TEST_CASE("HDR of every exponent", "[images][hdr]")
{
    const TempDirectory directory;
    std::string pixels;
    for (int exponent = 0; exponent < 256; ++exponent)
        for (const int mantissa : {128, 77, 255, exponent}) pixels += static_cast<char>(mantissa);
    check_same(directory.write("a.hdr", header("-Y 256 +X 1") + pixels));
}

// OpenImageIO takes the runs for pixels.
TEST_CASE("HDR in the older encoding is decoded by the lean module", "[images][hdr]")
{
    const TempDirectory directory;
    const std::string red = {'\x80', 0, 0, '\x81'};
    const std::string green = {0, '\x80', 0, '\x81'};
    const auto run = [](int count) { return std::string{1, 1, 1, static_cast<char>(count)}; };
    // 1 + 44 + 256 red ones, and 2 green ones
    directory.write("a.hdr", header("-Y 2 +X 303") + red + run(44) + run(1) + green + run(1) + green +
                                 run(46) + run(1));
    const Decoded image = decode(lean(), directory / "a.hdr");
    REQUIRE(image.error.empty());
    const auto is = [&](int x, int y, std::size_t lit) {
        for (std::size_t c = 0; c < 3; ++c)
            if (image.values[static_cast<std::size_t>(303 * y + x) * 3 + c] != (c == lit ? 0x3f800000u : 0u))
                return false;
        return true;
    };
    for (int x = 0; x < 303; ++x) {
        CAPTURE(x);
        CHECK(is(x, 0, x < 301 ? 0 : 1));
        CHECK(is(x, 1, 1));
    }
}
