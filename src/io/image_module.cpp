// SPDX-License-Identifier: MIT

// Finding and loading libplumb_images.so.

#include "io/image_module.h"

#include "io/image_text.h"
#include "plumb/error.h"
#include "plumb/hash.h"

#include <fmt/format.h>

#include <cfenv>
#include <dlfcn.h>
#include <system_error>

namespace plumb {

namespace fs = std::filesystem;

namespace {

constexpr const char* file_name = "libplumb_images.so";

// Where it lies in a build folder and where it is installed, seen from the program.
std::vector<fs::path> folders()
{
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    if (unknown) return {};
    const fs::path beside = program.parent_path();
    return {beside, (beside / PLUMB_MODULE_FOLDER).lexically_normal()};
}

[[noreturn]] void fail(const std::string& reason)
{
    throw Error(fmt::format("cannot read or write images: {}", reason));
}

void* open_module(const std::string& name)
{
    // Some libraries, as they are loaded, change how their thread rounds or what it makes of tiny numbers.
    std::fenv_t arithmetic;
    std::fegetenv(&arithmetic);
    void* const library = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
    std::fesetenv(&arithmetic);
    return library;
}

// Programs that use Plumb as a library may lie anywhere: last, it is looked for as any other library is.
void* open_module()
{
    std::string looked_in;
    for (const fs::path& folder : folders()) {
        std::error_code ignored;
        if (fs::exists(folder / file_name, ignored)) {
            if (void* const library = open_module((folder / file_name).string())) return library;
            fail(reason_text(dlerror()));
        }
        looked_in += fmt::format("{}'{}'", looked_in.empty() ? "" : ", ", folder.string());
    }
    if (void* const library = open_module(file_name)) return library;
    fail(fmt::format("{}, a part of Plumb, is neither in {} nor in the library path", file_name, looked_in));
}

struct LoadedModule {
    const ImageModule& module;
    std::string hash; // of its file
};

LoadedModule load_module()
{
    using Entry = const ImageModule*(const char*);
    auto* const entry = reinterpret_cast<Entry*>(dlsym(open_module(), "plumb_image_module"));
    const ImageModule* const module = entry ? entry(PLUMB_VERSION) : nullptr;
    if (!module)
        fail(fmt::format("the {} that was found has another version than " PLUMB_VERSION, file_name));
    Dl_info info{};
    dladdr(reinterpret_cast<const void*>(entry), &info);
    return {*module, hash_of_files({info.dli_fname})};
}

const LoadedModule& loaded_module()
{
    static const LoadedModule loaded = load_module();
    return loaded;
}

} // namespace

const ImageModule& image_module()
{
    return loaded_module().module;
}

const std::string& ImageLibrary::hash()
{
    return loaded_module().hash;
}

ImageLibrary::ImageLibrary()
{
    const auto load = [this] {
        try {
            image_module();
        } catch (...) {
            failed_ = true;
            throw;
        }
    };
    try {
        loading_ = std::async(std::launch::async, load);
    } catch (const std::system_error&) { // no thread to be had: then it waits until it is needed
    }
}

ImageLibrary::~ImageLibrary() = default;

void ImageLibrary::wait()
{
    if (loading_.valid()) loading_.get();
}

} // namespace plumb
