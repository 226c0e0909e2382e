// SPDX-License-Identifier: MIT

// Headers of images and state files that somebody has written by hand: whatever they say, the verbs that read them do what
// they do for good ones or end with an error that names the file; they write nothing that the command line does not name,
// and nothing of it steers a terminal.

#include "base/temporary_file.h"
#include "base/visible_text.h"
#include "cli/small_scene.h"
#include "cli/verbs.h"
#include "image/image_words.h"
#include "plumb/base/error.h"
#include "plumb/base/hash.h"
#include "plumb/render/state_file.h"
#include "plumb/settings/settings_header.h"
#include "support/catch.h"

#include <bit>
#include <fcntl.h>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <unistd.h>

using namespace plumb;

namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();
const std::string control = "\x1b[31m\x07\xc2\x9b"
                            "31m\xe2\x80\xae\n::error::forged";

std::vector<MetadataValue> hostile_values()
{
    return {-1,
            0,
            std::numeric_limits<int>::max(),
            std::numeric_limits<int>::min(),
            nan,
            std::numeric_limits<float>::infinity(),
            -1.f,
            std::vector<float>(16, nan),
            std::string("x"),
            std::string("-1"),
            std::string("99999999999999999999"),
            std::string("nan nan nan nan nan nan nan nan"),
            std::string("0,0,65536,65536:0-67108864"),
            std::string("7,5,2,1:0-4"),
            std::string("--spp"),
            std::string("-o stolen.exr"),
            std::string("--checkpoint stolen.exr"),
            std::string("'"),
            std::string(30000, 'A'),
            control};
}

std::string text_of(const MetadataValue& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) return visible_text(text->substr(0, 40));
    if (const auto* integer = std::get_if<int>(&value)) return std::to_string(*integer);
    if (const auto* number = std::get_if<float>(&value)) return std::to_string(*number);
    return "floats";
}

struct Outcome {
    int code = 0; // as main() makes it of what is thrown
    std::string said;
};

// Runs a verb here, for a process each would take minutes.
Outcome run_here(const TempDirectory& directory, const Names& words)
{
    const std::string file = (directory / "said").string();
    const int capture = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::fflush(stdout);
    const int out = dup(1);
    const int err = dup(2);
    dup2(capture, 1);
    dup2(capture, 2);
    Outcome outcome;
    std::string problem;
    try {
        outcome.code = verb_of(words).parse(words)();
    } catch (const UsageError& error) {
        outcome.code = 2;
        problem = error.what();
    } catch (const Error& error) {
        outcome.code = 1;
        problem = error.what();
    } // nothing else
    std::fflush(stdout);
    dup2(out, 1);
    dup2(err, 2);
    for (const int descriptor : {capture, out, err}) close(descriptor);
    outcome.said = read_bytes(file) + visible_text(problem);
    std::filesystem::remove(file);
    return outcome;
}

void check_outcome(const TempDirectory& directory, const Outcome& outcome, const std::string& file)
{
    INFO(outcome.said);
    CHECK((outcome.code == 0 || outcome.code == 1 || outcome.code == 3 || outcome.code == 4));
    std::string shown = outcome.said;
    CHECK(shown.find("\n::error") == shown.npos);
    std::erase(shown, '\n');
    CHECK(visible_text(shown) == shown);
    if (outcome.code == 1)
        CHECK((shown.find(file) != shown.npos || shown.find("the scene has changed") != shown.npos));
    CHECK_FALSE(std::filesystem::exists(directory / "stolen.exr"));
    CHECK_FALSE(std::filesystem::exists("stolen.exr"));
}

void set(Metadata& header, const std::string& name, MetadataValue value)
{
    std::erase_if(header, [&](const auto& entry) { return entry.first == name; });
    header.emplace_back(name, std::move(value));
}

// As Plumb 0.1 wrote its settings.
void set_arguments(Metadata& header, const std::string& arguments)
{
    std::erase_if(header, [](const auto& entry) { return is_settings_entry(entry.first); });
    set(header, "plumb:arguments", arguments);
}

// A small image, and a state file of half of it.
struct HostileDirectory : TempDirectory {
    HostileDirectory()
    {
        write("scene.xml", small_scene());
        REQUIRE(run({"(scene)", "--size", "8x6", "--spp", "4", "--quiet", "-o", "(good.exr)"}).code == 0);
        REQUIRE(run({"(scene)", "--size", "8x6", "--spp", "4", "--quiet", "--part", "1/2", "-o",
                     "(good.state.exr)"})
                    .code == 0);
    }
    // "(a.exr)": in this directory.
    Outcome run(Names words) const
    {
        for (std::string& word : words)
            if (word.starts_with('('))
                word = (*this / (word == "(scene)" ? "scene.xml" : word.substr(1, word.size() - 2))).string();
        return run_here(*this, words);
    }
};

