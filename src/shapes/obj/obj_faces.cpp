// SPDX-License-Identifier: MIT

// The only user of tinyobjloader.

#include "shapes/obj/obj_faces.h"

#include <istream>
#include <streambuf>
#include <tiny_obj_loader.h>
#include <utility>

namespace plumb {

namespace {

// The blocks as one text, each ended by a line end.
class FaceText final : public std::streambuf {
public:
    explicit FaceText(std::span<const ObjFaceBlock> blocks) : blocks_(blocks) {}

    // The block that face number `face` is in; faces are asked for in order.
    const ObjFaceBlock& block_of(std::size_t face)
    {
        while (current_ + 1 < blocks_.size() && blocks_[current_ + 1].first_face <= face) ++current_;
        return blocks_[current_];
    }

private:
    int_type underflow() override
    {
        if (!at_line_end_) {
            at_line_end_ = true;
            serve(line_end_, 1);
        } else {
            if (next_ == blocks_.size()) return traits_type::eof();
            at_line_end_ = false;
            // The stream only reads; streambuf's interface just has no const.
            const std::string_view text = blocks_[next_++].text;
            serve(const_cast<char*>(text.data()), text.size());
        }
        return traits_type::to_int_type(*gptr());
    }

    void serve(char* text, std::size_t size) { setg(text, text, text + size); }

    std::span<const ObjFaceBlock> blocks_;
    std::size_t next_ = 0;
    std::size_t current_ = 0;
    bool at_line_end_ = true;
    char line_end_[1] = {'\n'};
};

struct Reader {
    FaceText& text;
    ObjFaces faces;

    // From what an OBJ file says (1 is the first, -1 the last so far, 0 means none) to what ObjCorner says.
    static std::int32_t resolve(int index, std::int32_t before)
    {
        return index < 0 ? before + index : index - 1;
    }

    void add_face(const tinyobj::index_t* indices, int count)
    {
        const ObjFaceBlock& block = text.block_of(faces.ends.size());
        for (int i = 0; i < count; ++i) {
            const ObjCorner corner{resolve(indices[i].vertex_index, block.positions_before),
                                   resolve(indices[i].texcoord_index, block.uvs_before),
                                   resolve(indices[i].normal_index, block.normals_before)};
            faces.any_uv |= corner.uv >= 0;
            faces.all_uv &= corner.uv >= 0;
            faces.any_normal |= corner.normal >= 0;
            faces.corners.push_back(corner);
        }
        faces.ends.push_back(static_cast<std::uint32_t>(faces.corners.size()));
    }
};

} // namespace

ObjFaces read_obj_faces(std::span<const ObjFaceBlock> blocks)
{
    FaceText text(blocks);
    Reader reader{text, {}};
    tinyobj::callback_t callback;
    callback.index_cb = [](void* self, tinyobj::index_t* indices, int count) {
        static_cast<Reader*>(self)->add_face(indices, count);
    };
    std::istream stream(&text);
    stream.exceptions(std::ios::badbit); // so that bad_alloc inside the stream comes through
    tinyobj::LoadObjWithCallback(stream, callback, &reader);
    return std::move(reader.faces);
}

} // namespace plumb
