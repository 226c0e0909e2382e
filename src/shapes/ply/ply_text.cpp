// SPDX-License-Identifier: MIT

// Each element is a line. Chunks of lines are counted first, so that all threads know which elements theirs are.

#include "base/parallel.h"
#include "plumb/base/error.h"
#include "shapes/mesh_parts.h"
#include "shapes/obj/obj_number.h"
#include "shapes/ply/ply_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 19; // bytes

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

const char* line_end(const char* begin, const char* end)
{
    const void* const found = std::memchr(begin, '\n', static_cast<std::size_t>(end - begin));
    return found ? static_cast<const char*>(found) : end;
}

const char* skip_blanks(const char* p, const char* end)
{
    while (p != end && is_blank(*p)) ++p;
    return p;
}

// Calls line(begin, end) for each line that is not blank, until it returns false.
template <class Line>
void for_each_line(std::string_view text, const Line& line)
{
    const char* p = text.data();
    const char* const end = p + text.size();
    while (p != end) {
        const char* const stop = line_end(p, end);
        const char* const begin = skip_blanks(p, stop);
        if (begin != stop && !line(begin, stop)) return;
        p = stop == end ? end : stop + 1;
    }
}

class TextReader {
public:
    TextReader(const PlyFile& file, std::span<const PlyPlan> plans)
        : file_(file), plans_(plans), data_(file.bytes.substr(file.header.size))
    {
        std::uint64_t lines = 0;
        for (const PlyPlan& plan : plans_) {
            const PlyElement& element = *plan.element;
            // A value has a digit and a blank or a line end.
            const std::size_t least = 2 * element.properties.size();
            if (element.count > (data_.size() + 1) / least)
                throw Error(
                    fmt::format("the header announces {} elements '{}', but the file has only {} bytes for "
                                "them",
                                element.count, excerpt(element.name), data_.size()));
            lines += element.count;
            ends_.push_back(lines);
        }
        cut();
    }

    std::size_t read(std::vector<PlyFaces>& faces)
    {
        const std::size_t first_chunk = faces.size();
        faces.resize(first_chunk + chunks_.size());
        in_parallel_or_throw(chunks_.size(), [&](std::size_t i) { read_chunk(i, faces[first_chunk + i]); });
        const std::uint64_t wanted = ends_.empty() ? 0 : ends_.back();
        if (lines_ < wanted) {
            const std::size_t which = plan_of(lines_);
            throw Error(fmt::format("the file ends after {} of {} elements '{}'", lines_ - begin_of(which),
                                    plans_[which].element->count, excerpt(plans_[which].element->name)));
        }
        return lines_ - wanted;
    }

private:
    void cut()
    {
        std::string_view rest = data_;
        while (!rest.empty()) {
            std::size_t size = rest.size();
            if (size > chunk_size) {
                const std::size_t end = rest.find('\n', chunk_size);
                size = end == rest.npos ? rest.size() : end + 1;
            }
            chunks_.push_back(rest.substr(0, size));
            rest.remove_prefix(size);
        }
        first_line_.resize(chunks_.size());
        parallel_for(chunks_.size(), 0, [&](std::size_t i) {
            std::uint64_t count = 0;
            for_each_line(chunks_[i], [&](const char*, const char*) { return ++count, true; });
            first_line_[i] = count;
        });
        for (std::uint64_t& count : first_line_) {
            const std::uint64_t before = lines_;
            lines_ += count;
            count = before;
        }
    }

