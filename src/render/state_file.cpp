// SPDX-License-Identifier: MIT

#include "plumb/state_file.h"

#include "io/image_words.h"
#include "plumb/error.h"
#include "plumb/hash.h"

#include <algorithm>
#include <bit>
#include <map>
#include <new>
#include <sstream>

#include <fmt/format.h>

namespace plumb {
namespace {

constexpr int format_version = 1;
const std::string no_samples = "none"; // files keep no empty text

// "sum.R.0" to "sum.B.3" for the kind "sum".
void add_names(std::vector<std::string>& names, const char* kind)
{
    for (const char channel : {'R', 'G', 'B'})
        for (int word = 0; word < 4; ++word) names.push_back(fmt::format("{}.{}.{}", kind, channel, word));
}

std::vector<std::string> word_names(bool with_large)
{
    std::vector<std::string> names;
    add_names(names, "sum");
    add_names(names, "squares");
    names.insert(names.end(), {"count", "contributing"});
    if (with_large) add_names(names, "large");
    return names;
}

// The header as one text, in an order that no file changes. Without empty values, which no file keeps.
std::string text_of(const Metadata& header)
{
    const std::map<std::string, MetadataValue> sorted(header.begin(), header.end());
    std::string text;
    for (const auto& [name, value] : sorted) {
        if (value == MetadataValue(std::string())) continue;
        text += name + "=";
        if (const int* const integer = std::get_if<int>(&value))
            text += fmt::format("{}", *integer);
        else if (const float* const number = std::get_if<float>(&value))
            text += fmt::format("{:x}", std::bit_cast<std::uint32_t>(*number));
        else if (const std::string* const string = std::get_if<std::string>(&value))
            text += *string;
        else
            for (const float element : std::get<std::vector<float>>(value))
                text += fmt::format("{:x} ", std::bit_cast<std::uint32_t>(element));
        text += "\n";
    }
    return text;
}

// The words of a row of pixels, after 3 floats for each.
class RowWriter {
public:
    RowWriter(const Film& film, bool with_large)
        : film_(film), picture_(film.develop()), with_large_(with_large)
    {}

    void fill(int y, std::span<std::uint32_t> row) const
    {
        const PixelRect& window = film_.window();
        std::uint32_t* out = row.data();
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Color color = picture_.color(x, y);
            for (const float value : {color.r, color.g, color.b})
                *out++ = std::bit_cast<std::uint32_t>(value);
            const Film::Words words = film_.words({x, y});
            out = std::copy(words.begin(), words.end(), out);
            if (!with_large_) continue;
            const Film::LargeWords large = film_.large_words({x, y});
            out = std::copy(large.begin(), large.end(), out);
        }
    }

private:
    const Film& film_;
    Image picture_;
    bool with_large_;
};

void set_row(Film& film, int y, std::span<const std::uint32_t> row, bool with_large)
{
    const PixelRect& window = film.window();
    const std::uint32_t* in = row.data();
    for (int x = window.x; x < window.x + window.width; ++x) {
        in += 3; // the floats are for viewers
        Film::Words words;
        std::copy_n(in, words.size(), words.begin());
        in += words.size();
        film.set_words({x, y}, words);
        if (!with_large) continue;
        Film::LargeWords large;
        std::copy_n(in, large.size(), large.begin());
        in += large.size();
        film.set_large_words({x, y}, large);
    }
}

void add_row(Hash128& hash, std::span<const std::uint32_t> row)
{
    hash.update({reinterpret_cast<const char*>(row.data()), row.size_bytes()});
}

std::string left_out_text(const LeftOut& left_out)
{
    if (left_out.count == 0) return "0";
    const LeftOut::Sample& first = left_out.first;
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return fmt::format("{} {} {} {} {} {} {} {}", left_out.count, first.pixel.x, first.pixel.y, first.index,
                       static_cast<int>(first.verdict), bits(first.value.r), bits(first.value.g),
                       bits(first.value.b));
}

LeftOut left_out_from(const std::string& text)
{
    std::istringstream in(text);
    LeftOut left_out;
    int verdict = 0;
    std::uint32_t bits[3] = {};
    in >> left_out.count;
    if (left_out.count == 0) return left_out;
    LeftOut::Sample& first = left_out.first;
    in >> first.pixel.x >> first.pixel.y >> first.index >> verdict >> bits[0] >> bits[1] >> bits[2];
    first.verdict = static_cast<Verdict>(verdict);
    first.value = {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]),
                   std::bit_cast<float>(bits[2])};
    return left_out;
}

// What a reader of a state's header looks for.
class Entries {
public:
    explicit Entries(const Metadata& header) : entries_(header.begin(), header.end()) {}

