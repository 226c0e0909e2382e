// SPDX-License-Identifier: MIT

// Stands in for src/cli/interrupt.cpp: every rendering is interrupted soon. An input that asks for millions of samples
// takes no longer than another.

#include "cli/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

namespace plumb {
namespace {

std::atomic<bool> came = false;
std::jthread soon;

} // namespace

InterruptGuard::InterruptGuard(Interruption)
{
    came = false;
    soon = std::jthread([](const std::stop_token& end) {
        constexpr int patience = 20;
        for (int i = 0; i < patience && !end.stop_requested(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        came = true;
    });
}

InterruptGuard::~InterruptGuard()
{
    soon = {};
}

const std::atomic<bool>& InterruptGuard::flag()
{
    return came;
}

int InterruptGuard::signal()
{
    return came ? SIGTERM : 0;
}

} // namespace plumb
