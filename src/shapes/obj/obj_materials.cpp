// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_materials.h"

#include <map>
#include <optional>

namespace plumb {

FaceMaterials number_materials(std::span<ObjChunk> chunks)
{
    FaceMaterials result;
    std::map<std::string_view, std::uint32_t> numbers;
    std::optional<std::string_view> current; // nothing before the first `usemtl`
    bool any_without = false;
    const auto add_run = [&](ObjFaces& faces, std::size_t begin, std::size_t end) {
        if (begin == end) return;
        std::uint32_t number = FaceMaterials::none;
        any_without = any_without || !current;
        if (current) {
            const auto [known, is_new] =
                numbers.try_emplace(*current, static_cast<std::uint32_t>(result.names.size()));
            if (is_new) result.names.emplace_back(*current);
            number = known->second;
        }
        faces.materials.push_back({begin, number});
    };
    for (ObjChunk& chunk : chunks) {
        for (const std::string_view library : chunk.libraries) result.libraries.emplace_back(library);
        std::size_t begin = 0; // these faces go on with what the chunk before ended with
        for (const ObjMaterialUse& use : chunk.materials) {
            add_run(chunk.faces, begin, use.first_face);
            begin = use.first_face;
            current = use.name;
        }
        add_run(chunk.faces, begin, chunk.faces.ends.size());
    }
    if (result.names.size() + (any_without ? 1 : 0) < 2)
        for (ObjChunk& chunk : chunks) chunk.faces.materials = {};
    return result;
}

} // namespace plumb
