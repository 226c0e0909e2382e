// SPDX-License-Identifier: MIT

// Images in memory, and reading them.

#include "plumb/image/image.h"

#include "base/regular_file.h"
#include "image/chromaticities.h"
#include "image/image_file.h"
#include "image/image_module.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <new>
#include <span>

namespace plumb {

struct Image::Impl {
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> names;
    std::unique_ptr<PixelBuffer> buffer;
    int channels = static_cast<int>(names.size());
    float* pixels = buffer->pixels();

    std::size_t offset(int x, int y) const
    {
        const auto row = static_cast<std::size_t>(y - data.y);
        const auto column = static_cast<std::size_t>(x - data.x);
        return (row * static_cast<std::size_t>(data.width) + column) * static_cast<std::size_t>(channels);
    }
};

Image::Image(PixelRect data, int full_width, int full_height, std::vector<std::string> channels)
{
    auto buffer = image_module().make_buffer(data, full_width, full_height, channels, true);
    impl_ =
        std::make_unique<Impl>(Impl{data, full_width, full_height, std::move(channels), std::move(buffer)});
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

// The floats that the module made of integers, made exact and, but for alpha, decoded.
void convert_integers(const DecodedImage& image, bool decode_srgb)
{
    const std::size_t size = image.integer_levels;
    const std::vector<float> plain = integer_values(size, false);
    const std::vector<float> decoded = integer_values(size, decode_srgb);
    const std::size_t channels = image.channels.size();
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    const auto largest = static_cast<float>(size - 1);
    const std::span<float> values(image.buffer->pixels(), pixels * channels);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool is_alpha = static_cast<int>(i % channels) == image.alpha_channel;
        const auto integer = static_cast<std::size_t>(std::lround(values[i] * largest));
        values[i] = (is_alpha ? plain : decoded)[std::min(integer, size - 1)];
    }
}

// Colours of another colour space become linear sRGB.
void convert_colors(DecodedImage& image)
{
    const auto from = chromaticities_of(image.metadata);
    const auto matrix = from ? to_srgb(*from) : std::nullopt;
    if (!matrix) return;
    std::size_t at[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = std::find(image.channels.begin(), image.channels.end(), std::string(1, "RGB"[i]));
        if (found == image.channels.end()) return; // not of colours
        at[i] = static_cast<std::size_t>(found - image.channels.begin());
    }
    if (std::find(image.channels.begin(), image.channels.end(), "variance.R") != image.channels.end())
        throw Error("its colours are not linear sRGB, and the variances beside them cannot be converted");
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    for (std::size_t i = 0; i < pixels; ++i) {
        float* const pixel = image.buffer->pixels() + i * image.channels.size();
        const double color[3] = {static_cast<double>(pixel[at[0]]), static_cast<double>(pixel[at[1]]),
                                 static_cast<double>(pixel[at[2]])};
        for (std::size_t c = 0; c < 3; ++c)
            pixel[at[c]] = static_cast<float>((*matrix)[3 * c] * color[0] + (*matrix)[3 * c + 1] * color[1] +
                                              (*matrix)[3 * c + 2] * color[2]);
    }
    for (auto& [name, value] : image.metadata)
        if (name == chromaticities_name)
            value = std::vector<float>(srgb_chromaticities.begin(), srgb_chromaticities.end());
}

// read(module, name), with what it throws in our words.
template <class Read>
auto read_file(const std::filesystem::path& path, const Read& read)
{
    const std::string name = path.string();
    const auto fail = [&name](std::string reason) -> Error {
        return Error(fmt::format("cannot read '{}': {}", name, reason.empty() ? "not an image" : reason));
    };
    if (std::string problem = problem_of_file(path); !problem.empty()) throw fail(std::move(problem));
    if (is_truncated_png(path)) throw fail("the file ends early");
    const ImageModule& module = image_module();
    try {
        return read(module, name);
    } catch (const std::bad_alloc&) {
        throw fail("not enough memory");
    } catch (const std::exception& e) { // ours, and whatever OpenImageIO lets through
        throw fail(e.what());
    }
}

} // namespace

Image read_image(const std::filesystem::path& path, bool decode_srgb)
{
    // As the friend of Image.
    const auto make = [](DecodedImage& decoded) {
        Image image(std::make_unique<Image::Impl>(
            Image::Impl{decoded.data, decoded.full_width, decoded.full_height, std::move(decoded.channels),
                        std::move(decoded.buffer)}));
        image.metadata = std::move(decoded.metadata);
        return image;
    };
    return read_file(path, [&](const ImageModule& module, const std::string& name) {
        DecodedImage image = module.read(name);
        if (image.integer_levels > 0)
            convert_integers(image, decode_srgb);
        else if (decode_srgb)
            convert_colors(image);
        return make(image);
    });
}

std::optional<ByteImage> read_byte_image(const std::filesystem::path& path)
{
    return read_file(
        path, [](const ImageModule& module, const std::string& name) { return module.read_bytes(name); });
}

bool is_jpeg(const std::filesystem::path& path)
{
    constexpr std::string_view magic = "\xff\xd8\xff";
    if (!problem_of_file(path).empty()) return false;
    std::ifstream file(path, std::ios::binary);
    char start[magic.size()] = {};
    return file.read(start, sizeof start) && std::string_view(start, sizeof start) == magic;
}

std::string jpeg_decoder()
{
    return image_module().jpeg_decoder();
}

std::array<float, 256> byte_values(bool decode_srgb)
{
    std::array<float, 256> values;
    const std::vector<float> all = integer_values(values.size(), decode_srgb);
    std::copy(all.begin(), all.end(), values.begin());
    return values;
}

} // namespace plumb
