// SPDX-License-Identifier: MIT

#include "plumb/render/state_file.h"

#include "base/parallel.h"
#include "image/image_words.h"
#include "plumb/base/error.h"
#include "plumb/render/adaptive.h"
#include "render/state_hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <functional>
#include <map>
#include <new>

#include <fmt/format.h>

namespace plumb {
namespace {

constexpr int format_version = 3;
constexpr int version_without_layers = 2; // is read as well
constexpr const char* plans_name = "plumb:statePlans";
const std::string no_samples = "none"; // files keep no empty text

constexpr std::size_t small_count = std::tuple_size_v<Film::Words>;
constexpr std::size_t beauty_count = small_count + std::tuple_size_v<Film::LargeWords>;
using AllWords = std::vector<std::uint32_t>; // of a pixel: beauty_count, and those of the layers

// "sum.R.0" to "sum.B.3" for the kind "sum".
void add_names(std::vector<std::string>& names, const char* kind)
{
    for (const char channel : {'R', 'G', 'B'})
        for (int word = 0; word < 4; ++word) names.push_back(fmt::format("{}.{}.{}", kind, channel, word));
}

// What the channels of AllWords are called.
std::vector<std::string> word_names(const Film& film)
{
    std::vector<std::string> names;
    add_names(names, "sum");
    add_names(names, "squares");
    names.insert(names.end(), {"count", "contributing"});
    add_names(names, "large");
    const std::vector<std::string> layers = film.layer_word_names();
    names.insert(names.end(), layers.begin(), layers.end());
    if (film.plans() == Plans::kept) names.emplace_back("plan");
    return names;
}

AllWords room_for_words(const Film& film)
{
    return AllWords(beauty_count + film.layer_word_names().size() + (film.plans() == Plans::kept ? 1 : 0));
}

// Those of the layers.
template <class Words>
auto layer_words(const Film& film, Words& all)
{
    return std::span(all).subspan(beauty_count,
                                  all.size() - beauty_count - (film.plans() == Plans::kept ? 1 : 0));
}

// Whether a pixel with so many accepted samples can have the plan.
bool is_possible_plan(std::uint32_t plan, std::uint64_t count)
{
    return plan == 0 || (std::has_single_bit(plan) && plan >= least_adaptive_samples &&
                         plan <= film_max_samples && count <= plan);
}

void get_words(const Film& film, Vec2i pixel, AllWords& all)
{
    const Film::Words words = film.words(pixel);
    std::copy(words.begin(), words.end(), all.begin());
    film.layer_words(pixel, layer_words(film, all));
    if (film.plans() == Plans::kept) all.back() = film.plan(pixel);
    if (!film.has_large_squares()) return;
    const Film::LargeWords large = film.large_words(pixel);
    std::copy(large.begin(), large.end(), all.begin() + small_count);
}

void set_words(Film& film, Vec2i pixel, const AllWords& all)
{
    Film::Words words;
    std::copy_n(all.begin(), words.size(), words.begin());
    film.set_words(pixel, words);
    Film::LargeWords large;
    std::copy_n(all.begin() + small_count, large.size(), large.begin());
    if (large != Film::LargeWords{}) film.set_large_words(pixel, large);
    film.set_layer_words(pixel, layer_words(film, all));
    if (film.plans() == Plans::kept) film.set_plan(pixel, all.back());
}

// part(y) for each row of the window, on all threads.
void for_each_row(const PixelRect& window, const std::function<void(int)>& part)
{
    parallel_for(static_cast<std::size_t>(window.height), 0,
                 [&](std::size_t row) { part(window.y + static_cast<int>(row)); });
}

// The indices of the words that are not 0 in all pixels: the others are not worth a channel.
std::vector<std::size_t> words_in_use(const Film& film)
{
    const PixelRect& window = film.window();
    std::vector<AllWords> of_row(static_cast<std::size_t>(window.height));
    const AllWords room = room_for_words(film);
    for_each_row(window, [&](int y) {
        AllWords bits = room;
        AllWords words = room;
        for (int x = window.x; x < window.x + window.width; ++x) {
            get_words(film, {x, y}, words);
            for (std::size_t i = 0; i < words.size(); ++i) bits[i] |= words[i];
        }
        of_row[static_cast<std::size_t>(y - window.y)] = std::move(bits);
    });
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < room.size(); ++i)
        if (std::any_of(of_row.begin(), of_row.end(), [i](const AllWords& bits) { return bits[i] != 0; }))
            used.push_back(i);
    return used;
}

// Rows of pixels as they are in the file: for each pixel 3 floats, for viewers, and the words in use.
class RowWriter {
public:
    explicit RowWriter(const Film& film)
        : film_(film), image_(film.develop()), used_(words_in_use(film)), room_(room_for_words(film))
    {}

