// SPDX-License-Identifier: MIT

// Images of 32-bit words.

#include "image/image_text.h"
#include "image/oiio/module.h"
#include "image/oiio/quiet.h"
#include "image/oiio/spec.h"
#include "plumb/base/error.h"

namespace plumb {
namespace {

// Rows that are handed over at a time: whole blocks of the compression, and enough of them for all threads.
constexpr int rows_at_once = 128;

OIIO::ImageSpec spec_of(const WordImage& image)
{
    const std::size_t channels = image.float_channels.size() + image.word_channels.size();
    OIIO::ImageSpec spec(image.data.width, image.data.height, static_cast<int>(channels), OIIO::TypeFloat);
    spec.x = image.data.x;
    spec.y = image.data.y;
    spec.full_width = image.full_width;
    spec.full_height = image.full_height;
    spec.channelnames = image.float_channels;
    spec.channelnames.insert(spec.channelnames.end(), image.word_channels.begin(), image.word_channels.end());
    spec.channelformats.assign(image.float_channels.size(), OIIO::TypeFloat);
    spec.channelformats.resize(channels, OIIO::TypeUInt32);
    put_metadata(spec, image.metadata);
    spec.attribute("compression", "rle"); // by far the fastest, and the words have long runs of zeros
    return spec;
}

WordImage header_of(const OIIO::ImageSpec& spec)
{
    WordImage image;
    image.data = data_window_of(spec);
    image.full_width = spec.full_width;
    image.full_height = spec.full_height;
    image.metadata = metadata_of(spec);
    for (int c = 0; c < spec.nchannels; ++c) {
        const OIIO::TypeDesc type = spec.channelformat(c);
        if (type == OIIO::TypeFloat)
            image.float_channels.push_back(spec.channel_name(c));
        else if (type == OIIO::TypeUInt32)
            image.word_channels.push_back(spec.channel_name(c));
        else
            throw Error("it has channels of other types than 32-bit floats and integers");
    }
    return image;
}

// The numbers of these channels in the file.
std::vector<std::size_t> numbers_of(const std::vector<std::string>& names, const OIIO::ImageSpec& spec)
{
    std::vector<std::size_t> numbers;
    for (const std::string& name : names) {
        const int number = spec.channelindex(name);
        if (number < 0) throw Error("it lacks the channel " + name);
        numbers.push_back(static_cast<std::size_t>(number));
    }
    return numbers;
}

} // namespace

std::vector<unsigned char> OiioModule::encode_words(const WordImage& image, const FillRows& fill) const
{
    return encode_image("words.exr", spec_of(image), [&](OIIO::ImageOutput& output) {
        std::vector<std::uint32_t> words(image.words_per_row() * rows_at_once);
        const int bottom = image.data.y + image.data.height;
        for (int top = image.data.y; top < bottom; top += rows_at_once) {
            const int end = std::min(top + rows_at_once, bottom);
            fill(top, end - top, words);
            if (!output.write_scanlines(top, end, 0, OIIO::TypeUnknown, words.data())) return false;
        }
        return true;
    });
}

void OiioModule::read_words(const std::string& name, const ChooseChannels& choose, const UseRow& use) const
{
    const QuietStandardError quiet;
    const std::unique_ptr<OIIO::ImageInput> input = open_image(name);
    const OIIO::ImageSpec spec = input->spec();
    const WordImage image = header_of(spec);
    const std::vector<std::size_t> chosen = numbers_of(choose(image), spec);
    const std::size_t row_size = image.words_per_row();
    const auto width = static_cast<std::size_t>(spec.width);
    std::vector<std::uint32_t> words(row_size * rows_at_once);
    std::vector<std::uint32_t> row(width * chosen.size());
    for (int top = 0; top < spec.height; top += rows_at_once) {
        const int end = std::min(top + rows_at_once, spec.height);
        if (!input->read_scanlines(0, 0, spec.y + top, spec.y + end, 0, 0, spec.nchannels, OIIO::TypeUnknown,
                                   words.data()))
            throw Error(one_line(input->geterror()));
        const std::uint32_t* pixel = words.data();
        for (int y = top; y < end; ++y) {
            std::uint32_t* out = row.data();
            for (std::size_t x = 0; x < width; ++x, pixel += spec.nchannels)
                for (const std::size_t channel : chosen) *out++ = pixel[channel];
            use(image.data.y + y, row);
        }
    }
}

} // namespace plumb
