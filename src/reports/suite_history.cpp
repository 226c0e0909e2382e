// SPDX-License-Identifier: MIT
#include "reports/suite_history.h"

#include "base/json.h"
#include "base/regular_file.h"
#include "plumb/reports/suite_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

namespace plumb {

namespace {

constexpr std::size_t most_runs = 50;
constexpr std::size_t longest_line = std::size_t{1} << 20;
constexpr std::uintmax_t largest_file = std::uintmax_t{64} << 20;

// The writer puts every member into a line of its own; strings have no line ends.
std::string in_one_line(const std::string& text)
{
    std::string line;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\n') {
            line += text[i];
            continue;
        }
        while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
    }
    return line;
}

} // namespace

std::vector<std::string> read_history(const std::filesystem::path& file)
{
    std::vector<std::string> history;
    std::error_code problem;
    if (!problem_of_file(file).empty() || std::filesystem::file_size(file, problem) > largest_file || problem)
        return history;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.ends_with(',')) line.pop_back();
        if (line.starts_with('{') && line.ends_with('}') && line.size() <= longest_line)
            history.push_back(line);
    }
    return history;
}

std::vector<std::string> with_run(std::vector<std::string> history, const SuiteRun& run,
                                  std::uint64_t seconds)
{
    JsonWriter json;
    json.begin_object();
    json.integer("schema", 1);
    json.integer("time", seconds);
    json.integer("exit_code", static_cast<std::uint64_t>(exit_code_of(run)));
    json.begin_array("images");
    for (const SuiteResult& result : run.results) {
        json.begin_object();
        json.text("name", result.title);
        json.text("verdict", result_word(result));
        if (result.comparison) json.number("rmse", result.comparison->metrics.rmse);
        if (!result.up_to_date) json.number("seconds", result.seconds);
        json.end_object();
    }
    json.end_array();
    json.end_object();
    history.push_back(in_one_line(std::move(json).finish()));
    if (history.size() > most_runs)
        history.erase(history.begin(), history.end() - static_cast<std::ptrdiff_t>(most_runs));
    return history;
}

std::string history_json(const std::vector<std::string>& history)
{
    return fmt::format("[\n{}\n]\n", fmt::join(history, ",\n"));
}

} // namespace plumb