// What header.h lists, with what the image at hand does not have.
std::vector<std::string> image_keys(const Metadata& header)
{
    std::vector<std::string> keys = {"plumb:arguments",   "plumb:set.define",   "plumb:set.output",
                                     "plumb:stop",        "plumb:samplesTaken", "plumb:biases",
                                     "plumb:model",       "plumb:errorBars",    "plumb:samplerTotal",
                                     "plumb:definitions", "plumb:leftOutFirst"};
    for (const auto& [name, value] : header)
        if ((name.starts_with("plumb:") || name == "Software" || name == "worldToCamera") &&
            std::find(keys.begin(), keys.end(), name) == keys.end())
            keys.push_back(name);
    return keys;
}

// As state_file.cpp makes it: a forger can.
std::string state_hash(const WordImage& image, const std::vector<std::uint32_t>& words)
{
    std::map<std::string, MetadataValue> entries;
    for (const auto& entry : image.metadata)
        if ((entry.first.starts_with("plumb:") && entry.first != "plumb:stateHash") ||
            entry.first == "Software" || entry.first == "worldToCamera")
            entries.insert(entry);
    Hash128 hash;
    const auto bits = [](float value) { return fmt::format("{:x}", std::bit_cast<std::uint32_t>(value)); };
    for (const auto& [name, value] : entries) {
        if (value == MetadataValue(std::string())) continue;
        std::string text = name + "=";
        if (const auto* integer = std::get_if<int>(&value))
            text += std::to_string(*integer);
        else if (const auto* number = std::get_if<float>(&value))
            text += bits(*number);
        else if (const auto* string = std::get_if<std::string>(&value))
            text += *string;
        else
            for (const float element : std::get<std::vector<float>>(value)) text += bits(element) + " ";
        hash.update(text + "\n");
    }
    for (const std::string& name : image.word_channels) hash.update(name + "\n");
    const std::size_t row = image.words_per_row();
    for (std::size_t at = 0; at < words.size(); at += row) {
        Hash128 of_row;
        of_row.update({reinterpret_cast<const char*>(words.data() + at), row * sizeof(std::uint32_t)});
        hash.update(of_row.hex());
    }
    return hash.hex();
}

// The order of state_file.h, not that of the file.
std::vector<std::string> in_order(const std::vector<std::string>& channels)
{
    std::vector<std::string> all;
    const auto add = [&](const std::string& kind) {
        for (const char channel : {'R', 'G', 'B'})
            for (int word = 0; word < 4; ++word) all.push_back(fmt::format("{}.{}.{}", kind, channel, word));
    };
    add("sum");
    add("squares");
    all.insert(all.end(), {"count", "contributing"});
    add("large");
    std::erase_if(all, [&](const std::string& name) {
        return std::find(channels.begin(), channels.end(), name) == channels.end();
    });
    return all;
}

// The file again with another header, and a hash that says that all is well.
void forge_state(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<void(WordImage&, std::vector<std::uint32_t>&)>& change)
{
    WordImage image;
    std::vector<std::uint32_t> words;
    read_words(
        from,
        [&](const WordImage& header) {
            image = header;
            image.float_channels = {"R", "G", "B"};
            image.word_channels = in_order(header.word_channels);
            std::vector<std::string> names = image.float_channels;
            names.insert(names.end(), image.word_channels.begin(), image.word_channels.end());
            return names;
        },
        [&](int, std::span<const std::uint32_t> row) { words.insert(words.end(), row.begin(), row.end()); });
    std::erase_if(image.metadata, [](const auto& entry) {
        return !entry.first.starts_with("plumb:") && entry.first != "Software" &&
               entry.first != "worldToCamera";
    });
    change(image, words);
    set(image.metadata, "plumb:stateHash", state_hash(image, words));
    const std::size_t row = image.words_per_row();
    TemporaryFile file(to);
    file.write(std::span<const unsigned char>(
        encode_words(image, [&](int top, int count, std::span<std::uint32_t> rows) {
            std::copy_n(words.begin() +
                            static_cast<std::ptrdiff_t>(static_cast<std::size_t>(top - image.data.y) * row),
                        static_cast<std::size_t>(count) * row, rows.begin());
        })));
    file.take_place();
}

} // namespace

