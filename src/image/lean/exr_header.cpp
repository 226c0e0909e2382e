// SPDX-License-Identifier: MIT
#include "image/lean/exr_header.h"

#include "image/chromaticities.h"
#include "image/image_limits.h"
#include "image/lean/raster.h"

#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <tuple>

namespace plumb::lean {

namespace {

// The window's size may be more than an int holds.
PixelRect rect_of(const Imath::Box2i& box)
{
    const auto size = [](int min, int max) {
        const std::int64_t count = std::int64_t{max} - min + 1;
        return static_cast<int>(std::clamp<std::int64_t>(count, 0, std::numeric_limits<int>::max()));
    };
    return {box.min.x, box.min.y, size(box.min.x, box.max.x), size(box.min.y, box.max.y)};
}

Imath::Box2i box_of(const PixelRect& rect)
{
    return {{rect.x, rect.y}, {rect.x + rect.width - 1, rect.y + rect.height - 1}};
}

enum class Kind { text, number, matrix };

// What OpenEXR has names and types of its own for.
struct OwnName {
    std::string_view exr;
    std::string_view name; // OpenImageIO's
    Kind kind;
};

constexpr OwnName own_names[] = {
    {"worldToCamera", "worldToCamera", Kind::matrix},
    {"worldToNDC", "worldtoscreen", Kind::matrix},
    {"capDate", "DateTime", Kind::text},
    {"comments", "ImageDescription", Kind::text},
    {"comments", "description", Kind::text},
    {"owner", "Copyright", Kind::text},
    {"name", "oiio:subimagename", Kind::text},
    {"pixelAspectRatio", "PixelAspectRatio", Kind::number},
    {"xDensity", "XResolution", Kind::number},
    {"expTime", "ExposureTime", Kind::number},
    {"aperture", "FNumber", Kind::number},
};

// By OpenEXR's numbers.
constexpr std::string_view compressions[] = {"none",  "rle", "zips", "zip",  "piz",
                                             "pxr24", "b44", "b44a", "dwaa", "dwab"};

template <class Vector>
std::vector<float> floats_of(const Vector& vector, std::size_t count)
{
    const float* const first = reinterpret_cast<const float*>(&vector);
    return {first, first + count};
}

// Nothing for what Metadata cannot hold.
std::optional<MetadataValue> value_of(const Imf::Attribute& attribute)
{
    if (const auto* const text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
        if (const char* const value = text->value().c_str(); *value) // up to a zero, if it has one
            return std::string(value);
    if (const auto* const integer = dynamic_cast<const Imf::IntAttribute*>(&attribute))
        return integer->value();
    if (const auto* const number = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
        return number->value();
    if (const auto* const numbers = dynamic_cast<const Imf::FloatVectorAttribute*>(&attribute))
        if (!numbers->value().empty()) return numbers->value();
    if (const auto* const v2 = dynamic_cast<const Imf::V2fAttribute*>(&attribute))
        return floats_of(v2->value(), 2);
    if (const auto* const v3 = dynamic_cast<const Imf::V3fAttribute*>(&attribute))
        return floats_of(v3->value(), 3);
    if (const auto* const box = dynamic_cast<const Imf::Box2fAttribute*>(&attribute))
        return floats_of(box->value(), 4);
    if (const auto* const colors = dynamic_cast<const Imf::ChromaticitiesAttribute*>(&attribute))
        return floats_of(colors->value(), 8);
    if (const auto* const m33 = dynamic_cast<const Imf::M33fAttribute*>(&attribute))
        return floats_of(m33->value(), 9);
    if (const auto* const m44 = dynamic_cast<const Imf::M44fAttribute*>(&attribute))
        return floats_of(m44->value(), 16);
    return std::nullopt;
}

void insert(Imf::Header& header, const std::string& name, const std::vector<float>& values)
{
    const float* const v = values.data();
    if (same_name(name, chromaticities_name) && values.size() == srgb_chromaticities.size())
        return Imf::addChromaticities(header, {{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}});
    switch (values.size()) {
    case 0: return;
    case 2: return header.insert(name, Imf::V2fAttribute({v[0], v[1]}));
    case 3: return header.insert(name, Imf::V3fAttribute({v[0], v[1], v[2]}));
    case 9:
        return header.insert(name,
                             Imf::M33fAttribute({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]}));
    case 16:
        return header.insert(name, Imf::M44fAttribute({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8],
                                                       v[9], v[10], v[11], v[12], v[13], v[14], v[15]}));
    default: return header.insert(name, Imf::FloatVectorAttribute(values));
    }
}

// Such names mean something to the file itself, or to the format that the image was read from.
bool is_reserved(std::string_view name)
{
    constexpr std::string_view reserved[] = {
        "YResolution",        "planarconfig",       "type",           "tiles",
        "chunkCount",         "maxSamplesPerPixel", "compression",    "DateTime",
        "openexr:chunkCount", "openexr:lineOrder",  "openexr:version"};
    constexpr std::string_view prefixes[] = {"oiio:", "png:", "jpeg:", "hdr:", "bmp:", "targa:", "tiff:"};
    const auto is = [name](std::string_view other) { return same_name(name, other); };
    const auto begins = [name](std::string_view prefix) {
        return same_name(name.substr(0, prefix.size()), prefix);
    };
    return name.empty() || std::any_of(std::begin(reserved), std::end(reserved), is) ||
           (std::any_of(std::begin(prefixes), std::end(prefixes), begins) && !is("oiio:subimagename"));
}

// The value as OpenEXR wants it; nothing if it is of another kind.
std::optional<MetadataValue> of_kind(const MetadataValue& value, Kind kind)
{
    const int* const integer = std::get_if<int>(&value);
    const auto* const floats = std::get_if<std::vector<float>>(&value);
    if (kind == Kind::number && integer) return static_cast<float>(*integer);
    const bool good = kind == Kind::text     ? std::holds_alternative<std::string>(value)
                      : kind == Kind::number ? std::holds_alternative<float>(value)
                                             : floats && floats->size() == 16;
    if (!good) return std::nullopt;
    return value;
}

void insert(Imf::Header& header, std::string name, MetadataValue value)
{
    if (is_reserved(name)) return;
    for (const OwnName& own : own_names) {
        if (!same_name(name, own.name) && !same_name(name, own.exr)) continue;
        auto wanted = of_kind(value, own.kind);
        if (!wanted) return;
        name = own.exr;
        value = std::move(*wanted);
        break;
    }
    try {
        if (const int* const integer = std::get_if<int>(&value))
            header.insert(name, Imf::IntAttribute(*integer));
        else if (const float* const number = std::get_if<float>(&value))
            header.insert(name, Imf::FloatAttribute(*number));
        else if (const std::string* const text = std::get_if<std::string>(&value))
            header.insert(name, Imf::StringAttribute(*text));
        else
            insert(header, name, std::get<std::vector<float>>(value));
    } catch (const Iex::BaseExc&) { // what OpenEXR wants of another type is left out
    }
}

using Names = std::span<const std::string_view>;

// R, G and B first, then what goes with them.
constexpr std::string_view color_order[] = {"R",    "Red",  "G",  "Green", "B",     "Blue", "Y",
                                            "real", "imag", "A",  "Alpha", "AR",    "RA",   "AG",
                                            "GA",   "AB",   "BA", "Z",     "Depth", "Zback"};
// Of a layer of places or directions.
constexpr std::string_view vector_order[] = {"X", "Y", "Z",    "U",    "V",     "W", "R",
                                             "G", "B", "real", "imag", "Alpha", "A"};

std::size_t rank_of(std::string_view suffix, Names order)
{
    const auto is = [suffix](std::string_view other) { return same_name(suffix, other); };
    return static_cast<std::size_t>(std::find_if(order.begin(), order.end(), is) - order.begin());
}

// A channel's name: the layer, with a dot, and the rest.
struct Parts {
    std::string_view layer;
    std::string_view suffix;
};

Parts parts_of(std::string_view name)
{
    const std::size_t dot = name.rfind('.');
    const std::size_t begin = dot == std::string_view::npos ? 0 : dot + 1;
    return {name.substr(0, begin), name.substr(begin)};
}

} // namespace

Windows windows_of(const Imf::Header& header)
{
    const PixelRect full = rect_of(header.displayWindow());
    return {seen_from_corner(rect_of(header.dataWindow()), full), full.width, full.height};
}

std::vector<Channel> channels_of(const Imf::Header& header)
{
    std::vector<Channel> channels;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        const Imf::Channel& channel = i.channel();
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw Error(
                fmt::format("Subsampled channels are not supported (channel \"{}\" has sampling {},{})",
                            i.name(), channel.xSampling, channel.ySampling));
        channels.push_back({i.name(), channel.type});
    }
    const auto has = [&](std::string_view layer, std::string_view suffix) {
        return std::any_of(channels.begin(), channels.end(), [&](const Channel& channel) {
            const Parts parts = parts_of(channel.name);
            return parts.layer == layer && same_name(parts.suffix, suffix);
        });
    };
    std::map<std::string_view, Names> orders; // of the layers
    for (const Channel& channel : channels) {
        const std::string_view layer = parts_of(channel.name).layer;
        const bool is_vector = has(layer, "X") && (has(layer, "Y") || has(layer, "Z"));
        orders[layer] = is_vector ? Names(vector_order) : Names(color_order);
    }
    std::vector<std::pair<std::tuple<std::string_view, std::size_t, std::string_view>, std::size_t>> keys;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const Parts parts = parts_of(channels[i].name);
        keys.push_back({{parts.layer, rank_of(parts.suffix, orders.at(parts.layer)), parts.suffix}, i});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Channel> sorted;
    for (const auto& [key, i] : keys) sorted.push_back(channels[i]);
    return sorted;
}

