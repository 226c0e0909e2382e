// SPDX-License-Identifier: MIT
#include "base/text.h"
#include "cli/completion.h"
#include "cli/man_page.h"
#include "cli/verbs.h"
#include "support/catch.h"

using namespace plumb;

namespace {

std::vector<std::string> words_of(const Completions& completions)
{
    std::vector<std::string> words;
    for (const Completion& one : completions.words) words.push_back(one.word);
    return words;
}

using Words = std::vector<std::string>;

// What an option says that it takes, when it gets something else; empty: it does not say.
Words words_it_takes(const Verb& verb, const OptionHelp& option)
{
    Words line;
    if (!verb.name.empty()) line.emplace_back(verb.name);
    line.emplace_back(option.long_name());
    line.emplace_back("?");
    std::string message;
    try {
        verb.parse(line);
    } catch (const UsageError& error) {
        message = error.what();
    }
    const std::string known = "; known are ";
    const std::size_t begin = message.find(known);
    if (begin == std::string::npos) return {};
    std::string list = message.substr(begin + known.size());
    // The variances of layers are not listed one by one.
    if (const std::size_t more = list.find(", and "); more != std::string::npos) list.erase(more);
    if (const std::size_t last = list.find(" and "); last != std::string::npos) list.replace(last, 5, ", ");
    Words words = list_items(list);
    return words;
}

} // namespace

TEST_CASE("words are completed by what may stand there", "[cli][completion]")
{
    CHECK(words_of(complete({"comp"})) == Words{"compare", "completion"});
    CHECK(complete({""}).files); // a scene
    CHECK(words_of(complete({"compare", "--varia"})) == Words{"--variance-of"});
    CHECK(words_of(complete({"s.xml", "--part-by", ""})) == Words{"tiles", "samples"});
    CHECK(words_of(complete({"s.xml", "--part-by=t"})) == Words{"--part-by=tiles"});
    CHECK(words_of(complete({"s.xml", "--part-by", "=", "t"})) == Words{"--part-by=tiles"});
    CHECK(words_of(complete({"s.xml", "--aov", "albedo,dep"})) ==
          Words{"albedo,depth", "albedo,depth_behind", "albedo,depth_z"});
    CHECK(words_of(complete({"schema", ""})) == Words{"rng", "xsd"});
    CHECK(words_of(complete({"completion", "f"})) == Words{"fish"});
    CHECK(words_of(complete({"help", "ag"})) == Words{"agree"});
    CHECK(words_of(complete({"types", "roughcond"})) == Words{"roughconductor"});
    CHECK(complete({"info", ""}).files);
    CHECK(complete({"s.xml", "-o", "x"}).files);
    CHECK_FALSE(complete({"s.xml", "--seed", ""}).files);
    // Once is enough, except where it may be repeated.
    CHECK(words_of(complete({"s.xml", "--seed", "7", "--see"})).empty());
    CHECK(words_of(complete({"s.xml", "-o", "x.exr", "--outp"})) == Words{"--output"});
    CHECK(complete({}).files);
}

TEST_CASE("an option's words are those that it takes", "[cli][completion]")
{
    int checked = 0;
    for (const Verb* verb : all_verbs()) {
        for (const OptionHelp& option : verb->options) {
            if (!option.takes_value()) continue;
            const Words taken = words_it_takes(*verb, option);
            if (taken.empty()) continue;
            CAPTURE(verb->name, option.names);
            Words offered = words_of_option(option.long_name());
            std::erase_if(offered, [](const std::string& word) { return word.starts_with("variance_of_"); });
            CHECK(offered == taken);
            ++checked;
        }
    }
    CHECK(checked > 20);
}

TEST_CASE("every verb has a manual page with all its options", "[cli][man]")
{
    for (const Verb* verb : all_verbs()) {
        CAPTURE(verb->name);
        const std::string page = man_page(*verb);
        CHECK(page.starts_with(".TH \"RENDERER"));
        for (const char* part :
             {".SH NAME\n", ".SH SYNOPSIS\n", ".SH DESCRIPTION\n", ".SH OPTIONS\n", ".SH SEE ALSO\n"})
            CHECK_THAT(page, ContainsSubstring(part));
        for (const OptionHelp& option : verb->options) {
            std::string name(option.long_name());
            for (std::size_t i = name.find('-'); i != std::string::npos; i = name.find('-', i + 2))
                name.replace(i, 1, "\\-");
            CHECK_THAT(page, ContainsSubstring("\\fB" + name + "\\fR"));
        }
    }
}
