// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace plumb {

namespace {

std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free); // so that a signal handler may use it

struct sigaction before_interrupt;
struct sigaction before_terminate;

extern "C" void note_signal(int number)
{
    int none = 0;
    if (!noted.compare_exchange_strong(none, number)) _exit(128 + none);
}

} // namespace

InterruptGuard::InterruptGuard()
{
    noted = 0;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &before_interrupt);
    sigaction(SIGTERM, &action, &before_terminate);
    // A shell starts what runs in the background with SIGINT ignored, and means it.
    if (before_interrupt.sa_handler == SIG_IGN) sigaction(SIGINT, &before_interrupt, nullptr);
}

InterruptGuard::~InterruptGuard()
{
    sigaction(SIGINT, &before_interrupt, nullptr);
    sigaction(SIGTERM, &before_terminate, nullptr);
}

int InterruptGuard::signal()
{
    return noted;
}

} // namespace plumb
