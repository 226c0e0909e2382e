// SPDX-License-Identifier: MIT

// The command line, a word a line; quoting for shells; sets of samples as text.

#include "base/shell_words.h"
#include "base/visible_text.h"
#include "cli/verb_file.h"
#include "cli/verbs.h"
#include "fuzz/fuzz.h"
#include "plumb/render/sample_set.h"
#include "plumb/settings/settings_header.h"

using namespace plumb;
using namespace plumb::fuzz;

namespace {

struct Options : VerbOptions {
    RenderSettings settings;
};

OptionTable<Options> table()
{
    OptionTable<Options> all;
    for (const auto& row : setting_rows<RenderSettings>())
        all.push_back(setting_options<Options>(Topic::image, &Options::settings, {row.name}).front());
    return all;
}

std::vector<std::string> lines(std::string_view text)
{
    std::vector<std::string> result;
    for (bool more = true; more;) {
        const std::size_t end = text.find('\n');
        result.emplace_back(text.substr(0, end));
        more = end != std::string_view::npos;
        if (more) text.remove_prefix(end + 1);
    }
    return result;
}

std::string words_text(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += word;
    return text;
}

void try_quoting(const std::vector<std::string>& words)
{
    std::string line;
    for (const std::string& word : words) line += " " + shell_quote(word);
    expect(shell_split(line) == words, "what was quoted is not what is read: " + line);
}

// Of a line that nobody quoted, the words can be quoted.
void try_splitting(std::string_view line)
{
    try_quoting(shell_split(line));
}

void try_samples(const std::string& first, const std::string& second)
{
    const auto a = SampleSet::from_text(first);
    const auto b = SampleSet::from_text(second);
    if (!a || !b || a->blocks().size() + b->blocks().size() > 32) return;
    expect(SampleSet::from_text(a->text()) == a || a->empty(), "a set's text is another set's: " + a->text());
    expect(((*a - *b) | (*a & *b)) == *a, "the parts of a set are not the set");
    expect((*a | *b) == (*b | *a), "the order of a union matters");
    expect((*a - *b).count() + (*a & *b).count() == a->count(), "samples are counted twice, or not at all");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (text_of(data, size).find('\0') != std::string_view::npos) return 0; // no word has one
    const std::vector<std::string> words = lines(text_of(data, size));
    allow_our_errors([&] {
        verb_of(words).parse(words);
        expect_printable(help_text(verb_of(words)));
    });
    allow_our_errors([&] {
        const Options options =
            parse_into<Options>({"", "", "", "scene file", 1, 1}, table(), nullptr, words);
        expect(shell_split(options.typed) == words, "what was given is said to be other words");
        expect(settings_of_header(settings_header(options.settings)) == options.settings ||
                   valid_utf8(words_text(words)) != words_text(words),
               "settings in a header are others");
    });
    try_quoting(words);
    try_splitting(words.front());
    allow_our_errors([&] { try_samples(words.front(), words.back()); });
    return 0;
}
