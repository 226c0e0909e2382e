// SPDX-License-Identifier: MIT

// Three mantissas of 8 bits and one exponent a pixel.
//
// [1] G. Ward, "Real Pixels", Graphics Gems II, 1991, p. 80-83
// [2] "Radiance File Formats", https://radsite.lbl.gov/radiance/refer/filefmts.pdf

#include "image/hdr.h"

#include "base/regular_file.h"
#include "image/bytes.h"
#include "image/image_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace plumb {

namespace {

using Rgbe = std::array<unsigned char, 4>;

// Widths that the newer run-length encoding can say [2].
constexpr int least_encoded = 8;
constexpr int most_encoded = 0x7fff;

constexpr int exponent_bias = 128; // [1]
constexpr int mantissa_bits = 8;

std::string_view take_line(ByteReader& reader)
{
    const std::size_t begin = reader.position();
    const Bytes rest = reader.take(reader.left());
    const auto* const end = static_cast<const unsigned char*>(std::memchr(rest.data(), '\n', rest.size()));
    if (!end) throw Error("the file ends early");
    const auto length = static_cast<std::size_t>(end - rest.data());
    reader.go_to(begin + length + 1);
    return {reinterpret_cast<const char*>(rest.data()), length};
}

// A positive number of at most 9 digits at the end of such a piece as "-Y 480"; 0: it is something else.
int number_of_axis(std::string_view piece)
{
    if (piece.size() < 4 || piece.size() > 12 || piece[2] != ' ') return 0;
    int number = 0;
    for (const char c : piece.substr(3)) {
        if (c < '0' || c > '9') return 0;
        number = number * 10 + (c - '0');
    }
    return number;
}

struct Resolution {
    int rows = 0;
    int columns = 0;
    int orientation = 0; // as in TIFF
};

// "-Y 480 +X 640" and its kin. The first number counts the rows of the file, whatever way they run.
Resolution resolution_of(std::string_view line)
{
    constexpr std::string_view axes[] = {"-Y +X", "-Y -X", "+Y -X", "+Y +X",
                                         "+X -Y", "+X +Y", "-X +Y", "-X -Y"};
    const std::size_t second = line.find_first_of("XY", 2);
    if (second != std::string_view::npos && second >= 2 && line[second - 2] == ' ') {
        const std::string_view rows = line.substr(0, second - 2);
        std::string_view columns = line.substr(second - 1);
        while (!columns.empty() && (columns.back() == ' ' || columns.back() == '\r'))
            columns.remove_suffix(1);
        const std::string names = std::string(rows.substr(0, 2)) + " " + std::string(columns.substr(0, 2));
        for (int i = 0; i < 8; ++i)
            if (axes[i] == names && number_of_axis(rows) > 0 && number_of_axis(columns) > 0)
                return {number_of_axis(rows), number_of_axis(columns), i + 1};
    }
    throw Error("missing image size specifier");
}

// Of a line such as "GAMMA=2.2".
std::optional<float> value_of(std::string_view line, std::string_view name)
{
    if (!line.starts_with(name)) return std::nullopt;
    const std::string text(line.substr(name.size()));
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    return end == text.c_str() ? std::nullopt : std::optional(value);
}

struct Header {
    Resolution resolution;
    Metadata metadata;
};

Header read_header(ByteReader& reader)
{
    Header header;
    bool has_format = false;
    std::optional<float> gamma;
    std::optional<float> exposure;
    take_line(reader); // "#?RADIANCE" or what the program was called
    for (std::string_view line = take_line(reader); !line.empty(); line = take_line(reader)) {
        if (line == "FORMAT=32-bit_rle_rgbe") has_format = true;
        if (const auto value = value_of(line, "GAMMA=")) gamma = value;
        if (const auto value = value_of(line, "EXPOSURE=")) exposure = value;
    }
    if (!has_format) throw Error("no FORMAT specifier found");
    header.resolution = resolution_of(take_line(reader));
    // By OpenImageIO's names.
    const float inverse = gamma && *gamma > 0.f ? std::round(100.f / *gamma) / 100.f : 1.f;
    header.metadata.emplace_back("oiio:ColorSpace",
                                 inverse == 1.f ? "linear" : fmt::format("Gamma{:.2g}", inverse));
    if (gamma) header.metadata.emplace_back("oiio:Gamma", inverse);
    if (exposure) header.metadata.emplace_back("hdr:exposure", *exposure);
    header.metadata.emplace_back("Orientation", header.resolution.orientation);
    return header;
}

void decode(const Rgbe& pixel, float* color)
{
    const float scale =
        pixel[3] == 0 ? 0.f : std::ldexp(1.f, static_cast<int>(pixel[3]) - exponent_bias - mantissa_bits);
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(pixel[c]) * scale;
}

Rgbe take_pixel(ByteReader& reader)
{
    const Bytes bytes = reader.take(4);
    return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

// The older encoding [2]: 1, 1, 1, n repeats the last pixel n times; what follows as such counts 256 times as much.
void read_flat_row(ByteReader& reader, Rgbe pixel, int width, float* row)
{
    unsigned shift = 0;
    for (int x = 0; x < width;) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            const auto count = static_cast<std::uint64_t>(pixel[3]) << shift;
            if (x == 0 || count > static_cast<std::uint64_t>(width - x)) throw Error("bad scanline data");
            for (std::uint64_t i = 0; i < count; ++i, ++x) std::copy_n(row + 3 * (x - 1), 3, row + 3 * x);
            shift = std::min(shift + 8, 32u);
        } else {
            decode(pixel, row + 3 * x);
            ++x;
            shift = 0;
        }
        if (x < width) pixel = take_pixel(reader);
    }
}

