// SPDX-License-Identifier: MIT
#include "base/shell_words.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "cli/progress.h"
#include "render/sample_text.h"
#include "support/catch.h"

#include <limits>

using namespace plumb;

namespace {

Progress progress(std::uint64_t done, std::uint64_t total, std::uint64_t rays, double seconds)
{
    Progress result;
    result.samples_done = done;
    result.samples_total = total;
    result.rays = rays;
    result.seconds = seconds;
    return result;
}

} // namespace

TEST_CASE("percent is rounded down: 100 means finished", "[unit][progress]")
{
    CHECK(percent_done(progress(0, 1000, 0, 0.0)) == 0);
    CHECK(percent_done(progress(9, 1000, 0, 0.0)) == 0);
    CHECK(percent_done(progress(10, 1000, 0, 0.0)) == 1);
    CHECK(percent_done(progress(999, 1000, 0, 0.0)) == 99);
    CHECK(percent_done(progress(1000, 1000, 0, 0.0)) == 100);
    CHECK(percent_done(progress(0, 0, 0, 0.0)) == 100);
    for (std::uint64_t percent = 0; percent <= 100; ++percent) // 0.29 * 100 is below 29 in double
        CHECK(percent_done(progress(percent, 100, 0, 0.0)) == static_cast<int>(percent));
    // 65535 x 65535 pixels with 2^26 samples each: 100 times that needs more than 64 bits.
    const std::uint64_t most = (std::uint64_t{65535} * 65535) << 26;
    CHECK(percent_done(progress(most - 1, most, 0, 0.0)) == 99);
    CHECK(percent_done(progress(most / 2, most, 0, 0.0)) == 50);
}

TEST_CASE("a progress line says how much, how long and how fast", "[unit][progress]")
{
    CHECK(progress_line(progress(250, 1000, 12345678, 2.0)) ==
          "25 %, 250 of 1.00 k samples, 0:02, 0:06 left, 6.17 Mrays/s");
    CHECK(progress_line(progress(0, 1000, 0, 0.0)) == "0 %, 0 of 1.00 k samples, 0:00, ? left, ? Mrays/s");
}

TEST_CASE("the bar fits the terminal", "[unit][progress]")
{
    const Progress half = progress(500, 1000, 5000000, 1.0);
    const std::string facts = " 50 %  500 of 1.00 k samples, 0:01, 0:01 left, 5.00 Mrays/s";
    CHECK(progress_bar(half, 200) == "[####################....................] " + facts);
    for (const int columns : {0, 1, 2, 20, 40, 63, 64, 75, 76, 80, 100, 300}) {
        const std::string bar = progress_bar(half, columns);
        CHECK(bar.size() <= static_cast<std::size_t>(std::max(columns - 1, 0)));
        if (columns > static_cast<int>(facts.size())) CHECK_THAT(bar, ContainsSubstring(facts));
    }
    CHECK_THAT(progress_bar(progress(999, 1000, 1, 1.0), 200),
               ContainsSubstring(".] ")); // never full too early
    CHECK_THAT(progress_bar(progress(1000, 1000, 1, 1.0), 200), ContainsSubstring("##] 100 %"));
}

TEST_CASE("plain lines come at most every 10 % and every 5 seconds", "[unit][progress]")
{
    SECTION("a fast rendering prints none")
    {
        LinePace pace;
        for (std::uint64_t i = 0; i <= 1000; ++i)
            CHECK_FALSE(pace.due(progress(i, 1000, 0, 0.004 * static_cast<double>(i))));
    }
    SECTION("one of 100 s prints every 10 %")
    {
        LinePace pace;
        std::vector<std::uint64_t> at;
        for (std::uint64_t i = 0; i <= 1000; ++i)
            if (pace.due(progress(i, 1000, 0, 0.1 * static_cast<double>(i)))) at.push_back(i);
        CHECK(at == std::vector<std::uint64_t>{100, 200, 300, 400, 500, 600, 700, 800, 900});
    }
    SECTION("one of 20 s prints no faster than every 5 s")
    {
        LinePace pace;
        std::vector<double> at;
        for (std::uint64_t i = 0; i <= 1000; ++i) {
            const double seconds = 0.02 * static_cast<double>(i);
            if (pace.due(progress(i, 1000, 0, seconds))) at.push_back(seconds);
        }
        REQUIRE(at.size() >= 2);
        CHECK(at.front() >= 5.0);
        for (std::size_t i = 1; i < at.size(); ++i) CHECK(at[i] - at[i - 1] >= 5.0);
    }
}

TEST_CASE("durations are rounded down", "[unit][text]")
{
    CHECK(duration_text(0.0) == "0.000 s");
    CHECK(duration_text(0.9999) == "0.999 s");
    CHECK(duration_text(59.99) == "59.9 s");
    CHECK(duration_text(60.0) == "1:00");
    CHECK(duration_text(3599.9) == "59:59");
    CHECK(duration_text(3609.0) == "1:00:09");
    CHECK(duration_text(std::numeric_limits<double>::infinity()) == "?");
    CHECK(clock_text(0.9) == "0:00");
    CHECK(clock_text(65.9) == "1:05");
    CHECK(clock_text(std::numeric_limits<double>::quiet_NaN()) == "?");
}

TEST_CASE("counts have three digits, rounded down", "[unit][text]")
{
    CHECK(count_text(0) == "0");
    CHECK(count_text(999) == "999");
    CHECK(count_text(1000) == "1.00 k");
    CHECK(count_text(12399) == "12.3 k");
    CHECK(count_text(999999) == "999 k");
    CHECK(count_text(1000000) == "1.00 M");
    CHECK(count_text(18446744073709551615u) == "18.4 E");
    CHECK(rate_text(12399999, 1.0) == "12.3 Mrays/s");
    CHECK(rate_text(1, 0.0) == "? Mrays/s");
}

TEST_CASE("words for a shell and for people", "[unit][text]")
{
    CHECK(shell_quote("a/b-c_1.xml") == "a/b-c_1.xml");
    CHECK(shell_quote("a b") == "'a b'");
    CHECK(shell_quote("it's") == "'it'\\''s'");
    CHECK(shell_quote("") == "''");
    CHECK(shell_quote("$x") == "'$x'");
    CHECK(list_text({}).empty());
    CHECK(list_text({"a"}) == "a");
    CHECK(list_text({"a", "b"}) == "a and b");
    CHECK(list_text({"a", "b", "c"}) == "a, b and c");
    CHECK(visible_text("a\x1b[31m\n") == "a\\x1b[31m\\x0a");
    CHECK(color_text(Color(0.5f, 1.f, std::numeric_limits<float>::quiet_NaN())) == "0.5 1 nan");
}

TEST_CASE("what is not UTF-8 is replaced", "[unit][text]")
{
    const std::string replacement = "\xef\xbf\xbd";
    CHECK(valid_utf8("aé€😀") == "aé€😀");
    CHECK(valid_utf8("a\xff"
                     "b") == "a" + replacement + "b");
    CHECK(valid_utf8("\xc0\x80") == replacement + replacement);                   // an overlong NUL
    CHECK(valid_utf8("\xed\xa0\x80") == replacement + replacement + replacement); // a surrogate
    CHECK(valid_utf8("\xf4\x90\x80\x80") == replacement + replacement + replacement + replacement);
    CHECK(valid_utf8("\xe2\x82") == replacement + replacement); // cut off
}
