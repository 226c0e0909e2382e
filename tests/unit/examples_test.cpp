// SPDX-License-Identifier: MIT

// The examples in the manual are parts of scenes that can be loaded.

#include "plumb/image/image.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/document.h"
#include "support/catch.h"
#include "support/mesh_files.h"
#include "support/scene_text.h"

using namespace plumb;

namespace {

// The lines of a manual that are XML: indented by eight blanks, from the first < on.
std::string example_lines(std::string_view manual)
{
    std::string lines;
    while (!manual.empty()) {
        const std::size_t end = std::min(manual.find('\n'), manual.size());
        const std::string_view line = manual.substr(0, end);
        manual.remove_prefix(std::min(end + 1, manual.size()));
        if (line.starts_with("        ") && (!lines.empty() || line.find('<') == 8))
            lines.append(line).append("\n");
    }
    return lines;
}

// The objects in it, each with all that is inside.
std::vector<std::string> examples_in(const std::string& lines)
{
    const std::string text = "<scene>" + lines + "</scene>";
    Diagnostics diagnostics;
    const auto root = parse_document("manual.xml", text, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.all()) FAIL(diagnostic.text());
    std::vector<std::string> examples;
    for (std::size_t i = 0; i < root->children.size(); ++i) {
        const bool is_last = i + 1 == root->children.size();
        const std::size_t begin = root->children[i].tag_offset;
        const std::size_t end =
            is_last ? text.size() - std::string_view("</scene>").size() : root->children[i + 1].tag_offset;
        examples.push_back(text.substr(begin, end - begin));
    }
    return examples;
}

// A file of that name which can be read.
void make_file(const std::filesystem::path& file)
{
    std::filesystem::create_directories(file.parent_path());
    if (const std::string mesh = test::pyramid_file(file); !mesh.empty()) {
        std::ofstream(file, std::ios::binary) << mesh;
        return;
    }
    write_image(file, Image(2, 2));
}

void make_files(const Element& element, const std::filesystem::path& directory)
{
    const std::string name = element.value("name");
    if (element.tag == "string" && (name == "filename" || name == "filepath"))
        make_file(directory / element.value("value"));
    for (const Element& child : element.children) make_files(child, directory);
}

// A scene of dialect plumb with the object where it belongs.
std::string scene_with(const std::string& kind, const std::string& object, bool is_area)
{
    const std::string integrator = "<integrator type='normals'/>";
    const auto in_shape = [](const std::string& inner) {
        return "<shape type='sphere'>" + inner + "</shape>";
    };
    std::string body = object;
    if (kind == "bsdf" || is_area) body = in_shape(object);
    if (kind == "texture") body = in_shape("<bsdf type='diffuse'>" + object + "</bsdf>");
    if (kind == "rfilter")
        return "<scene dialect='plumb'>" + integrator + "<camera type='perspective'>" + object +
               "</camera></scene>";
    return "<scene dialect='plumb'>" + body + (kind == "integrator" ? "" : integrator) +
           (kind == "camera" ? "" : test::camera) + "</scene>";
}

} // namespace

TEST_CASE("every example of the manual is a part of a scene that loads", "[unit][catalog]")
{
    for (const TypeInfo& type : known_types()) {
        CAPTURE(type.kind, type.name);
        const auto examples = examples_in(example_lines(type.manual));
        CHECK_FALSE(examples.empty());
        for (const std::string& example : examples) {
            CAPTURE(example);
            const TempDirectory directory;
            Diagnostics diagnostics;
            const auto scene = parse_document("manual.xml", "<scene>" + example + "</scene>", diagnostics);
            REQUIRE(scene);
            REQUIRE(scene->children.size() == 1);
            const Element& element = scene->children[0];
            make_files(element, directory.path());
            std::string object = example;
            std::string kind(type.kind);
            // An example may show its type where it stands, a lamp in its shape say.
            if (element.tag == "mesh" || element.tag == "shape") kind = "shape";
            if (element.tag == "bsdf") kind = "bsdf";
            if (element.tag == "camera") kind = "camera";
            if (kind == "texture") { // whatever it is the texture of
                const std::size_t name = object.find("name=\"");
                REQUIRE(name != std::string::npos);
            }
            const bool is_area = element.tag == "emitter" && element.value("type") == "area";
            const LoadedScene loaded =
                load_scene(directory.write("scene.xml", scene_with(kind, object, is_area)));
            CHECK(loaded.dialect.name == DialectName::plumb);
            CHECK(loaded.warnings.empty());
        }
    }
}
