// SPDX-License-Identifier: MIT

// JPEG, by libjpeg-turbo.
//
// libjpeg reports an error by a jump that must not pass an object with a destructor. So its functions are called only by
// the functions that attempt() is given, and those have none.

#include "image/bytes.h"
#include "image/image_text.h"
#include "image/lean/codecs.h"
#include "image/lean/exif.h"

#include <fmt/format.h>

#include <cstdio> // jpeglib.h needs it before

#include <jerror.h>
#include <jpeglib.h>

#include <charconv>
#include <csetjmp>
#include <cstdlib>
#include <cstring>

namespace plumb::lean {

namespace {

struct ErrorManager {
    jpeg_error_mgr manager{}; // the first member: libjpeg knows its address
    std::jmp_buf back{};
    char message[JMSG_LENGTH_MAX] = {};
    bool out_of_memory = false;
};

[[noreturn]] void on_error(j_common_ptr info)
{
    auto* const errors = reinterpret_cast<ErrorManager*>(info->err);
    if (!errors->message[0]) info->err->format_message(info, errors->message);
    errors->out_of_memory = info->err->msg_code == JERR_OUT_OF_MEMORY;
    std::longjmp(errors->back, 1);
}

// libjpeg goes on with pixels of its own making where the file is damaged. An image with those is no image. Bytes that
// belong to nothing do no harm.
void on_message(j_common_ptr info, int level)
{
    if (level < 0 && info->err->msg_code != JWRN_EXTRANEOUS_DATA) on_error(info);
}

void print_nothing(j_common_ptr) {}

void prepare(ErrorManager& errors)
{
    jpeg_std_error(&errors.manager);
    errors.manager.error_exit = on_error;
    errors.manager.emit_message = on_message;
    errors.manager.output_message = print_nothing;
}

template <class Step>
void attempt(ErrorManager& errors, const Step& step)
{
    if (setjmp(errors.back) != 0) {
        if (errors.out_of_memory) throw std::bad_alloc();
        throw Error(fmt::format("JPEG error: {}", one_line(errors.message)));
    }
    step();
}

class Reader {
public:
    explicit Reader(Bytes bytes)
    {
        prepare(errors);
        info.err = &errors.manager;
        attempt(errors, [&] {
            jpeg_create_decompress(&info);
            jpeg_mem_src(&info, bytes.data(), static_cast<unsigned long>(bytes.size()));
            jpeg_save_markers(&info, JPEG_COM, 0xffff);
            jpeg_save_markers(&info, JPEG_APP0 + 1, 0xffff);
        });
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { jpeg_destroy_decompress(&info); }

    ErrorManager errors;
    jpeg_decompress_struct info{};
};

const char* subsampling_of(const jpeg_decompress_struct& info)
{
    if (info.num_components != 3) return nullptr;
    const jpeg_component_info* const parts = info.comp_info;
    for (const int c : {1, 2})
        if (parts[c].h_samp_factor != 1 || parts[c].v_samp_factor != 1) return nullptr;
    constexpr std::pair<std::pair<int, int>, const char*> names[] = {
        {{1, 1}, "4:4:4"}, {{2, 1}, "4:2:2"}, {{2, 2}, "4:2:0"}, {{4, 1}, "4:1:1"}};
    for (const auto& [factors, name] : names)
        if (factors == std::pair(parts[0].h_samp_factor, parts[0].v_samp_factor)) return name;
    return nullptr;
}

Metadata metadata_of(const jpeg_decompress_struct& info)
{
    Metadata metadata;
    put(metadata, "oiio:ColorSpace", "sRGB");
    if (const char* const name = subsampling_of(info)) put(metadata, "jpeg:subsampling", name);
    for (const jpeg_marker_struct* marker = info.marker_list; marker; marker = marker->next) {
        const Bytes data(marker->data, marker->data_length);
        if (marker->marker == JPEG_APP0 + 1) read_exif(data, metadata);
        if (marker->marker != JPEG_COM) continue;
        const std::string text(data.begin(), data.end());
        put(metadata, "ImageDescription", std::string(text.c_str())); // up to a zero, if it has one
    }
    return metadata;
}

// Inks to light. Adobe's files, and there are hardly any others, have them inverted.
void colors_of_inks(const unsigned char* inks, std::size_t pixels, unsigned char* out)
{
    for (std::size_t i = 0; i < pixels; ++i, inks += 4, out += 3)
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = static_cast<unsigned char>((unsigned{inks[c]} * inks[3] + 127u) / 255u);
}

} // namespace

Raster read_jpeg(const std::string& name)
{
    const ImageFileBytes file(name);
    Reader reader(file.all());
    jpeg_decompress_struct* const info = &reader.info;
    attempt(reader.errors, [=] {
        jpeg_read_header(info, TRUE);
        const bool has_inks = info->jpeg_color_space == JCS_CMYK || info->jpeg_color_space == JCS_YCCK;
        if (has_inks)
            info->out_color_space = JCS_CMYK;
        else if (info->num_components != 1)
            info->out_color_space = JCS_RGB;
        jpeg_start_decompress(info);
    });
    const auto width = static_cast<std::size_t>(info->output_width);
    const bool has_inks = info->output_components == 4;
    Raster raster = make_raster(static_cast<int>(info->output_width), static_cast<int>(info->output_height),
                                has_inks ? 3 : static_cast<std::size_t>(info->output_components), 1);
    std::vector<unsigned char> inks(has_inks ? 4 * width : 0);
    for (int y = 0; y < raster.data.height; ++y) {
        JSAMPROW const row = has_inks ? inks.data() : raster.row(y);
        attempt(reader.errors, [=] {
            JSAMPROW rows[] = {row};
            jpeg_read_scanlines(info, rows, 1);
        });
        if (has_inks) colors_of_inks(inks.data(), width, raster.row(y));
    }
    raster.metadata = metadata_of(*info);
    attempt(reader.errors, [=] { jpeg_finish_decompress(info); });
    return raster;
}

namespace {

class Writer {
public:
    Writer()
    {
        prepare(errors);
        info.err = &errors.manager;
        attempt(errors, [&] {
            jpeg_create_compress(&info);
            jpeg_mem_dest(&info, &memory, &size);
        });
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer()
    {
        jpeg_destroy_compress(&info);
        std::free(memory);
    }

    ErrorManager errors;
    jpeg_compress_struct info{};
    unsigned char* memory = nullptr;
    unsigned long size = 0;
};

// "jpeg:95" as the compression.
int quality_of(const Metadata& format)
{
    constexpr int usual = 98;
    constexpr std::string_view start = "jpeg:";
    for (const auto& [name, value] : format) {
        const std::string* const text = std::get_if<std::string>(&value);
        if (name != "compression" || !text || !text->starts_with(start)) continue;
        int quality = usual;
        std::from_chars(text->data() + start.size(), text->data() + text->size(), quality);
        return quality;
    }
    return usual;
}

} // namespace

std::vector<unsigned char> write_jpeg(const ImageFile& image)
{
    const std::size_t given = image.channels.size();
    if (given != 1 && given < 3) throw Error(fmt::format("JPEG does not support {}-channel images", given));
    const int taken = given == 1 ? 1 : 3; // alpha is left out
    Writer writer;
    jpeg_compress_struct* const info = &writer.info;
    const PixelRect data = image.data;
    const int quality = quality_of(image.format);
    // What the format says of itself stands for what the image says.
    Metadata texts = image.metadata;
    for (const auto& [name, value] : image.format) put(texts, name, value);
    const std::vector<unsigned char> exif = exif_of(texts);
    const Bytes marker = exif;
    attempt(writer.errors, [=] {
        info->image_width = static_cast<JDIMENSION>(data.width);
        info->image_height = static_cast<JDIMENSION>(data.height);
        info->input_components = taken;
        info->in_color_space = taken == 1 ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_set_defaults(info);
        jpeg_set_quality(info, quality, TRUE);
        for (int c = 0; c < info->num_components; ++c)
            info->comp_info[c].h_samp_factor = info->comp_info[c].v_samp_factor =
                1; // all the colour there is
        jpeg_start_compress(info, TRUE);
        if (!marker.empty())
            jpeg_write_marker(info, JPEG_APP0 + 1, marker.data(), static_cast<unsigned>(marker.size()));
    });
    std::vector<unsigned char> row(static_cast<std::size_t>(data.width) * static_cast<std::size_t>(taken));
    const std::uint8_t* pixel = image.bytes;
    for (int y = 0; y < data.height; ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(data.width); ++x, pixel += given)
            std::memcpy(row.data() + x * static_cast<std::size_t>(taken), pixel,
                        static_cast<std::size_t>(taken));
        JSAMPROW const first = row.data();
        attempt(writer.errors, [=] {
            JSAMPROW rows[] = {first};
            jpeg_write_scanlines(info, rows, 1);
        });
    }
    attempt(writer.errors, [=] { jpeg_finish_compress(info); });
    return {writer.memory, writer.memory + writer.size};
}

std::string jpeg_library()
{
#ifdef LIBJPEG_TURBO_VERSION
#define PLUMB_TEXT(x) #x
#define PLUMB_TEXT_OF(x) PLUMB_TEXT(x)
    return "jpeg-turbo " PLUMB_TEXT_OF(LIBJPEG_TURBO_VERSION);
#else
    return fmt::format("libjpeg {}", JPEG_LIB_VERSION);
#endif
}

} // namespace plumb::lean
