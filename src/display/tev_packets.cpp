// SPDX-License-Identifier: MIT
#include "display/tev_packets.h"

#include <bit>
#include <cstdint>

namespace plumb::tev {

namespace {

enum class Kind : unsigned char { create_image = 4, update_image = 6 };

class Writer {
public:
    explicit Writer(Kind kind)
    {
        put<std::uint32_t>(0); // the length
        packet_.push_back(static_cast<unsigned char>(kind));
        packet_.push_back(0); // a viewer keeps its focus: updates come often
    }

    template <class Integer>
    void put(Integer value)
    {
        const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
        for (unsigned shift = 0; shift < 8 * sizeof(Integer); shift += 8)
            packet_.push_back(static_cast<unsigned char>(bits >> shift & 0xff));
    }
    void put_size(std::size_t value) { put(static_cast<std::int32_t>(value)); }
    void put(const std::string& text)
    {
        packet_.insert(packet_.end(), text.begin(), text.end());
        packet_.push_back(0);
    }
    void put(std::span<const float> values)
    {
        packet_.reserve(packet_.size() + values.size_bytes());
        for (const float value : values) put(std::bit_cast<std::uint32_t>(value));
    }

    Packet finish() &&
    {
        const auto length = static_cast<std::uint32_t>(packet_.size());
        for (unsigned i = 0; i < 4; ++i) packet_[i] = static_cast<unsigned char>(length >> 8 * i & 0xff);
        return std::move(packet_);
    }

private:
    Packet packet_;
};

} // namespace

Packet create_image(const std::string& name, int width, int height, std::span<const std::string> channels)
{
    Writer writer(Kind::create_image);
    writer.put(name);
    writer.put<std::int32_t>(width);
    writer.put<std::int32_t>(height);
    writer.put_size(channels.size());
    for (const std::string& channel : channels) writer.put(channel);
    return std::move(writer).finish();
}

Packet update_image(const std::string& name, std::span<const std::string> channels, const PixelRect& part,
                    std::span<const float> values)
{
    Writer writer(Kind::update_image);
    writer.put(name);
    writer.put_size(channels.size());
    for (const std::string& channel : channels) writer.put(channel);
    for (const int number : {part.x, part.y, part.width, part.height}) writer.put<std::int32_t>(number);
    for (std::size_t i = 0; i < channels.size(); ++i) writer.put(static_cast<std::int64_t>(i));
    for (std::size_t i = 0; i < channels.size(); ++i) writer.put(static_cast<std::int64_t>(channels.size()));
    writer.put(values);
    return std::move(writer).finish();
}

} // namespace plumb::tev
