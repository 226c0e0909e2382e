// SPDX-License-Identifier: MIT

// Films with layers: their sums, and their state on disk.

#include "base/temporary_file.h"
#include "image/image_words.h"
#include "plumb/base/error.h"
#include "plumb/math/elementary.h"
#include "plumb/render/state_file.h"
#include "render/state_hash.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/temp_directory.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

const ChannelSet some_layers = {{"albedo", {"R", "G", "B"}, LayerKind::mean},
                                {"position", {"X", "Y", "Z"}, LayerKind::mean_of_hits},
                                {"object", {"id"}, LayerKind::id},
                                {"variance_of_albedo", {"R", "G", "B"}, LayerKind::variance},
                                {"variance_of_position", {"X", "Y", "Z"}, LayerKind::variance_of_hits}};
constexpr PixelRect one_pixel{0, 0, 1, 1};
constexpr PixelRect window{2, 1, 5, 4};

struct Sample {
    Color radiance;
    float weight = 1.f;
    std::vector<float> values; // of albedo and position
    std::uint32_t id = 0;
    std::uint64_t hits = 7;
    std::uint64_t index = 0;
};

SampleStatus add(Film& film, Vec2i pixel, const Sample& sample)
{
    // Their variances are of the same values.
    std::vector<float> values = sample.values;
    values.insert(values.end(), sample.values.begin(), sample.values.end());
    const std::uint64_t hits = sample.hits | sample.hits << 3;
    return film.add(pixel, sample.radiance, sample.weight, {values, {&sample.id, 1}, hits}, sample.index);
}

Sample random_sample(TestRandom& random, std::uint64_t index)
{
    Sample sample{Color(random.next_1d()), random.next_1d() < 0.2f ? -1.f : 1.f, {}, 0, 7, index};
    for (int i = 0; i < 3; ++i) sample.values.push_back(random.next_1d());
    for (int i = 0; i < 3; ++i) sample.values.push_back(static_cast<float>(random.between(-1e6, 1e6)));
    sample.id = static_cast<std::uint32_t>(random.between(1.0, 1000.0));
    if (random.next_1d() < 0.3f) sample.hits = 0;
    return sample;
}

std::vector<std::uint32_t> layer_words(const Film& film, Vec2i pixel)
{
    std::vector<std::uint32_t> words(film.layer_word_names().size());
    film.layer_words(pixel, words);
    return words;
}

// By name.
float value(const Film& film, Vec2i pixel, const std::string& channel)
{
    const Image image = film.develop();
    const std::vector<std::string>& names = image.channel_names();
    const auto found = std::find(names.begin(), names.end(), channel);
    REQUIRE(found != names.end());
    return image.pixel(pixel.x, pixel.y)[found - names.begin()];
}

RenderState noise(std::uint64_t seed, const SampleBlock& block)
{
    TestRandom random(seed);
    RenderState state{Film(window, 9, 9, some_layers), SampleSet(block), {}, {}, 0.0};
    for (int y = block.pixels.y; y < block.pixels.y + block.pixels.height; ++y)
        for (int x = block.pixels.x; x < block.pixels.x + block.pixels.width; ++x)
            for (std::uint64_t i = block.first; i < block.last; ++i)
                add(state.film, {x, y}, random_sample(random, i));
    return state;
}

bool same_film(const Film& a, const Film& b)
{
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (a.words({x, y}) != b.words({x, y}) || layer_words(a, {x, y}) != layer_words(b, {x, y}))
                return false;
    return a.layers() == b.layers();
}

