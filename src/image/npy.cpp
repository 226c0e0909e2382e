// SPDX-License-Identifier: MIT
#include "image/npy.h"

#include "base/temporary_file.h"

#include <bit>
#include <fmt/format.h>

namespace plumb {

void write_npy(const std::filesystem::path& path, const Image& image)
{
    const PixelRect& window = image.data_window();
    std::string header = fmt::format("{{'descr': '{}f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}",
                                     std::endian::native == std::endian::little ? '<' : '>', window.height,
                                     window.width, image.channel_count());
    constexpr std::size_t fixed = 10;     // magic number, version and length
    constexpr std::size_t alignment = 64; // of the values
    header.append((alignment - (fixed + header.size() + 1) % alignment) % alignment, ' ');
    header += '\n';
    const auto length = static_cast<std::uint16_t>(header.size());
    std::string start = "\x93NUMPY";
    start += '\1';
    start += '\0';
    start += static_cast<char>(length & 0xff);
    start += static_cast<char>(length >> 8);

    TemporaryFile file(path);
    file.write(start + header);
    const std::size_t row =
        static_cast<std::size_t>(window.width) * static_cast<std::size_t>(image.channel_count());
    for (int y = window.y; y < window.y + window.height; ++y)
        file.write(
            std::string_view(reinterpret_cast<const char*>(image.pixel(window.x, y)), row * sizeof(float)));
    file.take_place();
}

} // namespace plumb
