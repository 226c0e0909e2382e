// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_scan.h"

#include "shapes/obj/obj_characters.h"
#include "shapes/obj/obj_error.h"
#include "shapes/obj/obj_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace plumb {

namespace {

constexpr float largest_coordinate = 1e18f;

// What a line's keyword means, for messages.
struct Numbers {
    const char* name;
    const char* form;
    int needed;
    int kept;
};
constexpr Numbers vertex_numbers{"a vertex", "v x y z", 3, 3};
constexpr Numbers normal_numbers{"a normal", "vn x y z", 3, 3};
constexpr Numbers uv_numbers{"a texture coordinate", "vt u v", 1, 2};

// The keyword of a line: v, vn, vt, f; or nothing where it is another. p: behind the line's blanks.
std::string_view keyword_at(const char* p)
{
    if (p[0] != 'v' && p[0] != 'f') return {};
    const std::string_view keyword(p, p[0] == 'v' && (p[1] == 't' || p[1] == 'n') ? 2 : 1);
    return is_token_end(p + keyword.size()) ? keyword : std::string_view();
}

// What stands behind a keyword, to the end of the line; nothing where the statement is another. p: behind the line's
// blanks.
std::optional<std::string_view> text_behind(std::string_view keyword, const char* p)
{
    for (const char c : keyword)
        if (*p++ != c) return std::nullopt;
    if (!is_token_end(p)) return std::nullopt;
    p = skip_blanks(p);
    const char* end = line_end(p);
    while (end > p && is_blank(end[-1])) --end;
    return std::string_view(p, static_cast<std::size_t>(end - p));
}

class Scanner {
public:
    Scanner(const ObjFile& file, std::string_view chunk, const ObjCounts& before, ObjAttributes& found)
        : file_(file), chunk_(chunk), next_(before), found_(found)
    {}

    ObjChunk run()
    {
        const char* p = chunk_.data();
        const char* const end = p + chunk_.size();
        while (p != end) p = scan_line(p);
        return std::move(result_);
    }

private:
    // Returns the start of the next line.
    const char* scan_line(const char* line)
    {
        const char* p = skip_blanks(line);
        const std::string_view keyword = keyword_at(p);
        if (keyword.empty()) return scan_other(p);
        const char* rest = p + keyword.size();
        if (keyword == "f") return scan_face(p, rest);
        if (keyword == "v") {
            float x[3];
            rest = scan_numbers(p, rest, vertex_numbers, x);
            found_.positions[next_.positions++] = Vec3f(x[0], x[1], x[2]);
        } else if (keyword == "vn") {
            float x[3];
            rest = scan_numbers(p, rest, normal_numbers, x);
            const Vec3f normal(x[0], x[1], x[2]);
            found_.normals[next_.normals++] = normal != Vec3f(0.f) ? normalize(normal) : normal;
        } else {
            float x[3] = {0.f, 0.f, 0.f};
            rest = scan_numbers(p, rest, uv_numbers, x);
            found_.uvs[next_.uvs++] = Vec2f(x[0], x[1]);
        }
        return next_line(rest);
    }

    const char* scan_other(const char* p)
    {
        if (const auto name = text_behind("usemtl", p))
            result_.materials.push_back({result_.faces.ends.size(), *name});
        if (const auto name = text_behind("mtllib", p)) result_.libraries.push_back(*name);
        return next_statement(p);
    }

    // All numbers of a line; `values` receives the first ones.
    const char* scan_numbers(const char* keyword, const char* p, const Numbers& kind, float (&values)[3])
    {
        int count = 0;
        for (p = skip_blanks(p); !is_line_end(*p) && *p != '#'; p = skip_blanks(p)) {
            const char* const end = token_end(p);
            const std::string_view token(p, static_cast<std::size_t>(end - p));
            const float value = number(token, kind);
            if (count < kind.kept) values[count] = value;
            ++count;
            p = end;
        }
        if (count < kind.needed)
            fail(std::string_view(keyword, static_cast<std::size_t>(token_end(keyword) - keyword)),
                 fmt::format("{} needs {} number{}, not {}: {}", kind.name, kind.needed,
                             kind.needed == 1 ? "" : "s", count, kind.form));
        return p;
    }

    float number(std::string_view token, const Numbers& kind) const
    {
        const ObjNumber read = parse_obj_number(token);
        if (read.status == ObjNumber::Status::good && std::abs(read.value) <= largest_coordinate)
            return read.value;
        if (read.status == ObjNumber::Status::unreadable)
            fail(token,
                 fmt::format("'{}' is not a number; {} is written {}", excerpt(token), kind.name, kind.form));
        if (read.status == ObjNumber::Status::not_finite)
            fail(token, fmt::format("numbers must be finite, not '{}'", excerpt(token)));
        fail(token, fmt::format("numbers must lie between -1e18 and 1e18, not '{}'", excerpt(token)));
    }

