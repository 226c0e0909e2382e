// SPDX-License-Identifier: MIT

// EXR of every kind, written by OpenEXR.

#include "images/modules.h"

#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

using namespace plumb;
using namespace plumb::test;

namespace {

using Imath::Box2i;

Imf::Header header_of(const Box2i& display, const Box2i& data,
                      Imf::Compression compression = Imf::ZIP_COMPRESSION)
{
    Imf::Header header(display, data);
    header.compression() = compression;
    return header;
}

Imf::Header small_header(Imf::Compression compression = Imf::ZIP_COMPRESSION)
{
    const Box2i box({0, 0}, {36, 22});
    return header_of(box, box, compression);
}

void add(Imf::Header& header, const std::string& name, Imf::PixelType type)
{
    header.channels().insert(name, Imf::Channel(type));
}

// Random values of all channels of a header, half of them the value before, so that there is something to compress.
class Values {
public:
    explicit Values(const Imf::Header& header)
    {
        const Box2i& data = header.dataWindow();
        const std::int64_t width = data.max.x - data.min.x + 1;
        const std::int64_t height = data.max.y - data.min.y + 1;
        std::size_t count = 0;
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++count;
        const auto pixels = static_cast<std::size_t>(width * height);
        words_.resize(pixels * count);
        std::size_t i = 0;
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++i) {
            std::uint32_t* const words = words_.data() + i * pixels;
            const std::size_t size = c.channel().type == Imf::HALF ? 2 : 4;
            for (std::size_t p = 0; p < pixels; ++p)
                words[p] = p > 0 && random_bits() % 2 ? words[p - 1] : random_bits();
            frame.insert(c.name(), Imf::Slice::Make(c.channel().type, words, data, size));
        }
    }
    Imf::FrameBuffer frame;

private:
    std::vector<std::uint32_t> words_;
};

std::filesystem::path write_scanlines(const TempDirectory& directory, const Imf::Header& header)
{
    const std::filesystem::path path = directory / "image.exr";
    const Values values(header);
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(values.frame);
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    return path;
}

std::filesystem::path write_tiles(const TempDirectory& directory, Imf::Header header, unsigned size,
                                  Imf::LevelMode levels)
{
    const std::filesystem::path path = directory / "image.exr";
    header.setTileDescription(Imf::TileDescription(size, size, levels));
    const Values values(header);
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(values.frame);
    for (int y = 0; y < file.numYLevels(); ++y)
        for (int x = 0; x < file.numXLevels(); ++x)
            if (file.isValidLevel(x, y) && (levels == Imf::RIPMAP_LEVELS || x == y))
                file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
    return path;
}

constexpr Imf::Compression compressions[] = {
    Imf::NO_COMPRESSION,   Imf::RLE_COMPRESSION,   Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
    Imf::PIZ_COMPRESSION,  Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,  Imf::B44A_COMPRESSION,
    Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION};

} // namespace

TEST_CASE("EXR of every pixel type and compression", "[images][exr]")
{
    const TempDirectory directory;
    for (const Imf::Compression compression : compressions) {
        CAPTURE(compression);
        for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
            Imf::Header header = small_header(compression);
            for (const char* const name : {"R", "G", "B", "A"}) add(header, name, type);
            CAPTURE(type);
            check_same(write_scanlines(directory, header));
            check_same(write_tiles(directory, header, 16, Imf::ONE_LEVEL));
        }
        Imf::Header mixed = small_header(compression);
        add(mixed, "R", Imf::HALF);
        add(mixed, "id", Imf::UINT);
        add(mixed, "Z", Imf::FLOAT);
        check_same(write_scanlines(directory, mixed));
    }
}

TEST_CASE("EXR with other windows", "[images][exr]")
{
    const TempDirectory directory;
    const Box2i display({0, 0}, {63, 47});
    for (const Box2i& data : {Box2i({7, 3}, {26, 13}), Box2i({-9, -4}, {70, 50}),
                              Box2i({100, 200}, {100, 200}), Box2i({5, 5}, {5, 5})})
        for (const Imath::V2i& shift : {Imath::V2i(0, 0), Imath::V2i(11, -17)}) {
            Imf::Header header =
                header_of({display.min + shift, display.max + shift}, {data.min + shift, data.max + shift});
            add(header, "Y", Imf::FLOAT);
            check_same(write_scanlines(directory, header));
            check_same(write_tiles(directory, header, 8, Imf::ONE_LEVEL));
        }
}

