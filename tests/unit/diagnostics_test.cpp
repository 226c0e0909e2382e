// SPDX-License-Identifier: MIT
// How much is kept of what is wrong with a file.

#include "plumb/base/error.h"
#include "support/catch.h"

#include <functional>

#include <fmt/format.h>

using namespace plumb;

namespace {

SourceLocation place(int line)
{
    return SourceLocation::from_line("scene.xml", line, "<a/>", 0);
}

std::vector<std::string> messages(const Diagnostics& diagnostics)
{
    std::vector<std::string> messages;
    for (const Diagnostic& found : diagnostics.all()) messages.push_back(found.message);
    return messages;
}

} // namespace

TEST_CASE("of many messages of a kind the first are kept, and the last of them counts the others",
          "[unit][error]")
{
    Diagnostics diagnostics;
    for (int i = 0; i < 798; ++i)
        diagnostics.error(place(i), fmt::format("unknown tag <bogus{}>; did you mean <{}>?", i, i % 7));
    diagnostics.error(place(900), "another error");
    const std::vector<std::string> found = messages(diagnostics);
    REQUIRE(found.size() == 21);
    CHECK(found[0] == "unknown tag <bogus0>; did you mean <0>?");
    CHECK(found[18] == "unknown tag <bogus18>; did you mean <4>?");
    CHECK(found[19] == "unknown tag <bogus19>; did you mean <5>?; and 778 more like it");
    CHECK(found[20] == "another error");
    CHECK(diagnostics.has_errors());
}

TEST_CASE("messages of a kind have the same words around what they quote", "[unit][error]")
{
    const auto kept = [](const std::function<std::string(int)>& message) {
        Diagnostics diagnostics;
        for (int i = 0; i < 100; ++i) diagnostics.error(place(i), message(i));
        return diagnostics.all().size();
    };
    const auto letters = [](int i) {
        return std::string(1, static_cast<char>('a' + i % 26)) +
               std::string(static_cast<std::size_t>(i), 'x');
    };
    CHECK(kept([](int i) { return fmt::format("must be at least 0, not -{}e{}", i, i); }) == 20);
    CHECK(kept([&](int i) { return fmt::format("unknown parameter '{}' for mesh 'obj'", letters(i)); }) ==
          20);
    CHECK(kept([&](int i) { return fmt::format("a <{}> cannot contain a <{}>", letters(i), letters(i)); }) ==
          20);
    CHECK(kept([&](int i) { return fmt::format("${} has no value", letters(i)); }) == 20);
    CHECK(kept([&](int i) { return fmt::format("no such thing; try {}", letters(i)); }) == 20);
    CHECK(kept([&](int i) { return fmt::format("the attribute's {} is odd", letters(i)); }) == 100);
    CHECK(kept([](int i) { return std::string("unclosed ") + (i % 2 == 0 ? "'a" : "<b"); }) == 20);

    Diagnostics diagnostics; // errors and warnings are of different kinds
    for (int i = 0; i < 100; ++i) {
        diagnostics.error(place(i), "odd");
        diagnostics.warning(place(i), "odd");
    }
    CHECK(diagnostics.all().size() == 40);
}

TEST_CASE("notes go with the message that they belong to", "[unit][error]")
{
    Diagnostics diagnostics;
    for (int i = 0; i < 30; ++i) {
        diagnostics.error(place(2 * i), "a second thing");
        diagnostics.note(place(2 * i + 1), "the first is here");
    }
    const auto found = diagnostics.all();
    REQUIRE(found.size() == 40);
    CHECK(found.back().severity == Severity::note);
    CHECK(found.back().location.line == 39);
}

TEST_CASE("messages of a million kinds are bounded, too, and so are long ones", "[unit][error]")
{
    Diagnostics diagnostics;
    for (int i = 0; i < 3000; ++i) {
        std::string word;
        for (int rest = i; rest > 0; rest /= 26) word += static_cast<char>('a' + rest % 26);
        diagnostics.warning(place(i), "odd " + word);
    }
    diagnostics.error(place(1), std::string(100'000, 'x'));
    diagnostics.error(place(2), std::string(1998, '.') + "\u00fc\u00fc");
    const auto found = diagnostics.all();
    CHECK(found.size() == Diagnostics::most_of_a_severity + 2);
    CHECK_THAT(found[Diagnostics::most_of_a_severity - 1].message,
               ContainsSubstring("; and 2000 more of other kinds"));
    CHECK(found[found.size() - 2].message == std::string(Diagnostics::longest_message, 'x') + "...");
    CHECK(found.back().message == std::string(1998, '.') + "\u00fc...");
    CHECK(diagnostics.has_errors());
}

TEST_CASE("an error that is not kept is an error", "[unit][error]")
{
    Diagnostics diagnostics;
    CHECK_FALSE(diagnostics.has_errors());
    for (int i = 0; i < 20; ++i) {
        CHECK(diagnostics.keeps(Severity::error, "odd 'x'"));
        diagnostics.error(place(i), "odd 'y'");
    }
    CHECK_FALSE(diagnostics.keeps(Severity::error, "odd 'x'"));
    CHECK(diagnostics.keeps(Severity::warning, "odd 'x'"));
}

TEST_CASE("what was found in parts counts as if it had been found in one", "[unit][error]")
{
    Diagnostics all;
    for (int part = 0; part < 10; ++part) {
        Diagnostics diagnostics;
        for (int i = 0; i < 25; ++i) {
            diagnostics.error(place(100 * part + i), fmt::format("bad '{}'", i));
            diagnostics.note(place(100 * part + i), "here");
        }
        all.add(diagnostics);
    }
    const auto found = all.all();
    REQUIRE(found.size() == 40);
    CHECK(found[38].message == "bad '19'; and 230 more like it");

    Diagnostics full; // has no room for a new kind
    for (int i = 0; i < 1500; ++i)
        full.error(place(i), "odd " + std::string(static_cast<std::size_t>(i), 'x'));
    full.add(all);
    CHECK_THAT(full.all().back().message, ContainsSubstring("; and 750 more of other kinds"));
}
