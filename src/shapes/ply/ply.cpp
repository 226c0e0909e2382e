// SPDX-License-Identifier: MIT

// Reading PLY files: the header says what each property is (plan_of_vertices, plan_of_faces), the data goes where the plans
// say, and the faces become triangles.

#include "base/memory.h"
#include "plumb/base/error.h"
#include "plumb/shapes/mesh.h"
#include "shapes/mesh_parts.h"
#include "shapes/obj/obj_number.h"
#include "shapes/obj/obj_polygon.h"
#include "shapes/ply/ply_data.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

// The numbers of the properties with these names; nothing unless all are there.
std::optional<std::vector<std::size_t>> find_all(const PlyElement& element,
                                                 std::initializer_list<std::string_view> names)
{
    std::vector<std::size_t> found;
    for (const std::string_view name : names) {
        const auto at = std::find_if(
            element.properties.begin(), element.properties.end(),
            [&](const PlyProperty& property) { return property.name == name && !property.count_type; });
        if (at == element.properties.end()) return std::nullopt;
        found.push_back(static_cast<std::size_t>(at - element.properties.begin()));
    }
    return found;
}

// The first of several sets of names that is there.
std::optional<std::vector<std::size_t>> find_any(
    const PlyElement& element, std::initializer_list<std::initializer_list<std::string_view>> sets)
{
    for (const auto& names : sets)
        if (auto found = find_all(element, names)) return found;
    return std::nullopt;
}

// 1 for floating-point numbers; integers stand for the part of their largest value.
float color_scale(PlyType type)
{
    if (!is_integer(type)) return 1.f;
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    const double bits = 8.0 * static_cast<double>(size_of(type)) - (is_signed ? 1.0 : 0.0);
    return static_cast<float>(1.0 / (std::exp2(bits) - 1.0));
}

class PlyReader {
public:
    explicit PlyReader(PlyFile file) : file_(std::move(file)) {}

    MeshData read()
    {
        const PlyElement& vertices = element("vertex");
        const PlyElement& faces = element("face");
        if (vertices.count > std::numeric_limits<std::uint32_t>::max())
            throw Error(fmt::format("{} vertices are more than 32-bit indices can count", vertices.count));
        check_size();

        vertex_count_ = static_cast<std::uint32_t>(vertices.count);
        face_count_ = static_cast<std::size_t>(faces.count);
        for (const PlyElement& e : file_.header.elements) {
            PlyPlan plan{&e, std::vector<PlyTarget>(e.properties.size())};
            if (&e == &vertices) plan_vertices(plan);
            if (&e == &faces) plan_faces(plan);
            plans_.push_back(std::move(plan));
        }
        const bool is_text = file_.header.format == PlyHeader::Format::ascii;
        std::vector<PlyFaces> chunks;
        const std::size_t rest =
            is_text ? read_ply_text(file_, plans_, chunks) : read_ply_binary(file_, plans_, chunks);
        if (rest > 0)
            mesh_.warning =
                fmt::format("{} {}{} behind the last element {} ignored", rest, is_text ? "line" : "byte",
                            rest == 1 ? "" : "s", rest == 1 ? "is" : "are");
        make_triangles(chunks);
        tidy_mesh(mesh_);
        return std::move(mesh_);
    }

private:
    const PlyElement& element(std::string_view name) const
    {
        for (const PlyElement& e : file_.header.elements)
            if (e.name == name) return e;
        throw Error(fmt::format("the file has no element '{}'", name));
    }

    // Before memory is taken for what the header announces.
    void check_size() const
    {
        const std::size_t left = file_.bytes.size() - file_.header.size;
        const bool is_text = file_.header.format == PlyHeader::Format::ascii;
        for (const PlyElement& e : file_.header.elements) {
            const std::size_t least = is_text ? 2 * e.properties.size() : e.least_size();
            if (e.count > (left + 1) / least)
                throw Error(fmt::format(
                    "the header announces {} elements '{}', but the file has only {} bytes for them", e.count,
                    excerpt(e.name), left));
        }
    }