TEST_CASE("an image's header is untrusted, whatever reads it", "[cli][hostile]")
{
    const HostileDirectory directory;
    const Image good = read_image(directory / "good.exr", false);
    for (const std::string& key : image_keys(good.metadata)) {
        for (const MetadataValue& value : hostile_values()) {
            Image bad = read_image(directory / "good.exr", false);
            set(bad.metadata, key, value);
            write_image(directory / "bad.exr", bad);
            INFO(key << " = " << text_of(value));
            for (const Names& words :
                 {Names{"rerun", "(bad.exr)", "-o", "(again.exr)"}, Names{"info", "(bad.exr)"},
                  Names{"compare", "(bad.exr)", "(good.exr)", "--flip", "none"}})
                check_outcome(directory, directory.run(words), "bad.exr");
        }
    }
}

TEST_CASE("samples outside the image are refused", "[cli][hostile]")
{
    const HostileDirectory directory;
    for (const char* samples : {"8,6,1,1:0-4", "60000,60000,8,6:0-4", "0,0,65536,65536:0-4", "0,0,9,6:0-4",
                                "0,0,8,7:0-4", "0,0,8,6:0-4 8,0,1,1:0-1"}) {
        Image bad = read_image(directory / "good.exr", false);
        set(bad.metadata, "plumb:samplesTaken", std::string(samples));
        write_image(directory / "bad.exr", bad);
        const Outcome outcome = directory.run({"rerun", "(bad.exr)", "-o", "(again.exr)"});
        CHECK(outcome.code == 1);
        CHECK_THAT(
            outcome.said,
            ContainsSubstring("bad.exr' is invalid: plumb:samplesTaken has samples outside the image"));
        CHECK_FALSE(std::filesystem::exists(directory / "again.exr"));
    }
}

TEST_CASE("options in a header that do not change the image are refused", "[cli][hostile]")
{
    const HostileDirectory directory;
    for (const char* arguments :
         {"--spp 4 --checkpoint stolen.exr --checkpoint-every 1s", "--spp 4 -o stolen.exr --part 1/1",
          "--json stolen.exr", "--bogus", "'", "--help", "--version", "--threads 1000", "--quiet",
          "other.xml", "-- other.xml"}) {
        Image bad = read_image(directory / "good.exr", false);
        set_arguments(bad.metadata, arguments);
        write_image(directory / "bad.exr", bad);
        forge_state(directory / "good.state.exr", directory / "bad.state.exr",
                    [&](WordImage& image, auto&) { set_arguments(image.metadata, arguments); });
        INFO(arguments);
        for (const Names& words :
             {Names{"rerun", "(bad.exr)", "-o", "(again.exr)"},
              Names{"merge", "(bad.state.exr)", "-o", "(again.exr)", "--allow-missing"}}) {
            const Outcome outcome = directory.run(words);
            CHECK(outcome.code == 1);
            check_outcome(directory, outcome, words[1].substr(1, words[1].size() - 2));
            CHECK_THAT(outcome.said, ContainsSubstring("is invalid: plumb:arguments: "));
            CHECK_FALSE(std::filesystem::exists(directory / "again.exr"));
        }
    }
}

TEST_CASE("the options in headers of Plumb 0.1 are read and written as settings", "[cli][hostile]")
{
    const HostileDirectory directory;
    const std::string arguments = "--size 8x6 --spp 4";
    Image old = read_image(directory / "good.exr", false);
    set_arguments(old.metadata, arguments);
    write_image(directory / "old.exr", old);
    REQUIRE(directory.run({"rerun", "(old.exr)", "-o", "(again.exr)"}).code == 0);
    CHECK(read_bytes(directory / "again.exr") == read_bytes(directory / "good.exr"));

    forge_state(directory / "good.state.exr", directory / "old.state.exr",
                [&](WordImage& image, auto&) { set_arguments(image.metadata, arguments); });
    const auto merged = [&](const char* part, const char* image) {
        REQUIRE(directory.run({"merge", part, "--allow-missing", "-o", image}).code == 0);
        return read_bytes(directory / std::string(image).substr(1, std::string(image).size() - 2));
    };
    CHECK(merged("(old.state.exr)", "(a.exr)") == merged("(good.state.exr)", "(b.exr)"));
}

