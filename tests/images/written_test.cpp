// SPDX-License-Identifier: MIT

// What both modules write.

#include "images/modules.h"

#include "image/image_words.h"

#include <bit>
#include <fstream>

using namespace plumb;
using namespace plumb::test;

namespace {

using Encoded = std::vector<unsigned char>;

struct Written {
    ImageFile file;
    std::vector<float> floats;
    std::vector<std::uint8_t> bytes;
};

const Metadata metadata = {
    {"Software", std::string("Plumb 0.2.0")},
    {"plumb:seed", std::string("7")},
    {"plumb:spp", 7},
    {"plumb:scale", 0.5f},
    {"plumb:rmseInterval", std::vector<float>{1.f, 2.f}},
    {"worldToCamera", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16.5f}}};

std::vector<float> random_floats(std::size_t count)
{
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(random_bits() >> 8) * 0x1p-20f;
    return values;
}

Encoded encode(const ImageModule& module, const std::string& name, const PixelRect& data, int full_width,
               int full_height, const std::vector<std::string>& channels, const std::vector<float>& floats,
               const std::string& compression, const Metadata& with = metadata)
{
    ImageFile file{.name = name, .metadata = with};
    file.data = data;
    file.full_width = full_width;
    file.full_height = full_height;
    file.channels = channels;
    file.format = {{"oiio:ColorSpace", std::string("Linear")}};
    if (!compression.empty()) file.format.emplace_back("compression", compression);
    file.floats = floats.data();
    file.floats_per_pixel = static_cast<int>(channels.size());
    return module.encode(file);
}

Encoded encode_bytes(const ImageModule& module, const std::string& name, int width, int height,
                     const std::vector<std::string>& channels, const std::vector<std::uint8_t>& bytes)
{
    ImageFile file{.name = name, .metadata = metadata};
    file.data = {0, 0, width, height};
    file.full_width = width;
    file.full_height = height;
    file.channels = channels;
    file.format = {{"oiio:ColorSpace", std::string("sRGB")}};
    if (name.ends_with(".jpg")) {
        file.format.emplace_back("compression", std::string("jpeg:95"));
        file.format.emplace_back("jpeg:subsampling", std::string("4:4:4"));
    }
    file.bytes = bytes.data();
    return module.encode(file);
}

std::filesystem::path keep(const TempDirectory& directory, const std::string& name, const Encoded& bytes)
{
    return directory.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

const std::vector<std::string> all_channels = {"R", "G", "B", "contributing", "variance.R", "normal.X"};

} // namespace

TEST_CASE("EXR files are the same bytes", "[images][written]")
{
    const auto floats = random_floats(std::size_t{6} * 70 * 50);
    for (const std::string compression : {"zip", "rle"})
        for (const PixelRect& data : {PixelRect{0, 0, 70, 50}, PixelRect{7, 3, 20, 40}}) {
            const auto encoded = [&](const ImageModule& module) {
                return encode(module, "a.exr", data, 80, 60, all_channels, floats, compression);
            };
            CHECK((encoded(with_openimageio()) == encoded(lean())));
        }
}

TEST_CASE("metadata of any length and name goes into EXR files in the same way", "[images][written]")
{
    const auto floats = random_floats(12);
    for (std::size_t count = 1; count <= 17; ++count) {
        const Metadata with = {{"plumb:floats", std::vector<float>(count, 0.25f)}};
        CAPTURE(count);
        const auto encoded = [&](const ImageModule& module) {
            return encode(module, "a.exr", {0, 0, 2, 2}, 2, 2, {"R", "G", "B"}, floats, "zip", with);
        };
        CHECK((encoded(with_openimageio()) == encoded(lean())));
    }
    for (const std::string name : {"DateTime",
                                   "ImageDescription",
                                   "Copyright",
                                   "PixelAspectRatio",
                                   "XResolution",
                                   "YResolution",
                                   "ResolutionUnit",
                                   "compression",
                                   "oiio:ColorSpace",
                                   "channels",
                                   "dataWindow",
                                   "version",
                                   "description",
                                   "FNumber",
                                   "type",
                                   "tiles",
                                   "planarconfig",
                                   "name",
                                   "screenWindowWidth",
                                   "Orientation",
                                   "worldtocamera",
                                   "capDate",
                                   "comments",
                                   "png:filter",
                                   "jpeg:subsampling",
                                   "Exif:ExifVersion",
                                   "IPTC:Caption"})
        for (const MetadataValue& value :
             {MetadataValue(3), MetadataValue(2.5f), MetadataValue(std::string("text"))}) {
            const Metadata with = {{name, value}};
            CAPTURE(name, value.index());
            const auto encoded = [&](const ImageModule& module) {
                return encode(module, "a.exr", {0, 0, 2, 2}, 2, 2, {"R", "G", "B"}, floats, "zip", with);
            };
            CHECK((encoded(with_openimageio()) == encoded(lean())));
        }
}

