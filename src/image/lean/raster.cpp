// SPDX-License-Identifier: MIT
#include "image/lean/raster.h"

#include "base/lower_case.h"
#include "image/image_limits.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace plumb::lean {

namespace {

class Floats final : public PixelBuffer {
public:
    // From calloc, because memory that the system hands out is clear already.
    Floats(std::size_t count, bool clear)
        : values_(static_cast<float*>(clear ? std::calloc(count, sizeof(float))
                                            : std::malloc(count * sizeof(float))))
    {
        if (!values_) throw std::bad_alloc();
    }
    Floats(const Floats&) = delete;
    Floats& operator=(const Floats&) = delete;
    ~Floats() override { std::free(values_); }
    float* pixels() override { return values_; }

private:
    float* values_;
};

std::size_t area(const PixelRect& rect)
{
    return static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
}

template <class Integer>
void divide_by_largest(const Raster& raster, float* out)
{
    constexpr auto largest = static_cast<float>(static_cast<Integer>(-1));
    const std::size_t count = area(raster.data) * raster.channels.size();
    for (std::size_t i = 0; i < count; ++i) {
        Integer value;
        std::memcpy(&value, raster.values.get() + i * sizeof value, sizeof value);
        out[i] = static_cast<float>(value) / largest;
    }
}

} // namespace

std::unique_ptr<PixelBuffer> make_floats(const PixelRect& data, std::size_t channels, bool clear)
{
    check_size(data, channels);
    try {
        return std::make_unique<Floats>(area(data) * channels, clear);
    } catch (const std::bad_alloc&) {
        throw not_enough_memory(data);
    }
}

Raster make_raster(int width, int height, std::size_t channels, std::size_t value_size)
{
    const PixelRect data{0, 0, width, height};
    check_size(data, channels);
    seen_from_corner(data, data);
    Raster raster{.data = data, .full = data, .channels = {"R", "G", "B", "A"}, .value_size = value_size};
    if (channels < 3) raster.channels = {"Y", "A"};
    raster.channels.resize(channels);
    if (channels % 2 == 0) raster.alpha_channel = static_cast<int>(channels) - 1;
    try {
        raster.values =
            std::make_unique_for_overwrite<unsigned char[]>(area(data) * raster.channels.size() * value_size);
    } catch (const std::bad_alloc&) {
        throw not_enough_memory(data);
    }
    return raster;
}

DecodedImage decoded(Raster raster)
{
    DecodedImage image;
    image.data = seen_from_corner(raster.data, raster.full);
    image.full_width = raster.full.width;
    image.full_height = raster.full.height;
    image.buffer = make_floats(image.data, raster.channels.size(), false);
    image.integer_levels = raster.value_size == 1 ? 256 : 65536;
    image.alpha_channel = raster.alpha_channel;
    if (raster.value_size == 1)
        divide_by_largest<std::uint8_t>(raster, image.buffer->pixels());
    else
        divide_by_largest<std::uint16_t>(raster, image.buffer->pixels());
    image.channels = std::move(raster.channels);
    image.metadata = std::move(raster.metadata);
    return image;
}

std::optional<ByteImage> byte_image(const Raster& raster)
{
    if (raster.value_size != 1) return std::nullopt;
    const std::size_t given = raster.channels.size();
    const std::size_t taken = given >= 3 ? 3 : 1;
    const std::size_t pixels = area(raster.data);
    ByteImage image{raster.data.width, raster.data.height, static_cast<int>(taken), {}};
    image.values.resize(pixels * taken);
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(raster.values.get() + i * given, taken, image.values.data() + i * taken);
    return image;
}

bool same_name(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower_case(x) == lower_case(y); });
}

void put(Metadata& metadata, std::string_view name, MetadataValue value)
{
    for (auto& [key, old] : metadata)
        if (same_name(key, name)) {
            key = name;
            old = std::move(value);
            return;
        }
    metadata.emplace_back(name, std::move(value));
}

} // namespace plumb::lean