    std::vector<std::string> channels() const
    {
        const std::vector<std::string> all = word_names(film_);
        std::vector<std::string> names;
        for (const std::size_t i : used_) names.push_back(all[i]);
        return names;
    }

    void fill(int y, std::span<std::uint32_t> row) const
    {
        const PixelRect& window = film_.window();
        std::uint32_t* out = row.data();
        AllWords words = room_;
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Color color = image_.color(x, y);
            for (const float value : {color.r, color.g, color.b})
                *out++ = std::bit_cast<std::uint32_t>(value);
            get_words(film_, {x, y}, words);
            for (const std::size_t i : used_) *out++ = words[i];
        }
    }

private:
    const Film& film_;
    Image image_;
    std::vector<std::size_t> used_;
    AllWords room_;
};

// Whether so many samples can have such sums (film.h).
bool is_possible(const Film& film, const AllWords& words, std::uint64_t samples)
{
    const std::uint64_t count = words[24];
    const std::uint64_t contributing = words[25];
    if (count > samples || contributing > count) return false;
    // The highest words; |sample| < 2^37 and squares < 2^36 in units of 2^-64, large squares < 2^74 in units of 2^-20.
    const auto is_below = [&](std::size_t word, std::uint64_t largest) {
        const auto high = static_cast<std::int32_t>(words[word]);
        return std::abs(static_cast<std::int64_t>(high)) <= static_cast<std::int64_t>(largest) + 1;
    };
    for (std::size_t channel = 0; channel < 3; ++channel)
        if (!is_below(4 * channel + 3, count << 5) || !is_below(12 + 4 * channel + 3, count << 4) ||
            !is_below(small_count + 4 * channel + 3, count))
            return false;
    if (film.plans() == Plans::kept && !is_possible_plan(words.back(), count)) return false;
    return film.can_have_layer_words(layer_words(film, words), count);
}

// Returns whether all of the row is possible.
bool set_row(Film& film, int y, std::span<const std::uint32_t> row, const std::vector<std::size_t>& used,
             std::uint64_t samples)
{
    const PixelRect& window = film.window();
    const std::uint32_t* in = row.data();
    bool possible = true;
    AllWords words = room_for_words(film);
    for (int x = window.x; x < window.x + window.width; ++x) {
        in += 3;
        for (const std::size_t i : used) words[i] = *in++;
        possible = possible && is_possible(film, words, samples);
        set_words(film, {x, y}, words);
    }
    return possible;
}

std::string left_out_text(const LeftOut& left_out)
{
    if (left_out.count == 0) return "0";
    const LeftOut::Sample& first = left_out.first;
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return fmt::format("{} {} {} {} {} {} {} {}", left_out.count, first.pixel.x, first.pixel.y, first.index,
                       static_cast<int>(first.status), bits(first.value.r), bits(first.value.g),
                       bits(first.value.b));
}

[[noreturn]] void reject(std::string_view name)
{
    throw Error(fmt::format("{} in its header is invalid", name));
}

// The text must consist of at least one number and at most so many, with one space between two.
std::vector<std::uint64_t> numbers_from(std::string_view name, std::string_view text, std::size_t most)
{
    std::vector<std::uint64_t> numbers;
    for (bool more = true; more;) {
        std::uint64_t number = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (problem != std::errc() || numbers.size() == most) reject(name);
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        more = text.starts_with(' ');
        if (more) text.remove_prefix(1);
    }
    if (!text.empty()) reject(name);
    return numbers;
}

