// SPDX-License-Identifier: MIT

// Writing images.

#include "base/lower_case.h"
#include "base/temporary_file.h"
#include "image/chromaticities.h"
#include "image/image_module.h"
#include "image/image_text.h"
#include "plumb/base/error.h"
#include "plumb/image/development.h"
#include "plumb/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <new>
#include <span>
#include <unistd.h>

namespace plumb {

namespace {

enum class Encoding { linear_float, srgb_8bit };

// What a format holds: any channel, and that an image is a part of a larger one; or grey or red, green and blue, with alpha or without.
enum class Channels { any, colors_and_alpha, colors };

struct Format {
    std::string_view extension;
    Encoding encoding;
    Channels channels;
    std::string_view compression;
    std::string_view fast_compression = compression;
    bool not_in_all_modules = false;
};

constexpr Format formats[] = {
    {".exr", Encoding::linear_float, Channels::any, "zip", "rle"},
    {".hdr", Encoding::linear_float, Channels::colors, ""},
    {".tif", Encoding::linear_float, Channels::colors_and_alpha, "zip", "zip", true},
    {".tiff", Encoding::linear_float, Channels::colors_and_alpha, "zip", "zip", true},
    {".png", Encoding::srgb_8bit, Channels::colors_and_alpha, ""},
    {".jpg", Encoding::srgb_8bit, Channels::colors, "jpeg:95"},
    {".jpeg", Encoding::srgb_8bit, Channels::colors, "jpeg:95"},
};

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view reason)
{
    throw Error(fmt::format("cannot write '{}': {}", path.string(), reason));
}

const Format& format_of(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    std::string known;
    for (const Format& format : formats) {
        if (format.extension == extension) return format;
        known += (known.empty() ? "" : ", ") + std::string(format.extension);
    }
    if (extension.empty()) fail(path, fmt::format("the name has no extension; known are {}", known));
    fail(path, fmt::format("unknown extension '{}'; known are {}", path.extension().string(), known));
}

void check_module_writes(const std::filesystem::path& path, const Format& format)
{
    if (!format.not_in_all_modules) return; // else the module would be loaded where nothing is written yet
    const ImageModule& module = image_module();
    try {
        module.check_written_format(path.string());
    } catch (const Error& error) {
        fail(path, error.what());
    }
}

// Layers, which come last, and other numbers, as depth, go into formats that hold any channel.
int channels_written(const Image& image, const Format& format)
{
    if (format.channels == Channels::any) return image.channel_count();
    const std::vector<std::string>& names = image.channel_names();
    const auto first_of_layers = std::find_if(names.begin(), names.end(), is_layer_channel);
    const auto count = static_cast<int>(first_of_layers - names.begin());
    const int colors = count >= 3 ? 3 : std::min(count, 1);
    const bool has_alpha = colors < count && names[static_cast<std::size_t>(colors)] == "A";
    return has_alpha && format.channels == Channels::colors_and_alpha ? colors + 1 : colors;
}

// Grey and colours are developed; what else there is, alpha, is only encoded.
std::vector<std::uint8_t> encode_for_screens(const Image& image, int channels, const Development& development)
{
    const PixelRect& data = image.data_window();
    const auto written = static_cast<std::size_t>(channels);
    const auto given = static_cast<std::size_t>(image.channel_count());
    const std::size_t pixels = static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height);
    const float* const linear = image.pixel(data.x, data.y);
    const std::size_t colors = written >= 3 ? 3 : 1;
    std::vector<std::uint8_t> bytes(pixels * written);
    const Developer develop(development);
    const Developer only_encode({});
    const auto byte = [](float value) { return static_cast<std::uint8_t>(std::floor(value * 255.f + 0.5f)); };
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* const in = linear + i * given;
        std::uint8_t* const out = bytes.data() + i * written;
        const Color light = colors == 3 ? Color(in[0], in[1], in[2]) : Color(in[0]);
        const Color shown = develop(light);
        for (std::size_t c = 0; c < written; ++c)
            out[c] = byte(c < colors ? shown[static_cast<int>(c)] : only_encode(Color(in[c])).g);
    }
    return bytes;
}

