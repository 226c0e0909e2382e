// SPDX-License-Identifier: MIT
#include "scene_file/document.h"

#include "base/regular_file.h"
#include "scene_file/foreign_files.h"
#include "scene_file/xml_scan.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace plumb {

namespace {

// Turns pugixml's tree into ours. pugixml parses a copy of the text in place, so that every name and value that it
// hands out lies in that copy at the offset at which it stands in the file.
class Reader {
public:
    Reader(std::shared_ptr<const TextFile> file, const char* buffer, Diagnostics& diagnostics)
        : file_(std::move(file)), buffer_(buffer), diagnostics_(diagnostics)
    {}

    // Recursion ends: scan_xml() has counted levels.
    Element read(const pugi::xml_node& node) const
    {
        Element element;
        element.tag = node.name();
        element.file = file_;
        element.tag_offset = offset_of(node.name()) - 1;
        for (const pugi::xml_attribute& attribute : node.attributes()) add(element, attribute);
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element)
                element.children.push_back(read(child));
            else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
                reject_text(child.value());
        }
        return element;
    }

private:
    std::size_t offset_of(const char* text) const { return static_cast<std::size_t>(text - buffer_); }

    void add(Element& element, const pugi::xml_attribute& source) const
    {
        Attribute attribute;
        attribute.name = source.name();
        attribute.value = source.value();
        attribute.name_offset = offset_of(source.name());
        attribute.value_offset = offset_of(source.value());
        const std::string& text = file_->text();
        const std::size_t end = text.find(text[attribute.value_offset - 1], attribute.value_offset);
        attribute.value_length = end - attribute.value_offset;
        attribute.verbatim = attribute.value_length == attribute.value.size();
        if (element.attribute(attribute.name))
            diagnostics_.error(element.name_place(attribute),
                               fmt::format("attribute '{}' is given twice", attribute.name));
        else
            element.attributes.push_back(std::move(attribute));
    }

    void reject_text(std::string_view text) const
    {
        const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
        const std::size_t end = text.find_first_of(" \t\r\n", start);
        const std::string_view word = text.substr(start, end == text.npos ? end : end - start);
        diagnostics_.error(file_->place(offset_of(word.data()), word.size()),
                           fmt::format("unexpected text '{}'; a scene file consists of elements and comments",
                                       word.substr(0, 40)));
    }

    std::shared_ptr<const TextFile> file_;
    const char* buffer_;
    Diagnostics& diagnostics_;
};

// Files that XML parsers would read, or misread, in surprising ways.
std::string_view unreadable_encoding(std::string_view text)
{
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        return "the file is UTF-16 text; save it as UTF-8";
    if (text.starts_with("\x1F\x8B")) return "the file is compressed; unpack it first";
    return {};
}

bool is_object_of_mitsuba(std::string_view tag)
{
    constexpr std::string_view tags[] = {"sensor", "film",       "rfilter", "sampler", "bsdf",
                                         "shape",  "integrator", "texture", "emitter"};
    return std::find(std::begin(tags), std::end(tags), tag) != std::end(tags);
}

} // namespace

TextFile::TextFile(std::filesystem::path path, std::string text, bool hides_lines)
    : path_(std::move(path)), text_(std::move(text)), hides_lines_(hides_lines)
{
    line_starts_.push_back(0);
    for (std::size_t i = text_.find('\n'); i != text_.npos; i = text_.find('\n', i + 1))
        line_starts_.push_back(i + 1);
}

SourceLocation TextFile::place(std::size_t offset, std::size_t length) const
{
    offset = std::min(offset, text_.size());
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const std::size_t start = *(after - 1), end = after == line_starts_.end() ? text_.size() : *after;
    auto at =
        SourceLocation::from_line(path_.string(), static_cast<int>(after - line_starts_.begin()),
                                  std::string_view(text_).substr(start, end - start), offset - start, length);
    at.hides_line = hides_lines_;
    return at;
}

