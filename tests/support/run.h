// SPDX-License-Identifier: MIT
#pragma once

// Running the real program.

#include "build_paths.h"
#include "support/temp_directory.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plumb {

struct RunResult {
    int exit_code = -1; // 128 + signal if it died of one
    std::string out;
    std::string err;
};

// What to do while the program runs.
using Meanwhile = std::function<void(pid_t process)>;

// Runs words[0] in `directory` with standard input empty. out: where standard output goes, instead of into the result.
// variables: "NAME=VALUE", added to the environment.
inline RunResult run_program(const std::vector<std::string>& words, const std::filesystem::path& directory,
                             const std::string& out = "", const Meanwhile& meanwhile = {},
                             const std::vector<std::string>& variables = {})
{
    const TempDirectory capture;
    const std::string out_file = out.empty() ? (capture / "out").string() : out;
    const std::string err_file = (capture / "err").string();

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out_file.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err_file.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());

    std::vector<std::string> copies = words;
    std::vector<char*> argv;
    for (std::string& word : copies) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::vector<std::string> added = variables;
    std::vector<char*> environment;
    for (char** variable = environ; *variable; ++variable) environment.push_back(*variable);
    for (std::string& variable : added) environment.push_back(variable.data());
    environment.push_back(nullptr);
    pid_t process = 0;
    const int problem = posix_spawn(&process, argv[0], &actions, nullptr, argv.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) throw std::runtime_error("cannot run " + words.front() + ": " + std::strerror(problem));
    if (meanwhile) meanwhile(process);

    int status = 0;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) throw std::runtime_error("lost " + words.front());
    RunResult result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (out.empty()) result.out = read_bytes(out_file);
    result.err = read_bytes(err_file);
    return result;
}

inline RunResult run_renderer(std::vector<std::string> words, const std::filesystem::path& directory,
                              const std::string& out = "", const Meanwhile& meanwhile = {},
                              const std::vector<std::string>& variables = {})
{
    words.insert(words.begin(), PLUMB_RENDERER);
    return run_program(words, directory, out, meanwhile, variables);
}

} // namespace plumb
