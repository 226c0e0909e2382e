// SPDX-License-Identifier: MIT
#include "base/child_process.h"

#include "base/child_memory.h"
#include "base/memory.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plumb {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_output = 16384; // bytes that are kept
constexpr double grace_seconds = 2.0;         // from SIGTERM to SIGKILL
constexpr int poll_milliseconds = 20;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { reset(); }
    int number() const { return number_; }
    void reset(int number = -1)
    {
        if (number_ >= 0) close(number_);
        number_ = number;
    }

private:
    int number_;
};

struct Pipe {
    Descriptor out, in;
    Pipe()
    {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0)
            throw Error(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
        out.reset(ends[0]);
        in.reset(ends[1]);
    }
};

// What execve() takes.
class Strings {
public:
    explicit Strings(const std::vector<std::string>& texts) : texts_(texts)
    {
        for (std::string& text : texts_) pointers_.push_back(text.data());
        pointers_.push_back(nullptr);
    }
    char* const* data() const { return pointers_.data(); }

private:
    std::vector<std::string> texts_;
    std::vector<char*> pointers_;
};

std::vector<std::string> environment_with(const std::vector<std::string>& added)
{
    std::vector<std::string> all = added;
    for (char** variable = environ; *variable; ++variable) {
        const std::string_view text = *variable;
        const std::string_view name = text.substr(0, text.find('=') + 1);
        if (std::none_of(added.begin(), added.end(), [&](const auto& one) { return one.starts_with(name); }))
            all.emplace_back(text);
    }
    return all;
}

// In the new process, between fork() and exec(): nothing here may take a lock or memory.
[[noreturn]] void become(const char* program, char* const* words, char* const* variables,
                         const char* directory, pid_t parent, int output, int problem)
{
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    for (const int number : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        sigaction(number, &usual, nullptr);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = open("/dev/null", O_RDONLY);
    if (getppid() == parent && nothing >= 0 && dup2(nothing, 0) == 0 && dup2(output, 1) == 1 &&
        dup2(output, 2) == 2 && chdir(directory) == 0) {
#ifdef SYS_close_range
        constexpr unsigned close_on_exec = 4; // CLOSE_RANGE_CLOEXEC
        syscall(SYS_close_range, 3U, ~0U, close_on_exec);
#endif
        execve(program, words, variables);
    }
    const int number = errno;
    if (write(problem, &number, sizeof number) < 0) _exit(126);
    _exit(127);
}

class Child {
public:
    explicit Child(const ChildOptions& options) : options_(options)
    {
        const Strings words(options.words), variables(environment_with(options.environment));
        Pipe problem;
        const pid_t parent = getpid();
        process_ = fork();
        if (process_ == 0)
            become(options.program.c_str(), words.data(), variables.data(), options.directory.c_str(), parent,
                   output_.in.number(), problem.in.number());
        if (process_ < 0) fail(errno);
        setpgid(process_, process_); // whoever of both comes first
        output_.in.reset();
        problem.in.reset();
        int number = 0;
        ssize_t got = 0;
        do {
            got = read(problem.out.number(), &number, sizeof number);
        } while (got < 0 && errno == EINTR);
        if (got != sizeof number) return;
        waitpid(process_, nullptr, 0);
        fail(number);
    }

    ChildRun run()
    {
        fcntl(output_.out.number(), F_SETFL, O_NONBLOCK);
        bool is_told = false;
        double told = 0.0;
        while (!has_ended()) {
            pollfd readable{output_.out.number(), POLLIN, 0};
            poll(is_open_ ? &readable : nullptr, is_open_ ? 1 : 0, poll_milliseconds);
            read_output();
            memory_ = std::max(memory_, peak_memory_below(process_));
            const double now = seconds_since(start_);
            if (!is_told && (now > options_.timeout || (options_.stop && *options_.stop))) {
                run_.end = now > options_.timeout ? ChildRun::End::timed_out : ChildRun::End::stopped;
                is_told = true;
                told = now;
                kill(-process_, SIGTERM);
            }
            if (is_told && now > told + grace_seconds) kill(-process_, SIGKILL);
        }
        kill(-process_, SIGKILL); // what it has left behind; its number is still its own
        int status = 0;
        rusage usage{};
        while (wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
        }
        run_.seconds = seconds_since(start_);
        read_output();
        note_end(status, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
        return std::move(run_);
    }

private:
    [[noreturn]] void fail(int number) const
    {
        throw Error(fmt::format("cannot run '{}': {}", options_.program.string(), std::strerror(number)));
    }

    bool has_ended() const
    {
        siginfo_t info{};
        return waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == process_;
    }

    void read_output()
    {
        char bytes[4096];
        while (is_open_) {
            const ssize_t got = read(output_.out.number(), bytes, sizeof bytes);
            if (got < 0 && errno == EINTR) continue;
            if (got == 0) is_open_ = false;
            if (got <= 0) return;
            run_.output.append(bytes, static_cast<std::size_t>(got));
            if (run_.output.size() > longest_output)
                run_.output.erase(0, run_.output.size() - longest_output);
        }
    }

    void note_end(int status, std::uint64_t most)
    {
        if (run_.end == ChildRun::End::exited && WIFSIGNALED(status)) run_.end = ChildRun::End::signalled;
        run_.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
        // The system counts what this process held when the other one began: only what is above that is the other's.
        run_.peak_memory = most > peak_memory() ? most : memory_;
    }

    const ChildOptions& options_;
    Clock::time_point start_ = Clock::now();
    Pipe output_;
    bool is_open_ = true;
    pid_t process_ = -1;
    std::uint64_t memory_ = 0;
    ChildRun run_;
};

} // namespace

ChildRun run_child(const ChildOptions& options)
{
    return Child(options).run();
}

std::filesystem::path find_program(const std::string& name, const std::filesystem::path& directory)
{
    const auto is_program = [](const std::filesystem::path& file) {
        std::error_code ignored;
        return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
    };
    if (name.find('/') != std::string::npos) {
        const std::filesystem::path file = std::filesystem::absolute(directory / name).lexically_normal();
        return is_program(file) ? file : std::filesystem::path();
    }
    const char* variable = std::getenv("PATH");
    std::string_view rest = variable ? variable : "/usr/bin:/bin";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const std::filesystem::path file = std::filesystem::path(rest.substr(0, end)) / name;
        if (end > 0 && !name.empty() && is_program(file)) return std::filesystem::absolute(file);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return {};
}

} // namespace plumb
