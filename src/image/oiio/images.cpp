// SPDX-License-Identifier: MIT

// Images in memory, reading and encoding them.

#include "base/lower_case.h"
#include "image/hdr.h"
#include "image/image_limits.h"
#include "image/image_text.h"
#include "image/oiio/module.h"
#include "image/oiio/quiet.h"
#include "image/oiio/spec.h"
#include "plumb/base/error.h"

#include <OpenImageIO/imagebuf.h>

#include <new>

namespace plumb {

namespace {

class Buffer final : public PixelBuffer {
public:
    Buffer(const OIIO::ImageSpec& spec, OIIO::InitializePixels initialize)
    {
        try {
            buffer_.reset(spec, initialize);
            pixels_ = static_cast<float*>(buffer_.localpixels());
        } catch (const std::bad_alloc&) {
            pixels_ = nullptr;
        }
        buffer_.geterror(); // else it would be printed
        if (!pixels_) throw not_enough_memory({0, 0, spec.width, spec.height});
    }
    float* pixels() override { return pixels_; }

private:
    OIIO::ImageBuf buffer_;
    float* pixels_ = nullptr;
};

OIIO::ImageSpec spec_of(const ImageFile& image)
{
    const PixelRect& data = image.data;
    OIIO::ImageSpec spec(data.width, data.height, static_cast<int>(image.channels.size()),
                         image.bytes ? OIIO::TypeUInt8 : OIIO::TypeFloat);
    spec.channelnames = image.channels;
    spec.x = data.x;
    spec.y = data.y;
    spec.full_width = image.full_width;
    spec.full_height = image.full_height;
    put_metadata(spec, image.metadata);
    if (image.bytes) spec.attribute("oiio:UnassociatedAlpha", 1); // colours as they are, not divided by alpha
    for (const auto& [name, value] : image.format) spec.attribute(name, std::get<std::string>(value));
    return spec;
}

} // namespace

std::unique_ptr<PixelBuffer> OiioModule::make_buffer(const PixelRect& data, int full_width, int full_height,
                                                     const std::vector<std::string>& channels,
                                                     bool clear) const
{
    check_size(data, channels.size());
    OIIO::ImageSpec spec(data.width, data.height, static_cast<int>(channels.size()), OIIO::TypeFloat);
    spec.x = data.x;
    spec.y = data.y;
    spec.full_width = full_width;
    spec.full_height = full_height;
    spec.channelnames = channels;
    return std::make_unique<Buffer>(spec, clear ? OIIO::InitializePixels::Yes : OIIO::InitializePixels::No);
}

DecodedImage OiioModule::read(const std::string& name) const
{
    if (is_hdr(name)) return read_hdr(*this, name);
    const QuietStandardError quiet;
    const std::unique_ptr<OIIO::ImageInput> input = open_image(name);
    const OIIO::ImageSpec spec = input->spec();
    if (spec.deep) throw Error("images with deep pixels are not supported");
    if (spec.depth > 1) throw Error("volumes are not supported");

    DecodedImage image;
    image.data = data_window_of(spec);
    image.full_width = spec.full_width;
    image.full_height = spec.full_height;
    image.channels = spec.channelnames;
    image.channels.resize(static_cast<std::size_t>(std::max(spec.nchannels, 0)));
    // Not cleared: a broken file may claim any size.
    image.buffer = make_buffer(image.data, image.full_width, image.full_height, image.channels, false);
    const bool good = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, image.buffer->pixels());
    const std::string reason = input->geterror();
    if (!good || !reason.empty()) throw Error(one_line(reason));
    if (spec.format == OIIO::TypeUInt8) image.integer_levels = 256;
    if (spec.format == OIIO::TypeUInt16) image.integer_levels = 65536;
    image.alpha_channel = spec.alpha_channel;
    image.metadata = metadata_of(spec);
    return image;
}

std::optional<ByteImage> OiioModule::read_bytes(const std::string& name) const
{
    const QuietStandardError quiet;
    const std::unique_ptr<OIIO::ImageInput> input = open_image(name);
    const OIIO::ImageSpec spec = input->spec();
    if (spec.format != OIIO::TypeUInt8 || spec.deep || spec.depth > 1) return std::nullopt;
    const PixelRect data = data_window_of(spec);
    check_size(data, static_cast<std::size_t>(std::max(spec.nchannels, 0)));
    ByteImage image{data.width, data.height, spec.nchannels >= 3 ? 3 : 1, {}};
    image.values.resize(static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height) *
                        static_cast<std::size_t>(image.channels));
    const bool good = input->read_image(0, 0, 0, image.channels, OIIO::TypeUInt8, image.values.data());
    const std::string reason = input->geterror();
    if (!good || !reason.empty()) throw Error(one_line(reason));
    return image;
}

void OiioModule::check_written_format(const std::string&) const {} // it has all that Plumb writes

std::string OiioModule::jpeg_decoder() const
{
    // "jpeg:jpeg-turbo 2.1.2/jp62;png:libpng 1.6.39;..."
    constexpr std::string_view name = "jpeg:";
    const std::string libraries = OIIO::get_string_attribute("library_list");
    for (std::size_t begin = 0; begin < libraries.size();) {
        const std::size_t end = std::min(libraries.find(';', begin), libraries.size());
        const std::string library = libraries.substr(begin, end - begin);
        if (library.starts_with(name)) return library.substr(name.size());
        begin = end + 1;
    }
    return "OpenImageIO " OIIO_VERSION_STRING;
}

std::vector<unsigned char> OiioModule::encode(const ImageFile& image) const
{
    if (lower_case(std::filesystem::path(image.name).extension().string()) == ".hdr") return write_hdr(image);
    return encode_image(image.name, spec_of(image), [&](OIIO::ImageOutput& output) {
        if (image.bytes) return output.write_image(OIIO::TypeUInt8, image.bytes);
        const auto stride = static_cast<OIIO::stride_t>(sizeof(float)) * image.floats_per_pixel;
        return output.write_image(OIIO::TypeFloat, image.floats, stride);
    });
}

} // namespace plumb
