// SPDX-License-Identifier: MIT

// Every element in every other one: it is taken, or the error says where it belongs, which is where it is taken.

#include "plumb/suite.h"
#include "scene_file/placement.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>

using namespace plumb;

namespace {

using Tags = std::set<std::string>;

// An element with what it needs, around `inner`.
std::string element(const std::string& tag, const std::string& inner)
{
    static const std::map<std::string, std::string> attributes = {
        {"mesh", "type='sphere'"},
        {"shape", "type='sphere'"},
        {"camera", "type='perspective'"},
        {"sampler", "type='independent'"},
        {"integrator", "type='path_mis'"},
        {"emitter", "type='area'"},
        {"bsdf", "type='diffuse'"},
        {"texture", "type='constant_color' name='albedo'"},
        {"rfilter", "type='box'"},
        {"transform", "name='toWorld'"},
        {"translate", "value='1,0,0'"},
        {"scale", "value='2,2,2'"},
        {"rotate", "axis='1,0,0' angle='1'"},
        {"lookat", "origin='0,0,1' target='0,0,0' up='0,1,0'"},
        {"matrix", "value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1'"},
        {"boolean", "name='x' value='true'"},
        {"integer", "name='x' value='1'"},
        {"float", "name='x' value='1'"},
        {"string", "name='x' value='1'"},
        {"point", "name='x' value='1,1,1'"},
        {"vector", "name='x' value='1,1,1'"},
        {"color", "name='x' value='1,1,1'"},
        {"include", "filename='part.xml'"},
        {"default", "name='x' value='1'"},
        {"define", "name='x' value='1'"},
        {"render", "scene='part.xml'"},
        {"group", "name='x'"},
        {"ref", "id='x'"},
    };
    const auto found = attributes.find(tag);
    const std::string rest = found == attributes.end() ? "" : " " + found->second;
    return "<" + tag + rest + ">" + inner + "</" + tag + ">";
}

// A file in which `parent` stands where it may, with `inner` in it.
std::string file_with(const std::string& parent, const std::string& inner)
{
    static const std::map<std::string, std::string> around = {
        {"mesh", "scene"},       {"shape", "scene"},      {"camera", "scene"},        {"sampler", "scene"},
        {"integrator", "scene"}, {"emitter", "scene"},    {"bsdf", "mesh"},           {"texture", "bsdf"},
        {"rfilter", "camera"},   {"transform", "mesh"},   {"translate", "transform"}, {"scale", "transform"},
        {"rotate", "transform"}, {"lookat", "transform"}, {"matrix", "transform"},    {"boolean", "mesh"},
        {"integer", "mesh"},     {"float", "mesh"},       {"string", "mesh"},         {"point", "mesh"},
        {"vector", "mesh"},      {"color", "mesh"},       {"include", "scene"},       {"default", "scene"},
        {"define", "suite"},     {"render", "suite"},     {"group", "suite"},         {"ref", "mesh"},
    };
    const auto found = around.find(parent);
    const std::string text = element(parent, inner);
    return found == around.end() ? text : file_with(found->second, text);
}

std::string complaints(const std::string& text)
{
    const TempFolder folder;
    folder.write("part.xml", text.starts_with("<suite") ? "<suite/>" : "<scene/>");
    const auto file = folder.write("main.xml", text);
    try {
        if (text.starts_with("<suite"))
            load_suite(file, {}, {});
        else
            load_scene(file);
    } catch (const SceneError& error) {
        return error.what();
    }
    return {};
}

std::string with_article_in_brackets(const std::string& tag)
{
    return (std::string("aeio").find(tag[0]) == std::string::npos ? "a <" : "an <") + tag + ">";
}

// "a <scene> cannot contain a <rfilter>" and what follows in the line; empty if it may.
std::string rejection_of(const std::string& parent, const std::string& child)
{
    const std::string text = complaints(file_with(parent, element(child, "")));
    const std::string start = fmt::format("{} cannot contain {}", with_article_in_brackets(parent),
                                          with_article_in_brackets(child));
    const std::size_t at = text.find(start);
    return at == text.npos ? "" : text.substr(at, text.find('\n', at) - at);
}

Tags tags_in_brackets(const std::string& text)
{
    Tags tags;
    for (std::size_t i = text.find('<'); i != text.npos; i = text.find('<', i + 1))
        tags.insert(text.substr(i + 1, text.find('>', i) - i - 1));
    return tags;
}

// Of the tags, those that take the child are where the others say that it belongs.
void check_language(const std::vector<std::string>& parents, const std::vector<std::string>& children)
{
    for (const std::string& child : children) {
        CAPTURE(child);
        std::map<std::string, std::string> rejections;
        Tags takers;
        for (const std::string& parent : parents) {
            rejections[parent] = rejection_of(parent, child);
            if (rejections[parent].empty()) takers.insert(parent);
        }
        CHECK_FALSE(takers.empty());
        for (const auto& [parent, text] : rejections) {
            if (text.empty()) continue;
            const std::string belongs = "; it belongs in ";
            REQUIRE_THAT(text, ContainsSubstring(belongs));
            const std::string where = text.substr(text.find(belongs) + belongs.size());
            INFO(text);
            CHECK((where == "the object whose parameter it is" || tags_in_brackets(where) == takers));
        }
    }
}

} // namespace

