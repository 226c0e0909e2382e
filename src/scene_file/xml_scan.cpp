// SPDX-License-Identifier: MIT
#include "scene_file/xml_scan.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view xml_blanks = " \t\r\n";

bool is_blank(char c)
{
    return xml_blanks.find(c) != xml_blanks.npos;
}

bool is_name_character(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == ':' || c == '.' || (static_cast<unsigned char>(c) & 0x80u) != 0;
}

bool is_name_start(char c)
{
    return is_name_character(c) && c != '-' && c != '.' && (c < '0' || c > '9');
}

class Scanner {
public:
    Scanner(std::string_view text, const XmlLimits& limits) : text_(text), limits_(limits) {}

    // Throws XmlError, which never leaves this file.
    void scan()
    {
        if (const auto zero = text_.find('\0'); zero != text_.npos)
            fail(zero, 1, "the file contains a zero byte: this is not a text file");
        skip_mark();
        while (at_ < text_.size()) {
            if (text_[at_] == '<')
                scan_markup();
            else
                scan_text();
        }
        if (!open_.empty()) fail(open_.back() - 1, name_at(open_.back()).size() + 1, unclosed(open_.back()));
        if (!has_root_)
            fail(text_.size(), 1, "the file has no root element; a scene file consists of one <scene>");
    }

    // Throws XmlError as well.
    std::string_view root_tag()
    {
        skip_mark();
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
            const std::string_view rest = text_.substr(at_);
            if (!rest.starts_with("<!") && !rest.starts_with("<?"))
                return rest.starts_with('<') ? name_at(at_ + 1) : std::string_view();
            scan_markup();
        }
        return {};
    }