TEST_CASE("settings in a header that are none of an image are refused", "[cli][hostile]")
{
    const HostileDirectory directory;
    for (const auto& [name, value, problem] : std::vector<std::tuple<const char*, const char*, const char*>>{
             {"plumb:set.output", "stolen.exr", "plumb:set.output is not a setting of an image"},
             {"plumb:set.spp", "0", "plumb:set.spp must be an integer from 1 to 67108864, not '0'"},
             {"plumb:settings", "2", "plumb:settings must be an integer from 2"},
             {"plumb:arguments", "--spp 4", "plumb:settings and plumb:arguments cannot be used together"}}) {
        Image bad = read_image(directory / "good.exr", false);
        set(bad.metadata, name, std::string(value));
        write_image(directory / "bad.exr", bad);
        forge_state(directory / "good.state.exr", directory / "bad.state.exr",
                    [&, key = name, text = value](WordImage& image, auto&) {
                        set(image.metadata, key, std::string(text));
                    });
        for (const Names& words :
             {Names{"rerun", "(bad.exr)", "-o", "(again.exr)"},
              Names{"merge", "(bad.state.exr)", "-o", "(again.exr)", "--allow-missing"}}) {
            const Outcome outcome = directory.run(words);
            CHECK(outcome.code == 1);
            check_outcome(directory, outcome, words[1].substr(1, words[1].size() - 2));
            CHECK_THAT(outcome.said, ContainsSubstring(std::string("is invalid: ") + problem));
            CHECK_FALSE(std::filesystem::exists(directory / "again.exr"));
        }
    }
}

TEST_CASE("hashes of Plumb 0.1 are said to be so", "[cli][hostile]")
{
    const HostileDirectory directory;
    const std::string old(32, '7');
    Image bad = read_image(directory / "good.exr", false);
    set(bad.metadata, "plumb:inputHash", old);
    set(bad.metadata, "plumb:inputs", old + " scene.xml");
    write_image(directory / "bad.exr", bad);
    const Outcome rerun = directory.run({"rerun", "(bad.exr)", "-o", "(again.exr)"});
    CHECK(rerun.code == 1);
    CHECK_THAT(rerun.said, ContainsSubstring("hashes of Plumb 0.1, not by SHA-256"));
    CHECK(directory.run({"info", "(bad.exr)"}).code == 0);
}

TEST_CASE("a state's header is untrusted, whatever reads it", "[cli][hostile]")
{
    const HostileDirectory directory;
    std::vector<std::string> keys = {"plumb:workBiases", "plumb:workModel", "plumb:workStop"};
    forge_state(directory / "good.state.exr", directory / "same.state.exr", [&](WordImage& image, auto&) {
        for (const auto& [name, value] : image.metadata) keys.push_back(name);
    });
    REQUIRE(directory.run({"merge", "(same.state.exr)", "--allow-missing", "-o", "(again.exr)"}).code == 0);
    for (const std::string& key : keys) {
        if (key == "plumb:stateHash") continue;
        for (const MetadataValue& value : hostile_values()) {
            forge_state(directory / "good.state.exr", directory / "bad.state.exr",
                        [&](WordImage& image, auto&) { set(image.metadata, key, value); });
            INFO(key << " = " << text_of(value));
            check_outcome(directory,
                          directory.run({"merge", "(bad.state.exr)", "--allow-missing", "-o", "(again.exr)"}),
                          "bad.state.exr");
            check_outcome(
                directory,
                directory.run({"merge", "(good.state.exr)", "(bad.state.exr)", "-o", "(again.exr)"}),
                "bad.state.exr");
            check_outcome(directory,
                          directory.run({"(scene)", "--size", "8x6", "--spp", "4", "--part", "1/2",
                                         "--resume", "-o", "(bad.state.exr)"}),
                          "bad.state.exr");
            std::filesystem::remove(directory / "bad.state.previous.exr");
        }
    }
}

TEST_CASE("sums that no samples can have are refused", "[cli][hostile]")
{
    const HostileDirectory directory;
    for (const std::uint32_t word : {0x7fffffffu, 0x80000000u, 0xffffffffu, 5u}) {
        forge_state(
            directory / "good.state.exr", directory / "bad.state.exr", [&](WordImage& image, auto& words) {
                const auto count = std::find(image.word_channels.begin(), image.word_channels.end(), "count");
                REQUIRE(count != image.word_channels.end());
                words[3 + static_cast<std::size_t>(count - image.word_channels.begin())] = word;
            });
        const Outcome outcome =
            directory.run({"merge", "(bad.state.exr)", "--allow-missing", "-o", "(again.exr)"});
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.said, ContainsSubstring("its sums do not fit its samples"));
    }
}
