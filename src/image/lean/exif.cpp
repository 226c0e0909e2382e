// SPDX-License-Identifier: MIT
#include "image/lean/exif.h"

#include "image/lean/raster.h"

#include <algorithm>
#include <string_view>

namespace plumb::lean {

namespace {

struct Tag {
    unsigned number;
    std::string_view name; // OpenImageIO's
};

constexpr Tag tags[] = { // [1], table 4; texts, in the order of the numbers
    {0x010e, "ImageDescription"}, {0x010f, "Make"},   {0x0110, "Model"},
    {0x0131, "Software"},         {0x013b, "Artist"}, {0x8298, "Copyright"}};

constexpr unsigned orientation = 0x0112;
constexpr std::string_view start{"Exif\0\0", 6};
constexpr unsigned ascii = 2; // types
constexpr unsigned short_number = 3;
constexpr std::size_t entry_size = 12;

// TIFF's numbers, whose order of bytes the file says.
class Tiff {
public:
    explicit Tiff(Bytes bytes) : bytes_(bytes)
    {
        const std::string_view order(reinterpret_cast<const char*>(part(0, 2).data()), 2);
        if (order != "II" && order != "MM") throw Error("no TIFF");
        is_little_ = order == "II";
    }
    Bytes part(std::size_t at, std::size_t size) const
    {
        if (at > bytes_.size() || size > bytes_.size() - at) throw Error("the marker ends early");
        return bytes_.subspan(at, size);
    }
    unsigned number(std::size_t at, std::size_t size) const
    {
        unsigned value = 0;
        const Bytes bytes = part(at, size);
        for (std::size_t i = 0; i < size; ++i) value = value << 8 | bytes[is_little_ ? size - 1 - i : i];
        return value;
    }

private:
    Bytes bytes_;
    bool is_little_ = true;
};

void read_entry(const Tiff& tiff, std::size_t at, Metadata& metadata)
{
    const unsigned number = tiff.number(at, 2);
    const unsigned type = tiff.number(at + 2, 2);
    const unsigned count = tiff.number(at + 4, 4);
    if (number == orientation && type == short_number && count == 1)
        put(metadata, "Orientation", static_cast<int>(tiff.number(at + 8, 2)));
    const auto* const tag =
        std::find_if(std::begin(tags), std::end(tags), [&](const Tag& t) { return t.number == number; });
    if (tag == std::end(tags) || type != ascii) return;
    const Bytes text = tiff.part(count <= 4 ? at + 8 : tiff.number(at + 8, 4), count);
    const auto end = std::find(text.begin(), text.end(), 0);
    if (end != text.begin()) put(metadata, tag->name, std::string(text.begin(), end));
}

void add(std::vector<unsigned char>& out, std::size_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<unsigned char>(value >> 8 * i));
}

} // namespace

void read_exif(Bytes marker, Metadata& metadata)
{
    if (marker.size() < start.size() || !std::equal(start.begin(), start.end(), marker.begin())) return;
    try {
        const Tiff tiff(marker.subspan(start.size()));
        const std::size_t directory = tiff.number(4, 4);
        const unsigned entries = tiff.number(directory, 2);
        for (unsigned i = 0; i < entries; ++i) read_entry(tiff, directory + 2 + i * entry_size, metadata);
    } catch (const Error&) { // the image is good without
    }
}

std::vector<unsigned char> exif_of(const Metadata& metadata)
{
    constexpr std::size_t longest = 60000; // a marker holds 65533 bytes
    std::vector<std::pair<Tag, std::string>> texts;
    std::size_t size = 0;
    for (const Tag& tag : tags)
        for (const auto& [name, value] : metadata) {
            const std::string* const text = std::get_if<std::string>(&value);
            if (!text || !same_name(name, tag.name) || text->empty()) continue;
            if (size + text->size() > longest) continue;
            texts.emplace_back(tag, *text);
            size += text->size();
            break;
        }
    if (texts.empty()) return {};
    std::vector<unsigned char> out(start.begin(), start.end());
    std::vector<unsigned char> data; // what does not fit into the entries
    const std::size_t data_at = 8 + 2 + texts.size() * entry_size + 4;
    for (const char c : {'I', 'I', '*', '\0'}) out.push_back(static_cast<unsigned char>(c));
    add(out, 8, 4); // where the directory is
    add(out, texts.size(), 2);
    for (const auto& [tag, text] : texts) {
        add(out, tag.number, 2);
        add(out, ascii, 2);
        add(out, text.size() + 1, 4);
        std::vector<unsigned char>& place = text.size() < 4 ? out : data;
        if (&place == &data) add(out, data_at + data.size(), 4);
        place.insert(place.end(), text.begin(), text.end());
        add(place, 0, text.size() < 4 ? static_cast<int>(4 - text.size()) : 1);
    }
    add(out, 0, 4); // there is no other directory
    out.insert(out.end(), data.begin(), data.end());
    return out;
}

} // namespace plumb::lean
