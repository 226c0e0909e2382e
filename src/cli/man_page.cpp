// SPDX-License-Identifier: MIT
#include "cli/man_page.h"

#include "base/text.h"
#include "cli/verbs.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// A line of text, of which nothing is a request or an escape. groff_char(7): \- is the sign that options begin with.
std::string roff(std::string_view text)
{
    std::string line;
    for (const char c : text) {
        if (c == '\\')
            line += "\\e";
        else if (c == '-')
            line += "\\-";
        else
            line += c;
    }
    if (line.starts_with('.') || line.starts_with('\'')) line.insert(0, "\\&");
    return line;
}

std::string bold(std::string_view text)
{
    return fmt::format("\\fB{}\\fR", roff(text));
}

std::string italic(std::string_view text)
{
    return text.empty() ? "" : fmt::format("\\fI{}\\fR", roff(text));
}

// Paragraphs of help. Indented lines, and lists in columns, keep their line ends.
std::string paragraphs(std::string_view text)
{
    std::string page;
    bool literal = false, open = false;
    for (; !text.empty(); text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1)) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (line.empty()) {
            open = false;
            continue;
        }
        const bool indented = line.starts_with(' ');
        if (!open || indented != literal) {
            if (literal) page += ".fi\n.RE\n";
            if (!page.empty()) page += ".PP\n"; // a section begins with a paragraph by itself
            if (indented) page += ".RS 4\n.nf\n";
        }
        literal = indented;
        open = true;
        page +=
            roff(indented ? line.substr(std::min<std::size_t>(line.find_first_not_of(' '), 4)) : line) + "\n";
    }
    if (literal) page += ".fi\n.RE\n";
    return page;
}

std::string option_text(const OptionHelp& option)
{
    std::string names;
    for (const std::string& name : list_items(option.names))
        names += (names.empty() ? "" : ", ") + bold(name);
    if (option.value_is_optional)
        names += fmt::format("[={}]", italic(option.value));
    else if (option.takes_value())
        names += " " + italic(option.value);
    std::string help;
    for (const std::string& line : lines_of(option.help)) help += roff(line) + "\n";
    return fmt::format(".TP\n{}\n{}", names, help);
}

std::string section(std::string_view name, const std::string& text)
{
    return text.empty() ? "" : fmt::format(".SH {}\n{}", name, text);
}

std::string verbs_text()
{
    std::string text;
    for (const Verb* one : all_verbs())
        if (!one->name.empty())
            text += fmt::format(".TP\n{} {}\n{}\n", bold(fmt::format("renderer {}", one->name)),
                                italic(one->arguments), roff(one->summary));
    return text;
}

// A page that states no exit codes of its own.
constexpr std::string_view usual_exit_status =
    "0: done; 1: the scene, a file or the machine is at fault, and the error\n"
    "says where; 2: wrong usage.\n";

} // namespace

std::string man_name(const VerbHelp& verb)
{
    return verb.name.empty() ? "renderer" : fmt::format("renderer-{}", verb.name);
}

std::string man_page(const Verb& verb)
{
    const std::string name = man_name(verb);
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string page = fmt::format(".TH \"{}\" 1 \"\" \"Plumb {}\"\n", roff(title), PLUMB_VERSION);
    page += section("NAME", fmt::format("{} \\- {}\n", roff(name), roff(verb.summary)));
    page += section("SYNOPSIS",
                    fmt::format("{} {}\n",
                                bold(fmt::format("renderer{}{}", verb.name.empty() ? "" : " ", verb.name)),
                                italic(verb.arguments)));
    page += section("DESCRIPTION",
                    verb.manual.empty() ? fmt::format("{}.\n", roff(verb.summary)) : paragraphs(verb.manual));
    if (verb.name.empty()) page += section("VERBS", verbs_text());
    std::string options;
    for (const OptionHelp& option : verb.options) options += option_text(option);
    page += section("OPTIONS", options);
    if (verb.manual.find("Exit code") == std::string::npos)
        page += section("EXIT STATUS", std::string(usual_exit_status));
    std::string others;
    for (const Verb* one : all_verbs())
        if (one->name != verb.name)
            others += fmt::format("{}.BR {} (1)", others.empty() ? "" : " ,\n", roff(man_name(*one)));
    page += section("SEE ALSO", others + "\n");
    return page;
}

} // namespace plumb
