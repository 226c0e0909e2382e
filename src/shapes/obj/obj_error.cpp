// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_error.h"

#include "plumb/base/error.h"
#include "shapes/obj/obj_characters.h"

namespace plumb {

void fail_obj(const ObjFile& file, std::string_view at, const std::string& message)
{
    const char* line = file.text.data();
    int number = 1;
    for (const char* next = next_line(line); next <= at.data(); next = next_line(line)) {
        line = next;
        ++number;
    }
    const std::string_view text(line, static_cast<std::size_t>(line_end(line) - line));
    const auto offset = static_cast<std::size_t>(at.data() - line);
    throw FileError(SourceLocation::from_line(file.name, number, text, offset, at.size()), message);
}

} // namespace plumb
