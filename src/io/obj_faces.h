// SPDX-License-Identifier: MIT
#pragma once

// The faces of an OBJ file, on their way from the scanner, which checks them, to tinyobjloader, which reads them.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <vector>

namespace plumb {

// Consecutive `f` lines that passed every check but the upper end of their indices, and what came before them:
// negative indices count back from there. Without the last line's end.
struct ObjFaceBlock {
    std::string_view text;
    std::size_t first_face = 0;
    std::int32_t positions_before = 0;
    std::int32_t uvs_before = 0;
    std::int32_t normals_before = 0;
};

// A queue between two threads.
class ObjFaceQueue {
public:
    void push(std::vector<ObjFaceBlock> blocks);
    void close(); // nothing more will come
    // Waits; an empty vector means that the queue is closed and empty.
    std::vector<ObjFaceBlock> pop();

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<ObjFaceBlock> blocks_;
    bool closed_ = false;
};

// Indices count from 0; -1: the corner has none. They may still be too large.
struct ObjCorner {
    std::int32_t position = -1;
    std::int32_t uv = -1;
    std::int32_t normal = -1;
    friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};

struct ObjFaces {
    std::vector<ObjCorner> corners;  // of all faces, one after the other
    std::vector<std::uint32_t> ends; // face i ends before corner ends[i]
    bool any_uv = false;
    bool all_uv = true;
    bool any_normal = false;
};

// Reads blocks until the queue is closed.
ObjFaces read_obj_faces(ObjFaceQueue& queue);

} // namespace plumb
