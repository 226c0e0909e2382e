// SPDX-License-Identifier: MIT
// Runs at build time. Collects the doc block (`///` lines) directly above each `class X final : public Y` of the
// given plugin sources, and writes a C++ file that defines plugin_source_manual() (src/scene_file/manual.h).
//
//     make_manual manual_pages.cpp src/bsdfs/diffuse.cpp src/bsdfs/mirror.cpp ...

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

std::string read(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read '" + path + "'");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Takes white space and then one word (a class name, a keyword, punctuation in a row) off the front of the line.
std::string_view next_word(std::string_view& line)
{
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    const auto word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

// The X of a line that starts with `class X final`; otherwise nothing.
std::string_view plugin_class(std::string_view line)
{
    if (next_word(line) != "class") return {};
    const auto name = next_word(line);
    return next_word(line) == "final" ? name : std::string_view();
}

using Manual = std::map<std::string, std::string>; // class name -> text

void collect(const std::string& path, Manual& manual)
{
    const std::string text = read(path);
    std::string block;
    for (std::string_view rest = text; !rest.empty();) {
        const auto end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);

        const auto indent = line.find_first_not_of(" \t");
        if (indent != std::string_view::npos && line.substr(indent).starts_with("///")) {
            line.remove_prefix(indent + 3);
            if (line.starts_with(' ')) line.remove_prefix(1);
            block.append(line).append("\n");
            continue;
        }
        if (const std::string name(plugin_class(line)); !name.empty()) {
            if (!manual.emplace(name, block).second)
                throw std::runtime_error(path + ": there is a class '" + name + "' in another plugin file");
        }
        block.clear();
    }
}

// A raw string literal: any text, in pieces that every compiler takes (the standard promises 65536 characters).
std::string literal(std::string_view text)
{
    const std::string delimiter = "PLUMB_MANUAL";
    if (text.find(")" + delimiter + "\"") != std::string_view::npos)
        throw std::runtime_error("a doc block contains the delimiter '" + delimiter + "'");
    std::string result;
    do {
        const auto piece = text.substr(0, 16000);
        result.append("R\"").append(delimiter).append("(").append(piece).append(")").append(delimiter).append(
            "\"");
        text.remove_prefix(piece.size());
        if (!text.empty()) result += "\n        ";
    } while (!text.empty());
    return result;
}

std::string generated(const Manual& manual)
{
    std::string result =
        "// SPDX-License-Identifier: MIT\n"
        "// Written by make_manual; do not edit.\n"
        "#include \"scene_file/manual.h\"\n"
        "\n"
        "namespace plumb {\n"
        "\n"
        "std::string_view plugin_source_manual([[maybe_unused]] std::string_view class_name) {\n"
        "    using namespace std::string_view_literals;\n";
    for (const auto& [name, text] : manual)
        result += "    if (class_name == \"" + name + "\"sv)\n        return " + literal(text) + "sv;\n";
    return result + "    return {};\n"
                    "}\n"
                    "\n"
                    "}  // namespace plumb\n";
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 2) throw std::runtime_error("usage: make_manual OUTPUT SOURCE...");
    Manual manual;
    for (int i = 2; i < argc; ++i) collect(argv[i], manual);

    // An unchanged file keeps its time, so nothing is compiled again.
    const std::string output = argv[1], text = generated(manual);
    if (std::ifstream(output) && read(output) == text) return 0;
    std::ofstream file(output, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write '" + output + "'");
    return 0;
} catch (const std::exception& error) {
    std::cerr << "make_manual: " << error.what() << "\n";
    return 1;
}
