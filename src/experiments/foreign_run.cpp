// SPDX-License-Identifier: MIT
#include "experiments/foreign_run.h"

#include "base/child_process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "base/visible_text.h"
#include "plumb/base/hash.h"
#include "plumb/compare/compare.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t shown_output = 4000; // bytes

// Whole lines, where there are any.
std::string end_of(const std::string& output)
{
    if (output.size() <= shown_output) return output;
    const std::size_t cut = output.size() - shown_output;
    const std::size_t line = output.find('\n', cut);
    return output.substr(line == output.npos || line + 1 == output.size() ? cut : line + 1);
}

// Empty: it did what it should.
std::string problem_of(const ChildRun& run, const ForeignImage& foreign)
{
    const bool is_of_file = !foreign.at.file.empty();
    switch (run.end) {
    case ChildRun::End::exited:
        return run.code == 0 ? "" : fmt::format("the command failed with exit code {}", run.code);
    case ChildRun::End::signalled:
        return fmt::format("the command was killed by signal {} ({})", run.code, strsignal(run.code));
    case ChildRun::End::timed_out:
        return fmt::format("the command was stopped after {}; allow more with {}",
                           duration_text(foreign.timeout), is_of_file ? R"(timeout="...")" : "--timeout");
    case ChildRun::End::stopped: return "interrupted";
    }
    return {};
}

// The program has chosen it.
bool is_plain_extension(std::string_view text)
{
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    return text.size() > 1 && text.size() <= 6 && text.find_first_not_of(plain, 1) == text.npos;
}

// The directory that a program starts in, and where it writes its image.
class WorkDirectory {
public:
    explicit WorkDirectory(const std::string& stem) : path_(fs::absolute(stem + "_work").lexically_normal())
    {
        clear();
        make_directory(path_);
    }
    WorkDirectory(const WorkDirectory&) = delete;
    WorkDirectory& operator=(const WorkDirectory&) = delete;
    ~WorkDirectory() { clear(); }

    const fs::path& path() const { return path_; }
    fs::path image() const { return path_ / "image.exr"; }
    // Programs may put another ending in the place of .exr. Empty: there is no image.
    fs::path written_image() const
    {
        std::error_code ignored;
        if (fs::is_regular_file(fs::symlink_status(image(), ignored))) return image();
        for (const fs::directory_entry& entry : fs::directory_iterator(path_, ignored))
            if (entry.path().stem() == "image" && is_plain_extension(entry.path().extension().string()) &&
                fs::is_regular_file(entry.symlink_status(ignored)))
                return entry.path();
        return {};
    }

private:
    void clear() const
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    fs::path path_;
};

std::string stem_of_replica(const ForeignJob& job, int replica)
{
    return job.request.foreign.replicas == 1 ? job.stem : fmt::format("{}_r{}", job.stem, replica + 1);
}

Image read_written(const fs::path& written, const ForeignImage& foreign, const ProgramRun& run)
{
    try {
        return read_to_compare(written);
    } catch (const Error& error) {
        throw ProgramError(foreign.at, error.what(), run);
    }
}

ChildRun run_replica(const ForeignJob& job, int replica, const WorkDirectory& work)
{
    const ForeignImage& foreign = job.request.foreign;
    const std::vector<std::string> words = command_of(job.request, replica, work.image(), job.threads);
    const fs::path program = find_program(words.front(), directory_of(foreign));
    if (program.empty())
        throw ProgramError(foreign.at,
                           fmt::format("cannot run '{}': there is no program of this name {}", words.front(),
                                       words.front().find('/') == std::string::npos ? "in PATH"
                                       : foreign.at.file.empty()                    ? "here"
                                                                                    : "beside the suite"),
                           {});
    return run_child({.program = program,
                      .words = words,
                      .directory = work.path(),
                      .environment = {"TMPDIR=" + work.path().string()},
                      .timeout = foreign.timeout,
                      .stop = job.stop});
}

} // namespace

std::string output_text(const ProgramRun& run)
{
    std::string text;
    for (const std::string& line : lines_of(run.output)) text += "\n    " + visible_text(line);
    return text.empty() ? "\n    (it printed nothing)" : text;
}

std::string foreign_key(const ForeignJob& job)
{
    const ForeignImage& foreign = job.request.foreign;
    const std::vector<std::string> words = command_of(job.request, 0, "image.exr", 1);
    std::vector<fs::path> files = {find_program(words.front(), directory_of(foreign))};
    for (std::size_t i = 1; i < words.size(); ++i) {
        std::error_code ignored;
        if (fs::path(words[i]).is_absolute() && fs::is_regular_file(words[i], ignored))
            files.emplace_back(words[i]);
    }
    files.insert(files.end(), foreign.inputs.begin(), foreign.inputs.end());
    Hash128 hash;
    const auto add = [&hash](std::string_view part) { hash.update(fmt::format("{}:{}", part.size(), part)); };
    add(PLUMB_VERSION);
    add(words_text(words));
    add(std::to_string(foreign.replicas));
    for (const fs::path& file : files) {
        const std::string bytes = hash_of_files({file});
        if (bytes.empty() && file != files.front())
            throw SceneError({Diagnostic{Severity::error, foreign.inputs_at,
                                         fmt::format("cannot read the input '{}'", file.string())}});
        add(file.string());
        add(bytes);
    }
    return hash.hex();
}

std::vector<std::string> expected_images(const ForeignJob& job)
{
    std::vector<std::string> files;
    for (int replica = 0; replica < job.request.foreign.replicas; ++replica)
        files.push_back(stem_of_replica(job, replica) + ".exr");
    return files;
}

ForeignImages run_command(const ForeignJob& job)
{
    const ForeignImage& foreign = job.request.foreign;
    ForeignImages made;
    for (int replica = 0; replica < foreign.replicas; ++replica) {
        const WorkDirectory work(job.stem);
        const ChildRun run = run_replica(job, replica, work);
        made.run.exit_code = run.code;
        made.run.seconds += run.seconds;
        made.run.peak_memory = std::max(made.run.peak_memory, run.peak_memory);
        made.run.output = end_of(run.output);
        if (run.end == ChildRun::End::stopped) throw Error("interrupted");
        if (const std::string problem = problem_of(run, foreign); !problem.empty())
            throw ProgramError(foreign.at, problem, made.run);
        const fs::path written = work.written_image();
        if (written.empty())
            throw ProgramError(foreign.at,
                               "the command ended without an error, but wrote no image to {image}", made.run);
        made.images.push_back(read_written(written, foreign, made.run)); // else it takes nothing's place
        const std::string file = stem_of_replica(job, replica) + written.extension().string();
        std::error_code problem;
        fs::rename(written, file, problem);
        if (problem) throw Error(fmt::format("cannot write '{}': {}", file, problem.message()));
        made.files.push_back(file);
    }
    return made;
}

} // namespace plumb
