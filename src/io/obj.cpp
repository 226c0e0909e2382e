// SPDX-License-Identifier: MIT

// Reading OBJ files: this thread checks the text and reads numbers (obj_scan.cpp), another follows with tinyobjloader
// and reads faces (obj_faces.cpp), and then both are put together (obj_mesh.cpp).

#include "io/obj_mesh.h"
#include "plumb/error.h"
#include "plumb/mesh.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <future>
#include <memory>
#include <new>

namespace plumb {

namespace {

// Below this size a thread of its own would take longer than it saves.
constexpr std::size_t min_parallel_size = std::size_t{1} << 18;
// Above it, the number of lines might not fit an index.
constexpr std::size_t max_size = std::size_t{8} << 30;

struct Text {
    std::unique_ptr<char[]> bytes;
    std::size_t size;

    std::string_view view() const { return {bytes.get(), size}; }
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason)
{
    throw Error(fmt::format("cannot read '{}': {}", path.string(), reason));
}

// The whole file, and a line end behind it.
Text read_text(const std::filesystem::path& path)
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail(path, "it is a folder");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) fail(path, error.message());
    if (size == 0) fail(path, "the file is empty");
    if (size > max_size) fail(path, "files of more than 8 GiB are not supported");

    Text text{std::make_unique_for_overwrite<char[]>(size + 1), size + 1};
    std::ifstream stream(path, std::ios::binary);
    if (!stream) fail(path, std::strerror(errno));
    stream.read(text.bytes.get(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) fail(path, "the file ends early");
    text.bytes[size] = '\n';
    return text;
}

MeshData read_mesh(const std::filesystem::path& path)
{
    const Text text = read_text(path);
    ObjFaceQueue queue;
    const auto policy = text.size < min_parallel_size ? std::launch::deferred : std::launch::async;
    std::future<ObjFaces> faces = std::async(policy, [&queue] { return read_obj_faces(queue); });
    ObjAttributes attributes = scan_obj(path.string(), text.view(), queue);
    return assemble_obj_mesh(std::move(attributes), faces.get());
}

} // namespace

MeshData read_obj(const std::filesystem::path& path)
{
    try {
        return read_mesh(path);
    } catch (const std::bad_alloc&) {
        fail(path, "not enough memory");
    } catch (const std::system_error& error) { // no thread to be had
        fail(path, error.what());
    } catch (const FileError&) {
        throw;
    } catch (const Error& error) {
        if (std::string_view(error.what()).starts_with("cannot read")) throw;
        fail(path, error.what());
    }
}

} // namespace plumb
