// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"

#include <new>

namespace {

using namespace plumb;

constexpr int input_error = 1;
constexpr int usage_error = 2;

// Returns the exit code.
int run(const Options& options)
{
    if (options.help) {
        print_output(help_text(options.verb));
        return 0;
    }
    if (options.version) {
        print_output("Plumb " PLUMB_VERSION "\n");
        return 0;
    }
    switch (options.verb) {
    case Verb::render: render_command(options); break;
    case Verb::types: types_command(options); break;
    case Verb::info: info_command(options); break;
    case Verb::replay: replay_command(options); break;
    case Verb::rerun: rerun_command(options); break;
    case Verb::test: return test_command(options);
    case Verb::agree: return agree_command(options);
    case Verb::check: return check_command(options);
    case Verb::compare: return compare_command(options);
    }
    return 0;
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
        const int exit_code = run(options);
        finish_output();
        return exit_code;
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
