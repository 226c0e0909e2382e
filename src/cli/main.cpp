// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verbs.h"
#include "reports/exit_codes.h"
#include "reports/json_document.h"

#include "plumb/base/error.h"

#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace {

using namespace plumb;

// Prints what is wrong, and writes it where --json says. That may be what cannot be written: then nobody hears of it twice.
int complain(int code, const std::vector<std::string>& words, const std::vector<Diagnostic>& diagnostics)
{
    for (const Diagnostic& diagnostic : diagnostics) print_log(diagnostic);
    try {
        write_json(json_destination_of_errors(words), error_json(diagnostics, code));
        finish_output();
    } catch (const std::exception&) {
        return code;
    }
    return code;
}

int complain(int code, const std::vector<std::string>& words, const std::string& message)
{
    return complain(code, words, {Diagnostic{Severity::error, {}, message}});
}

// Some libraries that OpenImageIO brings start threads as they are loaded, and end the program if they get none: of
// liblog4cplus in Debian 13 that was seen. There is no exception to catch then. Where there is one, the fault is ours.
[[noreturn]] void on_terminate()
{
    if (std::current_exception()) std::abort();
    print_log("error: a library ended the program while it was loaded; there may be too little memory");
    _exit(exit_code::error);
}

} // namespace

int main(int argc, char** argv)
{
    prepare_console();
    std::set_terminate(on_terminate);
    const std::vector<std::string> words{argv + (argc > 0), argv + argc};
    try {
        const int code = verb_of(words).parse(words)();
        finish_output();
        return code;
    } catch (const UsageError& error) {
        return complain(exit_code::usage, words, error.what());
    } catch (const SceneError& error) {
        return complain(exit_code::error, words, error.diagnostics());
    } catch (const FileError& error) {
        return complain(exit_code::error, words,
                        {Diagnostic{Severity::error, error.location(), error.what()}});
    } catch (const std::bad_alloc&) {
        return complain(exit_code::error, words, "not enough memory");
    } catch (const std::system_error& error) {
        const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
        return complain(exit_code::error, words,
                        no_thread ? "cannot start a thread; there may be too little memory" : error.what());
    } catch (const std::exception& error) {
        return complain(exit_code::error, words, error.what());
    }
}
