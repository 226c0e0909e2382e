// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"

#include <new>

namespace {

using namespace plumb;

constexpr int input_error = 1;
constexpr int usage_error = 2;

void run(const Options& options)
{
    if (options.help) return print_output(help_text(options.verb));
    if (options.version) return print_output("Plumb " PLUMB_VERSION "\n");
    switch (options.verb) {
    case Verb::render: return render_command(options);
    case Verb::types: return types_command(options);
    case Verb::info: return info_command(options);
    case Verb::replay: return replay_command(options);
    case Verb::rerun: return rerun_command(options);
    }
}

int complain(int exit_code, const std::string& message)
{
    print_log("error: " + message);
    return exit_code;
}

} // namespace

int main(int argc, char** argv)
{
    prepare_console();
    Options options;
    try {
        options = parse_options({argv + (argc > 0), argv + argc});
        run(options);
        finish_output();
        return 0;
    } catch (const UsageError& error) {
        return complain(usage_error, error.what());
    } catch (const SceneError& error) {
        for (const Diagnostic& diagnostic : error.diagnostics())
            if (diagnostic.severity == Severity::error || !options.quiet) print_log(diagnostic.text());
        return input_error;
    } catch (const FileError& error) {
        print_log(Diagnostic{Severity::error, error.location(), error.what()}.text());
        return input_error;
    } catch (const std::bad_alloc&) {
        return complain(input_error, "not enough memory");
    } catch (const std::exception& error) {
        return complain(input_error, error.what());
    }
}
