// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include "base/text.h"
#include "cli/console.h"
#include "cli/terminal_frame.h"
#include "plumb/render/render.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr double redraw_seconds = 0.1;
constexpr double picture_seconds = 0.5;

std::string remaining_text(const Progress& progress)
{
    if (progress.samples_done <= progress.samples_before) return "?";
    const auto done =
        static_cast<double>(progress.samples_done - progress.samples_before); // in these seconds
    const auto left =
        static_cast<double>(progress.samples_total) - static_cast<double>(progress.samples_done);
    return clock_text(progress.seconds * std::max(left, 0.0) / done);
}

std::string facts(const Progress& progress)
{
    return fmt::format("{} of {} samples, {}, {} left, {}", count_text(progress.samples_done),
                       count_text(progress.samples_total), clock_text(progress.seconds),
                       remaining_text(progress), rate_text(progress.rays, progress.seconds));
}

} // namespace

int percent_done(const Progress& progress)
{
    if (progress.samples_done >= progress.samples_total) return 100;
    // 100 times a 64-bit number needs more bits.
    __extension__ typedef unsigned __int128 Wide;
    return static_cast<int>(Wide{progress.samples_done} * 100 / progress.samples_total);
}

std::string progress_line(const Progress& progress)
{
    return fmt::format("{} %, {}", percent_done(progress), facts(progress));
}

std::string progress_bar(const Progress& progress, int columns)
{
    const int percent = percent_done(progress);
    std::string text = fmt::format("{:3} %  {}", percent, facts(progress));
    const auto room = static_cast<std::size_t>(std::max(columns - 1, 0));
    constexpr std::size_t widest = 40;
    constexpr std::size_t narrowest = 10;
    if (room >= text.size() + 3 + narrowest) {
        const std::size_t width = std::min(room - text.size() - 3, widest);
        const std::size_t full = width * static_cast<std::size_t>(percent) / 100;
        text = "[" + std::string(full, '#') + std::string(width - full, '.') + "] " + text;
    }
    return text.substr(0, room);
}

bool LinePace::due(const Progress& progress)
{
    const int percent = percent_done(progress);
    if (percent < next_percent_ || percent == 100 || progress.seconds < next_seconds_) return false;
    next_percent_ = (percent / 10 + 1) * 10;
    next_seconds_ = progress.seconds + 5.0;
    return true;
}

ProgressDisplay::ProgressDisplay(bool quiet, TerminalFrame* frame)
    : frame_(frame), quiet_(quiet), terminal_(!quiet && log_is_terminal())
{}

ProgressDisplay::~ProgressDisplay()
{
    if (frame_ && drawn_) draw_on_terminal(frame_->draw(terminal_size())); // the last one stays
    make_way();
}

void ProgressDisplay::make_way()
{
    if (drawn_) redraw_line("");
    if (frame_) frame_->leave();
}

void ProgressDisplay::show(const Progress& progress)
{
    if (quiet_) return;
    if (progress.seconds < last_seconds_) { // another rendering
        next_redraw_ = next_picture_ = 0.0;
        pace_ = {};
    }
    last_seconds_ = progress.seconds;
    if (!terminal_) {
        if (pace_.due(progress)) print_log(progress_line(progress));
        return;
    }
    if (progress.seconds < next_redraw_) return;
    next_redraw_ = progress.seconds + redraw_seconds;
    drawn_ = true;
    if (frame_ && progress.seconds >= next_picture_) {
        next_picture_ = progress.seconds + picture_seconds;
        draw_on_terminal(frame_->draw(terminal_size()));
    }
    redraw_line(progress_bar(progress, terminal_columns()));
}

} // namespace plumb