LeftOut left_out_from(const std::string& text, const PixelRect& window)
{
    const std::string_view name = "plumb:stateLeftOut";
    const std::vector<std::uint64_t> numbers = numbers_from(name, text, 8);
    LeftOut left_out;
    left_out.count = numbers[0];
    if (numbers.size() == 1 && left_out.count == 0) return left_out;
    const auto is_inside = [](std::uint64_t at, int first, int size) {
        return at >= static_cast<std::uint64_t>(first) && at < static_cast<std::uint64_t>(first + size);
    };
    if (numbers.size() != 8 || left_out.count == 0 || !is_inside(numbers[1], window.x, window.width) ||
        !is_inside(numbers[2], window.y, window.height) ||
        numbers[4] > static_cast<std::uint64_t>(SampleStatus::out_of_range) ||
        std::any_of(numbers.begin() + 5, numbers.end(), [](std::uint64_t bits) { return bits > UINT32_MAX; }))
        reject(name);
    const auto value = [](std::uint64_t bits) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    };
    left_out.first.pixel = {static_cast<int>(numbers[1]), static_cast<int>(numbers[2])};
    left_out.first.index = numbers[3];
    left_out.first.status = static_cast<SampleStatus>(numbers[4]);
    left_out.first.value = {value(numbers[5]), value(numbers[6]), value(numbers[7])};
    return left_out;
}

RayCounts rays_from(const std::string& text)
{
    const std::string_view name = "plumb:stateRays";
    const std::vector<std::uint64_t> numbers = numbers_from(name, text, 3);
    if (numbers.size() != 3) reject(name);
    return {numbers[0], numbers[1], numbers[2]};
}

ChannelSet layers_from(const std::string& text)
{
    try {
        return channel_set_from_text(text);
    } catch (const Error&) {
        reject("plumb:stateLayers");
    }
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

Metadata without(Metadata header, std::string_view prefix)
{
    std::erase_if(header, [&](const auto& entry) { return entry.first.starts_with(prefix); });
    return header;
}

StateFile empty_state(const WordImage& image)
{
    const Metadata header = state_header(image.metadata);
    const Entries entries(header);
    if (!entries.has("plumb:state")) throw Error("it is not a checkpoint or a partial render");
    const int version = entries.get<int>("plumb:state");
    if (version != format_version && version != version_without_layers)
        throw Error(fmt::format("its format has version {}, but this program reads version {}", version,
                                format_version));
    const PixelRect& data = image.data;
    if (data.x < 0 || data.y < 0 || data.width < 1 || data.height < 1 ||
        data.width > image.full_width - data.x || data.height > image.full_height - data.y)
        throw Error("its pixels are not those of an image");
    const std::string& text = entries.get<std::string>("plumb:stateSamples");
    const auto samples = text == no_samples ? SampleSet() : SampleSet::from_text(text);
    if (!samples || !(*samples - SampleSet(SampleBlock{data, 0, film_max_samples})).empty())
        reject("plumb:stateSamples");
    const auto seconds = static_cast<double>(entries.get<float>("plumb:stateSeconds"));
    constexpr double longest = 1e12;
    if (!(seconds >= 0.0 && seconds <= longest)) reject("plumb:stateSeconds");
    const RayCounts rays = rays_from(entries.get<std::string>("plumb:stateRays"));
    const LeftOut left_out = left_out_from(entries.get<std::string>("plumb:stateLeftOut"), data);
    ChannelSet layers;
    if (version != version_without_layers)
        layers = layers_from(entries.get<std::string>("plumb:stateLayers"));
    StateFile file{{Film(data, image.full_width, image.full_height, std::move(layers),
                         entries.has(plans_name) ? Plans::kept : Plans::none),
                    *samples, rays, left_out},
                   without(header, "plumb:state"),
                   {image.full_width, image.full_height}};
    file.state.seconds = seconds;
    return file;
}

} // namespace

