// SPDX-License-Identifier: MIT

// Writing pictures.

#include "core/lower_case.h"
#include "io/image_quiet.h"
#include "io/image_text.h"
#include "plumb/error.h"
#include "plumb/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>
#include <unistd.h>
#include <utility>

namespace plumb {

namespace {

enum class Encoding { linear_float, srgb_8bit };

struct Format {
    std::string_view extension;
    Encoding encoding;
    bool keeps_all; // channels beyond red, green and blue; and that a picture is a part of a larger one
    std::string_view compression;
};

constexpr Format formats[] = {
    {".exr", Encoding::linear_float, true, "zip"},    {".hdr", Encoding::linear_float, false, ""},
    {".tif", Encoding::linear_float, false, "zip"},   {".tiff", Encoding::linear_float, false, "zip"},
    {".png", Encoding::srgb_8bit, false, ""},         {".jpg", Encoding::srgb_8bit, false, "jpeg:95"},
    {".jpeg", Encoding::srgb_8bit, false, "jpeg:95"},
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

// A new, empty file beside `path`; gone again when this goes, unless it took path's place.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& path) : target_(path)
    {
        constexpr int attempts = 1000;
        for (int i = 0; i < attempts; ++i) {
            name_ = path;
            name_.replace_filename(fmt::format(".{}.part{}", path.filename().string(), i));
            file_ = std::fopen(name_.c_str(), "wbx"); // x: fails if the file exists
            if (file_) return;
            if (errno != EEXIST) break;
        }
        fail(target_, std::strerror(errno));
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile()
    {
        if (file_) std::fclose(file_);
        if (!took_place_) std::remove(name_.c_str());
    }

    void write(std::span<const unsigned char> bytes)
    {
        const bool good = std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
        if (!good || std::fclose(std::exchange(file_, nullptr)) != 0) fail(target_, std::strerror(errno));
    }

    void take_place()
    {
        if (std::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, std::strerror(errno));
        took_place_ = true;
    }

private:
    std::filesystem::path target_;
    std::filesystem::path name_;
    std::FILE* file_ = nullptr;
    bool took_place_ = false;
};

// Error bars go into formats that hold any channel. They come last.
int channels_written(const Image& image, const Format& format)
{
    const std::vector<std::string>& names = image.channel_names();
    const auto first_of_evidence = std::find_if(names.begin(), names.end(), is_evidence_channel);
    return format.keeps_all ? image.channel_count() : static_cast<int>(first_of_evidence - names.begin());
}

OIIO::ImageSpec spec_of(const Image& image, const Format& format)
{
    const PixelRect& data = image.data_window();
    const bool is_float = format.encoding == Encoding::linear_float;
    const int channels = channels_written(image, format);
    OIIO::ImageSpec spec(data.width, data.height, channels, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
    spec.channelnames.assign(image.channel_names().begin(), image.channel_names().begin() + channels);
    if (format.keeps_all) {
        spec.x = data.x;
        spec.y = data.y;
        spec.full_width = image.full_width();
        spec.full_height = image.full_height();
    }
    for (const auto& [name, value] : image.metadata) {
        if (const int* const integer = std::get_if<int>(&value)) {
            spec.attribute(name, *integer);
        } else if (const float* const number = std::get_if<float>(&value)) {
            spec.attribute(name, *number);
        } else if (const std::string* const text = std::get_if<std::string>(&value)) {
            spec.attribute(name, *text);
        } else {
            const auto& floats = std::get<std::vector<float>>(value);
            OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, static_cast<int>(floats.size()));
            if (floats.size() == 16) type = OIIO::TypeMatrix;
            if (!floats.empty()) spec.attribute(name, type, floats.data());
        }
    }
    // OpenImageIO adds the time of day unless there is a DateTime, and leaves out one that is no text.
    spec.attribute("DateTime", 0);
    spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
    if (!format.compression.empty()) spec.attribute("compression", std::string(format.compression));
    if (format.extension.starts_with(".jp")) spec.attribute("jpeg:subsampling", "4:4:4");
    return spec;
}

std::vector<std::uint8_t> encode_srgb(const Image& image, int channels, float exposure)
{
    const PixelRect& data = image.data_window();
    const auto written = static_cast<std::size_t>(channels);
    const auto given = static_cast<std::size_t>(image.channel_count());
    const std::size_t pixels = static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height);
    const float scale = exposure < 0.f ? 1.f / pow(2.f, -exposure) : pow(2.f, exposure);
    const float* const linear = image.pixel(data.x, data.y);
    std::vector<std::uint8_t> bytes(pixels * written);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const float x = linear[i / written * given + i % written] * scale;
        const float clamped = x > 0.f ? std::min(x, 1.f) : 0.f; // not a number: 0
        bytes[i] = static_cast<std::uint8_t>(srgb_from_linear(clamped) * 255.f + 0.5f);
    }
    return bytes;
}

// What the file will hold. Encoded in memory and written by us, because libjpeg ends the process if it cannot write.
std::vector<unsigned char> encode(const std::string& name, const Image& image, const Format& format,
                                  float exposure)
{
    OIIO::attribute("debug", 0); // never print
    const QuietStandardError quiet;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) throw Error(OIIO::geterror());
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    bool good = output->set_ioproxy(&memory) && output->open(name, spec_of(image, format));
    if (good && format.encoding == Encoding::linear_float) {
        const PixelRect& data = image.data_window();
        const auto stride =
            static_cast<OIIO::stride_t>(sizeof(float)) * image.channel_count(); // from pixel to pixel
        good = output->write_image(OIIO::TypeFloat, image.pixel(data.x, data.y), stride);
    } else if (good) {
        const std::vector<std::uint8_t> bytes = encode_srgb(image, channels_written(image, format), exposure);
        good = output->write_image(OIIO::TypeUInt8, bytes.data());
    }
    std::string reason = output->geterror();
    good = output->close() && good;
    reason += output->geterror(); // fetched in any case: what is not would be printed
    if (!good) throw Error(reason.empty() ? "this format cannot hold the picture" : reason);
    return file;
}

} // namespace

void check_image_path(const std::filesystem::path& path)
{
    if (!path.has_filename()) fail(path, "no file name");
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail(path, "a folder of that name exists");
    format_of(path);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!std::filesystem::exists(folder, error))
        fail(path, fmt::format("the folder '{}' does not exist", folder.string()));
    if (!std::filesystem::is_directory(folder, error))
        fail(path, fmt::format("'{}' is no folder", folder.string()));
    if (std::filesystem::exists(path, error) && access(path.c_str(), W_OK) != 0)
        fail(path, std::strerror(errno));
    const TemporaryFile probe(path); // created, and removed
}

void write_image(const std::filesystem::path& path, const Image& image, float exposure)
{
    check_image_path(path);
    TemporaryFile file(path);
    std::vector<unsigned char> bytes;
    try {
        bytes = encode(path.string(), image, format_of(path), exposure);
    } catch (const std::bad_alloc&) {
        fail(path, "not enough memory");
    } catch (const std::exception& error) { // ours, and whatever OpenImageIO lets through
        fail(path, one_line(error.what()));
    }
    file.write(bytes);
    file.take_place();
}

} // namespace plumb
