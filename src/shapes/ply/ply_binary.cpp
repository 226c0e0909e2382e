// SPDX-License-Identifier: MIT

// Where all elements are of one size, threads share them. A face is expected to be a triangle; if one is not, faces are
// read one after the other.

#include "plumb/base/error.h"
#include "shapes/mesh_parts.h"
#include "shapes/obj/obj_number.h"
#include "shapes/ply/ply_data.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t elements_at_a_time = std::size_t{1} << 16;
constexpr std::uint64_t most_corners = std::uint64_t{1} << 24; // of one face

static_assert(std::endian::native == std::endian::little, "bytes are swapped where the file is big-endian");

template <class T>
T load(const char* p, bool swap)
{
    char bytes[sizeof(T)];
    if (swap)
        std::reverse_copy(p, p + sizeof(T), bytes);
    else
        std::memcpy(bytes, p, sizeof(T));
    return std::bit_cast<T>(bytes);
}

// Calls use(value) with a value of that type.
template <class Use>
auto with_type(PlyType type, const Use& use)
{
    switch (type) {
    case PlyType::int8: return use(std::int8_t{});
    case PlyType::uint8: return use(std::uint8_t{});
    case PlyType::int16: return use(std::int16_t{});
    case PlyType::uint16: return use(std::uint16_t{});
    case PlyType::int32: return use(std::int32_t{});
    case PlyType::uint32: return use(std::uint32_t{});
    case PlyType::float32: return use(float{});
    case PlyType::float64: break;
    }
    return use(double{});
}

class BinaryReader {
public:
    explicit BinaryReader(const PlyFile& file)
        : swap_(file.header.format == PlyHeader::Format::big_endian),
          p_(file.bytes.data() + file.header.size),
          end_(file.bytes.data() + file.bytes.size())
    {}

    void read(const PlyPlan& plan, std::vector<PlyFaces>& faces)
    {
        const PlyElement& element = *plan.element;
        if (element.count > left() / element.least_size())
            throw Error(
                fmt::format("the header announces {} elements '{}', but the file has only {} bytes for them",
                            element.count, excerpt(element.name), left()));
        const auto lists = static_cast<std::size_t>(
            std::count_if(element.properties.begin(), element.properties.end(),
                          [](const PlyProperty& property) { return property.count_type.has_value(); }));
        if (lists == 0)
            read_equal(plan, element.least_size(), faces);
        else if (!(lists == 1 && plan.has_corners() && read_triangles(plan, faces)))
            read_one_by_one(plan, faces);
    }

    std::size_t left() const { return static_cast<std::size_t>(end_ - p_); }

private:
    bool read_triangles(const PlyPlan& plan, std::vector<PlyFaces>& faces)
    {
        const PlyElement& element = *plan.element;
        const std::size_t size = element.least_size() + 3 * size_of(element.properties[plan.corners].type);
        if (element.count > left() / size) return false;
        const std::size_t first_chunk = faces.size();
        if (read_equal(plan, size, faces)) return true;
        faces.resize(first_chunk);
        return false;
    }

    // Elements of `size` bytes each. False: a face is not a triangle.
    bool read_equal(const PlyPlan& plan, std::size_t size, std::vector<PlyFaces>& faces)
    {
        const auto count = static_cast<std::size_t>(plan.element->count);
        const std::size_t chunks = (count + elements_at_a_time - 1) / elements_at_a_time;
        const std::size_t first_chunk = faces.size();
        if (plan.has_corners()) faces.resize(first_chunk + chunks);
        std::atomic<bool> equal = true;
        in_parallel_or_throw(chunks, [&](std::size_t chunk) {
            const std::size_t begin = chunk * elements_at_a_time;
            const std::size_t end = std::min(begin + elements_at_a_time, count);
            std::size_t offset = 0;
            for (std::size_t i = 0; i < plan.element->properties.size() && equal; ++i) {
                const PlyProperty& property = plan.element->properties[i];
                if (property.count_type) {
                    if (!read_corners(plan, {begin, end, size, offset}, faces[first_chunk + chunk]))
                        equal = false;
                    offset += size_of(*property.count_type) + 3 * size_of(property.type);
                    continue;
                }
                if (plan.targets[i].first) read_column(plan, i, {begin, end, size, offset});
                offset += size_of(property.type);
            }
        });
        if (equal) p_ += count * size;
        return equal;
    }

    // One property of elements of one size.
    struct Column {
        std::size_t begin; // elements
        std::size_t end;
        std::size_t size; // of an element
        std::size_t offset;
    };

    void read_column(const PlyPlan& plan, std::size_t property, const Column& column) const
    {
        const PlyTarget target = plan.targets[property];
        with_type(plan.element->properties[property].type, [&](auto type) {
            using T = decltype(type);
            const char* p = p_ + column.begin * column.size + column.offset;
            float* into = target.first + column.begin * target.stride;
            for (std::size_t i = column.begin; i < column.end; ++i, p += column.size, into += target.stride) {
                const auto value = static_cast<float>(load<T>(p, swap_));
                if (!(std::abs(value) <= target.largest)) [[unlikely]]
                    fail_value(plan, property, i, static_cast<double>(value), target);
                *into = value * target.scale;
            }
        });
    }