std::vector<unsigned char> encode_state(const RenderState& state, Vec2i resolution, const Metadata& header)
{
    const RowWriter writer(state.film);
    const PixelRect& window = state.film.window();
    WordImage image{window, resolution.x, resolution.y, {"R", "G", "B"}, writer.channels(), header};
    image.metadata.emplace_back("plumb:state", format_version);
    image.metadata.emplace_back("plumb:stateLayers", to_text(state.film.layers()));
    if (state.film.plans() == Plans::kept) image.metadata.emplace_back(plans_name, "adaptive");
    image.metadata.emplace_back("plumb:stateSamples", state.taken.empty() ? no_samples : state.taken.text());
    image.metadata.emplace_back(
        "plumb:stateRays", fmt::format("{} {} {}", state.rays.camera, state.rays.bounce, state.rays.shadow));
    image.metadata.emplace_back("plumb:stateSeconds", static_cast<float>(state.seconds));
    image.metadata.emplace_back("plumb:stateLeftOut", left_out_text(state.left_out));

    std::vector<std::string> row_hashes(static_cast<std::size_t>(window.height));
    for_each_row(window, [&](int y) {
        std::vector<std::uint32_t> row(image.words_per_row());
        writer.fill(y, row);
        row_hashes[static_cast<std::size_t>(y - window.y)] = hash_of_row(row);
    });
    StateHash hash(image.metadata, image.word_channels);
    for (const std::string& row_hash : row_hashes) hash.add(row_hash);
    image.metadata.emplace_back(state_hash_name, hash.hex());

    return encode_words(image, [&](int top, int count, std::span<std::uint32_t> rows) {
        parallel_for(static_cast<std::size_t>(count), 0, [&](std::size_t i) {
            const std::size_t size = image.words_per_row();
            writer.fill(top + static_cast<int>(i), rows.subspan(i * size, size));
        });
    });
}

std::optional<Metadata> read_state_header(const std::filesystem::path& path)
{
    std::optional<Metadata> header;
    try {
        read_words(
            path,
            [&](const WordImage& image) -> std::vector<std::string> {
                if (Entries(image.metadata).has("plumb:state"))
                    header = without(state_header(image.metadata), "plumb:state");
                throw Error("the header is enough");
            },
            [](int, std::span<const std::uint32_t>) {});
    } catch (const Error&) { // that, or it is no image
    }
    return header;
}

StateFile read_state(const std::filesystem::path& path, std::string_view purpose)
{
    std::optional<StateFile> file;
    std::string expected_hash;
    std::optional<StateHash> hash;
    std::vector<std::size_t> used;
    std::uint64_t samples = 0; // of a pixel, at most
    bool possible = true;
    try {
        read_words(
            path,
            [&](const WordImage& image) {
                file.emplace(empty_state(image));
                samples = file->state.taken.samples_per_pixel(image.data).most;
                std::vector<std::string> names;
                const std::vector<std::string> all = word_names(file->state.film);
                for (std::size_t i = 0; i < all.size(); ++i) {
                    const std::string& name = all[i];
                    const std::vector<std::string>& there = image.word_channels;
                    if (std::find(there.begin(), there.end(), name) == there.end()) continue;
                    used.push_back(i);
                    names.push_back(name);
                }
                const Metadata header = state_header(image.metadata);
                expected_hash = Entries(header).get<std::string>(state_hash_name);
                hash.emplace(header, names);
                names.insert(names.begin(), {"R", "G", "B"});
                return names;
            },
            [&](int y, std::span<const std::uint32_t> row) {
                hash->add(hash_of_row(row));
                possible = set_row(file->state.film, y, row, used, samples) && possible;
            });
        if (hash->hex() != expected_hash) throw Error("it is damaged: its hash is wrong");
        if (!possible) throw Error("its sums do not fit its samples");
    } catch (const Error& error) {
        throw Error(fmt::format("cannot {} '{}': {}", purpose, path.string(), error.what()));
    }
    return std::move(*file);
}

} // namespace plumb
