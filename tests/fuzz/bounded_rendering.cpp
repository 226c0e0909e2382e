// SPDX-License-Identifier: MIT

// Stands in for src/cli/interrupt.cpp: every rendering is interrupted soon. An input that asks for millions of samples
// takes no longer than another.

#include "cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace plumb {
namespace {

std::atomic<int> questions = 0;

} // namespace

InterruptGuard::InterruptGuard(Interruption)
{
    questions = 0;
}

InterruptGuard::~InterruptGuard() = default;

int InterruptGuard::signal()
{
    constexpr int patience = 8;
    return ++questions > patience ? SIGTERM : 0;
}

} // namespace plumb