    template <class T>
    static float* floats(std::vector<T>& values)
    {
        return values.empty() ? nullptr : &values[0][0];
    }

    static void aim(PlyPlan& plan, const std::vector<std::size_t>& properties, float* first, float largest)
    {
        for (std::size_t i = 0; i < properties.size(); ++i)
            plan.targets[properties[i]] = {first ? first + i : nullptr, properties.size(), 1.f, largest};
    }

    void plan_vertices(PlyPlan& plan)
    {
        const PlyElement& e = *plan.element;
        const auto positions = find_all(e, {"x", "y", "z"});
        if (!positions) throw Error("the vertices have no properties 'x', 'y' and 'z'");
        reserve_large_pages(mesh_.positions, vertex_count_ + 1); // MeshData
        mesh_.positions.resize(vertex_count_);
        aim(plan, *positions, floats(mesh_.positions), largest_position);
        if (const auto normals = find_all(e, {"nx", "ny", "nz"})) {
            reserve_large_pages(mesh_.normals, vertex_count_);
            mesh_.normals.resize(vertex_count_);
            aim(plan, *normals, floats(mesh_.normals), largest_position);
        }
        if (const auto uvs = find_any(e, {{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}})) {
            reserve_large_pages(mesh_.uvs, vertex_count_);
            mesh_.uvs.resize(vertex_count_);
            aim(plan, *uvs, floats(mesh_.uvs), largest_position);
        }
        plan_attributes(plan, "vertex_", vertex_count_);
    }

    void plan_faces(PlyPlan& plan)
    {
        const std::vector<PlyProperty>& properties = plan.element->properties;
        const auto corners =
            std::find_if(properties.begin(), properties.end(), [](const PlyProperty& property) {
                return property.count_type &&
                       (property.name == "vertex_indices" || property.name == "vertex_index");
            });
        if (corners == properties.end())
            throw Error("the faces have no list 'vertex_indices' or 'vertex_index'");
        plan.corners = static_cast<std::size_t>(corners - properties.begin());
        plan.vertices = vertex_count_;
        plan_attributes(plan, "face_", face_count_);
    }

    void plan_attributes(PlyPlan& plan, const std::string& prefix, std::size_t count)
    {
        const PlyElement& e = *plan.element;
        if (const auto colors = find_any(e, {{"r", "g", "b"}, {"red", "green", "blue"}}))
            add_attribute(plan, prefix + "color", *colors, count);
        for (const PlyProperty& property : e.properties) {
            const std::size_t end = property.name.rfind('_');
            if (property.count_type || end == std::string::npos || end == 0) continue;
            const std::string name = property.name.substr(0, end);
            const std::string last = property.name.substr(end + 1);
            if (last != "0" && last != "r" && last != "x") continue;
            const auto three = find_any(e, {{name + "_0", name + "_1", name + "_2"},
                                            {name + "_r", name + "_g", name + "_b"},
                                            {name + "_x", name + "_y", name + "_z"}});
            if (three)
                add_attribute(plan, prefix + name, *three, count);
            else if (last == "0" && !find_all(e, {name + "_1"}))
                add_attribute(plan, prefix + name, *find_all(e, {property.name}), count);
        }
    }

    void add_attribute(PlyPlan& plan, const std::string& name, const std::vector<std::size_t>& properties,
                       std::size_t count)
    {
        for (const MeshAttribute& other : mesh_.attributes)
            if (other.name == name) return;
        MeshAttribute attribute{name, name.starts_with("face_"),
                                static_cast<std::uint32_t>(properties.size()),
                                std::vector<float>(count * properties.size())};
        aim(plan, properties, attribute.values.data(), std::numeric_limits<float>::max());
        for (const std::size_t i : properties)
            plan.targets[i].scale = color_scale(plan.element->properties[i].type);
        mesh_.attributes.push_back(std::move(attribute)); // its values stay where they are
    }

    // The triangles of a chunk, and how many each face became; empty: one.
    struct Cut {
        std::vector<PolygonTriangle> triangles;
        std::vector<std::uint32_t> of_face;
    };

