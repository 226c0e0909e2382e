// SPDX-License-Identifier: MIT
#pragma once

// What in a file tells of a course: a pure function of its elements.

#include "plumb/model/dialect.h"
#include "scene_file/document.h"

#include <string>
#include <vector>

namespace plumb {

// How much a mark says. Nearly every name that course files use is one of Plumb's own, which its manual teaches to
// everybody; so a name alone tells nothing of who wrote a file.
enum class MarkWeight {
    name, // a type: seconds a parameter
    hint, // a type that hardly anybody but a course uses, or two types together: decides with another hint
    parameter, // a parameter that one course's code reads, and Plumb's too: decides with a second mark
    sign,      // what only one course's files have: decides
};

struct Mark {
    unsigned courses = 0; // bits of courses whose files have it
    MarkWeight weight = MarkWeight::name;
    std::string name; // "'path_nee'": marks of one name are one mark
    std::string text; // the name and its place, "'path_nee' (line 4)"
};

// Bits for Mark::courses; plumb's for what no course has.
constexpr unsigned course_bit(DialectName name)
{
    return 1U << static_cast<unsigned>(name);
}
inline constexpr unsigned plumb_files = course_bit(DialectName::plumb);

// Those of a <scene> or <test>, each once. beside: of a file in the directory of the one that is read, whose name the
// texts then have.
std::vector<Mark> find_marks(const Element& root, bool beside);

// Adds what is new in `more`.
void add_marks(std::vector<Mark>& marks, const std::vector<Mark>& more);

} // namespace plumb