    bool read_corners(const PlyPlan& plan, const Column& column, PlyFaces& faces) const
    {
        const PlyProperty& property = plan.element->properties[plan.corners];
        const std::size_t count_size = size_of(*property.count_type);
        faces.corners.resize(3 * (column.end - column.begin));
        faces.add_triangles(column.end - column.begin);
        const char* const first = p_ + column.begin * column.size + column.offset;
        const bool triangles = with_type(*property.count_type, [&](auto type) {
            const char* p = first;
            for (std::size_t i = column.begin; i < column.end; ++i, p += column.size)
                if (load<decltype(type)>(p, swap_) != decltype(type){3}) return false;
            return true;
        });
        if (!triangles) return false;
        with_type(property.type, [&](auto type) {
            using T = decltype(type);
            const char* p = first + count_size;
            std::uint32_t* into = faces.corners.data();
            for (std::size_t i = column.begin; i < column.end; ++i, p += column.size)
                for (std::size_t k = 0; k < 3; ++k)
                    *into++ = corner_from(plan, i, load<T>(p + k * sizeof(T), swap_));
        });
        return true;
    }

    template <class T>
    static std::uint32_t corner_from(const PlyPlan& plan, std::size_t face, T value)
    {
        if constexpr (std::is_integral_v<T>) {
            const auto corner = static_cast<std::uint32_t>(value); // negative ones become larger than any
            if (corner < plan.vertices) [[likely]]
                return corner;
        } else if (value >= T{0} && value < static_cast<T>(plan.vertices) && value == std::floor(value)) {
            return static_cast<std::uint32_t>(value);
        }
        throw Error(fmt::format("face {} has corner {}; the file has {} vertices, counted from 0", face,
                                value, plan.vertices));
    }

    void read_one_by_one(const PlyPlan& plan, std::vector<PlyFaces>& faces)
    {
        const PlyElement& element = *plan.element;
        for (std::size_t i = 0; i < element.count; ++i) {
            if (plan.has_corners() && i % elements_at_a_time == 0) faces.emplace_back();
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (!property.count_type) {
                    const double value = next(plan, i, property.type);
                    if (plan.targets[k].first) store(plan, k, i, value);
                    continue;
                }
                const double count = next(plan, i, *property.count_type);
                if (!(count >= 0.0))
                    throw Error(fmt::format("{} {} has a list of {} values", singular(plan), i, count));
                const auto values = static_cast<std::uint64_t>(count);
                if (values > left() / size_of(property.type)) fail_end(plan, i);
                if (k == plan.corners)
                    read_face(plan, i, values, faces.back());
                else
                    p_ += values * size_of(property.type);
            }
        }
    }

    void read_face(const PlyPlan& plan, std::size_t face, std::uint64_t count, PlyFaces& faces)
    {
        if (count < 3 || count > most_corners)
            throw Error(
                fmt::format("face {} has {} corners; it must have from 3 to {}", face, count, most_corners));
        const PlyType type = plan.element->properties[plan.corners].type;
        with_type(type, [&](auto example) {
            using T = decltype(example);
            for (std::uint64_t k = 0; k < count; ++k, p_ += sizeof(T))
                faces.corners.push_back(corner_from(plan, face, load<T>(p_, swap_)));
        });
        faces.add_face();
    }

    double next(const PlyPlan& plan, std::size_t element, PlyType type)
    {
        if (size_of(type) > left()) fail_end(plan, element);
        const double value = with_type(
            type, [&](auto example) { return static_cast<double>(load<decltype(example)>(p_, swap_)); });
        p_ += size_of(type);
        return value;
    }

    static void store(const PlyPlan& plan, std::size_t property, std::size_t element, double value)
    {
        const PlyTarget& target = plan.targets[property];
        if (!(std::abs(value) <= static_cast<double>(target.largest)))
            fail_value(plan, property, element, value, target);
        target.first[element * target.stride] = static_cast<float>(value) * target.scale;
    }

    static std::string singular(const PlyPlan& plan) { return excerpt(plan.element->name); }

    [[noreturn]] static void fail_value(const PlyPlan& plan, std::size_t property, std::size_t element,
                                        double value, const PlyTarget& target)
    {
        const std::string what = fmt::format("{} {}: '{}' is", singular(plan), element,
                                             excerpt(plan.element->properties[property].name));
        if (!std::isfinite(value)) throw Error(what + " not a finite number");
        throw Error(fmt::format("{} {:.6g}, which is too large: numbers may be at most {:.3g}", what, value,
                                static_cast<double>(target.largest)));
    }

    [[noreturn]] static void fail_end(const PlyPlan& plan, std::size_t element)
    {
        throw Error(
            fmt::format("the file ends in {} {} of {}", singular(plan), element, plan.element->count));
    }

    bool swap_;
    const char* p_; // what has not been read
    const char* end_;
};

} // namespace

std::size_t read_ply_binary(const PlyFile& file, std::span<const PlyPlan> plans, std::vector<PlyFaces>& faces)
{
    BinaryReader reader(file);
    for (const PlyPlan& plan : plans) reader.read(plan, faces);
    return reader.left();
}

} // namespace plumb
