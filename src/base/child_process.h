// SPDX-License-Identifier: MIT
#pragma once

// Running another program: without a shell, in a process group of its own, and never longer than allowed.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct ChildOptions {
    std::filesystem::path program;   // the file to execute
    std::vector<std::string> words;  // its arguments, the name that it is called by first
    std::filesystem::path directory; // that it starts in
    std::vector<std::string> environment =
        {};                                  // "NAME=VALUE", instead of what this process has under the name
    double timeout = 600.0;                  // seconds
    const std::atomic<bool>* stop = nullptr; // somebody may set it: then the program ends, too
};

struct ChildRun {
    enum class End { exited, signalled, timed_out, stopped };
    End end = End::exited;
    int code = 0; // exit code, or the number of the signal
    double seconds = 0.0;
    std::uint64_t peak_memory = 0; // bytes, of its largest process; 0: unknown
    std::string output;            // the end of what it wrote to standard output and standard error
};

// Waits for it. Standard input is empty. When it ends, or is to end, so does its whole process group: by SIGTERM, and
// two seconds later by SIGKILL. If this process is killed, the program is, too. Throws Error, "cannot run 'X': " and the reason.
ChildRun run_child(const ChildOptions& options);

// The file that a command of this name is: a name with a slash is seen from `directory`, any other is looked for in PATH.
// Empty: there is none that may be executed.
std::filesystem::path find_program(const std::string& name, const std::filesystem::path& directory);

} // namespace plumb