std::string message(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("layers do not depend on the order of samples, nor on how they are parted", "[unit][layers]")
{
    TestRandom random(11);
    std::vector<Sample> samples;
    for (std::uint64_t i = 0; i < 1000; ++i) samples.push_back(random_sample(random, i));
    Film forward(one_pixel, 1, 1, some_layers);
    for (const Sample& sample : samples) REQUIRE(add(forward, {0, 0}, sample) == SampleStatus::accepted);
    Film even(one_pixel, 1, 1, some_layers);
    Film odd(one_pixel, 1, 1, some_layers);
    std::reverse(samples.begin(), samples.end());
    for (const Sample& sample : samples) add(sample.index % 2 == 0 ? even : odd, {0, 0}, sample);
    odd += even;
    CHECK(odd.words({0, 0}) == forward.words({0, 0}));
    CHECK(layer_words(odd, {0, 0}) == layer_words(forward, {0, 0}));
}

TEST_CASE("a layer is the mean of its samples, and an id the first one", "[unit][layers]")
{
    TestRandom random(12);
    Film film(one_pixel, 1, 1, some_layers);
    double albedo = 0.0;
    double position = 0.0;
    double albedo_squares = 0.0;
    double position_squares = 0.0;
    double hits = 0.0;
    std::uint32_t id = 0;
    constexpr int count = 1000;
    for (std::uint64_t i = count; i-- > 0;) {
        const Sample sample = random_sample(random, i);
        add(film, {0, 0}, sample);
        id = sample.hits != 0 ? sample.id : 0;
        if (sample.hits == 0) continue;
        albedo += static_cast<double>(sample.values[1] * sample.weight);
        position += static_cast<double>(sample.values[5]);
        albedo_squares += sqr(static_cast<double>(sample.values[1] * sample.weight));
        position_squares += sqr(static_cast<double>(sample.values[5]));
        ++hits;
    }
    CHECK(value(film, {0, 0}, "albedo.G") == Approx(albedo / count).epsilon(1e-6));
    CHECK(value(film, {0, 0}, "position.Z") == Approx(position / hits).epsilon(1e-6));
    albedo /= count;
    position /= hits;
    CHECK(value(film, {0, 0}, "variance_of_albedo.G") ==
          Approx((albedo_squares / count - albedo * albedo) / (count - 1)).epsilon(1e-6));
    CHECK(value(film, {0, 0}, "variance_of_position.Z") ==
          Approx((position_squares / hits - position * position) / (hits - 1)).epsilon(1e-6));
    CHECK(value(film, {0, 0}, "object.id") == static_cast<float>(id));
}

TEST_CASE("what sees nothing is 0 in all layers", "[unit][layers]")
{
    Film film(one_pixel, 1, 1, some_layers);
    add(film, {0, 0}, {Color(1.f), 1.f, std::vector<float>(6, 0.f), 0, 0, 0});
    for (const char* channel : {"albedo.R", "position.X", "object.id"})
        CHECK(value(film, {0, 0}, channel) == 0.f);
    CHECK(value(film, {0, 0}, "R") == 1.f);
}

TEST_CASE("the largest values of a layer add up without wrapping", "[unit][layers]")
{
    // 2^26 samples of almost 2^37 fill 127 bits; a position of 1e6 is far below.
    const float large = std::nextafter(film_max_value, 0.f);
    Film film(one_pixel, 1, 1, some_layers);
    for (std::uint64_t i = 0; i < 4096; ++i)
        add(film, {0, 0}, {Color(), 1.f, {large, large, large, -large, large, 1e6f}, 1, 7, i});
    CHECK(value(film, {0, 0}, "albedo.R") == large);
    CHECK(value(film, {0, 0}, "position.X") == -large);
    CHECK(value(film, {0, 0}, "position.Z") == 1e6f);
    CHECK(value(film, {0, 0}, "variance_of_albedo.R") == 0.f);
    CHECK(value(film, {0, 0}, "variance_of_position.X") == 0.f);
}

TEST_CASE("a value that a layer cannot hold changes nothing else", "[unit][layers]")
{
    const float bad =
        GENERATE(as<float>{}, infinity, std::numeric_limits<float>::quiet_NaN(), film_max_value);
    Film film(one_pixel, 1, 1, some_layers);
    add(film, {0, 0}, {Color(1.f), 1.f, {0.5f, 0.5f, 0.5f, 3.f, 4.f, 5.f}, 2, 7, 1});
    CHECK(add(film, {0, 0}, {Color(3.f), 1.f, {0.25f, 0.5f, 0.5f, 1.f, bad, 1.f}, 1, 7, 0}) ==
          SampleStatus::accepted);
    CHECK(value(film, {0, 0}, "R") == 2.f);
    CHECK(value(film, {0, 0}, "albedo.R") == 0.375f);
    CHECK(value(film, {0, 0}, "position.X") == 3.f);
    CHECK(value(film, {0, 0}, "object.id") == 1.f);
    // What beauty leaves out, layers leave out.
    CHECK(add(film, {0, 0}, {Color(-1.f), 1.f, {1.f, 1.f, 1.f, 1.f, 1.f, 1.f}, 1, 7, 2}) ==
          SampleStatus::negative);
    CHECK(value(film, {0, 0}, "albedo.R") == 0.375f);
}

TEST_CASE("films with different layers cannot be added", "[unit][layers]")
{
    Film film(one_pixel, 1, 1, some_layers);
    const auto before = film.words({0, 0});
    Film other(one_pixel, 1, 1);
    other.add({0, 0}, Color(1.f), 1.f);
    CHECK(message([&] { film += other; }) == "films with different layers cannot be added: one has albedo, "
                                             "position, object, variance_of_albedo, variance_of_position, "
                                             "the other none");
    CHECK(film.words({0, 0}) == before);
}

TEST_CASE("a set of layers is the same after it was text", "[unit][layers]")
{
    CHECK(to_text(some_layers) == "albedo:R,G,B:mean position:X,Y,Z:hits object:id:id "
                                  "variance_of_albedo:R,G,B:variance "
                                  "variance_of_position:X,Y,Z:variance_of_hits");
    CHECK(channel_set_from_text(to_text(some_layers)) == some_layers);
    CHECK(to_text({}) == "none");
    CHECK(channel_set_from_text("none").empty());
    for (const char* bad :
         {"", " ", "a", "a:R", "a:R:", "a::mean", "a:R:men", "a:R,R:mean", "a:R:mean a:G:mean", "a:R:mean ",
          " a:R:mean", "a:R,G:id", "a:R,G,B,A,Z:mean", ":R:mean", "a/b:R:mean"})
        CHECK_THROWS_AS(channel_set_from_text(bad), Error);
    std::string many;
    for (std::size_t i = 0; i <= max_layers; ++i) many += fmt::format("{}a{}:R:mean", i == 0 ? "" : " ", i);
    CHECK_THROWS_AS(channel_set_from_text(many), Error);
}

TEST_CASE("a rendering with layers comes back from disk bit for bit", "[unit][layers][state_file]")
{
    const TempDirectory directory;
    const RenderState state = noise(1, {window, 0, 8});
    const auto read = [&](const RenderState& written) {
        const std::vector<unsigned char> bytes = encode_state(written, {9, 9}, {});
        directory.write("state.exr", std::string(bytes.begin(), bytes.end()));
        return read_state(directory / "state.exr").state;
    };
    CHECK(same_film(read(state).film, state.film));

    // Of parts, too, in whatever order.
    RenderState whole = noise(2, {{2, 1, 5, 2}, 0, 8});
    const RenderState lower = noise(3, {{2, 3, 5, 2}, 0, 8});
    RenderState other = read(lower);
    other += read(whole);
    whole += lower;
    CHECK(same_film(other.film, whole.film));
    CHECK(same_film(read(other).film, whole.film));
}

TEST_CASE("a state file of format 2 is one without layers", "[unit][layers][state_file]")
{
    const int version = GENERATE(1, 2, 4);
    const TempDirectory directory;
    WordImage image{one_pixel, 1, 1, {"R", "G", "B"}, {"sum.R.2", "count", "contributing"}, {}};
    image.metadata = {{"plumb:state", version},
                      {"plumb:stateSamples", std::string("0,0,1,1:0-4")},
                      {"plumb:stateRays", std::string("4 5 6")},
                      {"plumb:stateSeconds", 1.5f},
                      {"plumb:stateLeftOut", std::string("0")}};
    const std::vector<std::uint32_t> row = {0, 0, 0, 6, 4, 3}; // a sum of 6 of four samples
    StateHash hash(image.metadata, image.word_channels);
    hash.add(hash_of_row(row));
    image.metadata.emplace_back(state_hash_name, hash.hex());
    const std::vector<unsigned char> bytes =
        encode_words(image, [&](int, int, std::span<std::uint32_t> rows) {
            std::copy(row.begin(), row.end(), rows.begin());
        });
    directory.write("old.exr", std::string(bytes.begin(), bytes.end()));
    if (version != 2) {
        CHECK(message([&] { read_state(directory / "old.exr"); }) ==
              fmt::format(
                  "cannot resume from '{}': its format has version {}, but this program reads version 3",
                  (directory / "old.exr").string(), version));
        return;
    }
    const StateFile read = read_state(directory / "old.exr");
    CHECK(read.state.film.layers().empty());
    CHECK(read.state.film.develop().color(0, 0).r == 1.5f);
    CHECK(read.state.film.sample_count({0, 0}) == 4);
}

TEST_CASE("a state file with impossible layers is refused", "[unit][layers][state_file]")
{
    const TempDirectory directory;
    RenderState state = noise(1, {window, 0, 8});
    std::vector<std::uint32_t> words = layer_words(state.film, {4, 3});
    const std::vector<std::string> names = state.film.layer_word_names();
    const auto [name, word] = GENERATE(std::pair("layer.albedo.G.3", 0x1000u), std::pair("hits.position", 9u),
                                       std::pair("squares.variance_of_albedo.G.3", 0x1000u),
                                       std::pair("squares.variance_of_albedo.G.3", 0x80000000u),
                                       std::pair("largeSquares.variance_of_position.X.3", 8u),
                                       std::pair("first.object.sample", 0x8000000u));
    const auto found = std::find(names.begin(), names.end(), name);
    REQUIRE(found != names.end());
    words[static_cast<std::size_t>(found - names.begin())] = word;
    state.film.set_layer_words({4, 3}, words);
    const std::vector<unsigned char> bytes = encode_state(state, {9, 9}, {});
    directory.write("bad.exr", std::string(bytes.begin(), bytes.end()));
    CHECK_THAT(message([&] { read_state(directory / "bad.exr"); }),
               ContainsSubstring("its sums do not fit its samples"));
}