// The newer one [2]: the four components one after the other, in runs of up to 127 and pieces of up to 128 bytes.
void read_encoded_row(ByteReader& reader, std::vector<unsigned char>& components, int width, float* row)
{
    const auto size = static_cast<std::size_t>(width);
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t x = 0; x < size;) {
            const unsigned code = reader.byte();
            const bool is_run = code > 128;
            const std::size_t count = is_run ? code - 128 : code;
            if (count == 0 || count > size - x) throw Error("bad scanline data");
            const Bytes bytes = reader.take(is_run ? 1 : count);
            for (std::size_t i = 0; i < count; ++i, ++x) components[c * size + x] = bytes[is_run ? 0 : i];
        }
    for (std::size_t x = 0; x < size; ++x)
        decode({components[x], components[size + x], components[2 * size + x], components[3 * size + x]},
               row + 3 * x);
}

} // namespace

bool is_hdr(const std::string& name)
{
    const RegularFile file(name);
    char start[2] = {};
    if (file.size() >= sizeof start) file.read(0, start);
    return start[0] == '#' && start[1] == '?';
}

DecodedImage read_hdr(const ImageModule& module, const std::string& name)
{
    const ImageFileBytes file(name);
    ByteReader reader(file.all());
    Header header = read_header(reader);
    const int width = header.resolution.columns;
    const int height = header.resolution.rows;
    DecodedImage image;
    image.data = {0, 0, width, height};
    image.full_width = width;
    image.full_height = height;
    image.channels = {"R", "G", "B"};
    image.metadata = std::move(header.metadata);
    image.data = seen_from_corner(image.data, image.data);
    image.buffer = module.make_buffer(image.data, width, height, image.channels, false);
    std::vector<unsigned char> components(width > most_encoded ? 0 : 4 * static_cast<std::size_t>(width));
    float* row = image.buffer->pixels();
    for (int y = 0; y < height; ++y, row += 3 * static_cast<std::size_t>(width)) {
        const Rgbe first = take_pixel(reader);
        const bool encoded = width >= least_encoded && width <= most_encoded && first[0] == 2 &&
                             first[1] == 2 && first[2] < 128;
        if (!encoded) {
            read_flat_row(reader, first, width, row);
            continue;
        }
        if ((first[2] << 8 | first[3]) != width) throw Error("wrong scanline width");
        read_encoded_row(reader, components, width, row);
    }
    return image;
}

