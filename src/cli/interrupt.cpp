// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <unistd.h>

namespace plumb {

namespace {

std::atomic<int> noted = 0; // the signal
std::atomic<bool> came = false;
// So that a signal handler may use them.
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// Those by hand first.
constexpr std::array numbers = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGXCPU};
constexpr std::size_t count_by_hand = 2;
std::array<struct sigaction, numbers.size()> before;
std::size_t caught = 0; // of them

extern "C" void note_signal(int number)
{
    int none = 0;
    if (noted.compare_exchange_strong(none, number)) {
        came = true;
        return;
    }
    if (number == SIGINT || number == SIGTERM || number == SIGQUIT) _exit(128 + none);
}

} // namespace

InterruptGuard::InterruptGuard(Interruption kind)
{
    noted = 0;
    came = false;
    caught = kind == Interruption::by_hand ? count_by_hand : numbers.size();
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    // Of signals that wait together, the first would else be the last one to be noted.
    sigemptyset(&action.sa_mask);
    for (const int number : numbers) sigaddset(&action.sa_mask, number);
    for (std::size_t i = 0; i < caught; ++i) {
        sigaction(numbers[i], nullptr, &before[i]);
        // A shell starts what runs in the background with SIGINT ignored, nohup with SIGHUP, and they mean it. But whoever
        // sends SIGTERM wants an end.
        if (before[i].sa_handler != SIG_IGN || numbers[i] == SIGTERM) sigaction(numbers[i], &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard()
{
    for (std::size_t i = 0; i < caught; ++i) sigaction(numbers[i], &before[i], nullptr);
}

const std::atomic<bool>& InterruptGuard::flag()
{
    return came;
}

int InterruptGuard::signal()
{
    return noted;
}

} // namespace plumb
