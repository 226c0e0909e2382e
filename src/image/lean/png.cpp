// SPDX-License-Identifier: MIT

// Portable Network Graphics, by libpng.
//
// libpng reports an error by a jump that must not pass an object with a destructor. So its functions are called only by
// the functions that attempt() is given, and those have none.

#include "image/bytes.h"
#include "image/image_text.h"
#include "image/lean/codecs.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>

namespace plumb::lean {

namespace {

struct Failure {
    char message[200] = {};
};

[[noreturn]] void on_error(png_structp png, png_const_charp message)
{
    auto* const failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::strncpy(failure->message, message, sizeof failure->message - 1);
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

[[noreturn]] void fail(const Failure& failure)
{
    const std::string_view message = failure.message;
    if (message.find("emory") != std::string_view::npos) throw std::bad_alloc();
    throw Error(fmt::format("PNG library error: {}", one_line(message)));
}

template <class Step>
void attempt(png_structp png, const Failure& failure, const Step& step)
{
    if (setjmp(png_jmpbuf(png)) != 0) fail(failure);
    step();
}

class Reader {
public:
    explicit Reader(Bytes bytes) : left_(bytes)
    {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning);
        if (!png) throw std::bad_alloc();
        info = png_create_info_struct(png);
        if (!info) {
            png_destroy_read_struct(&png, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png, this, &Reader::take);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

    Failure failure;
    png_structp png = nullptr;
    png_infop info = nullptr;

private:
    static void take(png_structp png, png_bytep out, std::size_t count)
    {
        auto* const reader = static_cast<Reader*>(png_get_io_ptr(png));
        if (count > reader->left_.size()) png_error(png, "the file ends early");
        std::memcpy(out, reader->left_.data(), count);
        reader->left_ = reader->left_.subspan(count);
    }

    Bytes left_;
};

// As OpenImageIO names it.
std::string name_of_text(std::string_view key)
{
    constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"Description", "ImageDescription"}, {"Author", "Artist"}, {"Title", "DocumentName"}};
    for (const auto& [png_name, name] : names)
        if (same_name(key, png_name)) return std::string(name);
    return std::string(key);
}

void add_color_space(png_structp png, png_infop info, Metadata& metadata)
{
    int intent = 0;
    double gamma = 0.0;
    if (png_get_sRGB(png, info, &intent)) {
        put(metadata, "oiio:ColorSpace", "sRGB");
    } else if (png_get_gAMA(png, info, &gamma)) {
        const float inverse = std::round(100.f * static_cast<float>(1.0 / gamma)) / 100.f;
        put(metadata, "oiio:Gamma", inverse);
        put(metadata, "oiio:ColorSpace", gamma == 1.0 ? "linear" : fmt::format("Gamma{:.2g}", inverse));
    } else {
        put(metadata, "oiio:ColorSpace", "sRGB");
    }
}

void add_density(png_structp png, png_infop info, Metadata& metadata)
{
    png_uint_32 x = 0;
    png_uint_32 y = 0;
    int unit = 0;
    if (!png_get_pHYs(png, info, &x, &y, &unit)) return;
    const bool in_metres = unit == PNG_RESOLUTION_METER;
    const float scale = in_metres ? static_cast<float>(2.54 / 100.0) : 1.f; // to inches
    put(metadata, "ResolutionUnit", in_metres ? "inch" : "none");
    put(metadata, "XResolution", static_cast<float>(x) * scale);
    put(metadata, "YResolution", static_cast<float>(y) * scale);
}

Metadata metadata_of(png_structp png, png_infop info)
{
    Metadata metadata;
    add_color_space(png, info, metadata);
    png_timep time = nullptr;
    if (png_get_tIME(png, info, &time))
        put(metadata, "DateTime",
            fmt::format("{:4}:{:02}:{:02} {:02}:{:02}:{:02}", time->year, time->month, time->day, time->hour,
                        time->minute, time->second));
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; ++i) put(metadata, name_of_text(texts[i].key), texts[i].text);
    add_density(png, info, metadata);
    const float aspect = png_get_pixel_aspect_ratio(png, info);
    if (aspect != 0.f && aspect != 1.f) put(metadata, "PixelAspectRatio", aspect);
    put(metadata, "oiio:UnassociatedAlpha", 1);
    return metadata;
}

} // namespace

