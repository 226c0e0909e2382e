// SPDX-License-Identifier: MIT
#include "denoise/oidn.h"

#include "base/text.h"
#include "image/image_text.h"
#include "plumb/base/error.h"

#include <cfenv>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <vector>

namespace plumb::oidn {

namespace {

constexpr const char* file_name = "libOpenImageDenoise.so.2";
constexpr const char* variable = "PLUMB_OIDN";

template <class Result, class... Arguments>
using Function = Result (*)(Arguments...);

std::string environment(const char* name)
{
    const char* const value = std::getenv(name);
    return value ? value : "";
}

// Where tools/install-denoiser puts it; empty: this user has no home.
std::string installed_file()
{
    std::filesystem::path data = environment("XDG_DATA_HOME"); // XDG Base Directory Specification
    if (!data.is_absolute()) {
        const std::string home = environment("HOME");
        if (home.empty()) return {};
        data = std::filesystem::path(home) / ".local/share";
    }
    return data / "plumb/oidn/lib" / file_name;
}

[[noreturn]] void fail(const std::string& reason)
{
    throw Error(fmt::format("cannot denoise: {}", reason));
}

void* open_file(const std::string& name)
{
    // Some libraries, as they are loaded, change how their thread rounds or what it makes of tiny numbers.
    std::fenv_t arithmetic;
    std::fegetenv(&arithmetic);
    void* const file = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    std::fesetenv(&arithmetic);
    return file;
}

void* open_library()
{
    std::error_code ignored;
    const std::string named = environment(variable);
    const std::string installed = installed_file();
    for (const std::string& file : {named, installed}) {
        if (file.empty() || (file != named && !std::filesystem::exists(file, ignored))) continue;
        if (void* const library = open_file(file)) return library;
        fail(fmt::format("'{}' cannot be loaded: {}", file, reason_text(dlerror())));
    }
    if (void* const library = open_file(file_name)) return library;
    fail(fmt::format("Open Image Denoise 2 is not installed ({}); tools/install-denoiser "
                     "(renderer-install-denoiser, where Plumb is installed) installs it for this user, or {} "
                     "names the file",
                     reason_text(dlerror()), variable));
}

// Becomes what the member of the table is that it fills.
struct Symbol {
    void* address;
    template <class Result, class... Arguments>
    operator Function<Result, Arguments...>() const
    {
        return reinterpret_cast<Function<Result, Arguments...>>(address);
    }
};

Library load()
{
    void* const file = open_library();
    const auto find = [file](const char* name) {
        void* const address = dlsym(file, name);
        if (!address)
            fail(fmt::format("the {} that was found lacks {}: it is no Open Image Denoise 2", file_name,
                             name));
        return Symbol{address};
    };
    return {.new_device = find("oidnNewDevice"),
            .set_device_int = find("oidnSetDeviceInt"),
            .set_device_bool = find("oidnSetDeviceBool"),
            .get_device_int = find("oidnGetDeviceInt"),
            .get_device_error = find("oidnGetDeviceError"),
            .commit_device = find("oidnCommitDevice"),
            .release_device = find("oidnReleaseDevice"),
            .new_filter = find("oidnNewFilter"),
            .set_shared_filter_image = find("oidnSetSharedFilterImage"),
            .set_filter_bool = find("oidnSetFilterBool"),
            .commit_filter = find("oidnCommitFilter"),
            .execute_filter = find("oidnExecuteFilter"),
            .release_filter = find("oidnReleaseFilter")};
}

} // namespace

const Library& library()
{
    static const Library loaded = load();
    return loaded;
}

} // namespace plumb::oidn
