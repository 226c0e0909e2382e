// SPDX-License-Identifier: MIT

// Pictures in a terminal: each text is read again as a terminal reads it.

#include "plumb/display/terminal_picture.h"

#include "cli/terminal_frame.h"
#include "plumb/display/preview.h"
#include "support/catch.h"
#include "support/random.h"

#include <map>

using namespace plumb;

namespace {

ByteImage random_image(int width, int height, std::uint64_t seed)
{
    test::TestRandom random(seed);
    ByteImage image{width, height, 3, {}};
    for (int i = 0; i < 3 * width * height; ++i)
        image.values.push_back(static_cast<std::uint8_t>(256.0 * random.next_double()));
    return image;
}

std::function<const char*(const char*)> terminal(std::map<std::string, std::string> variables)
{
    return [variables = std::move(variables)](const char* name) -> const char* {
        const auto found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
    };
}

std::vector<std::uint8_t> from_base64(const std::string& text)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> count & 255u));
    }
    return bytes;
}

// The image that [2] makes of the text; colours are 0 to 100 there.
ByteImage from_sixel(const std::string& text, int width, int height)
{
    ByteImage image{width, height, 3,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
    std::map<int, std::array<int, 3>> palette;
    std::size_t at = text.find('"');
    const auto number = [&] {
        int value = 0;
        while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])))
            value = 10 * value + (text[at++] - '0');
        return value;
    };
    ++at;
    for (int i = 0; i < 4; ++i, ++at) number();
    --at;
    int x = 0, y = 0, color = 0;
    while (at < text.size() && text[at] != '\033') {
        const char c = text[at++];
        int run = 1;
        if (c == '#') {
            color = number();
            if (at < text.size() && text[at] == ';') {
                ++at;
                REQUIRE(number() == 2); // red, green and blue
                for (int i = 0; i < 3; ++i) {
                    ++at;
                    palette[color][static_cast<std::size_t>(i)] = number();
                }
            }
            continue;
        }
        if (c == '$') {
            x = 0;
            continue;
        }
        if (c == '-') {
            x = 0;
            y += 6;
            continue;
        }
        char sixel = c;
        if (c == '!') {
            run = number();
            sixel = text[at++];
        }
        REQUIRE((sixel >= '?' && sixel <= '~'));
        for (int i = 0; i < run; ++i, ++x)
            for (int bit = 0; bit < 6; ++bit)
                if ((sixel - '?') >> bit & 1) {
                    REQUIRE(x < width);
                    REQUIRE(y + bit < height);
                    for (std::size_t k = 0; k < 3; ++k)
                        image.values[3 * static_cast<std::size_t>((y + bit) * width + x) + k] =
                            static_cast<std::uint8_t>(palette.at(color)[k] * 255 / 100);
                }
    }
    return image;
}

} // namespace

TEST_CASE("half blocks have an upper and a lower pixel in each character", "[unit][display]")
{
    const ByteImage image{2, 3, 3, {255, 0, 0, 0, 255, 0, /**/ 0, 0, 255, 0, 0, 255, /**/ 7, 8, 9, 7, 8, 9}};
    CHECK(half_blocks(image, true) ==
          "\033[38;2;255;0;0m\033[48;2;0;0;255m\u2580\033[38;2;0;255;0m\u2580\033[0m\033[K\r\n"
          "\033[38;2;7;8;9m\033[49m\u2580\u2580\033[0m\033[K\r\n");
    CHECK(half_blocks(image, false) == "\033[38;5;196m\033[48;5;21m\u2580\033[38;5;46m\u2580\033[0m\033[K\r\n"
                                       "\033[38;5;16m\033[49m\u2580\u2580\033[0m\033[K\r\n");
}

TEST_CASE("half blocks of 256 colours keep greys and the mean of others", "[unit][display]")
{
    const ByteImage grey{1, 1, 3, {128, 128, 128}};
    CHECK(half_blocks(grey, false).starts_with("\033[38;5;244m\033[49m")); // 8 + 10 * 12
    const ByteImage color{16, 16, 3, [] {
                              std::vector<std::uint8_t> values;
                              for (int i = 0; i < 256; ++i) values.insert(values.end(), {110, 60, 200});
                              return values;
                          }()};
    const std::string text = half_blocks(color, false);
    double sums[3] = {0.0, 0.0, 0.0};
    std::array<int, 2> code{}; // of both grounds
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (std::size_t ground = 0; ground < 2; ++ground)
            if (text.compare(at, 7, ground == 0 ? "\033[38;5;" : "\033[48;5;") == 0)
                code[ground] = std::stoi(text.substr(at + 7)) - 16;
        if (text.compare(at, 3, "\u2580") != 0) continue;
        constexpr int levels[] = {0, 95, 135, 175, 215, 255};
        for (const int one : code) {
            sums[0] += levels[one / 36];
            sums[1] += levels[one / 6 % 6];
            sums[2] += levels[one % 6];
        }
    }
    CHECK(sums[0] / 256.0 == Approx(110).margin(3.0));
    CHECK(sums[1] / 256.0 == Approx(60).margin(3.0));
    CHECK(sums[2] / 256.0 == Approx(200).margin(3.0));
}