private:
    [[noreturn]] static void fail(std::size_t offset, std::size_t length, std::string message)
    {
        throw XmlError{offset, std::max<std::size_t>(length, 1), std::move(message)};
    }

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skip_mark()
    {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3; // byte order mark
    }

    void count_part(std::size_t offset)
    {
        if (++parts_ > limits_.parts)
            fail(offset, 1, fmt::format("the file has more than {} elements and attributes", limits_.parts));
    }

    void skip_blanks()
    {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }

    std::string_view name_at(std::size_t offset) const
    {
        std::size_t end = offset;
        while (end < text_.size() && is_name_character(text_[end])) ++end;
        return text_.substr(offset, end - offset);
    }

    std::string unclosed(std::size_t offset) const
    {
        return fmt::format("<{0}> is never closed; write </{0}> at its end, or <{0} .../>", name_at(offset));
    }

    void scan_text()
    {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        skip_blanks();
        if (at_ < end && open_.empty())
            fail(at_, 1,
                 has_root_ ? "unexpected text after the end of the root element"
                           : "unexpected text before the root element; is this a scene file?");
        at_ = end;
    }

    void scan_markup()
    {
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("<!--"))
            skip_past("-->", 4, "this comment is never closed; write --> at its end");
        else if (rest.starts_with("<![CDATA["))
            scan_cdata();
        else if (rest.starts_with("<?"))
            skip_past("?>", 2, "this declaration is never closed; write ?> at its end");
        else if (rest.starts_with("<!"))
            skip_doctype();
        else if (rest.starts_with("</"))
            scan_end_tag();
        else
            scan_start_tag();
    }

    void skip_past(std::string_view end, std::size_t start_length, std::string_view message)
    {
        const std::size_t found = text_.find(end, at_ + start_length);
        if (found == text_.npos) fail(at_, start_length, std::string(message));
        at_ = found + end.size();
    }

    void scan_cdata()
    {
        if (open_.empty()) fail(at_, 9, "unexpected text outside the root element");
        skip_past("]]>", 9, "this CDATA section is never closed; write ]]> at its end");
    }

    void skip_doctype()
    {
        const std::size_t start = at_;
        int brackets = 0;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '[') ++brackets;
            if (text_[at_] == ']') --brackets;
            if (text_[at_] == '>' && brackets <= 0) {
                ++at_;
                return;
            }
        }
        fail(start, 2, "this declaration is never closed; write > at its end");
    }

    void scan_end_tag()
    {
        const std::size_t start = at_;
        at_ += 2;
        const std::string_view name = name_at(at_);
        at_ += name.size();
        skip_blanks();
        if (peek() != '>') fail(start, name.size() + 2, fmt::format("expected '>' at the end of </{}", name));
        ++at_;
        if (open_.empty()) fail(start, name.size() + 2, fmt::format("</{}> closes nothing", name));
        const std::size_t opened = open_.back();
        if (name_at(opened) != name)
            fail(start, name.size() + 2,
                 fmt::format("</{}> does not close <{}>, opened at line {}", name, name_at(opened),
                             1 + std::count(text_.begin(),
                                            text_.begin() + static_cast<std::ptrdiff_t>(opened), '\n')));
        open_.pop_back();
    }

    void scan_start_tag()
    {
        const std::size_t start = at_++;
        if (!is_name_start(peek()))
            fail(start, 1, "expected a tag's name after '<'; write &lt; for the sign itself");
        const std::size_t name_offset = at_;
        const std::string_view name = name_at(name_offset);
        at_ += name.size();
        if (open_.empty() && has_root_)
            fail(start, name.size() + 1, fmt::format("<{}> is a second root element; a file has one", name));
        has_root_ = true;
        count_part(start);

        for (std::size_t attributes = 0;; ++attributes) {
            const std::size_t before = at_;
            skip_blanks();
            if (peek() == '>') {
                ++at_;
                open_.push_back(name_offset);
                if (open_.size() > limits_.depth)
                    fail(start, name.size() + 1,
                         fmt::format("elements are nested deeper than {} levels", limits_.depth));
                return;
            }
            if (text_.substr(at_, 2) == "/>") {
                at_ += 2;
                return;
            }
            if (at_ == text_.size() || peek() == '<')
                fail(start, name.size() + 1, fmt::format("expected '>' at the end of <{}", name));
            if (before == at_)
                fail(at_, 1, "expected a blank, '>' or '/>' here; is a quote missing or misplaced?");
            if (attributes == limits_.attributes)
                fail(at_, 1, fmt::format("<{}> has more than {} attributes", name, limits_.attributes));
            count_part(at_);
            scan_attribute();
        }
    }

    void scan_attribute()
    {
        const std::size_t start = at_;
        const std::string_view name = name_at(at_);
        if (!is_name_start(peek())) fail(at_, 1, "expected an attribute, '>' or '/>' here");
        at_ += name.size();
        skip_blanks();
        if (peek() != '=')
            fail(start, name.size(), fmt::format("attribute '{0}' needs a value: {0}=\"...\"", name));
        ++at_;
        skip_blanks();
        const char quote = peek();
        if (quote != '"' && quote != '\'')
            fail(at_, 1, fmt::format("the value of attribute '{0}' needs quotes: {0}=\"...\"", name));
        const std::size_t end = text_.find_first_of(quote == '"' ? "\"<" : "'<", at_ + 1);
        if (end == text_.npos || text_[end] == '<')
            fail(at_, 1, fmt::format("the closing quote of attribute '{}' is missing", name));
        at_ = end + 1;
    }

    std::string_view text_;
    const XmlLimits& limits_;
    std::size_t at_ = 0;
    std::size_t parts_ = 0; // elements and attributes
    bool has_root_ = false;
    std::vector<std::size_t> open_; // offsets of the names of open tags
};

} // namespace

std::optional<XmlError> scan_xml(std::string_view text, const XmlLimits& limits)
{
    try {
        Scanner(text, limits).scan();
        return {};
    } catch (const XmlError& error) {
        return error;
    }
}

std::string_view root_tag(std::string_view text)
{
    try {
        return Scanner(text, {}).root_tag();
    } catch (const XmlError&) {
        return {};
    }
}

} // namespace plumb