TEST_CASE("EXR with its rows from the bottom, with smaller copies, and in parts", "[images][exr]")
{
    const TempDirectory directory;
    Imf::Header header = small_header();
    add(header, "G", Imf::HALF);
    header.lineOrder() = Imf::DECREASING_Y;
    check_same(write_scanlines(directory, header));
    header.lineOrder() = Imf::INCREASING_Y;
    for (const Imf::LevelMode levels : {Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS})
        check_same(write_tiles(directory, header, 8, levels), Compare::pixels);

    Imf::Header parts[] = {small_header(), small_header(Imf::PIZ_COMPRESSION)};
    for (Imf::Header& part : parts) part.setType(Imf::SCANLINEIMAGE);
    parts[0].setName("first");
    parts[1].setName("second");
    add(parts[0], "R", Imf::FLOAT);
    add(parts[1], "other", Imf::HALF);
    {
        Imf::MultiPartOutputFile file((directory / "parts.exr").c_str(), parts, 2);
        for (int i = 0; i < 2; ++i) {
            const Values values(parts[i]);
            Imf::OutputPart part(file, i);
            part.setFrameBuffer(values.frame);
            part.writePixels(23);
        }
    }
    check_same(directory / "parts.exr");
}

TEST_CASE("EXR with many names of channels, in the same order", "[images][exr]")
{
    const TempDirectory directory;
    for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{
             {"R", "G", "B", "contributing", "variance.R", "variance.G", "variance.B"},
             {"B", "G", "R", "A", "Z", "Y", "normal.X", "normal.Y", "normal.Z", "depth.Z", "a.b.R", "a.b.A"},
             {"red", "green", "blue", "alpha", "depth"},
             {"Red", "Green", "Blue", "Alpha", "Depth", "Zback", "u", "v", "BY", "RY"},
             {"X", "Y", "Z"},
             {"AR", "AG", "AB", "R", "G", "B"},
             {"left.R", "left.G", "left.B", "right.R", "right.G", "right.B", "R", "G", "B", "real", "imag"},
             {"x.y", "X.y", "x", ".R", "R."}}) {
        Imf::Header header = small_header();
        for (const std::string& name : names) add(header, name, Imf::HALF);
        CAPTURE(names);
        check_same(write_scanlines(directory, header));
    }
}

TEST_CASE("EXR with attributes of every type", "[images][exr]")
{
    const TempDirectory directory;
    Imf::Header header = small_header();
    add(header, "R", Imf::HALF);
    header.insert("plumb:seed", Imf::StringAttribute("7"));
    header.insert("plumb:text", Imf::StringAttribute(std::string("with\0zero", 9)));
    header.insert("plumb:empty", Imf::StringAttribute(""));
    header.insert("anInt", Imf::IntAttribute(-3));
    header.insert("aFloat", Imf::FloatAttribute(0.1f));
    header.insert("aDouble", Imf::DoubleAttribute(0.1));
    header.insert("aV2f", Imf::V2fAttribute({1.f, 2.f}));
    header.insert("aV2i", Imf::V2iAttribute({1, 2}));
    header.insert("aV3f", Imf::V3fAttribute({1.f, 2.f, 3.f}));
    header.insert("aV3i", Imf::V3iAttribute({1, 2, 3}));
    header.insert("aV3d", Imf::V3dAttribute({1.0, 2.0, 3.0}));
    header.insert("aBox2i", Imf::Box2iAttribute({{1, 2}, {3, 4}}));
    header.insert("aBox2f", Imf::Box2fAttribute({{1.f, 2.f}, {3.f, 4.f}}));
    header.insert("aM33", Imf::M33fAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9}));
    header.insert("worldToCamera",
                  Imf::M44fAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
    header.insert("worldToNDC", Imf::M44fAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 17}));
    header.insert("floats", Imf::FloatVectorAttribute({1.f, 2.f, 3.f, 4.f, 5.f}));
    header.insert("words", Imf::StringVectorAttribute({"a", "b"}));
    header.insert("chromaticities", Imf::ChromaticitiesAttribute(Imf::Chromaticities()));
    header.insert("timeCode", Imf::TimeCodeAttribute(Imf::TimeCode(1, 2, 3, 4)));
    header.insert("comments", Imf::StringAttribute("a comment"));
    header.insert("owner", Imf::StringAttribute("nobody"));
    header.insert("capDate", Imf::StringAttribute("2026:11:01 00:00:00"));
    header.insert("xDensity", Imf::FloatAttribute(72.f));
    header.insert("expTime", Imf::FloatAttribute(0.5f));
    header.insert("aperture", Imf::FloatAttribute(2.f));
    header.insert("Software", Imf::StringAttribute("Plumb"));
    header.insert("software", Imf::StringAttribute("other"));
    header.pixelAspectRatio() = 1.5f;
    check_same(write_scanlines(directory, header));
}