Raster read_png(const std::string& name)
{
    const ImageFileBytes file(name);
    Reader reader(file.all());
    png_structp const png = reader.png;
    png_infop const info = reader.info;
    attempt(png, reader.failure, [=] {
        png_read_info(png, info);
        png_set_expand(
            png); // to 8 bits, colours instead of their numbers, alpha instead of a transparent colour
        if (std::endian::native == std::endian::little) png_set_swap(png);
        png_set_interlace_handling(png);
        png_read_update_info(png, info);
    });
    const std::size_t value_size = png_get_bit_depth(png, info) == 16 ? 2 : 1;
    Raster raster = make_raster(static_cast<int>(png_get_image_width(png, info)),
                                static_cast<int>(png_get_image_height(png, info)),
                                png_get_channels(png, info), value_size);
    std::vector<png_bytep> rows(static_cast<std::size_t>(raster.data.height));
    for (int y = 0; y < raster.data.height; ++y) rows[static_cast<std::size_t>(y)] = raster.row(y);
    png_bytepp const first_row = rows.data();
    attempt(png, reader.failure, [=] {
        png_read_image(png, first_row);
        png_read_end(png, info);
    });
    raster.data.x = png_get_x_offset_pixels(png, info);
    raster.data.y = png_get_y_offset_pixels(png, info);
    raster.metadata = metadata_of(png, info);
    return raster;
}

namespace {

class Writer {
public:
    Writer()
    {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning);
        if (!png) throw std::bad_alloc();
        info = png_create_info_struct(png);
        if (!info) {
            png_destroy_write_struct(&png, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png, this, &Writer::add, nullptr);
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }

    Failure failure;
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::vector<unsigned char> out;

private:
    static void add(png_structp png, png_bytep bytes, std::size_t count)
    {
        auto* const writer = static_cast<Writer*>(png_get_io_ptr(png));
        bool added = true;
        try {
            writer->out.insert(writer->out.end(), bytes, bytes + count);
        } catch (const std::bad_alloc&) {
            added = false;
        }
        if (!added) png_error(png, "Out of memory");
    }
};

// The texts that go into the file; they point into the image's metadata, but for names that PNG has others for.
std::vector<png_text> texts_of(const ImageFile& image)
{
    constexpr std::string_view left_out[] = {"planarconfig", "compression", "ResolutionUnit",  "XResolution",
                                             "YResolution",  "DateTime",    "jpeg:subsampling"};
    constexpr std::pair<std::string_view, const char*> names[] = {
        {"ImageDescription", "Description"}, {"Artist", "Author"}, {"DocumentName", "Title"}};
    std::vector<png_text> texts;
    for (const Metadata* const metadata : {&image.metadata, &image.format})
        for (const auto& [name, value] : *metadata) {
            const std::string* const text = std::get_if<std::string>(&value);
            const auto is_name = [&name = name](std::string_view other) { return same_name(name, other); };
            if (!text || std::any_of(std::begin(left_out), std::end(left_out), is_name)) continue;
            png_text entry{};
            entry.compression = PNG_TEXT_COMPRESSION_NONE;
            entry.key = const_cast<char*>(name.c_str());
            for (const auto& [other, png_name] : names)
                if (is_name(other)) entry.key = const_cast<char*>(png_name);
            entry.text = const_cast<char*>(text->c_str());
            texts.push_back(entry);
        }
    return texts;
}

} // namespace

std::vector<unsigned char> write_png(const ImageFile& image)
{
    constexpr int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    const std::size_t channels = image.channels.size();
    if (channels < 1 || channels > 4)
        throw Error(fmt::format("PNG only supports 1-4 channels, not {}", channels));
    Writer writer;
    png_structp const png = writer.png;
    png_infop const info = writer.info;
    const PixelRect data = image.data;
    const std::uint8_t* const bytes = image.bytes;
    const int type = types[channels - 1];
    std::vector<png_text> texts = texts_of(image);
    png_textp const first_text = texts.data();
    const auto count = static_cast<int>(texts.size());
    attempt(png, writer.failure, [=] {
        png_set_IHDR(png, info, static_cast<png_uint_32>(data.width), static_cast<png_uint_32>(data.height),
                     8, type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_compression_level(png, 6);
        png_set_compression_strategy(png, 0); // the usual one
        png_set_oFFs(png, info, data.x, data.y, PNG_OFFSET_PIXEL);
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
        if (count > 0) png_set_text(png, info, first_text, count);
        png_write_info(png, info);
        for (int y = 0; y < data.height; ++y)
            png_write_row(png, bytes + static_cast<std::size_t>(y) * static_cast<std::size_t>(data.width) *
                                           channels);
        png_write_end(png, nullptr);
    });
    return std::move(writer.out);
}

} // namespace plumb::lean
