// SPDX-License-Identifier: MIT
#pragma once

// A scene file as text and as a tree, with the place of every tag, attribute and value. document.cpp is the only user
// of pugixml.

#include "plumb/base/error.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

// The text of a file, and where its lines start.
class TextFile {
public:
    // hides_lines: places do not show their lines.
    TextFile(std::filesystem::path path, std::string text, bool hides_lines);

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path directory() const { return path_.parent_path(); }
    const std::string& text() const { return text_; }
    SourceLocation place(std::size_t offset, std::size_t length) const;

private:
    std::filesystem::path path_;
    std::string text_;
    bool hides_lines_;
    std::vector<std::size_t> line_starts_;
};

struct Attribute {
    std::string name;
    std::string value;
    std::size_t name_offset = 0;
    std::size_t value_offset = 0;
    std::size_t value_length = 0; // in the file
    bool verbatim = true;         // value is exactly what stands in the file: no entities, no variables
    bool broken = false;          // value is not what was meant, which has been reported
};

// What the file says, where the dialect's words have been replaced by ours (vocabulary.h). Empty: ours.
struct Written {
    std::string tag;
    std::string type;
    std::string name;
};

struct Element {
    std::string tag;
    std::shared_ptr<const TextFile> file;
    std::size_t tag_offset = 0; // of '<'
    std::vector<Attribute> attributes;
    std::vector<Element> children;
    std::shared_ptr<const Written> written; // null: all as it stands in the file

    const Attribute* attribute(std::string_view name) const; // or null
    std::string value(std::string_view name) const;          // of an attribute; empty without it
    const Element* child_named(
        std::string_view name) const; // the first with such an attribute `name`, or null
    Element* child_named(std::string_view name);
    std::size_t count_parts() const; // elements, itself included, and attributes

    // The tag and the attributes type and name as the file has them, for messages.
    std::string written_tag() const;
    std::string written_type() const;
    std::string written_name() const;

    // Places, of one of this element's attributes where there is a parameter. They copy text, so they are made when
    // they are needed.
    SourceLocation place() const;
    SourceLocation name_place(const Attribute& attribute) const;
    SourceLocation value_place(const Attribute& attribute) const;
    SourceLocation id_place() const; // of the value of its id, or its own
    // Of a part of the value; of all of it where it is not verbatim.
    SourceLocation part_place(const Attribute& attribute, std::size_t begin, std::size_t length) const;
};

inline constexpr std::size_t max_text_size = std::size_t{256} << 20;

// The bytes of a regular file. Throws Error.
std::string read_text(const std::filesystem::path& path);

// The root element. What is wrong with the XML goes to `diagnostics`; nothing where no tree could be made. Elements are
// nested at most XmlLimits().depth levels. Of a file that does not begin with <scene>, <test> or <suite> nothing is
// read or shown but its first tag: whoever wrote the scene that includes it may have no right to see it. objects: it may
// also begin with an object, as files that Mitsuba's scenes include.
std::optional<Element> parse_document(const std::filesystem::path& path, std::string text,
                                      Diagnostics& diagnostics, bool objects = false);

} // namespace plumb
