// SPDX-License-Identifier: MIT
#pragma once

// Signals while an image is rendered.

#include <atomic>

namespace plumb {

// Which signals are told to stop.
enum class Interruption {
    by_hand, // Ctrl-C (SIGINT) and SIGTERM
    by_manager // those, and what terminals and farms send before they kill: SIGHUP, SIGQUIT, SIGUSR1 and SIGXCPU
};

// While one of these lives, the first of its signals is only noted. A second SIGINT, SIGTERM or SIGQUIT ends the process at
// once, with the exit code of the first signal: 128 and its number; the others come in series, without anybody being
// impatient. What was ignored before stays so: nohup means it. One at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(Interruption kind);
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    ~InterruptGuard();

    static int signal();                    // that came; 0: none
    static const std::atomic<bool>& flag(); // whether one came
};

} // namespace plumb