    // Throws Error if it is not there.
    template <class Value>
    const Value& get(const char* name) const
    {
        const auto found = entries_.find(name);
        const Value* const value = found == entries_.end() ? nullptr : std::get_if<Value>(&found->second);
        if (!value) throw Error(fmt::format("its header lacks {}", name));
        return *value;
    }
    bool has(const char* name) const { return entries_.count(name) > 0; }

private:
    std::map<std::string, MetadataValue> entries_;
};

// What of a file's header was written by us: not what the format adds.
Metadata ours(const Metadata& header)
{
    Metadata result;
    for (const auto& entry : header)
        if (entry.first.starts_with("plumb:") || entry.first == "Software" || entry.first == "worldToCamera")
            result.push_back(entry);
    return result;
}

Metadata without(Metadata header, std::string_view prefix)
{
    std::erase_if(header, [&](const auto& entry) { return entry.first.starts_with(prefix); });
    return header;
}

StateFile empty_state(const WordImage& image)
{
    const Metadata header = ours(image.metadata);
    const Entries entries(header);
    if (!entries.has("plumb:state")) throw Error("it is no checkpoint and no part of a picture");
    if (const int version = entries.get<int>("plumb:state"); version != format_version)
        throw Error(
            fmt::format("its format has the version {}, and this program knows {}", version, format_version));
    const std::string& text = entries.get<std::string>("plumb:stateSamples");
    const auto samples = text == no_samples ? SampleSet() : SampleSet::from_text(text);
    if (!samples) throw Error("plumb:stateSamples in its header makes no sense");
    StateFile file{{Film(image.data, image.full_width, image.full_height), *samples, {}, {}},
                   without(header, "plumb:state"),
                   {image.full_width, image.full_height}};
    std::istringstream rays(entries.get<std::string>("plumb:stateRays"));
    rays >> file.state.rays.camera >> file.state.rays.bounce >> file.state.rays.shadow;
    file.state.left_out = left_out_from(entries.get<std::string>("plumb:stateLeftOut"));
    file.state.seconds = static_cast<double>(entries.get<float>("plumb:stateSeconds"));
    return file;
}

} // namespace

std::vector<unsigned char> encode_state(const RenderState& state, Vec2i resolution, const Metadata& header)
{
    const bool with_large = state.film.has_large_squares();
    WordImage image{state.film.window(), resolution.x,           resolution.y,
                    {"R", "G", "B"},     word_names(with_large), header};
    image.metadata.emplace_back("plumb:state", format_version);
    image.metadata.emplace_back("plumb:stateSamples", state.taken.empty() ? no_samples : state.taken.text());
    image.metadata.emplace_back(
        "plumb:stateRays", fmt::format("{} {} {}", state.rays.camera, state.rays.bounce, state.rays.shadow));
    image.metadata.emplace_back("plumb:stateSeconds", static_cast<float>(state.seconds));
    image.metadata.emplace_back("plumb:stateLeftOut", left_out_text(state.left_out));

    const RowWriter writer(state.film, with_large);
    Hash128 hash;
    hash.update(text_of(image.metadata));
    std::vector<std::uint32_t> row(image.words_per_row());
    for (int y = image.data.y; y < image.data.y + image.data.height; ++y) {
        writer.fill(y, row);
        add_row(hash, row);
    }
    image.metadata.emplace_back("plumb:stateHash", hash.hex());
    return encode_words(image, [&](int y, std::span<std::uint32_t> out) { writer.fill(y, out); });
}

StateFile read_state(const std::filesystem::path& path)
{
    std::optional<StateFile> file;
    std::string expected_hash;
    Hash128 hash;
    bool with_large = false;
    try {
        read_words(
            path,
            [&](const WordImage& image) {
                file.emplace(empty_state(image));
                with_large = image.word_channels.size() > word_names(false).size();
                const Metadata header = ours(image.metadata);
                expected_hash = Entries(header).get<std::string>("plumb:stateHash");
                hash.update(text_of(without(header, "plumb:stateHash")));
                std::vector<std::string> channels = {"R", "G", "B"};
                const std::vector<std::string> names = word_names(with_large);
                channels.insert(channels.end(), names.begin(), names.end());
                return channels;
            },
            [&](int y, std::span<const std::uint32_t> row) {
                add_row(hash, row);
                set_row(file->state.film, y, row, with_large);
            });
        if (hash.hex() != expected_hash) throw Error("it is damaged: its hash is wrong");
    } catch (const Error& error) {
        throw Error(fmt::format("cannot go on from '{}': {}", path.string(), error.what()));
    }
    return std::move(*file);
}

} // namespace plumb
