// SPDX-License-Identifier: MIT

// Which format a file has, and who reads and writes it.

#include "image/lean/lean_module.h"

#include "base/lower_case.h"
#include "base/regular_file.h"
#include "image/hdr.h"
#include "image/lean/codecs.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <span>

namespace plumb {

namespace {

constexpr const char* no_tiff =
    "this build of Plumb has no TIFF; one with OpenImageIO has it (configured with PLUMB_IMAGES=oiio)";

std::string extension_of(const std::string& name)
{
    return lower_case(std::filesystem::path(name).extension().string());
}

enum class Format { png, exr, jpeg, hdr, bmp, tga };

struct Magic {
    std::string_view start;
    Format format;
};

constexpr Magic magics[] = {
    {"\x89PNG\r\n\x1a\n", Format::png},
    {"\x76\x2f\x31\x01", Format::exr},
    {"\xff\xd8\xff", Format::jpeg},
    {"#?", Format::hdr},
    {"BM", Format::bmp},
};

constexpr std::string_view tiff_magics[] = {{"II*\0", 4}, {"MM\0*", 4}, {"II+\0", 4}, {"MM\0+", 4}};

// By what the file begins with. TGA has nothing there that says so: its extension does. Throws Error for other formats.
Format format_of(const std::string& name)
{
    const RegularFile file(name);
    std::string start(static_cast<std::size_t>(std::min<std::uintmax_t>(file.size(), 8)), '\0');
    file.read(0, std::span(start));
    for (const auto& [magic, format] : magics)
        if (start.starts_with(magic)) return format;
    for (const std::string_view magic : tiff_magics)
        if (start.starts_with(magic)) throw Error(no_tiff);
    if (extension_of(name) == ".tga") return Format::tga;
    throw Error(
        "it is not an image of a format that this build of Plumb reads: EXR, PNG, JPEG, HDR, BMP or TGA");
}

lean::Raster read_raster(Format format, const std::string& name)
{
    switch (format) {
    case Format::png: return lean::read_png(name);
    case Format::jpeg: return lean::read_jpeg(name);
    case Format::bmp: return lean::read_bmp(name);
    default: return lean::read_tga(name);
    }
}

bool has_floats(Format format)
{
    return format == Format::exr || format == Format::hdr;
}

} // namespace

std::unique_ptr<PixelBuffer> LeanModule::make_buffer(const PixelRect& data, int, int,
                                                     const std::vector<std::string>& channels,
                                                     bool clear) const
{
    return lean::make_floats(data, channels.size(), clear);
}

DecodedImage LeanModule::read(const std::string& name) const
{
    const Format format = format_of(name);
    if (format == Format::exr) return lean::read_exr(name);
    if (format == Format::hdr) return read_hdr(*this, name);
    return lean::decoded(read_raster(format, name));
}

std::optional<ByteImage> LeanModule::read_bytes(const std::string& name) const
{
    const Format format = format_of(name);
    if (has_floats(format)) return std::nullopt;
    return lean::byte_image(read_raster(format, name));
}

void LeanModule::check_written_format(const std::string& name) const
{
    if (extension_of(name).starts_with(".tif")) throw Error(no_tiff);
}

std::vector<unsigned char> LeanModule::encode(const ImageFile& image) const
{
    const std::string extension = extension_of(image.name);
    if (extension == ".exr") return lean::write_exr(image);
    if (extension == ".png") return lean::write_png(image);
    if (extension == ".hdr") return write_hdr(image);
    if (extension.starts_with(".jp")) return lean::write_jpeg(image);
    throw Error(no_tiff);
}

std::vector<unsigned char> LeanModule::encode_words(const WordImage& image, const FillRows& fill) const
{
    return lean::write_exr_words(image, fill);
}

void LeanModule::read_words(const std::string& name, const ChooseChannels& choose, const UseRow& use) const
{
    if (format_of(name) != Format::exr)
        throw Error("it has channels of other types than 32-bit floats and integers");
    lean::read_exr_words(name, choose, use);
}

std::string LeanModule::jpeg_decoder() const
{
    return lean::jpeg_library();
}

} // namespace plumb

// Null for a program of another version.
extern "C" const plumb::ImageModule* plumb_image_module(const char* version)
{
    static const plumb::LeanModule module;
    return std::string_view(version) == PLUMB_VERSION ? &module : nullptr;
}