// The header says that colours are linear sRGB, where the format has words for it.
Metadata with_color_space(const Image& image, const Format& format)
{
    Metadata metadata = image.metadata;
    const std::vector<std::string>& names = image.channel_names();
    const bool has_colors = std::find(names.begin(), names.end(), "R") != names.end();
    std::erase_if(metadata, [](const auto& entry) { return entry.first == chromaticities_name; });
    if (has_colors && format.extension == ".exr")
        metadata.emplace_back(chromaticities_name,
                              std::vector<float>(srgb_chromaticities.begin(), srgb_chromaticities.end()));
    return metadata;
}

// Whoever made the colours may have said what they are.
std::string display_text_of(const Metadata& header, const Development& development)
{
    if (std::string given = display_text(header); !given.empty()) return given;
    const bool is_denoised = std::any_of(header.begin(), header.end(),
                                         [](const auto& entry) { return entry.first == denoised_entry; });
    const std::string text = development_text(development);
    return (is_denoised ? "denoised" : "") + std::string(is_denoised && !text.empty() ? ", " : "") + text;
}

// What the file will hold.
std::vector<unsigned char> encode(const std::string& name, const Image& image, const Format& format,
                                  const Development& development, Packing packing)
{
    const bool is_float = format.encoding == Encoding::linear_float;
    const int channels = channels_written(image, format);
    const PixelRect& data = image.data_window();
    const Metadata metadata = with_color_space(image, format);
    ImageFile file{.name = name, .metadata = metadata};
    file.channels.assign(image.channel_names().begin(), image.channel_names().begin() + channels);
    const bool keeps_windows = format.channels == Channels::any;
    file.data = keeps_windows ? data : PixelRect{0, 0, data.width, data.height};
    file.full_width = keeps_windows ? image.full_width() : data.width;
    file.full_height = keeps_windows ? image.full_height() : data.height;
    file.format.emplace_back("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
    const std::string_view compression =
        packing == Packing::fast ? format.fast_compression : format.compression;
    if (!compression.empty()) file.format.emplace_back("compression", std::string(compression));
    if (format.extension.starts_with(".jp")) file.format.emplace_back("jpeg:subsampling", "4:4:4");
    if (is_float) {
        file.floats = image.pixel(data.x, data.y);
        file.floats_per_pixel = image.channel_count();
        return image_module().encode(file);
    }
    for (Metadata::value_type& entry :
         display_header(format.extension, display_text_of(image.metadata, development)))
        file.format.push_back(std::move(entry));
    const std::vector<std::uint8_t> bytes = encode_for_screens(image, channels, development);
    file.bytes = bytes.data();
    return image_module().encode(file);
}

} // namespace

void check_image_path(const std::filesystem::path& path)
{
    if (!path.has_filename()) fail(path, "no file name");
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail(path, "a directory of that name exists");
    check_module_writes(path, format_of(path));
    const std::filesystem::path end = end_of_links(path);
    const std::filesystem::path directory = end.has_parent_path() ? end.parent_path() : ".";
    if (!std::filesystem::exists(directory, error))
        fail(path, fmt::format("the directory '{}' does not exist", directory.string()));
    if (!std::filesystem::is_directory(directory, error))
        fail(path, fmt::format("'{}' is not a directory", directory.string()));
    if (std::filesystem::exists(path, error) && access(path.c_str(), W_OK) != 0)
        fail(path, std::strerror(errno));
    const TemporaryFile probe(path); // created, and removed
}

bool is_for_screens(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    return std::any_of(std::begin(formats), std::end(formats), [&](const Format& format) {
        return format.extension == extension && format.encoding == Encoding::srgb_8bit;
    });
}

void write_image(const std::filesystem::path& path, const Image& image, const Development& development,
                 Packing packing)
{
    check_image_path(path);
    TemporaryFile file(path);
    std::vector<unsigned char> bytes;
    try {
        bytes = encode(path.string(), image, format_of(path), development, packing);
    } catch (const std::bad_alloc&) {
        fail(path, "not enough memory");
    } catch (const std::exception& error) { // ours, and whatever OpenImageIO lets through
        fail(path, reason_text(error.what()));
    }
    file.write(std::span<const unsigned char>(bytes));
    file.take_place();
}

} // namespace plumb