namespace {

Rgbe encode(const float* color)
{
    constexpr float smallest = 1e-32f;
    float positive[3];
    for (int c = 0; c < 3; ++c) positive[c] = color[c] > 0.f ? color[c] : 0.f; // not a number: 0
    const float largest = std::max({positive[0], positive[1], positive[2]});
    if (largest < smallest) return {0, 0, 0, 0};
    // As [1]: the mantissas are cut off, not rounded. Infinity becomes the largest number there is.
    int exponent = 0;
    std::frexp(std::min(largest, 0x1.fep126f), &exponent);
    Rgbe pixel{};
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] =
            static_cast<unsigned char>(std::min(std::ldexp(positive[c], mantissa_bits - exponent), 255.f));
    pixel[3] = static_cast<unsigned char>(exponent + exponent_bias);
    return pixel;
}

// Where the next run of at least 4 equal bytes begins, and its length; the end and 0 if there is none.
std::pair<std::size_t, std::size_t> next_run(Bytes bytes, std::size_t from)
{
    constexpr std::size_t shortest = 4;
    constexpr std::size_t longest = 127;
    while (from < bytes.size()) {
        std::size_t count = 1;
        while (count < longest && from + count < bytes.size() && bytes[from + count] == bytes[from]) ++count;
        if (count >= shortest) return {from, count};
        from += count;
    }
    return {from, 0};
}

void add_run(std::vector<unsigned char>& out, std::size_t count, unsigned char value)
{
    out.push_back(static_cast<unsigned char>(128 + count));
    out.push_back(value);
}

void encode_component(std::vector<unsigned char>& out, Bytes bytes)
{
    constexpr std::size_t longest = 128;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto [run, count] = next_run(bytes, at);
        const Bytes before = bytes.subspan(at, run - at);
        const bool all_equal =
            before.size() > 1 && before.size() < 4 &&
            std::all_of(before.begin(), before.end(), [&](unsigned char b) { return b == before[0]; });
        if (all_equal) {
            add_run(out, before.size(), before[0]);
        } else {
            for (std::size_t i = 0; i < before.size(); i += longest) {
                const Bytes piece = before.subspan(i, std::min(longest, before.size() - i));
                out.push_back(static_cast<unsigned char>(piece.size()));
                out.insert(out.end(), piece.begin(), piece.end());
            }
        }
        if (count > 0) add_run(out, count, bytes[run]);
        at = run + count;
    }
}

} // namespace

std::vector<unsigned char> write_hdr(const ImageFile& image)
{
    if (image.channels.size() != 3) throw Error("HDR can only support 3-channel images");
    const int width = image.data.width;
    const int height = image.data.height;
    const std::string header =
        fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    std::vector<unsigned char> out(header.begin(), header.end());
    const auto size = static_cast<std::size_t>(width);
    std::vector<unsigned char> components(4 * size);
    const float* color = image.floats;
    for (int y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < size; ++x, color += image.floats_per_pixel) {
            const Rgbe pixel = encode(color);
            for (std::size_t c = 0; c < 4; ++c) components[c * size + x] = pixel[c];
        }
        if (width < least_encoded || width > most_encoded) {
            for (std::size_t x = 0; x < size; ++x)
                for (std::size_t c = 0; c < 4; ++c) out.push_back(components[c * size + x]);
            continue;
        }
        for (const int byte : {2, 2, width >> 8, width & 0xff})
            out.push_back(static_cast<unsigned char>(byte));
        for (std::size_t c = 0; c < 4; ++c)
            encode_component(out, std::span(components).subspan(c * size, size));
    }
    return out;
}

} // namespace plumb
