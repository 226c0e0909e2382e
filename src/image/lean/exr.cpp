// SPDX-License-Identifier: MIT

// OpenEXR's images: the first part of a file, scanlines or tiles.

#include "image/image_limits.h"
#include "image/image_text.h"
#include "image/lean/codecs.h"
#include "image/lean/exr_file.h"

#include <OpenEXR/ImfFrameBuffer.h>

#include <algorithm>
#include <bit>
#include <span>

namespace plumb::lean {

namespace {

// A channel of 32-bit integers, whose bits stand where its floats are to be.
void divide_by_largest(std::span<float> values, std::size_t channel, std::size_t channels)
{
    constexpr auto scale = static_cast<float>(1.0 / 4294967295.0);
    for (std::size_t i = channel; i < values.size(); i += channels)
        values[i] = static_cast<float>(std::bit_cast<std::uint32_t>(values[i])) * scale;
}

std::size_t pixels_of(const PixelRect& rect)
{
    return static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
}

constexpr std::size_t word_size = 4; // bytes: of floats, too

// Rows that are handed over at a time: whole blocks of the compression, and enough of them for all threads.
constexpr int rows_at_once = 128;

} // namespace

DecodedImage read_exr(const std::string& name)
{
    return attempt_exr("Failed OpenEXR read", [&] {
        ExrInput input(name);
        const std::size_t count = input.channels.size();
        DecodedImage image;
        image.data = input.windows.data;
        image.full_width = input.windows.full_width;
        image.full_height = input.windows.full_height;
        image.buffer = make_floats(image.data, count, false);
        std::vector<Imf::PixelType> types;
        for (const Channel& channel : input.channels) {
            types.push_back(channel.type == Imf::UINT ? Imf::UINT : Imf::FLOAT);
            image.channels.push_back(channel.name);
        }
        float* const pixels = image.buffer->pixels();
        input.read_rows(0, image.data.height, types, pixels);
        for (std::size_t c = 0; c < count; ++c)
            if (types[c] == Imf::UINT) divide_by_largest({pixels, pixels_of(image.data) * count}, c, count);
        image.metadata = input.metadata();
        return image;
    });
}

void read_exr_words(const std::string& name, const ChooseChannels& choose, const UseRow& use)
{
    attempt_exr("Failed OpenEXR read", [&] {
        ExrInput input(name);
        WordImage image{input.windows.data, input.windows.full_width, input.windows.full_height, {}, {},
                        input.metadata()};
        std::vector<Imf::PixelType> types;
        for (const Channel& channel : input.channels) {
            if (channel.type == Imf::HALF)
                throw Error("it has channels of other types than 32-bit floats and integers");
            (channel.type == Imf::UINT ? image.word_channels : image.float_channels).push_back(channel.name);
            types.push_back(channel.type);
        }
        std::vector<std::size_t> chosen; // their numbers in the file
        for (const std::string& wanted : choose(image)) {
            const auto found = std::find_if(input.channels.begin(), input.channels.end(),
                                            [&](const Channel& channel) { return channel.name == wanted; });
            if (found == input.channels.end()) throw Error("it lacks the channel " + wanted);
            chosen.push_back(static_cast<std::size_t>(found - input.channels.begin()));
        }
        const auto width = static_cast<std::size_t>(image.data.width);
        const std::size_t channels = input.channels.size();
        const auto words = std::make_unique_for_overwrite<std::uint32_t[]>(
            width * channels * static_cast<std::size_t>(std::min(rows_at_once, image.data.height)));
        std::vector<std::uint32_t> row(width * chosen.size());
        for (int top = 0; top < image.data.height; top += rows_at_once) {
            const int end = std::min(top + rows_at_once, image.data.height);
            input.read_rows(top, end - top, types, words.get());
            const std::uint32_t* pixel = words.get();
            for (int y = top; y < end; ++y) {
                std::uint32_t* out = row.data();
                for (std::size_t x = 0; x < width; ++x, pixel += channels)
                    for (const std::size_t channel : chosen) *out++ = pixel[channel];
                use(image.data.y + y, row);
            }
        }
    });
}

std::vector<unsigned char> write_exr(const ImageFile& image)
{
    return attempt_exr("Failed OpenEXR write", [&] {
        check_size(image.data, image.channels.size());
        std::string compression = "zip";
        for (const auto& [name, value] : image.format)
            if (name == "compression") compression = std::get<std::string>(value);
        std::vector<Channel> channels;
        for (const std::string& name : image.channels) channels.push_back({name, Imf::FLOAT});
        ExrOutput output(
            header_of(image.data, image.full_width, image.full_height, image.metadata, compression),
            channels);
        const auto apart = static_cast<std::size_t>(image.floats_per_pixel) * word_size;
        output.write_rows(image.data, apart, image.floats);
        return output.take();
    });
}

std::vector<unsigned char> write_exr_words(const WordImage& image, const FillRows& fill)
{
    return attempt_exr("Failed OpenEXR write", [&] {
        std::vector<Channel> channels;
        for (const std::string& name : image.float_channels) channels.push_back({name, Imf::FLOAT});
        for (const std::string& name : image.word_channels) channels.push_back({name, Imf::UINT});
        // "rle" is by far the fastest, and the words have long runs of zeros.
        ExrOutput output(header_of(image.data, image.full_width, image.full_height, image.metadata, "rle"),
                         channels);
        std::vector<std::uint32_t> words(image.words_per_row() * rows_at_once);
        const int bottom = image.data.y + image.data.height;
        for (int top = image.data.y; top < bottom; top += rows_at_once) {
            const int count = std::min(rows_at_once, bottom - top);
            fill(top, count, words);
            output.write_rows({image.data.x, top, image.data.width, count}, channels.size() * word_size,
                              words.data());
        }
        return output.take();
    });
}

} // namespace plumb::lean
