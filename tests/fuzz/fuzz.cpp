// SPDX-License-Identifier: MIT
#include "fuzz/fuzz.h"

#include "cli/usage_error.h"
#include "plumb/base/error.h"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <typeinfo>
#include <unistd.h>

namespace plumb::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path make_directory()
{
    std::error_code ignored;
    const fs::path memory = "/dev/shm";
    const fs::path parent = fs::is_directory(memory, ignored) ? memory : fs::temp_directory_path();
    std::string name = (parent / "plumb-fuzz-XXXXXX").string();
    expect(::mkdtemp(name.data()) != nullptr, "there is no place for files");
    static const fs::path made = name;
    std::atexit([] {
        std::error_code failed;
        fs::remove_all(made, failed);
    });
    return made;
}

void check_messages(const SceneError& error)
{
    for (const Diagnostic& diagnostic : error.diagnostics()) expect_printable(diagnostic.text());
}

} // namespace

const fs::path& directory()
{
    static const fs::path result = make_directory();
    return result;
}

fs::path write_file(std::string_view name, std::string_view content)
{
    fs::path path = directory() / name;
    std::ofstream file(path, std::ios::binary);
    file << content;
    return path;
}

void expect(bool holds, std::string_view what)
{
    if (holds) return;
    std::fprintf(stderr, "FOUND: %.*s\n", static_cast<int>(what.size()), what.data());
    std::abort();
}

void expect_printable(std::string_view text)
{
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool control = (byte(i) < 0x20 && byte(i) != '\n' && byte(i) != '\t') || byte(i) == 0x7f;
        const bool c1 = byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0;
        // U+200E, U+200F, U+202A to U+202E and U+2066 to U+2069; U+061C.
        const unsigned last = byte(i + 2);
        const bool bidi = (byte(i) == 0xe2 && byte(i + 1) == 0x80 &&
                           (last == 0x8e || last == 0x8f || (last >= 0xaa && last <= 0xae))) ||
                          (byte(i) == 0xe2 && byte(i + 1) == 0x81 && last >= 0xa6 && last <= 0xa9) ||
                          (byte(i) == 0xd8 && byte(i + 1) == 0x9c);
        if (control || c1 || bidi)
            expect(false, fmt::format("byte {} of a message is 0x{:02x}, which a terminal may obey:\n{}", i,
                                      byte(i), text));
    }
}

bool allow_our_errors(const std::function<void()>& action)
{
    try {
        action();
        return true;
    } catch (const SceneError& error) {
        check_messages(error);
    } catch (const FileError& error) {
        expect_printable(Diagnostic{Severity::error, error.location(), error.what()}.text());
    } catch (const Error& error) {
        static_cast<void>(std::string_view(error.what()).size());
    } catch (const UsageError& error) {
        static_cast<void>(std::string_view(error.what()).size());
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& error) {
        expect(false, fmt::format("{}: {}", typeid(error).name(), error.what()));
    }
    return false;
}

} // namespace plumb::fuzz