TEST_CASE("every element of a scene says where it belongs", "[unit][placement]")
{
    const std::vector<std::string> values = {"boolean", "integer", "float", "string",
                                             "point",   "vector",  "color"};
    const std::vector<std::string> operations = {"translate", "scale", "rotate", "lookat", "matrix"};
    const std::vector<std::string> objects = {"mesh",    "shape",   "camera",     "emitter", "bsdf",
                                              "texture", "rfilter", "integrator", "sampler"};
    std::vector<std::string> children = objects;
    children.insert(children.end(), operations.begin(), operations.end());
    children.insert(children.end(), {"include", "default", "ref"});
    std::vector<std::string> parents = children;
    parents.insert(parents.end(), {"scene", "transform"});
    parents.insert(parents.end(), values.begin(), values.end());
    check_language(parents, children);

    // Parameters belong in objects. In a scene, which is none, they are unknown parameters.
    std::vector<std::string> parameters = values;
    parameters.push_back("transform");
    for (const std::string& parameter : parameters) {
        for (const std::string& parent : parents) {
            CAPTURE(parameter, parent);
            const bool is_object = std::find(objects.begin(), objects.end(), parent) != objects.end();
            CHECK(rejection_of(parent, parameter).empty() == (is_object || parent == "scene"));
        }
    }
}

TEST_CASE("every element of a suite says where it belongs", "[unit][placement]")
{
    check_language({"suite", "group", "render", "define"},
                   {"render", "group", "define", "include", "default"});
}

TEST_CASE("the messages of misplaced elements", "[unit][placement]")
{
    CHECK(rejection_of("scene", "rfilter") == "a <scene> cannot contain a <rfilter>; it belongs in <camera>");
    CHECK(rejection_of("integrator", "sampler") ==
          "an <integrator> cannot contain a <sampler>; it belongs in <scene>");
    CHECK(rejection_of("scene", "bsdf") == "");
    CHECK(rejection_of("camera", "bsdf") ==
          "a <camera> cannot contain a <bsdf>; it belongs in <scene>, <mesh>, <shape> or <bsdf>");
    CHECK(rejection_of("bsdf", "emitter") ==
          "a <bsdf> cannot contain an <emitter>; it belongs in <scene>, <mesh> or <shape>");
    CHECK(rejection_of("camera", "lookat") ==
          "a <camera> cannot contain a <lookat>; it belongs in <transform>");
    CHECK(rejection_of("mesh", "include") == "a <mesh> cannot contain an <include>; it belongs in <scene>");
    CHECK(rejection_of("render", "render") ==
          "a <render> cannot contain a <render>; it belongs in <suite> or <group>");
    CHECK(rejection_of("color", "float") ==
          "a <color> cannot contain a <float>; it belongs in the object whose parameter it is");
    CHECK(rejection_of("scene", "scene") ==
          "a <scene> cannot contain a <scene>; a <scene> is the root of a file");
    CHECK(rejection_of("scene", "render") ==
          "a <scene> cannot contain a <render>; it belongs in <suite> or <group>");
    CHECK(rejection_of("suite", "mesh") == "a <suite> cannot contain a <mesh>; it belongs in <scene>");
}
