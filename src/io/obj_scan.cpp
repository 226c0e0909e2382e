// SPDX-License-Identifier: MIT

#include "io/obj_scan.h"

#include "io/obj_characters.h"
#include "io/obj_number.h"
#include "plumb/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumb {

namespace {

constexpr float largest_coordinate = 1e18f;
constexpr std::size_t batch_size = std::size_t{1} << 18; // bytes of faces that are passed on at once

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

// The indices of one kind: what they count, and the largest one that was seen.
struct IndexKind {
    const char* one;
    const char* many;
    std::int32_t largest = 0;
    std::string_view at = {};

    std::string counted(std::size_t count) const
    {
        return count == 0 ? fmt::format("no {}", many) : fmt::format("{} {}", count, count == 1 ? one : many);
    }
};

class Scanner {
public:
    Scanner(const std::string& file, std::string_view text, ObjFaceQueue& queue)
        : file_(file), text_(text), queue_(queue)
    {}

    ObjAttributes run()
    {
        const char* p = text_.data();
        const char* const end = p + text_.size();
        if (text_.starts_with("\xef\xbb\xbf")) p += 3; // a byte order mark
        while (p != end) p = scan_line(p);
        pass_on_block();
        pass_on_batch();
        if (face_count_ == 0) fail_without_faces();
        check_largest(position_indices_, found_.positions.size());
        check_largest(uv_indices_, found_.uvs.size());
        check_largest(normal_indices_, found_.normals.size());
        return std::move(found_);
    }

private:
    // Returns the start of the next line.
    const char* scan_line(const char* line)
    {
        const char* p = skip_blanks(line);
        if (is_line_end(*p)) return next_line(p);
        const std::string_view keyword(p, p[0] == 'v' && (p[1] == 't' || p[1] == 'n') ? 2 : 1);
        const char* rest = p + keyword.size();
        const bool complete = is_blank(*rest) || is_line_end(*rest);
        if (complete && keyword == "f") return scan_face(line, p, rest);
        if (complete && keyword == "v") {
            float x[3];
            rest = scan_numbers(p, rest, vertex_numbers, x);
            found_.positions.emplace_back(x[0], x[1], x[2]);
        } else if (complete && keyword == "vn") {
            float x[3];
            rest = scan_numbers(p, rest, normal_numbers, x);
            found_.normals.emplace_back(x[0], x[1], x[2]);
        } else if (complete && keyword == "vt") {
            float x[3] = {0.f, 0.f, 0.f};
            rest = scan_numbers(p, rest, uv_numbers, x);
            found_.uvs.emplace_back(x[0], x[1]);
        } else {
            rest = p; // anything else is skipped
        }
        return next_line(rest);
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
        if (read.verdict == ObjNumber::Verdict::good && std::abs(read.value) <= largest_coordinate)
            return read.value;
        if (token.ends_with('\\')) fail_continued(token);
        if (read.verdict == ObjNumber::Verdict::unreadable)
            fail(token,
                 fmt::format("'{}' is not a number; {} is written {}", excerpt(token), kind.name, kind.form));
        if (read.verdict == ObjNumber::Verdict::not_finite)
            fail(token, fmt::format("numbers must be finite, not '{}'", excerpt(token)));
        fail(token, fmt::format("numbers must lie between -1e18 and 1e18, not '{}'", excerpt(token)));
    }

    const char* scan_face(const char* line, const char* keyword, const char* p)
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

        // Extend the block if nothing came in between.
        if (line != block_next_ || block_bytes() >= batch_size) {
            pass_on_block();
            block_ = {{},
                      face_count_,
                      static_cast<std::int32_t>(found_.positions.size()),
                      static_cast<std::int32_t>(found_.uvs.size()),
                      static_cast<std::int32_t>(found_.normals.size())};
            block_begin_ = line;
        }
        ++face_count_;
        block_end_ = last;
        const char* const next = next_line(p);
        block_next_ = *p == '#' ? nullptr : next;
        return next;
    }

