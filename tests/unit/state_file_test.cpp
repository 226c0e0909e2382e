// SPDX-License-Identifier: MIT

// Renderings that are written to disk and read again.

#include "base/temporary_file.h"
#include "plumb/base/error.h"
#include "plumb/render/state_file.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/temp_directory.h"

#include <algorithm>
#include <cstring>
#include <map>

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr Vec2i resolution(40, 300);
constexpr PixelRect window{3, 5, 30, 280};

const Metadata header = {{"Software", std::string("Plumb 1.2.3")},
                         {"plumb:inputs", std::string("00 a.xml\n01 b.obj")},
                         {"plumb:nothing", std::string()},
                         {"plumb:samplesPerPixel", 8},
                         {"plumb:envmapScale", 0.1f},
                         {"worldToCamera", std::vector<float>(16, 0.3f)}};

RenderState noise(std::uint64_t seed, bool large, const SampleBlock& block)
{
    TestRandom random(seed);
    RenderState state{Film(window, resolution.x, resolution.y), SampleSet(block), {1, 2, 3}, {}, 1.5};
    for (int y = block.pixels.y; y < block.pixels.y + block.pixels.height; ++y) {
        for (int x = block.pixels.x; x < block.pixels.x + block.pixels.width; ++x) {
            for (std::uint64_t i = block.first; i < block.last; ++i) {
                const auto size = static_cast<float>(std::exp(random.between(-20.0, large ? 15.0 : 5.0)));
                const float weight = random.next_1d() < 0.2f ? -1.f : 1.f;
                state.film.add({x, y}, Color(size, 0.f, 2.f * size), weight);
            }
        }
    }
    state.left_out.add(
        {{4, 6}, 7, Color(std::numeric_limits<float>::quiet_NaN(), -0.f, 1.f), SampleStatus::negative});
    return state;
}

std::filesystem::path write(const TempDirectory& directory, const RenderState& state)
{
    TemporaryFile file(directory / "state.exr");
    file.write(std::span<const unsigned char>(encode_state(state, resolution, header)));
    file.take_place();
    return directory / "state.exr";
}

bool same_film(const Film& a, const Film& b)
{
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (a.words({x, y}) != b.words({x, y}) || a.large_words({x, y}) != b.large_words({x, y}))
                return false;
    return a.window() == b.window();
}

std::string problem(const std::filesystem::path& path)
{
    try {
        read_state(path);
    } catch (const Error& error) {
        const std::string text = error.what();
        const std::string start = "cannot resume from '" + path.string() + "': ";
        REQUIRE(text.substr(0, start.size()) == start);
        return text.substr(start.size());
    }
    return "no error";
}

} // namespace

