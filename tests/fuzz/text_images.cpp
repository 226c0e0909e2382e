// SPDX-License-Identifier: MIT

// Stands in for src/image/image_module.cpp: the door to images, with image_text.h behind it instead of OpenImageIO, which
// takes a quarter of a second to load, is not compiled for fuzzing, and has bugs of its own to be found by others.

#include "fuzz/image_text.h"
#include "image/image_module.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>

namespace plumb {
namespace fuzz {
namespace {

// A few bytes may claim to be millions of pixels, which takes time and finds nothing.
constexpr double most_values = 1 << 14;

WordsRead last_read;

class Values final : public PixelBuffer {
public:
    explicit Values(std::size_t size) : values_(size) {}
    float* pixels() override { return values_.data(); }

private:
    std::vector<float> values_;
};

// What src/image/oiio and the libraries below it refuse, and what takes too long.
void check(const PixelRect& data, std::size_t channels)
{
    if (data.width < 1 || data.height < 1 || channels < 1) throw Error("there is nothing in the image");
    for (const int place : {data.x, data.y})
        if (place < -farthest_pixel || place > farthest_pixel) throw Error("the pixels are too far out");
    if (double(data.width) * double(data.height) * static_cast<double>(channels) > most_values)
        throw std::bad_alloc();
}

TextImage read_text_image(const std::string& name)
{
    std::ifstream file(name, std::ios::binary);
    TextImage image = parse_image(std::string(std::istreambuf_iterator<char>(file), {}));
    check(image.data, image.channels());
    return image;
}

std::vector<unsigned char> bytes_of(const TextImage& image)
{
    const std::string text = image_text(image);
    return {text.begin(), text.end()};
}

void append(std::string& values, std::uint32_t value)
{
    for (int i = 0; i < 4; ++i) values += static_cast<char>(value >> 8 * i & 0xff);
}

std::size_t number_of(const std::string& channel, const TextImage& image)
{
    std::vector<std::string> all = image.floats;
    all.insert(all.end(), image.words.begin(), image.words.end());
    const auto found = std::find(all.begin(), all.end(), channel);
    if (found == all.end()) throw Error("it lacks the channel " + channel);
    return static_cast<std::size_t>(found - all.begin());
}

class TextModule final : public ImageModule {
public:
    std::unique_ptr<PixelBuffer> make_buffer(const PixelRect& data, int, int,
                                             const std::vector<std::string>& channels, bool) const override
    {
        return std::make_unique<Values>(static_cast<std::size_t>(data.width) *
                                        static_cast<std::size_t>(data.height) * channels.size());
    }

    std::optional<ByteImage> read_bytes(const std::string&) const override { return std::nullopt; }

    DecodedImage read(const std::string& name) const override
    {
        const TextImage text = read_text_image(name);
        DecodedImage image;
        image.data = text.data;
        image.full_width = text.full_width;
        image.full_height = text.full_height;
        image.channels = text.floats;
        image.channels.insert(image.channels.end(), text.words.begin(), text.words.end());
        image.integer_levels =
            text.integer_levels == 256 || text.integer_levels == 65536 ? text.integer_levels : 0;
        image.metadata = text.metadata;
        image.buffer = std::make_unique<Values>(text.size());
        for (std::size_t i = 0; i < text.size(); ++i) {
            const std::uint32_t value = text.value(i);
            const std::size_t levels = image.integer_levels;
            image.buffer->pixels()[i] =
                levels > 0 ? static_cast<float>(value % levels) / static_cast<float>(levels - 1)
                           : std::bit_cast<float>(value);
        }
        return image;
    }

    void check_written_format(const std::string&) const override {}

    std::string jpeg_decoder() const override { return "none"; }

    std::vector<unsigned char> encode(const ImageFile& image) const override
    {
        TextImage text{image.data, image.full_width, image.full_height, image.channels, {}, 0, image.metadata,
                       {}};
        text.integer_levels = image.bytes ? 256 : 0;
        const std::size_t channels = text.channels();
        const std::size_t apart = image.floats ? static_cast<std::size_t>(image.floats_per_pixel) : channels;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const std::size_t at = i / channels * apart + i % channels;
            append(text.values,
                   image.bytes ? image.bytes[at] : std::bit_cast<std::uint32_t>(image.floats[at]));
        }
        return bytes_of(text);
    }

    std::vector<unsigned char> encode_words(const WordImage& image, const FillRows& fill) const override
    {
        TextImage text{image.data,          image.full_width,
                       image.full_height,   image.float_channels,
                       image.word_channels, 0,
                       image.metadata,      {}};
        std::vector<std::uint32_t> rows(text.size());
        fill(image.data.y, image.data.height, rows);
        for (const std::uint32_t value : rows) append(text.values, value);
        return bytes_of(text);
    }

    void read_words(const std::string& name, const ChooseChannels& choose, const UseRow& use) const override
    {
        const TextImage text = read_text_image(name);
        const WordImage image{text.data,   text.full_width, text.full_height,
                              text.floats, text.words,      text.metadata};
        last_read = {choose(image), {}};
        std::vector<std::size_t> chosen;
        for (const std::string& channel : last_read.channels) chosen.push_back(number_of(channel, text));
        std::vector<std::uint32_t> row;
        const auto width = static_cast<std::size_t>(text.data.width);
        for (std::size_t y = 0; y < static_cast<std::size_t>(text.data.height); ++y) {
            row.clear();
            for (std::size_t x = 0; x < width; ++x)
                for (const std::size_t channel : chosen)
                    row.push_back(text.value((y * width + x) * text.channels() + channel));
            last_read.rows.push_back(row);
            use(text.data.y + static_cast<int>(y), row);
        }
    }
};

} // namespace

const WordsRead& words_read()
{
    return last_read;
}

void forget_words_read()
{
    last_read = {};
}

} // namespace fuzz

const ImageModule& image_module()
{
    static const fuzz::TextModule module;
    return module;
}

const std::string& ImageLibrary::hash()
{
    static const std::string none(32, '0');
    return none;
}

ImageLibrary::ImageLibrary() = default;
ImageLibrary::~ImageLibrary() = default;
void ImageLibrary::wait() {}

} // namespace plumb
