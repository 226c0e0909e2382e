// SPDX-License-Identifier: MIT
#include "base/terminal_text.h"
#include "cli/verbs.h"
#include "support/catch.h"

#include <algorithm>
#include <sstream>

using namespace plumb;

namespace {

std::size_t longest_line(const std::string& text)
{
    std::istringstream lines(text);
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
    return longest;
}

std::string words_of(const std::string& text)
{
    std::istringstream stream(text);
    std::string all;
    for (std::string word; stream >> word;) all += word + " ";
    return all;
}

} // namespace

TEST_CASE("errors are red and names bold", "[unit][terminal_text]")
{
    CHECK(with_colors("error: cannot write 'a b.exr'") ==
          "\033[1;31merror:\033[0m cannot write \033[1m'a b.exr'\033[0m");
    CHECK(with_colors("s.xml:1:2: warning: it isn't 'x'\n  <x error: 'y'>\n   ^") ==
          "\033[1ms.xml:1:2: \033[0m\033[1;33mwarning:\033[0m it isn't \033[1m'x'\033[0m\n  <x error: 'y'>\n "
          "  ^");
    CHECK(with_colors("no error: nothing") == "no error: nothing");
    CHECK(with_colors("the dog's 'bone") == "the dog's 'bone");
    CHECK(with_colors("").empty());
}

TEST_CASE("help fits the terminal, whatever its width, and says the same", "[unit][terminal_text]")
{
    for (const Verb* verb : all_verbs()) {
        CAPTURE(verb->name);
        const std::string help = help_text(*verb);
        CHECK(longest_line(help) <= 80);
        CHECK(rewrapped(help, 80) == help);
        for (const int columns : {60, 72, 100, 200}) {
            CAPTURE(columns);
            const std::string other = rewrapped(help, columns);
            CHECK(longest_line(other) <= static_cast<std::size_t>(columns));
            CHECK(words_of(other) == words_of(help));
        }
    }
    const std::string option =
        "  -o,--output FILE  write this image: .exr, .hdr, .tif, .png or .jpg; may be\n"
        "                    repeated";
    CHECK(rewrapped(option, 100) ==
          "  -o,--output FILE  write this image: .exr, .hdr, .tif, .png or .jpg; may be repeated\n");
    CHECK(rewrapped(option, 50) == "  -o,--output FILE  write this image: .exr, .hdr,\n"
                                   "                    .tif, .png or .jpg; may be\n"
                                   "                    repeated\n");
}
