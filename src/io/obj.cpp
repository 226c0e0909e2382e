// SPDX-License-Identifier: MIT

// Reading OBJ files, in chunks that all threads share: what is in each is counted; then its text is checked and its
// numbers (obj_scan.cpp) and faces (obj_faces.cpp, tinyobjloader) are read; then all are put together (obj_mesh.cpp).
// What comes out does not depend on the chunks: errors are those of the first chunk that has one.

#include "core/memory.h"
#include "core/parallel.h"
#include "io/obj_characters.h"
#include "io/obj_mesh.h"
#include "plumb/error.h"
#include "plumb/mesh.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <memory>
#include <new>
#include <span>
#include <unistd.h>
#include <utility>

namespace plumb {

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 20;
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

constexpr int early_end = -1;

// Returns 0, early_end, or what went wrong.
int read_bytes(int file, std::size_t offset, std::span<char> bytes)
{
    while (!bytes.empty()) {
        const ssize_t size = pread(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) return size < 0 ? errno : early_end;
        bytes = bytes.subspan(static_cast<std::size_t>(size));
        offset += static_cast<std::size_t>(size);
    }
    return 0;
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
    prefer_large_pages(text.bytes.get(), text.size);
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail(path, std::strerror(errno));
    std::vector<int> problems((size + chunk_size - 1) / chunk_size, 0);
    parallel_for(problems.size(), 0, [&](std::size_t i) {
        const std::size_t begin = i * chunk_size;
        problems[i] = read_bytes(file, begin, {text.bytes.get() + begin, std::min(chunk_size, size - begin)});
    });
    close(file);
    for (const int problem : problems)
        if (problem != 0) fail(path, problem == early_end ? "the file ends early" : std::strerror(problem));
    text.bytes[size] = '\n';
    return text;
}

// Whole lines, but for the byte order mark.
std::vector<std::string_view> cut_into_chunks(std::string_view text)
{
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    std::vector<std::string_view> chunks;
    while (text.size() > chunk_size) {
        const auto size = static_cast<std::size_t>(next_line(text.data() + chunk_size) - text.data());
        chunks.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    if (!text.empty()) chunks.push_back(text);
    return chunks;
}

ObjCounts operator+(const ObjCounts& a, const ObjCounts& b)
{
    return {a.positions + b.positions, a.uvs + b.uvs, a.normals + b.normals};
}

// Calls read(i) for all chunks, and throws what the first of those that failed has thrown.
void read_chunks(std::size_t count, const std::function<void(std::size_t)>& read)
{
    std::vector<std::exception_ptr> problems(count);
    parallel_for(count, 0, [&](std::size_t i) {
        try {
            read(i);
        } catch (...) {
            problems[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& problem : problems)
        if (problem) std::rethrow_exception(problem);
}

MeshData read_mesh(const std::filesystem::path& path)
{
    Text text = read_text(path);
    const ObjFile file{path.string(), text.view()};
    const std::vector<std::string_view> parts = cut_into_chunks(file.text);

    std::vector<ObjCounts> before(parts.size());
    parallel_for(parts.size(), 0, [&](std::size_t i) { before[i] = count_obj(parts[i]); });
    ObjCounts all;
    for (ObjCounts& count : before) count = std::exchange(all, all + count);

    ObjAttributes found;
    reserve_large_pages(found.positions, all.positions + 1); // MeshData
    reserve_large_pages(found.uvs, all.uvs);
    reserve_large_pages(found.normals, all.normals);
    found.positions.resize(all.positions);
    found.uvs.resize(all.uvs);
    found.normals.resize(all.normals);
    std::vector<ObjChunk> chunks(parts.size());
    read_chunks(parts.size(), [&](std::size_t i) { chunks[i] = scan_obj(file, parts[i], before[i], found); });
    check_obj(file, chunks, all);
    text.bytes.reset();

    std::vector<ObjFaces> faces;
    for (ObjChunk& chunk : chunks) faces.push_back(std::move(chunk.faces));
    return assemble_obj_mesh(std::move(found), std::move(faces));
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