TEST_CASE("kitty gets every byte, in chunks of 4096 at most", "[unit][display]")
{
    const auto [width, height] =
        GENERATE(std::pair{1, 1}, std::pair{7, 5}, std::pair{64, 16}, std::pair{90, 50});
    const ByteImage image = random_image(width, height, 1);
    const std::string text = kitty(image, 12, 6);
    std::string data;
    std::size_t chunks = 0;
    for (std::size_t at = 0; at < text.size(); ++chunks) {
        REQUIRE(text.substr(at, 3) == "\033_G");
        const std::size_t semicolon = text.find(';', at), end = text.find("\033\\", at);
        const std::string keys = text.substr(at + 3, semicolon - at - 3);
        const bool is_last = end + 2 == text.size();
        CHECK(keys.ends_with(is_last ? "m=0" : "m=1"));
        if (chunks == 0)
            CHECK(keys.starts_with("a=T,f=24,s=" + std::to_string(width) + ",v=" + std::to_string(height) +
                                   ",c=12,r=6,"));
        const std::string part = text.substr(semicolon + 1, end - semicolon - 1);
        CHECK(part.size() <= 4096);
        CHECK((is_last || part.size() % 4 == 0));
        data += part;
        at = end + 2;
    }
    CHECK(from_base64(data) == image.values);
}

TEST_CASE("a sixel picture is the image in 216 colours", "[unit][display]")
{
    const auto [width, height] = GENERATE(std::pair{1, 1}, std::pair{13, 6}, std::pair{20, 17});
    const ByteImage image = random_image(width, height, 2);
    const std::string text = sixel(image);
    CHECK(text.starts_with("\0337\033P0;1;0q\"1;1;" + std::to_string(width) + ";" + std::to_string(height) +
                           "#"));
    CHECK(text.ends_with("\033\\\0338"));
    const ByteImage back = from_sixel(text, width, height);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        REQUIRE(std::abs(int(back.values[i]) - int(image.values[i])) <= 51);
}

TEST_CASE("dithering keeps the mean", "[unit][display]")
{
    const int value = GENERATE(0, 10, 51, 77, 128, 200, 255);
    const ByteImage grey{16, 16, 3, std::vector<std::uint8_t>(768, static_cast<std::uint8_t>(value))};
    double sum = 0.0;
    for (const std::uint8_t byte : from_sixel(sixel(grey), 16, 16).values) sum += byte;
    CHECK(sum / 768.0 == Approx(value).margin(3.0));
}

TEST_CASE("what a terminal can draw is told by its environment", "[unit][display]")
{
    using G = TerminalGraphics;
    CHECK(terminal_graphics(terminal({{"TERM", "xterm-256color"}})) == G::blocks);
    CHECK(terminal_graphics(terminal({})) == G::blocks);
    CHECK(terminal_graphics(terminal({{"TERM", "xterm-kitty"}})) == G::kitty);
    CHECK(terminal_graphics(terminal({{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "WezTerm"}})) == G::kitty);
    CHECK(terminal_graphics(terminal({{"TERM", "foot-extra"}})) == G::sixel);
    CHECK(terminal_graphics(terminal({{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "iTerm.app"}})) ==
          G::sixel);
    // Whatever is outside of a multiplexer.
    CHECK(terminal_graphics(terminal({{"TERM", "tmux-256color"}, {"KITTY_WINDOW_ID", "1"}})) == G::blocks);
    CHECK(terminal_graphics(terminal({{"TERM", "xterm-kitty"}, {"TMUX", "/tmp/t"}})) == G::blocks);
    CHECK(has_true_color(terminal({{"COLORTERM", "truecolor"}})));
    CHECK_FALSE(has_true_color(terminal({{"TERM", "xterm-256color"}})));
}

TEST_CASE("a preview is the mean of what each pixel covers, in the window's proportions", "[unit][display]")
{
    Preview preview({10, 20, 40, 20}, {});
    std::vector<float> values; // five channels; 1 in the left half
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x)
            for (int c = 0; c < 5; ++c)
                values.push_back(c < 3 ? (x < 20 ? 1.f : y % 2 == 0 ? 0.4f : 0.f) : 9.f);
    preview.update({10, 20, 40, 20}, values, 5);
    const ByteImage small = preview.picture(10, 100);
    CHECK(small.width == 10);
    CHECK(small.height == 5);
    CHECK(small.values[0] == 255);
    CHECK(small.values[3 * 9] == static_cast<int>(srgb_from_linear(0.2f) * 255.f + 0.5f));
    CHECK(preview.picture(1000, 1000).width == 40); // never larger than it is
    CHECK(preview.picture(1000, 4).width == 8);
    CHECK(preview.picture(1, 1).values.size() == 3);

    // A part changes its pixels alone.
    preview.update({49, 39, 1, 1}, std::vector<float>{1.f, 1.f, 1.f}, 3);
    const ByteImage whole = preview.picture(40, 20);
    CHECK(whole.values[3 * (20 * 40 - 1)] == 255);
    CHECK(whole.values[3 * (20 * 40 - 2)] == 0);
}

TEST_CASE("a frame is drawn again in its place", "[unit][display]")
{
    Preview preview({0, 0, 8, 8}, {});
    TerminalFrame frame(preview, TerminalGraphics::blocks, true);
    const TerminalSize size{80, 24, 10, 20};
    const auto count = [](const std::string& text, const std::string& part) {
        int found = 0;
        for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
        return found;
    };
    const std::string first = frame.draw(size);
    CHECK(first.starts_with("\r\n\n\n\n\033[4A")); // room for four lines
    CHECK(count(first, "\r\n") == 1 + 4);
    const std::string second = frame.draw(size);
    CHECK(second.starts_with("\r\033[4A"));
    CHECK(count(second, "\r\n") == 4);
    frame.leave();
    CHECK(frame.draw(size).starts_with("\r\n\n\n\n\033[4A"));
    // Half of the lines at most.
    CHECK(count(TerminalFrame(preview, TerminalGraphics::blocks, true).draw({80, 4, 10, 20}), "\u2580") ==
          4 * 2);

    const std::string graphics = TerminalFrame(preview, TerminalGraphics::kitty, true).draw(size);
    CHECK(graphics.starts_with("\r\n\033[1A\033_G"));
    CHECK(graphics.ends_with("\r\033[1B"));
}