    void make_triangles(std::vector<PlyFaces>& chunks)
    {
        std::vector<Cut> cuts(chunks.size());
        in_parallel_or_throw(chunks.size(), [&](std::size_t i) {
            if (!chunks[i].ends.empty()) cuts[i] = cut(chunks[i]);
        });
        std::vector<std::size_t> first(chunks.size() + 1);
        for (std::size_t i = 0; i < chunks.size(); ++i)
            first[i + 1] = first[i] + (chunks[i].ends.empty() ? chunks[i].count() : cuts[i].triangles.size());
        if (first.back() == 0) throw Error("the file has no faces");
        if (first.back() > std::numeric_limits<std::uint32_t>::max())
            throw Error(fmt::format("{} triangles are more than 32-bit indices can count", first.back()));
        reserve_large_pages(mesh_.triangles, first.back());
        mesh_.triangles.resize(first.back());
        in_parallel_or_throw(chunks.size(), [&](std::size_t i) {
            MeshData::Triangle* const into = mesh_.triangles.data() + first[i];
            if (!chunks[i].ends.empty())
                std::copy(cuts[i].triangles.begin(), cuts[i].triangles.end(), into);
            else if (chunks[i].count() > 0)
                std::memcpy(into, chunks[i].corners.data(), chunks[i].count() * sizeof(*into));
        });
        if (first.back() != face_count_) spread_attributes(chunks, cuts);
    }

    Cut cut(const PlyFaces& faces) const
    {
        Cut result;
        std::vector<Vec3f> polygon;
        std::vector<PolygonTriangle> triangles;
        std::uint32_t begin = 0;
        for (const std::uint32_t end : faces.ends) {
            triangles.clear();
            if (end - begin == 3) {
                triangles.push_back({0, 1, 2});
            } else {
                polygon.clear();
                for (std::uint32_t i = begin; i < end; ++i)
                    polygon.push_back(mesh_.positions[faces.corners[i]]);
                triangulate_polygon(polygon, triangles);
            }
            for (const PolygonTriangle& t : triangles)
                result.triangles.push_back(
                    {faces.corners[begin + t[0]], faces.corners[begin + t[1]], faces.corners[begin + t[2]]});
            result.of_face.push_back(static_cast<std::uint32_t>(triangles.size()));
            begin = end;
        }
        return result;
    }

    // From faces to their triangles.
    void spread_attributes(const std::vector<PlyFaces>& chunks, const std::vector<Cut>& cuts)
    {
        for (MeshAttribute& attribute : mesh_.attributes) {
            if (!attribute.per_face) continue;
            std::vector<float> values;
            values.reserve(mesh_.triangles.size() * attribute.channels);
            const float* p = attribute.values.data();
            for (std::size_t i = 0; i < chunks.size(); ++i)
                for (std::size_t k = 0; k < chunks[i].count(); ++k, p += attribute.channels)
                    for (std::uint32_t n = chunks[i].ends.empty() ? 1 : cuts[i].of_face[k]; n > 0; --n)
                        values.insert(values.end(), p, p + attribute.channels);
            attribute.values = std::move(values);
        }
    }

    PlyFile file_;
    std::vector<PlyPlan> plans_;
    std::uint32_t vertex_count_ = 0;
    std::size_t face_count_ = 0;
    MeshData mesh_;
};

} // namespace

MeshData read_ply(const std::filesystem::path& path)
{
    const auto fail = [&](const std::string& reason) -> MeshData {
        throw Error(fmt::format("cannot read '{}': {}", path.string(), reason));
    };
    try {
        const FileBytes content = read_file_bytes(path);
        PlyFile file{path.string(), {content.bytes.get(), content.size}, {}};
        file.header = read_ply_header(file.name, file.bytes);
        return PlyReader(std::move(file)).read();
    } catch (const std::bad_alloc&) {
        return fail("not enough memory");
    } catch (const std::system_error& error) { // no thread to be had
        return fail(error.what());
    } catch (const FileError&) {
        throw;
    } catch (const Error& error) {
        if (std::string_view(error.what()).starts_with("cannot read")) throw;
        return fail(error.what());
    }
}

} // namespace plumb