    std::size_t plan_of(std::uint64_t line) const
    {
        return static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), line) - ends_.begin());
    }
    std::uint64_t begin_of(std::size_t plan) const { return plan == 0 ? 0 : ends_[plan - 1]; }

    void read_chunk(std::size_t chunk, PlyFaces& faces) const
    {
        std::uint64_t line = first_line_[chunk];
        std::size_t plan = plan_of(line);
        for_each_line(chunks_[chunk], [&](const char* begin, const char* end) {
            while (plan < plans_.size() && line >= ends_[plan]) ++plan;
            if (plan == plans_.size()) return false;
            read_element(plans_[plan], static_cast<std::size_t>(line - begin_of(plan)), begin, end, faces);
            ++line;
            return true;
        });
    }

    void read_element(const PlyPlan& plan, std::size_t index, const char* p, const char* end,
                      PlyFaces& faces) const
    {
        const std::vector<PlyProperty>& properties = plan.element->properties;
        for (std::size_t i = 0; i < properties.size(); ++i) {
            if (!properties[i].count_type) {
                const float value = read_number(plan, i, p, end);
                const PlyTarget& target = plan.targets[i];
                if (target.first) target.first[index * target.stride] = value * target.scale;
                continue;
            }
            const std::uint64_t count = read_index(plan, i, p, end);
            if (i == plan.corners)
                read_face(plan, count, p, end, faces);
            else
                for (std::uint64_t k = 0; k < count; ++k) read_number(plan, i, p, end);
        }
        p = skip_blanks(p, end);
        if (p != end)
            fail({p, token_end(p, end)},
                 fmt::format("more values than the properties of '{}' take", excerpt(plan.element->name)));
    }

    void read_face(const PlyPlan& plan, std::uint64_t count, const char*& p, const char* end,
                   PlyFaces& faces) const
    {
        if (count < 3) fail(token_at(p, end), fmt::format("a face needs at least 3 corners, not {}", count));
        for (std::uint64_t k = 0; k < count; ++k) {
            const std::uint64_t corner = read_index(plan, plan.corners, p, end);
            if (corner >= plan.vertices)
                fail(last_token(p, end), fmt::format("there is no vertex {}; the file has {}, counted from 0",
                                                     corner, plan.vertices));
            faces.corners.push_back(static_cast<std::uint32_t>(corner));
        }
        faces.add_face();
    }

    // p moves behind the number.
    float read_number(const PlyPlan& plan, std::size_t property, const char*& p, const char* end) const
    {
        p = skip_blanks(p, end);
        if (p == end) fail_short(plan, property, end);
        const PlyTarget& target = plan.targets[property];
        float value = 0.f;
        const std::from_chars_result result = std::from_chars(p, end, value);
        const bool is_number =
            result.ec == std::errc() && (result.ptr == end || is_blank(*result.ptr)) && std::isfinite(value);
        if (is_number && std::abs(value) <= target.largest) [[likely]] {
            p = result.ptr;
            return value;
        }
        // A leading +, a number too small for a float; or a mistake.
        const std::string_view token(p, token_end(p, end));
        const ObjNumber number = parse_obj_number(token);
        p = token.data() + token.size();
        switch (number.status) {
        case ObjNumber::Status::unreadable: fail(token, fmt::format("'{}' is not a number", excerpt(token)));
        case ObjNumber::Status::not_finite:
            if (!target.first) return 0.f;
            fail(token, fmt::format("'{}' is not a finite number", excerpt(token)));
        case ObjNumber::Status::too_large: break;
        case ObjNumber::Status::good:
            if (std::abs(number.value) <= target.largest) return number.value;
        }
        if (!target.first) return 0.f;
        fail(token, fmt::format("'{}' is too large: numbers may be at most {:.3g}", excerpt(token),
                                static_cast<double>(target.largest)));
    }

    std::uint64_t read_index(const PlyPlan& plan, std::size_t property, const char*& p, const char* end) const
    {
        p = skip_blanks(p, end);
        if (p == end) fail_short(plan, property, end);
        std::uint64_t value = 0;
        const std::from_chars_result result = std::from_chars(p, end, value);
        if (result.ec != std::errc() || (result.ptr != end && !is_blank(*result.ptr))) {
            const std::string_view token(p, token_end(p, end));
            fail(token, fmt::format("'{}' is not a whole number from 0", excerpt(token)));
        }
        p = result.ptr;
        return value;
    }

    static const char* token_end(const char* p, const char* end) { return std::find_if(p, end, is_blank); }
    static std::string_view token_at(const char* p, const char* end)
    {
        p = skip_blanks(p, end);
        return {p, static_cast<std::size_t>(token_end(p, end) - p)};
    }
    static std::string_view last_token(const char* p, const char*)
    {
        const char* begin = p;
        while (!is_blank(begin[-1]) && begin[-1] != '\n') --begin;
        return {begin, static_cast<std::size_t>(p - begin)};
    }

    [[noreturn]] void fail_short(const PlyPlan& plan, std::size_t property, const char* at) const
    {
        fail({at, std::size_t{0}},
             fmt::format("the line ends before property '{}' of '{}'",
                         excerpt(plan.element->properties[property].name), excerpt(plan.element->name)));
    }

    // at: a part of the data.
    [[noreturn]] void fail(std::string_view at, const std::string& message) const
    {
        const auto offset = static_cast<std::size_t>(at.data() - file_.bytes.data());
        throw FileError(
            SourceLocation::from_offset(file_.name, file_.bytes, offset, std::max<std::size_t>(at.size(), 1)),
            message);
    }

    const PlyFile& file_;
    std::span<const PlyPlan> plans_;
    std::string_view data_;
    std::vector<std::uint64_t> ends_; // the number of lines up to each plan's end
    std::vector<std::string_view> chunks_;
    std::vector<std::uint64_t> first_line_; // of each chunk, among those that are not blank
    std::uint64_t lines_ = 0;               // that are not blank
};

} // namespace

std::size_t read_ply_text(const PlyFile& file, std::span<const PlyPlan> plans, std::vector<PlyFaces>& faces)
{
    return TextReader(file, plans).read(faces);
}

} // namespace plumb
