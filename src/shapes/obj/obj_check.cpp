// SPDX-License-Identifier: MIT

#include "plumb/base/error.h"
#include "shapes/obj/obj_error.h"
#include "shapes/obj/obj_number.h"
#include "shapes/obj/obj_scan.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

[[noreturn]] void fail_without_faces(const ObjFile& file)
{
    if (file.text.find('\0') != std::string_view::npos)
        throw Error(fmt::format("cannot read '{}': not a text file", file.name));
    throw Error(fmt::format("cannot read '{}': no faces (lines that begin with 'f')", file.name));
}

void check_largest(const ObjFile& file, const std::vector<ObjChunk>& chunks, ObjLargestIndex ObjChunk::*index,
                   const IndexKind& kind, std::size_t count)
{
    ObjLargestIndex largest;
    for (const ObjChunk& chunk : chunks)
        if ((chunk.*index).value > largest.value) largest = chunk.*index;
    if (largest.value > static_cast<std::int64_t>(count))
        fail_obj(file, largest.at,
                 fmt::format("{} index {} is out of range: the file has {}", kind.one, excerpt(largest.at),
                             kind.counted(count)));
}

} // namespace

void check_obj(const ObjFile& file, const std::vector<ObjChunk>& chunks, const ObjCounts& all)
{
    const auto has_faces = [](const ObjChunk& chunk) { return !chunk.faces.ends.empty(); };
    if (std::none_of(chunks.begin(), chunks.end(), has_faces)) fail_without_faces(file);
    check_largest(file, chunks, &ObjChunk::position, position_indices, all.positions);
    check_largest(file, chunks, &ObjChunk::uv, uv_indices, all.uvs);
    check_largest(file, chunks, &ObjChunk::normal, normal_indices, all.normals);
}

} // namespace plumb
