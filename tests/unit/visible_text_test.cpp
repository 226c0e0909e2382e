// SPDX-License-Identifier: MIT

// Names and texts of others never steer a terminal, and never break a report.

#include "base/shell_words.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "plumb/base/error.h"
#include "plumb/reports/suite_report.h"
#include "support/catch.h"

#include <pugixml.hpp>

using namespace plumb;

namespace {

// What a hostile file name may contain: ESC, BEL, DEL, C1 as UTF-8 and as bare bytes, bidi controls, line separators, a
// forged line, U+FFFE and U+FFFF, bytes that are no UTF-8.
const std::string hostile[] = {"\x1b[31mred",
                               "\x07",
                               "\x7f",
                               "\xc2\x9b"
                               "31m",
                               "\x9b"
                               "31m",
                               "\xe2\x80\xae"
                               "gnp",
                               "\xe2\x81\xa6",
                               "\xd8\x9c",
                               "\xe2\x80\xa8",
                               "\xef\xbb\xbf",
                               "a\n::error::forged",
                               "a\r\tb",
                               "\xef\xbf\xbe",
                               "\xef\xbf\xbf",
                               "\xff\xfe",
                               "\xed\xa0\x80",
                               "\xf4\x90\x80\x80",
                               "]]> <!-- -- > & \" '"};

// But for line ends and tabs, which layouts of ours have.
bool is_harmless(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        const std::string_view character = text.substr(0, length);
        if (steers(character) && character != "\n" && character != "\t") return false;
        text.remove_prefix(length);
    }
    return true;
}

// XML 1.0, section 2.2, production [2].
bool is_xml_text(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        const char32_t code = code_point(text.substr(0, length));
        const bool allowed = code == 0x9 || code == 0xa || code == 0xd || (code >= 0x20 && code <= 0xd7ff) ||
                             (code >= 0xe000 && code <= 0xfffd) || code >= 0x10000;
        if (!allowed) return false;
        text.remove_prefix(length);
    }
    return true;
}

SuiteRun run_with(const std::string& name)
{
    SuiteRun run;
    run.suite = name + ".xml";
    run.directory = name;
    for (const JobState state : {JobState::failed, JobState::rendered, JobState::not_run}) {
        SuiteResult result;
        result.title = result.scene = result.reference = name;
        result.command = "renderer " + shell_quote(name);
        result.problem = "error: there is no '" + visible_text(name) + "'\nof any kind";
        result.warnings = {name};
        result.biases = name;
        result.state = state;
        run.results.push_back(result);
    }
    return run;
}

} // namespace

TEST_CASE("visible text shows what would steer a terminal", "[unit][text]")
{
    CHECK(visible_text("Möbius 漢字 \xf0\x9f\x98\x80") == "Möbius 漢字 \xf0\x9f\x98\x80");
    CHECK(visible_text("\x1b[31m\n\x7f") == "\\x1b[31m\\x0a\\x7f");
    CHECK(visible_text("\xc2\x9b") == "\\u009b");
    CHECK(visible_text("\x9b") == "\\x9b");
    CHECK(visible_text("\xe2\x80\xae") == "\\u202e");
    CHECK(visible_text("\xe2\x80") == "\\xe2\\x80");
    for (const std::string& text : hostile) {
        const std::string shown = visible_text(text);
        CHECK(is_harmless(shown));
        CHECK(shown.find('\n') == shown.npos);
    }
}

TEST_CASE("a message and its excerpt steer nothing, whatever the file's name and contents are",
          "[unit][text]")
{
    for (const std::string& text : hostile) {
        const Diagnostic diagnostic{
            Severity::error, SourceLocation::from_line(text + ".xml", 3, "ab" + text + "cd", 2, text.size()),
            "unknown '" + text + "'"};
        const std::string shown = diagnostic.text();
        INFO(shown);
        CHECK(is_harmless(shown));
        CHECK(std::count(shown.begin(), shown.end(), '\n') == 2); // the line, and the marks below it
    }
}

TEST_CASE("a caret stands below what it marks, characters of several bytes before it or not", "[unit][text]")
{
    const Diagnostic diagnostic{
        Severity::error, SourceLocation::from_line("a.xml", 1, "\xc3\xb6\xff\xc2\x9b x y", 6, 1), "no"};
    CHECK(diagnostic.text() == "a.xml:1:7: error: no\n\xc3\xb6?? x y\n    ^");
}

TEST_CASE("words for a shell steer nothing either, and come back", "[unit][text]")
{
    for (const std::string& text : hostile) {
        const std::string quoted = shell_quote(text);
        INFO(visible_text(text));
        CHECK(is_harmless(quoted));
        CHECK(quoted.find('\n') == quoted.npos);
        CHECK(shell_split("a " + quoted + " b") == std::vector<std::string>{"a", text, "b"});
    }
    CHECK(shell_quote("a\nb'") == "$'a\\x0ab\\''");
}

TEST_CASE("reports are well-formed for any name, and steer nothing", "[unit][batch]")
{
    for (const std::string& name : hostile) {
        INFO(visible_text(name));
        const SuiteRun run = run_with(name);
        const std::string junit = suite_junit(run);
        CHECK(is_xml_text(junit));
        CHECK(is_harmless(junit));
        pugi::xml_document document;
        REQUIRE(document.load_string(junit.c_str()));
        const pugi::xml_node suite = document.child("testsuites").child("testsuite");
        CHECK(std::distance(suite.begin(), suite.end()) == 3);
        if (is_xml_text(name)) CHECK(suite.first_child().attribute("name").value() == name);

        CHECK(is_harmless(suite_json(run)));
        CHECK(is_harmless(suite_markdown(run)));
        const std::string markdown = suite_markdown(run);
        CHECK(std::count(markdown.begin(), markdown.end(), '\n') == 9); // one line an image
        CHECK(is_harmless(suite_html(run, ShownImages(1))));
        for (const SuiteResult& result : run.results) {
            const std::string line = result_line(result, 10);
            CHECK(is_harmless(line));
            CHECK(std::count(line.begin(), line.end(), '\n') <= 3);
        }
    }
}
