// SPDX-License-Identifier: MIT
#include "plumb/base/error.h"

#include <algorithm>
#include <iterator>

namespace plumb {

namespace {

// At most `longest` bytes of it, whole characters.
std::string cut(std::string text, std::size_t longest)
{
    while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0u) == 0x80u) --longest; // of UTF-8
    text.resize(longest);
    return text + "...";
}

// See Diagnostics. Names stand in '...' or <...>, or behind $.
std::string kind_of(Severity severity, std::string_view message)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    std::string kind = std::to_string(static_cast<int>(severity));
    char before = ' ';
    for (std::size_t i = 0; i < message.size() && message[i] != ';'; ++i) {
        const char c = message[i];
        if ((c == '\'' && !is_letter(before)) || c == '<')
            i = std::min(message.find(c == '<' ? '>' : c, i + 1), message.size() - 1);
        else if (c == '$')
            i = std::min(message.find_first_of(" ;", i), message.size()) - 1;
        else if (is_letter(c) || (c == ' ' && before != ' '))
            kind += c;
        before = c;
    }
    return kind;
}

} // namespace

void Diagnostics::unsupported(const SourceLocation& at, std::string message, bool lenient)
{
    const bool had_others = has_other_errors_;
    add(lenient ? Severity::warning : Severity::error, at, std::move(message));
    has_other_errors_ = had_others;
}

void Diagnostics::add(Severity severity, const SourceLocation& at, std::string message)
{
    if (severity == Severity::note && leaves_out_notes_) return;
    if (message.size() > longest_message) message = cut(std::move(message), longest_message);
    has_errors_ = has_errors_ || severity == Severity::error;
    has_other_errors_ = has_other_errors_ || severity == Severity::error;
    std::string key = at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " +
                      std::to_string(static_cast<int>(severity)) + message;
    if (seen_.contains(key)) return;
    if (severity != Severity::note) {
        std::string kind = kind_of(severity, message);
        leaves_out_notes_ = !count(std::move(kind), severity);
        if (leaves_out_notes_) return;
    }
    seen_.insert(std::move(key));
    diagnostics_.push_back({severity, at, std::move(message)});
}

bool Diagnostics::count(std::string kind, Severity severity)
{
    Count& all = severities_[static_cast<std::size_t>(severity)];
    const auto same = kinds_.find(kind);
    if (same != kinds_.end() && same->second.kept >= most_of_a_kind) {
        ++same->second.left_out;
        return false;
    }
    if (all.kept >= most_of_a_severity) {
        ++all.left_out;
        return false;
    }
    for (Count* const counted : {&all, &kinds_[std::move(kind)]}) {
        ++counted->kept;
        counted->last = diagnostics_.size();
    }
    return true;
}

void Diagnostics::add(const Diagnostics& others)
{
    const bool has_others = has_other_errors_ || others.has_other_errors_;
    for (const Diagnostic& other : others.diagnostics_) add(other.severity, other.location, other.message);
    for (const auto& [kind, counted] : others.kinds_) {
        const auto same = kinds_.find(kind); // not there if none of that kind was kept
        const Severity severity = others.diagnostics_[counted.last].severity;
        Count& here = same != kinds_.end() ? same->second : severities_[static_cast<std::size_t>(severity)];
        here.left_out += counted.left_out;
    }
    for (std::size_t i = 0; i < std::size(severities_); ++i)
        severities_[i].left_out += others.severities_[i].left_out;
    has_errors_ = has_errors_ || others.has_errors_;
    has_other_errors_ = has_others;
}

bool Diagnostics::keeps(Severity severity, std::string_view message) const
{
    const auto same = kinds_.find(kind_of(severity, message));
    return severities_[static_cast<std::size_t>(severity)].kept < most_of_a_severity &&
           (same == kinds_.end() || same->second.kept < most_of_a_kind);
}

const std::vector<Diagnostic>& Diagnostics::all() const
{
    shown_ = diagnostics_;
    const auto say = [this](const Count& counted, std::string_view what) {
        if (counted.left_out > 0 && counted.kept > 0)
            shown_[counted.last].message += "; and " + std::to_string(counted.left_out) + std::string(what);
    };
    for (const auto& [kind, counted] : kinds_) say(counted, " more like it");
    for (const Count& counted : severities_) say(counted, " more of other kinds");
    return shown_;
}

} // namespace plumb