    // p, p/t, p//n or p/t/n.
    const char* scan_corner(const char* p)
    {
        const char* const begin = p;
        p = scan_index(begin, p, found_.positions.size(), position_indices_);
        if (*p == '/' && p[1] == '/') {
            p = scan_index(begin, p + 2, found_.normals.size(), normal_indices_);
        } else if (*p == '/') {
            p = scan_index(begin, p + 1, found_.uvs.size(), uv_indices_);
            if (*p == '/') p = scan_index(begin, p + 1, found_.normals.size(), normal_indices_);
        }
        if (!is_blank(*p) && !is_line_end(*p)) fail_corner(begin);
        return p;
    }

    const char* scan_index(const char* corner, const char* p, std::size_t count_so_far, IndexKind& kind) const
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
        if (negative && magnitude > static_cast<std::int64_t>(count_so_far))
            fail(token, fmt::format("{} index {} reaches back beyond the first: {} so far", kind.one,
                                    excerpt(token), kind.counted(count_so_far)));
        if (!negative && magnitude > kind.largest) {
            kind.largest = static_cast<std::int32_t>(magnitude);
            kind.at = token;
        }
        return p;
    }

    void check_largest(const IndexKind& kind, std::size_t count) const
    {
        if (kind.largest > static_cast<std::int64_t>(count))
            fail(kind.at, fmt::format("{} index {} is out of range: the file has {}", kind.one,
                                      excerpt(kind.at), kind.counted(count)));
    }

    std::size_t block_bytes() const { return static_cast<std::size_t>(block_end_ - block_begin_); }
    void pass_on_block()
    {
        if (!block_begin_) return;
        block_.text = std::string_view(block_begin_, block_bytes());
        batch_.push_back(block_);
        batch_bytes_ += block_.text.size();
        block_begin_ = block_end_ = block_next_ = nullptr;
        if (batch_bytes_ >= batch_size) pass_on_batch();
    }

    void pass_on_batch()
    {
        if (!batch_.empty()) queue_.push(std::exchange(batch_, {}));
        batch_bytes_ = 0;
    }

    [[noreturn]] void fail(std::string_view at, const std::string& message) const
    {
        const auto offset = static_cast<std::size_t>(at.data() - text_.data());
        throw FileError(SourceLocation::from_offset(file_, text_, offset, at.size()), message);
    }

    [[noreturn]] void fail_corner(const char* begin) const
    {
        const std::string_view token(begin, static_cast<std::size_t>(token_end(begin) - begin));
        if (token.ends_with('\\')) fail_continued(token);
        fail(token, fmt::format("'{}' is not a face corner; those are written p, p/t, p//n or p/t/n",
                                excerpt(token)));
    }

    [[noreturn]] void fail_continued(std::string_view token) const
    {
        fail(token, "lines continued with '\\' are not supported; write the line as one");
    }

    [[noreturn]] void fail_without_faces() const
    {
        if (text_.find('\0') != std::string_view::npos)
            throw Error(fmt::format("cannot read '{}': not a text file", file_));
        throw Error(fmt::format("cannot read '{}': no faces (lines that begin with 'f')", file_));
    }

    const std::string& file_;
    std::string_view text_;
    ObjFaceQueue& queue_;
    ObjAttributes found_;
    std::size_t face_count_ = 0;
    IndexKind position_indices_{"vertex", "vertices"};
    IndexKind uv_indices_{"texture coordinate", "texture coordinates"};
    IndexKind normal_indices_{"normal", "normals"};

    // The faces that were checked and not yet passed on.
    ObjFaceBlock block_;
    const char* block_begin_ = nullptr;
    const char* block_end_ = nullptr;
    const char* block_next_ = nullptr; // the line that would extend the block
    std::vector<ObjFaceBlock> batch_;
    std::size_t batch_bytes_ = 0;
};

} // namespace

ObjAttributes scan_obj(const std::string& file, std::string_view text, ObjFaceQueue& queue)
{
    struct Closer {
        ObjFaceQueue& queue;
        ~Closer() { queue.close(); }
    } const closer{queue};
    return Scanner(file, text, queue).run();
}

} // namespace plumb
