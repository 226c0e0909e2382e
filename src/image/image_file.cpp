// SPDX-License-Identifier: MIT

// [1] "Portable Network Graphics (PNG) Specification", 2nd ed., ISO/IEC 15948:2003, sections 5.2 and 5.3.

#include "image/image_file.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

namespace plumb {

bool is_truncated_png(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::array<char, 8> head{}; // the signature, then the length and the type of one chunk after the other
    if (!file.read(head.data(), 8) || std::string_view(head.data(), 8) != "\x89PNG\r\n\x1a\n") return false;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::uintmax_t position = 8;
    while (file.read(head.data(), 8)) {
        std::uint32_t length = 0;
        for (int i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(head[static_cast<std::size_t>(i)]);
        constexpr std::uintmax_t around = 12; // length, type and checksum
        position += around + length;
        if (position > size) return true;
        if (std::string_view(head.data() + 4, 4) == "IEND") return false;
        file.seekg(static_cast<std::streamoff>(position));
    }
    return true;
}

} // namespace plumb
