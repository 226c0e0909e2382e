// SPDX-License-Identifier: MIT
#pragma once

// Ctrl-C and SIGTERM while a picture is rendered.

namespace plumb {

// While one of these lives, the first of these signals is only noted; the second ends the process at once, with the exit
// code of the first kind: 128 and its number. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    ~InterruptGuard();

    static int signal(); // that came; 0: none
};

} // namespace plumb
