// SPDX-License-Identifier: MIT
#include "scene_file/foreign_files.h"

#include "scene_file/mitsuba_words.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

struct Beginning {
    std::string_view bytes;
    std::string_view kind;
};

constexpr Beginning images[] = {
    {"\x76\x2f\x31\x01", "OpenEXR"}, {"\x89PNG", "PNG"},         {"\xff\xd8\xff", "JPEG"},
    {"#?RADIANCE", "Radiance HDR"},  {"#?RGBE", "Radiance HDR"}, {"PF\n", "PFM"},
};
constexpr Beginning others[] = {
    {"PK\x03\x04", "a zip archive; unpack it first"},
    {"glTF", "a glTF scene; Plumb reads its own XML scenes only"},
    {"ply\n", "a PLY mesh; a scene refers to it as an .obj file: <mesh type=\"obj\">"},
    {"ply\r", "a PLY mesh; a scene refers to it as an .obj file: <mesh type=\"obj\">"},
};

// Words that the lines of files begin with; the first line that is neither empty nor a comment decides.
constexpr std::string_view pbrt_words[] = {
    "LookAt",  "Camera", "Film",        "Sampler", "Integrator",  "WorldBegin", "AttributeBegin", "Scale",
    "Include", "Option", "PixelFilter", "Texture", "Accelerator", "Transform",  "ColorSpace"};
constexpr std::string_view obj_words[] = {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"};

std::string_view first_word(std::string_view text)
{
    while (!text.empty()) {
        const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size()));
        const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
        if (begin < line.size() && line[begin] != '#')
            return line.substr(begin, std::min(line.find_first_of(" \t\r", begin), line.size()) - begin);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return {};
}

template <std::size_t count>
bool is_in(const std::string_view (&words)[count], std::string_view word)
{
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

// What is in Mitsuba's scenes and never in ours.
bool is_of_mitsuba(const Element& element)
{
    return element.tag == "sensor" || element.tag == "film";
}

// Recursion ends: elements are nested at most max_nesting levels.
const Element* find_mitsuba(const Element& element)
{
    if (is_of_mitsuba(element)) return &element;
    for (const Element& child : element.children)
        if (const Element* found = find_mitsuba(child)) return found;
    return nullptr;
}

} // namespace

std::optional<std::string> foreign_content(std::string_view text)
{
    for (const Beginning& image : images)
        if (text.starts_with(image.bytes))
            return fmt::format(
                "this is an image ({}), not a scene; 'renderer info' prints what is in its header",
                image.kind);
    for (const Beginning& other : others)
        if (text.starts_with(other.bytes)) return fmt::format("this is {}", other.kind);
    const std::string_view word = first_word(text);
    if (is_in(pbrt_words, word)) return "this is a scene of pbrt; Plumb reads its own XML scenes only";
    if (is_in(obj_words, word))
        return "this is an OBJ mesh; a scene refers to it: <mesh type=\"obj\"> with <string "
               "name=\"filename\" value=\"...\"/>";
    if (word.starts_with('{')) return "this is JSON; Plumb reads its own XML scenes only";
    return {};
}

std::optional<Diagnostic> foreign_scene(const Element& root)
{
    if (root.tag != "scene" || root.attribute("dialect")) return {};
    if (is_mitsuba_scene(root))
        return Diagnostic{
            Severity::error, root.name_place(*root.attribute("version")),
            fmt::format("this is a scene of Mitsuba {}, which one of Plumb's own scenes cannot include",
                        root.value("version"))};
    const Element* found = find_mitsuba(root);
    if (!found) return {};
    return Diagnostic{Severity::error, found->place(),
                      "this is a scene of Mitsuba, but its root has no version: <scene version=\"3.0.0\">"};
}

} // namespace plumb
