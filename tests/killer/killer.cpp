// SPDX-License-Identifier: MIT

// A library to be loaded before all others (LD_PRELOAD) into the renderer: it kills the process, as kill -9 does, at a
// chosen moment of a chosen phase, and leaves a trace of the phases that the process came to.
//
//     PLUMB_KILL=PHASE:N:MOMENT    in the N-th PHASE, from 1; MOMENT: before, half (of what is written), after, or
//                                  microseconds from its beginning
//     PLUMB_KILL_TRACE=FILE        gets a line for each phase that begins
//
// Phases: load (the program has begun), build (Embree builds), pass (Embree has built), write (to a file that will
// be renamed), flush, rename (and the link that keeps the previous generation).

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>

namespace {

template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

[[noreturn]] void die()
{
    kill(getpid(), SIGKILL);
    for (;;) pause();
}

void die_in(long microseconds)
{
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGKILL;
    timer_t timer{};
    itimerspec when{};
    when.it_value = {microseconds / 1000000, microseconds % 1000000 * 1000 + 1};
    if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0 || timer_settime(timer, 0, &when, nullptr) != 0)
        abort();
}

void trace(const char* phase)
{
    const char* const file = std::getenv("PLUMB_KILL_TRACE");
    if (!file) return;
    const int descriptor = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    const std::string line = std::string(phase) + "\n";
    using Write = ssize_t(int, const void*, size_t);
    if (descriptor < 0 || next<Write>("write")(descriptor, line.data(), line.size()) < 0) abort();
    close(descriptor);
}

// The moment in this phase, if it is the one; else "".
std::string moment_of(const char* phase, std::atomic<int>& count)
{
    trace(phase);
    const char* const wanted = std::getenv("PLUMB_KILL");
    const std::string prefix = std::string(phase) + ":" + std::to_string(++count) + ":";
    if (!wanted || std::strncmp(wanted, prefix.c_str(), prefix.size()) != 0) return {};
    const std::string moment = wanted + prefix.size();
    if (moment == "before") die();
    if (moment != "half" && moment != "after") {
        die_in(std::atol(moment.c_str()));
        return {};
    }
    return moment;
}

bool is_regular(int descriptor)
{
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

std::atomic<int> loads;
std::atomic<int> builds;
std::atomic<int> passes;
std::atomic<int> writes;
std::atomic<int> flushes;
std::atomic<int> renames;

const struct Start {
    Start() { moment_of("load", loads); }
} start;

} // namespace

extern "C" {

void rtcCommitScene(void* scene)
{
    moment_of("build", builds);
    next<void(void*)>("rtcCommitScene")(scene);
    moment_of("pass", passes);
}

ssize_t write(int descriptor, const void* bytes, size_t size)
{
    const auto real = next<ssize_t(int, const void*, size_t)>("write");
    if (descriptor <= STDERR_FILENO || !is_regular(descriptor)) return real(descriptor, bytes, size);
    const std::string moment = moment_of("write", writes);
    const ssize_t written = real(descriptor, bytes, moment == "half" ? size / 2 : size);
    if (!moment.empty()) die();
    return written;
}

int fsync(int descriptor)
{
    const std::string moment = moment_of("flush", flushes);
    const int result = next<int(int)>("fsync")(descriptor);
    if (!moment.empty()) die();
    return result;
}

int rename(const char* from, const char* to)
{
    const std::string moment = moment_of("rename", renames);
    const int result = next<int(const char*, const char*)>("rename")(from, to);
    if (!moment.empty()) die();
    return result;
}

int link(const char* from, const char* to)
{
    const std::string moment = moment_of("rename", renames);
    const int result = next<int(const char*, const char*)>("link")(from, to);
    if (!moment.empty()) die();
    return result;
}

} // extern "C"