Metadata metadata_of(const Imf::Header& header)
{
    constexpr std::string_view own[] = {"channels",  "compression", "dataWindow", "displayWindow",
                                        "lineOrder", "type",        "tiles"};
    Metadata metadata;
    put(metadata, "oiio:ColorSpace", "Linear");
    const auto compression = static_cast<std::size_t>(header.compression());
    if (compression < std::size(compressions))
        put(metadata, "compression", std::string(compressions[compression]));
    for (auto i = header.begin(); i != header.end(); ++i) {
        std::string name = i.name();
        const auto value = value_of(i.attribute());
        if (!value || std::find(std::begin(own), std::end(own), name) != std::end(own)) continue;
        if (name == "chunkCount" || name == "version") name = "openexr:" + name;
        if (name == "name") put(metadata, name, *value);
        for (const OwnName& other : own_names)
            if (i.name() == other.exr && other.kind != Kind::matrix && other.name != "description")
                name = other.name;
        put(metadata, name, *value);
    }
    if (const auto* const density = header.findTypedAttribute<Imf::FloatAttribute>("xDensity")) {
        put(metadata, "YResolution", density->value() * header.pixelAspectRatio());
        put(metadata, "ResolutionUnit", "in");
    }
    return metadata;
}

Imf::Header header_of(const PixelRect& data, int full_width, int full_height, const Metadata& metadata,
                      std::string_view compression)
{
    const auto* const known = std::find(std::begin(compressions), std::end(compressions), compression);
    if (known == std::end(compressions)) throw Error(fmt::format("unknown compression {}", compression));
    Imf::Header header(box_of({0, 0, full_width, full_height}), box_of(data));
    header.compression() = static_cast<Imf::Compression>(known - std::begin(compressions));
    for (const auto& [name, value] : metadata) insert(header, name, value);
    return header;
}

} // namespace plumb::lean
