// SPDX-License-Identifier: MIT
#include "plumb/base/error.h"

#include "base/lower_case.h"
#include "base/visible_text.h"

#include <algorithm>

namespace plumb {

namespace {

// Of longer lines only this much on either side of the column is kept: a file may be one line of 100 MB.
constexpr std::size_t kept_bytes = 320;
// Wider lines are shown through a window.
constexpr int max_width = 160;
constexpr int tab_width = 8;

// A line as a terminal shows it: one string a terminal column, tabs expanded, what would steer it made harmless.
struct ShownLine {
    std::vector<std::string> cells;
    int mark_begin = 0; // cells
    int mark_end = 0;
};

ShownLine show(const SourceLocation& at)
{
    ShownLine shown;
    const std::string& text = at.line_text;
    const int begin = at.column - at.line_text_column, end = begin + std::max(at.length, 1);
    const auto cell_count = [&] { return static_cast<int>(shown.cells.size()); };
    for (int i = 0; i < static_cast<int>(text.size());) {
        const std::string_view rest = std::string_view(text).substr(static_cast<std::size_t>(i));
        const std::size_t length = utf8_length(rest);
        const std::string_view character = rest.substr(0, std::max<std::size_t>(length, 1));
        const int next = i + static_cast<int>(character.size());
        if (i <= begin && begin < next) shown.mark_begin = cell_count();
        if (character == "\t")
            shown.cells.resize(
                shown.cells.size() + static_cast<std::size_t>(tab_width - cell_count() % tab_width), " ");
        else
            shown.cells.emplace_back(length == 0 || steers(character) ? "?" : character);
        if (i < end && end <= next) shown.mark_end = cell_count();
        i = next;
    }
    if (begin >= static_cast<int>(text.size())) shown.mark_begin = cell_count();
    if (end > static_cast<int>(text.size())) shown.mark_end = cell_count();
    shown.mark_end = std::max(shown.mark_end, shown.mark_begin + 1);
    return shown;
}

// The line, and below it a caret and tildes.
std::string excerpt(const SourceLocation& at)
{
    const ShownLine shown = show(at);
    const int count = static_cast<int>(shown.cells.size());

    // A window that has the mark a third of the way in.
    int first = 0, last = count;
    if (count > max_width) {
        first = std::clamp(shown.mark_begin - max_width / 3, 0, count - max_width);
        last = first + max_width;
    }
    const bool cut_left = first > 0 || at.line_text_column > 1, cut_right = last < count;

    std::string line = cut_left ? "..." : "", marks(line.size(), ' ');
    for (int i = first; i < last; ++i) line += shown.cells[static_cast<std::size_t>(i)];
    if (cut_right) line += "...";
    marks.append(static_cast<std::size_t>(std::max(shown.mark_begin - first, 0)), ' ');
    marks += '^';
    const int mark_end = std::min(shown.mark_end, std::max(last, shown.mark_begin + 1));
    marks.append(static_cast<std::size_t>(mark_end - shown.mark_begin - 1), '~');
    return line + "\n" + marks;
}

std::string_view to_string(Severity severity)
{
    switch (severity) {
    case Severity::error: return "error";
    case Severity::warning: return "warning";
    case Severity::note: break;
    }
    return "note";
}

std::string joined(const std::vector<Diagnostic>& diagnostics)
{
    std::string result;
    for (const Diagnostic& diagnostic : diagnostics)
        result += (result.empty() ? "" : "\n") + diagnostic.text();
    return result;
}

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, in three rows of the
// table. Upper and lower case count as equal.
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted =
                previous[j - 1] + (lower_case(a[i - 1]) == lower_case(b[j - 1]) ? 0 : 1);
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substituted});
            if (i > 1 && j > 1 && lower_case(a[i - 1]) == lower_case(b[j - 2]) &&
                lower_case(a[i - 2]) == lower_case(b[j - 1]))
                current[j] = std::min(current[j], before[j - 2] + 1);
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

} // namespace

SourceLocation SourceLocation::from_offset(std::string file, std::string_view text, std::size_t offset,
                                           std::size_t length)
{
    offset = std::min(offset, text.size());
    const std::string_view before = text.substr(0, offset);
    const std::size_t newline = before.rfind('\n');
    const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
    const std::size_t end = std::min(text.find('\n', offset), text.size());
    const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    return from_line(std::move(file), line, text.substr(start, end - start), offset - start, length);
}

SourceLocation SourceLocation::from_line(std::string file, int line, std::string_view text,
                                         std::size_t offset, std::size_t length)
{
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
    const std::size_t start = std::min(offset - std::min(offset, kept_bytes), text.size());
    const std::size_t end = std::max(start, std::min(text.size(), offset + kept_bytes));

    SourceLocation at;
    at.file = std::move(file);
    at.line = line;
    at.column = static_cast<int>(offset) + 1;
    at.length = static_cast<int>(std::clamp<std::size_t>(length, 1, end > offset ? end - offset : 1));
    at.line_text = text.substr(start, end - start);
    at.line_text_column = static_cast<int>(start) + 1;
    return at;
}

std::string Diagnostic::text() const
{
    const std::string what = std::string(to_string(severity)) + ": " + visible_text(message);
    if (location.file.empty()) return what;
    std::string place = visible_text(location.file) + ":";
    if (location.line > 0)
        place += std::to_string(location.line) + ":" + std::to_string(location.column) + ":";
    return place + " " + what + (location.line > 0 && !location.hides_line ? "\n" + excerpt(location) : "");
}

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : Error(joined(diagnostics)), diagnostics_(std::move(diagnostics))
{}

std::string_view closest_name(std::string_view word, const std::vector<std::string_view>& candidates)
{
    std::size_t best = std::max<std::size_t>(word.size() / 3, 1) + 1;
    std::string_view closest;
    for (const std::string_view candidate : candidates) {
        const auto [shorter, longer] = std::minmax({word.size(), candidate.size()});
        if (longer - shorter >= best) continue;
        const std::size_t d = distance(word, candidate);
        if (d < best && d < candidate.size()) {
            best = d;
            closest = candidate;
        }
    }
    return closest;
}

std::string way_out(std::string_view word, const std::vector<std::string_view>& candidates)
{
    if (candidates.empty()) return {};
    if (const std::string_view closest = closest_name(word, candidates); !closest.empty())
        return "; did you mean '" + std::string(closest) + "'?";
    std::string list(candidates.front());
    for (std::size_t i = 1; i < candidates.size(); ++i)
        list.append(i + 1 == candidates.size() ? " and " : ", ").append(candidates[i]);
    return (candidates.size() == 1 ? "; known is " : "; known are ") + list;
}

} // namespace plumb
