// SPDX-License-Identifier: MIT
#include "cli/load.h"

#include "base/named_file.h"
#include "cli/console.h"
#include "cli/usage_error.h"
#include "cli/verbs.h"
#include "plumb/reports/render_report.h"

#include <fmt/format.h>

namespace plumb {

std::unique_ptr<SceneFile> open_scene(const std::string& file, const SceneSettings& settings)
{
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        if (is_no_file_name(file) && !closest_verb(file).empty()) throw UsageError(unknown_verb(file));
        throw Error(fmt::format("scene file '{}' does not exist{}", file, find_named_file({}, file).way_out));
    }
    return std::make_unique<SceneFile>(file, settings);
}

void log_scene(const RenderTask& task, bool verbose)
{
    for (const Diagnostic& warning : task.scene.warnings) print_log(warning);
    const Dialect& dialect = task.scene.dialect;
    print_log(fmt::format("dialect: {} ({})", to_string(dialect.name), dialect.reason));
    if (!verbose) return;
    for (const std::string& line : facts_of(task)) print_log(line);
}

} // namespace plumb
