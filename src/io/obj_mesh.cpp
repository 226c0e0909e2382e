// SPDX-License-Identifier: MIT

#include "io/obj_mesh.h"

#include "io/obj_polygon.h"
#include "plumb/error.h"

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

class Assembler {
public:
    Assembler(ObjAttributes& attributes, const ObjFaces& faces) : found_(attributes), faces_(faces)
    {
        for (Vec3f& normal : found_.normals)
            if (normal != Vec3f(0.f)) normal = normalize(normal);
    }

    MeshData run()
    {
        if (faces_.any_uv || faces_.any_normal)
            share_corners();
        else
            share_positions();
        if (mesh_.triangles.empty()) throw Error("no face has an area");
        write_warning();
        return std::move(mesh_);
    }

private:
    // Calls use(face, a, b, c) for each triangle with an area; a, b, c number corners.
    template <class Use>
    void for_each_triangle(const Use& use)
    {
        std::vector<Vec3f> polygon;
        std::vector<PolygonTriangle> cut;
        std::uint32_t begin = 0;
        mesh_.triangles.reserve(faces_.corners.size() - 2 * faces_.ends.size());
        for (std::uint32_t face = 0; face < faces_.ends.size(); ++face) {
            const std::uint32_t end = faces_.ends[face];
            if (end - begin == 3) {
                use_if_area(use, face, begin, begin + 1, begin + 2);
            } else {
                polygon.clear();
                cut.clear();
                for (std::uint32_t i = begin; i < end; ++i) polygon.push_back(position(i));
                triangulate_polygon(polygon, cut);
                for (const PolygonTriangle& t : cut)
                    use_if_area(use, face, begin + t[0], begin + t[1], begin + t[2]);
            }
            begin = end;
        }
    }

    template <class Use>
    void use_if_area(const Use& use, std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        if (has_area(position(a), position(b), position(c)))
            use(face, a, b, c);
        else
            ++without_area_;
    }

    const Vec3f& position(std::uint32_t corner) const
    {
        return found_.positions[static_cast<std::size_t>(faces_.corners[corner].position)];
    }

    // Without uvs and normals: the file's positions, but for those that no triangle uses.
    void share_positions()
    {
        std::vector<std::uint32_t> numbers(found_.positions.size(), unused);
        const auto index = [&](std::uint32_t corner) {
            const auto position = static_cast<std::uint32_t>(faces_.corners[corner].position);
            numbers[position] = position;
            return position;
        };
        for_each_triangle([&](std::uint32_t, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh_.triangles.push_back({index(a), index(b), index(c)});
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
        const bool with_uvs = faces_.any_uv && faces_.all_uv;
        dropped_uvs_ = faces_.any_uv && !faces_.all_uv;
        CornerNumbers numbers(found_.positions.size());
        const auto index = [&](std::uint32_t face, std::uint32_t number) {
            ObjCorner corner = faces_.corners[number];
            if (!with_uvs) corner.uv = -1;
            if (faces_.any_normal && !has_normal(corner)) corner.normal = face_normal(face);
            return numbers[corner];
        };
        for_each_triangle([&](std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const std::uint32_t first = index(face, a);
            const std::uint32_t second = index(face, b);
            mesh_.triangles.push_back({first, second, index(face, c)});
        });

        const std::size_t count = numbers.corners().size();
        mesh_.positions.reserve(count);
        if (with_uvs) mesh_.uvs.reserve(count);
        if (faces_.any_normal) mesh_.normals.reserve(count);
        for (const ObjCorner& corner : numbers.corners()) {
            mesh_.positions.push_back(found_.positions[static_cast<std::size_t>(corner.position)]);
            if (with_uvs) mesh_.uvs.push_back(found_.uvs[static_cast<std::size_t>(corner.uv)]);
            if (faces_.any_normal)
                mesh_.normals.push_back(found_.normals[static_cast<std::size_t>(corner.normal)]);
        }
    }

    bool has_normal(const ObjCorner& corner) const
    {
        return corner.normal >= 0 && found_.normals[static_cast<std::size_t>(corner.normal)] != Vec3f(0.f);
    }

    // The index of the face's own normal, which is added to the file's when it is first needed.
    std::int32_t face_normal(std::uint32_t face)
    {
        if (face != last_face_) {
            std::vector<Vec3f> polygon;
            for (std::uint32_t i = face == 0 ? 0 : faces_.ends[face - 1]; i < faces_.ends[face]; ++i)
                polygon.push_back(position(i));
            const Vec3d sum = newell_normal(polygon);
            const Vec3f normal = sum == Vec3d(0.0) ? Vec3f(0.f, 0.f, 1.f) : Vec3f(normalize(sum));
            found_.normals.push_back(normal);
            last_face_ = face;
            ++faces_without_normal_;
        }
        return static_cast<std::int32_t>(found_.normals.size() - 1);
    }

    void write_warning()
    {
        const auto add = [this](const std::string& text) {
            mesh_.warning += (mesh_.warning.empty() ? "" : "; ") + text;
        };
        if (without_area_ == 1) add("1 triangle has no area and was left out");
        if (without_area_ > 1) add(fmt::format("{} triangles have no area and were left out", without_area_));
        if (faces_without_normal_ > 0)
            add(fmt::format(
                "{} of {} faces have corners without a normal, or with one of length zero, where the face's "
                "own normal is used",
                faces_without_normal_, faces_.ends.size()));
        if (dropped_uvs_) add("texture coordinates are left out, because some face corners have none");
    }

    ObjAttributes& found_;
    const ObjFaces& faces_;
    MeshData mesh_;
    std::size_t without_area_ = 0;
    std::size_t faces_without_normal_ = 0;
    std::uint32_t last_face_ = unused;
    bool dropped_uvs_ = false;
};

} // namespace

MeshData assemble_obj_mesh(ObjAttributes attributes, const ObjFaces& faces)
{
    return Assembler(attributes, faces).run();
}

} // namespace plumb
