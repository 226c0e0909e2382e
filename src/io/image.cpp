// SPDX-License-Identifier: MIT

// Pictures in memory, and reading them.

#include "plumb/image.h"

#include "io/image_png.h"
#include "io/image_quiet.h"
#include "io/image_spec.h"
#include "io/image_text.h"
#include "plumb/error.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cstring>
#include <new>

namespace plumb {

struct Image::Impl {
    OIIO::ImageBuf buffer;
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
    int channels = 0;
    float* pixels = nullptr; // those of `buffer`: rows from the top, without padding
    std::vector<std::string> names;

    Impl(PixelRect data_window, int width, int height, std::vector<std::string> channel_names,
         OIIO::InitializePixels initialize)
        : data(data_window),
          full_width(width),
          full_height(height),
          channels(static_cast<int>(channel_names.size())),
          names(std::move(channel_names))
    {
        OIIO::ImageSpec spec(data.width, data.height, channels, OIIO::TypeFloat);
        spec.x = data.x;
        spec.y = data.y;
        spec.full_width = full_width;
        spec.full_height = full_height;
        spec.channelnames = names;
        try {
            buffer.reset(spec, initialize);
            pixels = static_cast<float*>(buffer.localpixels());
        } catch (const std::bad_alloc&) {
            pixels = nullptr;
        }
        buffer.geterror(); // else it would be printed
        if (!pixels)
            throw Error(
                fmt::format("not enough memory for a picture of {} x {} pixels", data.width, data.height));
    }

    std::size_t offset(int x, int y) const
    {
        const auto row = static_cast<std::size_t>(y - data.y);
        const auto column = static_cast<std::size_t>(x - data.x);
        return (row * static_cast<std::size_t>(data.width) + column) * static_cast<std::size_t>(channels);
    }
};

namespace {

void check_size(const PixelRect& data, std::size_t channels)
{
    // Far more than any memory, and far from overflow.
    constexpr double most_floats = 0x1p40;
    const double floats = double(data.width) * double(data.height) * double(channels);
    if (data.width < 1 || data.height < 1 || channels < 1 || floats > most_floats)
        throw Error(fmt::format("a picture cannot have {} x {} pixels of {} channels", data.width,
                                data.height, channels));
}

} // namespace

Image::Image(PixelRect data, int full_width, int full_height, std::vector<std::string> channels)
{
    check_size(data, channels.size());
    impl_ = std::make_unique<Impl>(data, full_width, full_height, std::move(channels),
                                   OIIO::InitializePixels::Yes);
}

Image::Image(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;
Image::~Image() = default;

const PixelRect& Image::data_window() const
{
    return impl_->data;
}

int Image::full_width() const
{
    return impl_->full_width;
}

int Image::full_height() const
{
    return impl_->full_height;
}

int Image::channel_count() const
{
    return impl_->channels;
}

const std::vector<std::string>& Image::channel_names() const
{
    return impl_->names;
}

float* Image::pixel(int x, int y)
{
    return impl_->pixels + impl_->offset(x, y);
}

const float* Image::pixel(int x, int y) const
{
    return impl_->pixels + impl_->offset(x, y);
}

Color Image::color(int x, int y) const
{
    const float* const p = pixel(x, y);
    return impl_->channels >= 3 ? Color(p[0], p[1], p[2]) : Color(p[0]);
}

namespace {

// value[i] = i / (size - 1), through the sRGB curve if asked.
std::vector<float> integer_values(std::size_t size, bool decode_srgb)
{
    std::vector<float> values(size);
    for (std::size_t i = 0; i < size; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(size - 1);
        values[i] = decode_srgb ? linear_from_srgb(x) : x;
    }
    return values;
}

// The floats that OpenImageIO made of 8-bit or 16-bit integers, made exact and, but for alpha, decoded.
void convert_integers(float* pixels, std::size_t count, const OIIO::ImageSpec& spec, bool decode_srgb)
{
    const std::size_t size = spec.format == OIIO::TypeUInt8 ? 256 : 65536;
    const std::vector<float> plain = integer_values(size, false);
    const std::vector<float> decoded = integer_values(size, decode_srgb);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    const auto largest = static_cast<float>(size - 1);
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_alpha = static_cast<int>(i % channels) == spec.alpha_channel;
        const auto integer = static_cast<std::size_t>(std::lround(pixels[i] * largest));
        pixels[i] = (is_alpha ? plain : decoded)[std::min(integer, size - 1)];
    }
}

} // namespace

Image read_image(const std::filesystem::path& path, bool decode_srgb)
{
    const std::string name = path.string();
    const auto fail = [&name](std::string reason) -> Error {
        return Error(fmt::format("cannot read '{}': {}", name, reason.empty() ? "not a picture" : reason));
    };
    if (const std::string_view problem = problem_of_file(path); !problem.empty())
        throw fail(std::string(problem));
    if (is_truncated_png(path)) throw fail("the file ends early");
    try {
        const QuietStandardError quiet;
        const std::unique_ptr<OIIO::ImageInput> input = open_image(name);
        const OIIO::ImageSpec spec = input->spec();
        if (spec.deep) throw Error("pictures with deep pixels are not supported");
        if (spec.depth > 1) throw Error("volumes are not supported");

        const PixelRect data{spec.x - spec.full_x, spec.y - spec.full_y, spec.width, spec.height};
        check_size(data, static_cast<std::size_t>(std::max(spec.nchannels, 0)));
        std::vector<std::string> channels = spec.channelnames;
        channels.resize(static_cast<std::size_t>(spec.nchannels));
        // Uninitialised: a broken file may claim any size, and memory that is not touched costs nothing.
        auto impl = std::make_unique<Image::Impl>(data, spec.full_width, spec.full_height,
                                                  std::move(channels), OIIO::InitializePixels::No);
        const bool good = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, impl->pixels);
        const std::string reason = input->geterror();
        if (!good || !reason.empty()) throw Error(one_line(reason));
        if (spec.format == OIIO::TypeUInt8 || spec.format == OIIO::TypeUInt16)
            convert_integers(impl->pixels, spec.image_pixels() * static_cast<std::size_t>(spec.nchannels),
                             spec, decode_srgb);
        Image image(std::move(impl));
        image.metadata = metadata_of(spec);
        return image;
    } catch (const std::bad_alloc&) {
        throw fail("not enough memory");
    } catch (const std::exception& e) { // ours, and whatever OpenImageIO lets through
        throw fail(e.what());
    }
}

} // namespace plumb
