// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_mesh.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "plumb/base/error.h"
#include "shapes/obj/obj_polygon.h"

#include <fmt/format.h>

#include <bit>
#include <span>

namespace plumb {

namespace {

constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();

bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c)
{
    const Vec3d origin(a);
    const Vec3d normal = cross(Vec3d(b) - origin, Vec3d(c) - origin);
    return normal != Vec3d(0.0);
}

// Numbers the different corners in the order in which they are first seen: a hash table with linear probing.
class CornerNumbers {
public:
    explicit CornerNumbers(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 16), unused)
    {
        corners_.reserve(expected);
    }

    std::uint32_t operator[](const ObjCorner& corner)
    {
        for (std::size_t slot = hash(corner);; ++slot) {
            std::uint32_t& number = slots_[slot & (slots_.size() - 1)];
            if (number == unused) {
                number = static_cast<std::uint32_t>(corners_.size());
                corners_.push_back(corner);
                if (2 * corners_.size() > slots_.size()) grow();
                return static_cast<std::uint32_t>(corners_.size() - 1);
            }
            if (corners_[number] == corner) return number;
        }
    }

    const std::vector<ObjCorner>& corners() const { return corners_; }

private:
    static std::size_t hash(const ObjCorner& corner)
    {
        // Multiplicative hashing; neighbours in the file stay near each other in the table where only `position`
        // changes, which spares the caches.
        const std::uint64_t rest = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.uv)) << 32 |
                                    static_cast<std::uint32_t>(corner.normal)) *
                                   0x9e3779b97f4a7c15u;
        const std::uint64_t mixed = (rest ^ rest >> 29) * 0xbf58476d1ce4e5b9u;
        return static_cast<std::size_t>((mixed >> 32) + 2 * static_cast<std::uint64_t>(corner.position));
    }

    void grow()
    {
        slots_.assign(2 * slots_.size(), unused);
        for (std::uint32_t number = 0; number < corners_.size(); ++number) {
            std::size_t slot = hash(corners_[number]);
            while (slots_[slot & (slots_.size() - 1)] != unused) ++slot;
            slots_[slot & (slots_.size() - 1)] = number;
        }
    }

    std::vector<std::uint32_t> slots_;
    std::vector<ObjCorner> corners_;
};

// What the whole file has.
struct FileFacts {
    const ObjAttributes& attributes;
    bool with_uvs = false;
    bool with_normals = false;
};

// The triangles of a chunk: three corners each, and what became of the others.
struct ObjTriangles {
    ObjCorners corners;
    std::vector<std::uint32_t> materials; // one a triangle, or empty
    std::vector<Vec3f> face_normals;      // a corner's normal -2 - i is the i-th of them
    std::size_t without_area = 0;
};

// Cuts the faces of a chunk into triangles that have an area.
class Cutter {
public:
    Cutter(const FileFacts& file, const ObjFaces& faces) : file_(file), faces_(faces) {}

    ObjTriangles run()
    {
        std::vector<Vec3f> polygon;
        std::vector<PolygonTriangle> cut;
        std::uint32_t begin = 0;
        std::size_t run = 0;
        for (std::size_t face = 0; face < faces_.ends.size(); ++face) {
            const std::uint32_t end = faces_.ends[face];
            while (run + 1 < faces_.materials.size() && faces_.materials[run + 1].first_face <= face) ++run;
            if (!faces_.materials.empty()) material_ = faces_.materials[run].material;
            face_begin_ = begin;
            face_end_ = end;
            has_face_normal_ = false;
            if (end - begin == 3) {
                add_if_area(begin, begin + 1, begin + 2);
            } else {
                polygon.clear();
                cut.clear();
                for (std::uint32_t i = begin; i < end; ++i) polygon.push_back(position(i));
                triangulate_polygon(polygon, cut);
                for (const PolygonTriangle& t : cut) add_if_area(begin + t[0], begin + t[1], begin + t[2]);
            }
            begin = end;
        }
        return std::move(result_);
    }

private:
    void add_if_area(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        if (!has_area(position(a), position(b), position(c))) {
            ++result_.without_area;
            return;
        }
        for (const std::uint32_t i : {a, b, c}) result_.corners.push_back(corner(i));
        if (!faces_.materials.empty()) result_.materials.push_back(material_);
    }

    ObjCorner corner(std::uint32_t i)
    {
        ObjCorner corner = faces_.corners[i];
        if (!file_.with_uvs) corner.uv = -1;
        if (file_.with_normals && !has_normal(corner)) corner.normal = face_normal();
        return corner;
    }

    const Vec3f& position(std::uint32_t i) const
    {
        return file_.attributes.positions[static_cast<std::size_t>(faces_.corners[i].position)];
    }

    bool has_normal(const ObjCorner& corner) const
    {
        return corner.normal >= 0 &&
               file_.attributes.normals[static_cast<std::size_t>(corner.normal)] != Vec3f(0.f);
    }

    // The index of the face's own normal.
    std::int32_t face_normal()
    {
        if (!has_face_normal_) {
            std::vector<Vec3f> polygon;
            for (std::uint32_t i = face_begin_; i < face_end_; ++i) polygon.push_back(position(i));
            const Vec3d sum = newell_normal(polygon);
            result_.face_normals.push_back(sum == Vec3d(0.0) ? Vec3f(0.f, 0.f, 1.f) : Vec3f(normalize(sum)));
            has_face_normal_ = true;
        }
        return -1 - static_cast<std::int32_t>(result_.face_normals.size());
    }

