// SPDX-License-Identifier: MIT
#pragma once

// How far a rendering is: a bar on a terminal, a line now and then elsewhere.

#include <string>

namespace plumb {

struct Progress;
class TerminalFrame;

int percent_done(const Progress& progress); // rounded down: 100 means finished
// "42 %, 1.26 M of 3.00 M samples, 0:04, 0:05 left, 5.00 Mrays/s": done, elapsed, remaining.
std::string progress_line(const Progress& progress);
std::string progress_bar(const Progress& progress, int columns); // at most columns - 1 characters

// Whether a plain line is due: not more than one every 10 % nor one every 5 seconds.
class LinePace {
public:
    bool due(const Progress& progress); // if so, it counts as printed

private:
    int next_percent_ = 10;
    double next_seconds_ = 5.0;
};

// Prints to the console, of one rendering or of several after each other; an object's end clears the bar.
class ProgressDisplay {
public:
    // frame: a picture above the bar, or null; only on a terminal. It must outlive this.
    explicit ProgressDisplay(bool quiet, TerminalFrame* frame = nullptr);
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void show(const Progress& progress);
    // Before anything else is printed: the bar goes, and the picture stays above it.
    void make_way();

private:
    TerminalFrame* frame_;
    double next_picture_ = 0.0; // seconds
    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    double next_redraw_ = 0.0; // seconds
    double last_seconds_ = 0.0;
    LinePace pace_;
};

} // namespace plumb
