// SPDX-License-Identifier: MIT

// Reading OBJ files, in chunks that all threads share: what is in each is counted; then its text is checked and its
// numbers and faces are read (obj_scan.cpp); then all are put together (obj_mesh.cpp).
// What comes out does not depend on the chunks: errors are those of the first chunk that has one.

#include "base/memory.h"
#include "base/parallel.h"
#include "base/regular_file.h"
#include "plumb/base/error.h"
#include "plumb/shapes/mesh.h"
#include "shapes/mesh_parts.h"
#include "shapes/obj/obj_characters.h"
#include "shapes/obj/obj_materials.h"
#include "shapes/obj/obj_mesh.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace plumb {

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 20;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason)
{
    throw Error(fmt::format("cannot read '{}': {}", path.string(), reason));
}

// The whole file, and line ends behind it: one for the last line, one more in case that it ends with a backslash.
FileBytes read_text(const std::filesystem::path& path)
{
    FileBytes text = read_file_bytes(path, 2);
    text.bytes[text.size] = text.bytes[text.size + 1] = '\n';
    text.size += 2;
    return text;
}

// Whole statements, but for the byte order mark.
std::vector<std::string_view> cut_into_chunks(std::string_view text)
{
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    std::vector<std::string_view> chunks;
    while (text.size() > chunk_size) {
        const auto size = static_cast<std::size_t>(next_chunk(text.data() + chunk_size) - text.data());
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

MeshData read_mesh(const std::filesystem::path& path)
{
    FileBytes text = read_text(path);
    const ObjFile file{path.string(), {text.bytes.get(), text.size}};
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
    in_parallel_or_throw(parts.size(),
                         [&](std::size_t i) { chunks[i] = scan_obj(file, parts[i], before[i], found); });
    check_obj(file, chunks, all);

    FaceMaterials materials = number_materials(chunks);
    std::vector<ObjFaces> faces;
    for (ObjChunk& chunk : chunks) faces.push_back(std::move(chunk.faces));
    text.bytes.reset(); // memory
    MeshData mesh = assemble_obj_mesh(std::move(found), std::move(faces));
    materials.of_primitive = std::move(mesh.materials.of_primitive);
    materials.directory = path.parent_path();
    mesh.materials = std::move(materials);
    return mesh;
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
