// SPDX-License-Identifier: MIT

// Words and placeholders of the commands in suites.

#include "plumb/base/error.h"
#include "suite_file/command_line.h"
#include "support/catch.h"

using namespace plumb;

using Words = std::vector<std::string>;

TEST_CASE("a command is split into words as a shell would, and no more", "[unit][suite]")
{
    CHECK(command_words("") == Words{});
    CHECK(command_words(" \t\n ") == Words{});
    CHECK(command_words("a  b\tc\nd") == Words{"a", "b", "c", "d"});
    CHECK(command_words(R"('a b' "c d" e\ f)") == Words{"a b", "c d", "e f"});
    CHECK(command_words(R"(a'b'"c"d)") == Words{"abcd"});
    CHECK(command_words(R"('' "")") == Words{"", ""});
    CHECK(command_words(R"('\' "\"" \\)") == Words{"\\", "\"", "\\"});
    CHECK(command_words("$HOME `id` $(id) * ? > x | y; z &") ==
          Words{"$HOME", "`id`", "$(id)", "*", "?", ">", "x", "|", "y;", "z", "&"});
    CHECK(command_words("a\\") == Words{"a\\"});
    CHECK_THROWS_AS(command_words("'a"), Error);
    CHECK_THROWS_AS(command_words("a \""), Error);
}

TEST_CASE("placeholders of a command", "[unit][suite]")
{
    CHECK(placeholders_in("{a} {b}{a} {{c}}") == Words{"a", "b"});
    const Placeholders values = {{"a", "x y"}, {"b", "{a}"}};
    CHECK(with_placeholders("-{a}-{b}-{{a}}", values) == "-x y-{a}-{a}");
    CHECK(with_placeholders("", values).empty());
    for (const char* wrong : {"{", "}", "{a", "a}", "{a}}", "{{a}"})
        CHECK_THROWS_AS(with_placeholders(wrong, values), Error);
    CHECK_THROWS_WITH(with_placeholders("{bb}", {{"bc", ""}}),
                      "unknown placeholder '{bb}'; did you mean 'bc'?");
}