TEST_CASE("PNG files are the same bytes", "[images][written]")
{
    std::vector<std::uint8_t> bytes(std::size_t{4} * 70 * 50);
    for (const std::uint32_t noise : {1u, 8u, 256u}) {
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::uint8_t>(random_bits() % noise + i / 100 + i % 7 * (i % 280));
        for (const std::vector<std::string>& channels : std::vector<std::vector<std::string>>{
                 {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}) {
            CAPTURE(channels, noise);
            CHECK((encode_bytes(with_openimageio(), "a.png", 70, 50, channels, bytes) ==
                   encode_bytes(lean(), "a.png", 70, 50, channels, bytes)));
        }
    }
}

TEST_CASE("HDR files are the same bytes", "[images][written]")
{
    auto floats = random_floats(std::size_t{3} * 400 * 10);
    for (std::size_t i = 3; i < floats.size(); ++i)
        if (random_bits() % 4 > 0) floats[i] = floats[i - 3]; // runs
    floats[30] = 0.f;
    floats[31] = 1e-35f;
    floats[32] = 1e-33f;
    floats[33] = 1e30f;
    for (const int width : {1, 7, 8, 130, 400}) {
        const auto encoded = [&](const ImageModule& module) {
            return encode(module, "a.hdr", {0, 0, width, 10}, width, 10, {"R", "G", "B"}, floats, "");
        };
        CAPTURE(width);
        CHECK((encoded(with_openimageio()) == encoded(lean())));
    }
}

TEST_CASE("JPEG files have the same pixels, and the program's name", "[images][written]")
{
    const TempDirectory directory;
    std::vector<std::uint8_t> bytes(std::size_t{3} * 70 * 50);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i / 40);
    for (const std::vector<std::string>& channels :
         std::vector<std::vector<std::string>>{{"Y"}, {"R", "G", "B"}}) {
        const auto a =
            keep(directory, "a.jpg", encode_bytes(with_openimageio(), "a.jpg", 70, 50, channels, bytes));
        const auto b = keep(directory, "b.jpg", encode_bytes(lean(), "b.jpg", 70, 50, channels, bytes));
        const Decoded first = check_same(a, Compare::pixels);
        const Decoded second = check_same(b, Compare::pixels);
        CHECK((first.values == second.values));
        for (const auto& file : {a, b})
            for (const ImageModule* const module : {&with_openimageio(), &lean()}) {
                const Decoded image = decode(*module, file);
                const std::string* const software = image.find("Software");
                REQUIRE(software);
                CHECK(*software == "Software: text Plumb 0.2.0");
            }
    }
}

TEST_CASE("words are the same bytes, and the same when they are read", "[images][written]")
{
    const TempDirectory directory;
    WordImage image;
    image.data = {3, 2, 31, 300};
    image.full_width = 40;
    image.full_height = 400;
    image.float_channels = {"R", "G", "B"};
    image.word_channels = {"sum.0", "sum.1", "count"};
    image.metadata = metadata;
    const auto fill = [&](int top, int count, std::span<std::uint32_t> rows) {
        for (std::size_t i = 0; i < image.words_per_row() * static_cast<std::size_t>(count); ++i)
            rows[i] = static_cast<std::uint32_t>(i / 7 * 2654435761u) + static_cast<std::uint32_t>(top);
    };
    const Encoded encoded = with_openimageio().encode_words(image, fill);
    CHECK((encoded == lean().encode_words(image, fill)));

    const auto file = keep(directory, "words.exr", encoded);
    const auto read = [&](const ImageModule& module) {
        std::vector<std::uint32_t> all;
        module.read_words(
            file.string(),
            [](const WordImage& header) {
                std::vector<std::string> names = {"count", "G"};
                names.insert(names.end(), header.word_channels.begin(), header.word_channels.end());
                names.insert(names.end(), header.float_channels.begin(), header.float_channels.end());
                return names;
            },
            [&](int y, std::span<const std::uint32_t> row) {
                all.push_back(static_cast<std::uint32_t>(y));
                all.insert(all.end(), row.begin(), row.end());
            });
        return all;
    };
    const auto words = read(with_openimageio());
    CHECK(words.size() == std::size_t{300} * (1 + 8 * 31));
    CHECK((words == read(lean())));
}