const Attribute* Element::attribute(std::string_view name) const
{
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

std::string Element::value(std::string_view name) const
{
    const Attribute* found = attribute(name);
    return found ? found->value : std::string();
}

const Element* Element::child_named(std::string_view name) const
{
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const Element& child) { return child.value("name") == name; });
    return found == children.end() ? nullptr : &*found;
}

Element* Element::child_named(std::string_view name)
{
    return const_cast<Element*>(std::as_const(*this).child_named(name));
}

// Recursion ends: parse_document().
std::size_t Element::count_parts() const
{
    std::size_t count = 1 + attributes.size();
    for (const Element& child : children) count += child.count_parts();
    return count;
}

std::string Element::written_tag() const
{
    return written && !written->tag.empty() ? written->tag : tag;
}

std::string Element::written_type() const
{
    return written && !written->type.empty() ? written->type : value("type");
}

std::string Element::written_name() const
{
    return written && !written->name.empty() ? written->name : value("name");
}

SourceLocation Element::place() const
{
    return file->place(tag_offset, written_tag().size() + 1);
}

SourceLocation Element::name_place(const Attribute& attribute) const
{
    return file->place(attribute.name_offset, attribute.name.size());
}

SourceLocation Element::value_place(const Attribute& attribute) const
{
    return file->place(attribute.value_offset, attribute.value_length);
}

SourceLocation Element::id_place() const
{
    const Attribute* id = attribute("id");
    return id ? value_place(*id) : place();
}

SourceLocation Element::part_place(const Attribute& attribute, std::size_t begin, std::size_t length) const
{
    return attribute.verbatim ? file->place(attribute.value_offset + begin, length) : value_place(attribute);
}

std::string read_text(const std::filesystem::path& path)
{
    std::error_code status;
    if (std::filesystem::is_directory(path, status))
        throw Error(fmt::format("'{}' is a directory, not a scene file", path.string()));
    if (!std::filesystem::exists(path, status))
        throw Error(fmt::format("file '{}' does not exist", path.string()));
    const RegularFile file(path);
    if (file.size() > max_text_size)
        throw Error(
            fmt::format("'{}' is larger than {} MiB: not a scene file", path.string(), max_text_size >> 20));
    std::string text(file.size(), '\0');
    file.read(0, text);
    return text;
}

std::optional<Element> parse_document(const std::filesystem::path& path, std::string text,
                                      Diagnostics& diagnostics, bool objects)
{
    const std::string_view tag = root_tag(text);
    const bool is_ours =
        tag == "scene" || tag == "test" || tag == "suite" || (objects && is_object_of_mitsuba(tag));
    // The text moves and the tag with it, so this comes before.
    Element stranger;
    stranger.tag = tag;
    stranger.tag_offset = tag.empty() ? 0 : static_cast<std::size_t>(tag.data() - text.data()) - 1;
    const auto file = std::make_shared<const TextFile>(path, std::move(text), !is_ours);
    const auto fail = [&](std::size_t offset, std::size_t length, std::string_view message) {
        diagnostics.error(file->place(offset, length), std::string(message));
        return std::nullopt;
    };
    if (const std::string_view message = unreadable_encoding(file->text()); !message.empty())
        return fail(0, 1, message);
    if (auto content = foreign_content(file->text())) { // the line may be binary
        diagnostics.error({.file = path.string(), .line_text = {}}, *std::move(content));
        return std::nullopt;
    }
    if (!is_ours && !stranger.tag.empty()) {
        stranger.file = file;
        return stranger;
    }
    if (const auto error = scan_xml(file->text(), {}))
        return fail(error->offset, error->length, error->message);

    std::string buffer = file->text();
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer_inplace(buffer.data(), buffer.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) return fail(static_cast<std::size_t>(result.offset), 1, "this is not XML");
    return Reader(file, buffer.data(), diagnostics).read(document.document_element());
}

} // namespace plumb
