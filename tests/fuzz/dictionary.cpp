// SPDX-License-Identifier: MIT

// Prints the words that an input of a target is made of, as a dictionary for libFuzzer: fuzz_dictionary TARGET. Or the scene
// of the seeds: fuzz_dictionary --scene.

#include "cli/verbs.h"
#include "fuzz/small_scene.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/catalog.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <set>

using namespace plumb;

namespace {

using Words = std::set<std::string>;

void add_scene_words(Words& words)
{
    for (const TypeInfo& type : known_types()) {
        words.insert(fmt::format("<{} type=\"{}\">", type.kind, type.name));
        words.insert(fmt::format("</{}>", type.kind));
        for (const std::string_view name : parameters_in(type.manual))
            words.insert(fmt::format("name=\"{}\"", name));
    }
    for (const char* tag :
         {"integer",   "float",   "boolean", "string",   "point",  "vector", "color", "transform",
          "default",   "include", "scene",   "test",     "suite",  "render", "group", "define",
          "reference", "command", "image",   "replicas", "inputs", "mesh",   "ref"}) {
        words.insert(fmt::format("<{} ", tag));
        words.insert(fmt::format("</{}>", tag));
    }
    for (const char* word : {"value=\"",
                             "name=\"",
                             "id=\"a\"",
                             "type=\"",
                             "dialect=\"plumb\"",
                             "dialect=\"eth\"",
                             "<lookat origin=\"0,0,4\" target=\"0,0,0\" up=\"0,1,0\"/>",
                             "<matrix value=\"",
                             "<rotate axis=\"0 1 0\" angle=\"90\"/>",
                             "<scale value=\"",
                             "<translate value=\"",
                             "<![CDATA[",
                             "]]>",
                             "<!--",
                             "-->",
                             "<?xml?>",
                             "<!DOCTYPE [",
                             "&#x1b;",
                             "&amp;",
                             "${a}",
                             "$a",
                             "1e38",
                             "-1e-45",
                             "nan",
                             "inf",
                             "9223372036854775807",
                             "m.obj",
                             "i.xml",
                             "t.png",
                             "t.exr",
                             "*.xml",
                             "ttest",
                             "chi2test",
                             "references"})
        words.insert(word);
}

void add_option_words(Words& words)
{
    for (const Verb* verb : all_verbs()) {
        if (!verb->name.empty()) words.insert(std::string(verb->name));
        for (const OptionHelp& option : verb->options) words.insert(std::string(option.long_name()));
    }
    for (const char* word :
         {"a.xml", "a.exr", "b.png", "1/2", "3/3", "16x16", "0,0,4,4", "10m", "rmse=0.1", "a=b", "'", "\\",
          "0,0,4,4:0-8", " ", "--", "-", "path,path_mis", "18446744073709551615"})
        words.insert(word);
}

void add_ply_words(Words& words)
{
    for (const char* word : {"ply\n",
                             "format ascii 1.0\n",
                             "format binary_little_endian 1.0\n",
                             "format binary_big_endian 1.0\n",
                             "element vertex ",
                             "element face ",
                             "property float ",
                             "property uchar ",
                             "property double ",
                             "property list uchar int ",
                             "vertex_indices",
                             "nx",
                             "ny",
                             "nz",
                             "u",
                             "v",
                             "red",
                             "color_0",
                             "end_header\n",
                             "nan",
                             "1e18",
                             "-1",
                             "4294967296",
                             "\r\n"})
        words.insert(word);
}

void add_image_words(Words& words)
{
    for (const char* word : {"window ",
                             " of ",
                             "floats R G B",
                             "words ",
                             "levels 256",
                             "levels 65536",
                             "pixels",
                             "next",
                             "int ",
                             "text ",
                             "float ",
                             "list ",
                             "Y",
                             "variance.R",
                             "variance.G",
                             "variance.B",
                             "variance.Y",
                             "contributing",
                             "count",
                             "sum.R.0",
                             "squares.R.0",
                             "large.R.0",
                             "plumb:state 3",
                             "plumb:stateLayers albedo:R,G,B:mean object:id:id",
                             "plumb:stateSamples",
                             "plumb:stateRays",
                             "plumb:stateSeconds",
                             "plumb:stateLeftOut",
                             "plumb:scene",
                             "plumb:settings",
                             "plumb:set.define",
                             "plumb:set.seed",
                             "plumb:set.spp",
                             "plumb:arguments",
                             "plumb:inputs",
                             "plumb:inputHash",
                             "plumb:samplerTotal",
                             "plumb:samplesPerPixel",
                             "plumb:samplesTaken",
                             "plumb:seed",
                             "plumb:stop",
                             "plumb:workWanted",
                             "plumb:workPart",
                             "plumb:workBiases",
                             "plumb:workModel",
                             "plumb:workStop",
                             "plumb:workProgram",
                             "Software",
                             "1/3 by tiles",
                             "2147483647",
                             "-2147483648",
                             "1073741823",
                             "-1073741824"})
        words.insert(word);
}

std::string quoted(const std::string& word)
{
    std::string text = "\"";
    for (const char c : word)
        text += c == '"' || c == '\\' ? fmt::format("\\{}", c)
                : c < ' '             ? fmt::format("\\x{:02x}", c)
                                      : std::string(1, c);
    return text + "\"\n";
}

} // namespace

int main(int argc, char** argv)
{
    const std::string target = argc > 1 ? argv[1] : "";
    if (target == "--scene") std::fputs(fuzz::small_scene, stdout);
    Words words;
    if (target == "scene" || target == "suite") add_scene_words(words);
    if (target == "options" || target == "headers" || target == "merge") add_option_words(words);
    if (target == "headers" || target == "merge" || target == "state" || target == "compare")
        add_image_words(words);
    if (target == "ply") add_ply_words(words);
    if (target == "mtl")
        words = {"newmtl a\n", "Kd ",       "Ks ",   "Ns ",       "Ni ",    "Tf ", "d ", "illum 7",
                 "map_Kd ",    "-s 1 1 1 ", "norm ", "map_Bump ", "-bm 1 ", "Pr ", "Pm "};
    if (target == "obj")
        words = {"v ",   "vt ",  "vn ",      "f ",   "-1",    "1/1/1", "1//1",
                 "\r\n", "\\\n", "usemtl a", "1e38", "1e-40", "#"};
    for (const std::string& word : words) std::fputs(quoted(word).c_str(), stdout);
    return 0;
}