TEST_CASE("a rendering comes back from disk bit for bit", "[unit][state_file]")
{
    const bool large = GENERATE(false, true);
    const TempDirectory directory;
    const RenderState state = noise(1, large, {window, 0, 8});
    REQUIRE(state.film.has_large_squares() == large);
    const std::filesystem::path path = write(directory, state);
    const StateFile read = read_state(path);

    CHECK(same_film(read.state.film, state.film));
    CHECK(read.state.taken == state.taken);
    CHECK(read.state.rays.camera == 1);
    CHECK(read.state.rays.bounce == 2);
    CHECK(read.state.rays.shadow == 3);
    CHECK(read.state.seconds == 1.5);
    CHECK(read.state.left_out.count == 1);
    const LeftOut::Sample& first = read.state.left_out.first;
    CHECK(std::memcmp(&first.value, &state.left_out.first.value, sizeof first.value) == 0);
    CHECK(first.pixel == Vec2i(4, 6));
    CHECK(first.index == 7);
    CHECK(first.status == SampleStatus::negative);
    CHECK(read.resolution == resolution);
    std::map<std::string, MetadataValue> expected(header.begin(), header.end());
    expected.erase("plumb:nothing"); // files keep no empty values
    CHECK(std::map<std::string, MetadataValue>(read.header.begin(), read.header.end()) == expected);

    // It is an image, too, without the channels that say nothing.
    const Image seen = read_image(path, false);
    const auto has = [&](const std::string& name) {
        const std::vector<std::string>& names = seen.channel_names();
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    CHECK(has("sum.R.1"));
    CHECK_FALSE(has("sum.G.1")); // green is black
    CHECK(has("large.B.1") == large);
    const Image developed = state.film.develop();
    CHECK(std::memcmp(seen.pixel(9, 20), developed.pixel(9, 20), 3 * sizeof(float)) == 0);
}

TEST_CASE("a rendering without a sample comes back from disk", "[unit][state_file]")
{
    const TempDirectory directory;
    const RenderState nothing{Film(window, resolution.x, resolution.y), {}, {}, {}};
    const StateFile read = read_state(write(directory, nothing));
    CHECK(same_film(read.state.film, nothing.film));
    CHECK(read.state.taken.empty());
}

TEST_CASE("films add up as if they were one", "[unit][state_file][film]")
{
    const bool large = GENERATE(false, true);
    const PixelRect upper{3, 5, 30, 100};
    const PixelRect lower{3, 105, 30, 180};
    RenderState sum = noise(1, large, {upper, 0, 8});
    const RenderState other = noise(2, large, {lower, 0, 8});
    sum += other;
    CHECK(sum.taken == SampleSet(SampleBlock{window, 0, 8}));
    CHECK(sum.rays.shadow == 6);
    CHECK(sum.left_out.count == 2);
    const Film again = noise(1, large, {upper, 0, 8}).film;
    for (const Vec2i& pixel : {Vec2i(3, 5), Vec2i(32, 104), Vec2i(17, 50)}) {
        CHECK(sum.film.words(pixel) == again.words(pixel));
        CHECK(sum.film.large_words(pixel) == again.large_words(pixel));
    }
    CHECK(sum.film.words({10, 200}) == other.film.words({10, 200}));
    CHECK(sum.film.sample_count({10, 200}) == 8);
}

TEST_CASE("a damaged state file is found out", "[unit][state_file]")
{
    const TempDirectory directory;
    const std::filesystem::path path = write(directory, noise(1, false, {window, 0, 2}));
    const std::string good = read_bytes(path);
    REQUIRE(problem(path) == "no error");

    SECTION("wherever a bit falls over")
    {
        TestRandom random(3);
        int found = 0;
        constexpr int rounds = 60;
        for (int i = 0; i < rounds; ++i) {
            std::string bad = good;
            bad[static_cast<std::size_t>(random.next_double() * double(bad.size()))] ^= char(1 << (i % 8));
            directory.write("bad.exr", bad);
            if (problem(directory / "bad.exr") != "no error") {
                ++found;
                continue;
            }
            // What the header has for viewers only may change: nothing of the state has.
            const StateFile read = read_state(directory / "bad.exr");
            CHECK(same_film(read.state.film, read_state(path).state.film));
            CHECK(read.state.taken == read_state(path).state.taken);
        }
        CHECK(found > rounds * 9 / 10);
    }
    SECTION("wherever it ends")
    {
        for (const double share : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
            directory.write("bad.exr", good.substr(0, static_cast<std::size_t>(share * double(good.size()))));
            CHECK(problem(directory / "bad.exr") != "no error");
        }
        directory.write("bad.exr", good.substr(0, good.size() - 1));
        CHECK(problem(directory / "bad.exr") != "no error");
    }
    SECTION("if a channel has another's name")
    {
        std::string bad = good;
        const std::size_t name = bad.find("squares.B.1");
        REQUIRE(name != std::string::npos);
        REQUIRE(bad.find("squares.B.3") == std::string::npos);
        bad.replace(name, 11, "squares.B.3");
        directory.write("bad.exr", bad);
        CHECK(problem(directory / "bad.exr") == "it is damaged: its hash is wrong");
    }
    SECTION("and what is none is said to be none")
    {
        Image image(4, 4);
        write_image(directory / "image.exr", image);
        CHECK(problem(directory / "image.exr") == "it is not a checkpoint or a partial render");
        CHECK(problem(directory / "none.exr") == "no such file");
        CHECK(problem(directory.path()) == "it is a directory");
    }
}