    const char* scan_face(const char* keyword, const char* p)
    {
        int count = 0;
        const char* last = p;
        for (p = skip_blanks(p); !is_line_end(*p) && *p != '#'; p = skip_blanks(p)) {
            last = p = scan_corner(p);
            ++count;
        }
        if (count < 3)
            fail(std::string_view(keyword, static_cast<std::size_t>(last - keyword)),
                 fmt::format("a face needs at least 3 corners, not {}", count));
        result_.faces.end_face();
        return next_line(p);
    }

    // p, p/t, p//n or p/t/n; what is left out may leave its slashes behind.
    const char* scan_corner(const char* p)
    {
        const char* const begin = p;
        ObjCorner corner;
        const auto scan = [&](std::int32_t& to, std::size_t count_so_far, const IndexKind& kind,
                              ObjLargestIndex& largest) {
            const Index index = scan_index(begin, p, count_so_far, kind, largest);
            to = index.value;
            p = index.end;
        };
        scan(corner.position, next_.positions, position_indices, result_.position);
        if (*p == '/' && p[1] == '/') {
            p += 2;
            if (!is_token_end(p)) scan(corner.normal, next_.normals, normal_indices, result_.normal);
        } else if (*p == '/' && !is_token_end(++p)) {
            scan(corner.uv, next_.uvs, uv_indices, result_.uv);
            if (*p == '/' && !is_token_end(++p))
                scan(corner.normal, next_.normals, normal_indices, result_.normal);
        }
        if (!is_token_end(p)) fail_corner(begin);
        result_.faces.add_corner(corner);
        return p;
    }

    // Counted from 0; where it ends.
    struct Index {
        std::int32_t value;
        const char* end;
    };

    // In the file 1 is the first and -1 the last so far.
    Index scan_index(const char* corner, const char* p, std::size_t count_so_far, const IndexKind& kind,
                     ObjLargestIndex& largest) const
    {
        const char* const begin = p;
        const bool negative = *p == '-';
        if (*p == '-' || *p == '+') ++p;
        if (!is_digit(*p)) fail_corner(corner);
        std::int64_t magnitude = 0;
        for (; is_digit(*p); ++p)
            magnitude =
                std::min<std::int64_t>(magnitude * 10 + (*p - '0'), std::numeric_limits<std::int32_t>::max());

        const std::string_view token(begin, static_cast<std::size_t>(p - begin));
        if (magnitude == 0) fail(token, "indices count from 1 (or backwards from -1), not from 0");
        const auto so_far = static_cast<std::int64_t>(count_so_far);
        if (negative && magnitude > so_far)
            fail(token, fmt::format("{} index {} is out of range: only {} so far", kind.one, excerpt(token),
                                    kind.counted(count_so_far)));
        if (!negative && magnitude > largest.value) largest = {static_cast<std::int32_t>(magnitude), token};
        return {static_cast<std::int32_t>(negative ? so_far - magnitude : magnitude - 1), p};
    }

    [[noreturn]] void fail(std::string_view at, const std::string& message) const
    {
        fail_obj(file_, at, message);
    }

    [[noreturn]] void fail_corner(const char* begin) const
    {
        const std::string_view token(begin, static_cast<std::size_t>(token_end(begin) - begin));
        fail(token, fmt::format("'{}' is not a face corner; those are written p, p/t, p//n or p/t/n",
                                excerpt(token)));
    }

    const ObjFile& file_;
    std::string_view chunk_;
    ObjCounts next_; // what has been found so far, in the whole file
    ObjAttributes& found_;
    ObjChunk result_;
};

} // namespace

ObjCounts count_obj(std::string_view chunk)
{
    ObjCounts counts;
    const char* const end = chunk.data() + chunk.size();
    for (const char* p = chunk.data(); p != end; p = next_statement(p)) {
        p = skip_blanks(p);
        const std::string_view keyword = keyword_at(p);
        if (keyword == "v")
            ++counts.positions;
        else if (keyword == "vt")
            ++counts.uvs;
        else if (keyword == "vn")
            ++counts.normals;
    }
    return counts;
}

ObjChunk scan_obj(const ObjFile& file, std::string_view chunk, const ObjCounts& before, ObjAttributes& found)
{
    return Scanner(file, chunk, before, found).run();
}

} // namespace plumb