    const FileFacts& file_;
    const ObjFaces& faces_;
    ObjTriangles result_;
    std::uint32_t material_ = 0; // of the face
    std::uint32_t face_begin_ = 0;
    std::uint32_t face_end_ = 0;
    bool has_face_normal_ = false;
};

class Assembler {
public:
    Assembler(ObjAttributes& attributes, std::vector<ObjFaces> faces) : found_(attributes)
    {
        bool any_uv = false;
        bool all_uv = true;
        bool any_normal = false;
        for (const ObjFaces& chunk : faces) {
            any_uv |= chunk.any_uv;
            all_uv &= chunk.all_uv;
            any_normal |= chunk.any_normal;
            face_count_ += chunk.ends.size();
        }
        dropped_uvs_ = any_uv && !all_uv;
        file_.with_uvs = any_uv && all_uv;
        file_.with_normals = any_normal;
        chunks_.resize(faces.size());
        parallel_for(faces.size(), 0, [&](std::size_t i) {
            chunks_[i] = Cutter(file_, faces[i]).run();
            faces[i] = {}; // memory
        });
    }

    MeshData run()
    {
        std::size_t corners = 0;
        for (const ObjTriangles& chunk : chunks_) corners += chunk.corners.size();
        if (corners == 0) throw Error("no face has an area");
        reserve_large_pages(mesh_.triangles, corners / 3);
        if (file_.with_uvs || file_.with_normals)
            share_corners();
        else
            share_positions();
        write_warning();
        return std::move(mesh_);
    }

private:
    // Takes them chunk by chunk; number(corner) is the number of its vertex.
    template <class Number>
    void make_triangles(const Number& number)
    {
        for (ObjTriangles& chunk : chunks_) {
            const auto first_normal = static_cast<std::int32_t>(found_.normals.size());
            found_.normals.insert(found_.normals.end(), chunk.face_normals.begin(), chunk.face_normals.end());
            const auto index = [&](std::size_t i) {
                ObjCorner corner = chunk.corners[i];
                if (corner.normal < -1) corner.normal = first_normal - 2 - corner.normal;
                return number(corner);
            };
            for (std::size_t i = 0; i < chunk.corners.size(); i += 3) {
                const std::uint32_t a = index(i);
                const std::uint32_t b = index(i + 1);
                mesh_.triangles.push_back({a, b, index(i + 2)});
            }
            std::vector<std::uint32_t>& materials = mesh_.materials.of_primitive;
            materials.insert(materials.end(), chunk.materials.begin(), chunk.materials.end());
            without_area_ += chunk.without_area;
            faces_without_normal_ += chunk.face_normals.size();
            chunk = {}; // memory
        }
    }

    // Without uvs and normals: the file's positions, but for those that no triangle uses.
    void share_positions()
    {
        std::vector<std::uint32_t> numbers(found_.positions.size(), unused);
        make_triangles([&](const ObjCorner& corner) {
            const auto position = static_cast<std::uint32_t>(corner.position);
            numbers[position] = position;
            return position;
        });
        mesh_.positions = std::move(found_.positions);
        if (std::find(numbers.begin(), numbers.end(), unused) == numbers.end()) return;

        std::uint32_t kept = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] == unused) continue;
            mesh_.positions[kept] = mesh_.positions[i];
            numbers[i] = kept++;
        }
        mesh_.positions.resize(kept);
        for (MeshData::Triangle& triangle : mesh_.triangles)
            for (std::uint32_t& vertex : triangle) vertex = numbers[vertex];
    }

    // With uvs or normals: one vertex for each different triple of indices.
    void share_corners()
    {
        CornerNumbers numbers(found_.positions.size());
        make_triangles([&](const ObjCorner& corner) { return numbers[corner]; });

        const std::size_t count = numbers.corners().size();
        reserve_large_pages(mesh_.positions, count + 1); // MeshData
        if (file_.with_uvs) reserve_large_pages(mesh_.uvs, count);
        if (file_.with_normals) reserve_large_pages(mesh_.normals, count);
        for (const ObjCorner& corner : numbers.corners()) {
            mesh_.positions.push_back(found_.positions[static_cast<std::size_t>(corner.position)]);
            if (file_.with_uvs) mesh_.uvs.push_back(found_.uvs[static_cast<std::size_t>(corner.uv)]);
            if (file_.with_normals)
                mesh_.normals.push_back(found_.normals[static_cast<std::size_t>(corner.normal)]);
        }
    }

    void write_warning()
    {
        const auto add = [this](const std::string& text) {
            mesh_.warning += (mesh_.warning.empty() ? "" : "; ") + text;
        };
        if (without_area_ == 1) add("1 triangle has no area and was discarded");
        if (without_area_ > 1)
            add(fmt::format("{} triangles have no area and were discarded", without_area_));
        if (faces_without_normal_ > 0)
            add(fmt::format(
                "{} of {} faces have corners without a normal, or with one of length zero, where the face's "
                "own normal is used",
                faces_without_normal_, face_count_));
        if (dropped_uvs_) add("texture coordinates are ignored, because some face corners have none");
    }

    ObjAttributes& found_;
    FileFacts file_{found_};
    std::vector<ObjTriangles> chunks_;
    MeshData mesh_;
    std::size_t face_count_ = 0;
    std::size_t without_area_ = 0;
    std::size_t faces_without_normal_ = 0;
    bool dropped_uvs_ = false;
};

} // namespace

MeshData assemble_obj_mesh(ObjAttributes attributes, std::vector<ObjFaces> faces)
{
    return Assembler(attributes, std::move(faces)).run();
}

} // namespace plumb
